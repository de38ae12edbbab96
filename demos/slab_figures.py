# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures of the face slabs, like those of the paper, and files for ParaView."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

import contactx as cx
from dolfinx import fem

import plot
from slab_results import faces_of_joint, middle_joint, opening, profile
from slab_scene import CONCRETE, CUSHION, Array, Scene

PEAK = (10.0, 25.0)  # the paper's peak of scheme 2: mm, MPa


def _box(scene: Scene, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Surroundings of the middle joint at the lower end, m; of one slab those of its middle."""
    edge = scene.model.edges[middle_joint(scene)] if scene.joints else 0.0
    thickness = float(scene.model.thickness_at(0.0))
    return (edge - width, -1.0, -width / 2), (edge + width, 1.0, 1.01 * thickness)


def _camera(scene: Scene) -> tuple[float, float, float]:
    """A slice is seen from its front."""
    return (0.0, -1.0, 0.0) if scene.model.rows == 1 else (0.55, -1.5, 0.9)


def mesh(scene: Scene, path: Path) -> None:
    """Draw the mesh with a close-up of the joint."""
    V = scene.u.function_space
    young = fem.Function(scene.sigma.values.function_space)
    young.x.array[:] = CONCRETE / 1000
    young.x.array[scene.nodes_of(0)] = CUSHION / 1000
    plot.deformed_bodies(
        fem.Function(V),
        young,
        path,
        title="Mesh (lengths in metres)",
        label="Young's modulus / GPa",
        clim=(0.0, 75.0),  # light enough for the lines of the mesh
        camera=_camera(scene),
        box=_box(scene, 1.0),
    )


def deformed(scene: Scene, path: Path, *, scale: float = 1.0, thickness: float = 10.0) -> None:
    """Draw the deformed bodies, coloured by the stress along the dam."""
    compression = fem.Function(scene.sigma.values.function_space)
    compression.x.array[:] = -scene.sigma.update()
    plot.deformed_bodies(
        scene.u,
        compression,
        path,
        title="Deformed slabs (lengths in metres)",
        label="compression along the dam / MPa",
        scale=scale,
        stretch=(1.0, 1.0, thickness),
        camera=_camera(scene),
        box=_box(scene, 1.0),
    )


def joint_opening(scene: Scene, stem: Path) -> list[Path]:
    """Draw the joint's opening over the thickness at mid length, and along the slope."""
    left, right = faces_of_joint(scene, scene.section())
    files = [stem.with_name(stem.name + "_opening.png")]
    plot.curves(
        {"computed": (1000 * opening(scene, left, right), scene.x[left, 2])},
        {},
        files[0],
        labels=("opening of the joint / mm", "height above the slab's bottom / m"),
        title="Opening of the joint at mid length",
        joined=True,
    )
    if scene.model.rows > 1:
        left, right = faces_of_joint(scene)
        y, z = scene.x[left, 1], scene.x[left, 2]
        share = z / scene.model.thickness_at(y)
        wide = 1000 * opening(scene, left, right)
        rows = {"bottom": 0.0, "top": 1.0}
        files.append(stem.with_name(stem.name + "_opening_slope.png"))
        plot.curves(
            {
                name: (y[np.isclose(share, at)], wide[np.isclose(share, at)])
                for name, at in rows.items()
            },
            {},
            files[1],
            labels=("distance up the slope / m", "opening of the joint / mm"),
            title="Opening of the joint along the slope",
            joined=True,
        )
    return files


def joint_pressure(scene: Scene, stem: Path) -> list[Path]:
    """Draw what presses the middle joint: over the thickness at mid length, and as a map."""
    label, height = "pressure, compression / MPa", "height above the slab's bottom / m"
    files = [stem.with_name(stem.name + "_pressure.png")]
    plot.curves(
        profile(scene, -scene.sigma.update()),
        {},
        files[0],
        labels=(label, height),
        title="What presses the joint at mid length",
        joined=True,
    )
    if scene.model.rows > 1:
        files.append(stem.with_name(stem.name + "_band.png"))
        contact = scene.joints[middle_joint(scene) - 1]
        nodes = contact.slave_nodes
        ((_, facets),) = contact.slave.facet_nodes(scene.u.function_space).groups()
        halves = facets[:, [[0, 1, 2], [1, 3, 2]]].reshape(-1, 3)
        plot.nodal_map(
            scene.x[nodes][:, 1:],
            contact.pressure.x.array[nodes],
            files[1],
            labels=("distance up the slope / m", height),
            title="Contact pressure in the joint",
            label="contact.pressure / MPa",
            triangles=np.searchsorted(nodes, halves),
        )
    return files


def top_stress(scene: Scene, path: Path) -> None:
    """Draw the stress along the dam on the top at mid length across the joint."""
    stress, curves = -scene.sigma.update(), {}
    left = middle_joint(scene)
    for body, name in ((left, "left slab"), (left + 1, "right slab")):
        top = scene.at(body, y=scene.section(), top=True)
        curves[name] = (scene.x[top, 0], stress[top])
    edge = float(scene.model.edges[left])
    plot.curves(
        curves,
        {},
        path,
        labels=("place along the dam / m", "compression along the dam / MPa"),
        title="Stress on the slabs' top at mid length",
        joined=True,
        close_up=(edge - 1.0, edge + 1.0),
    )


def statuses(scene: Scene, path: Path) -> None:
    """Draw the status of the cushion contact's slave nodes."""
    nodes = np.concatenate([contact.slave_nodes for contact in scene.cushion_contacts])
    status = np.concatenate(
        [contact.status.x.array[contact.slave_nodes] for contact in scene.cushion_contacts]
    )
    plot.nodal_map(
        scene.x[nodes][:, :2],
        status,
        path,
        labels=("place along the dam / m", "distance up the slope / m"),
        title="Status of the cushion's contact",
        kinds=plot.STATUS_NAMES,
    )


def pushed(curves: Mapping[str, tuple[Array, Array]], path: Path) -> None:
    """Draw the largest stress over the push, with the paper's peak.

    Args:
        curves: Push of each side, mm, and largest stress, MPa, by the name of the mesh.
        path: The image file.
    """
    plot.curves(
        curves,
        {},
        path,
        labels=("push of each side / mm", "largest compression along the dam / MPa"),
        title="Slabs pushed together",
        joined=True,
        marks={"peak in the paper": PEAK},
    )


def write(scene: Scene, path: Path) -> None:
    """Write displacement, stress and the contacts' fields for ParaView."""
    scene.sigma.update()
    contacts = scene.problem.contacts
    with cx.VTKOutput(path, scene.u, contacts, fields=[scene.sigma.values]) as output:
        output.write(1.0)


def draw(scene: Scene, stem: Path) -> list[Path]:
    """Draw all pictures of a solved scene and write the file for ParaView.

    Args:
        scene: Scene; of one slab alone there are no pictures of a joint.
        stem: Folder and first part of the files' names.

    Returns:
        The files.
    """

    def named(end: str) -> Path:
        files.append(stem.with_name(stem.name + end))
        return files[-1]

    files: list[Path] = []
    mesh(scene, named("_mesh.png"))
    deformed(scene, named("_deformed.png"))
    deformed(scene, named("_joint.png"), scale=100.0, thickness=1.0)
    statuses(scene, named("_status.png"))
    write(scene, named(".pvd"))
    if scene.joints:
        top_stress(scene, named("_stress.png"))
        files += joint_pressure(scene, stem)
        files += joint_opening(scene, stem)
    return files
