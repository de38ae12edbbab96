# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is read off face slabs: rotation, opening, stresses, and whether the laws hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from meshes import block_tag
from slab_scene import Array, Scene


@dataclass(frozen=True)
class Measured:
    """Results at the joint nearest to the middle of the row; compression is positive.

    Attributes:
        rotation: Mean rotation of the two slabs at mid length, degrees.
        settled: Difference of the normal displacements of a slab's two sides there, their mean, m.
        opening: Distance of the slabs' bottom edges at mid length, m.
        widest: Largest distance of the joint's faces, m.
        stress: Largest stress along the dam of the section at mid length, MPa.
        largest: The same of all slabs, MPa.
        pressure: Largest contact pressure of the joint at mid length, MPa.
        crushed: The same of the whole joint, MPa.
        multiplier: Largest multiplier at mid length, MPa.
        means: Mean stresses at mid length that the largest one may be compared with, MPa, by name.
    """

    rotation: float
    settled: float
    opening: float
    widest: float
    stress: float
    largest: float
    pressure: float
    crushed: float
    multiplier: float
    means: Mapping[str, float]

    @property
    def factors(self) -> dict[str, float]:
        """Largest stress of the section at mid length over each of the means."""
        return {name: self.stress / mean for name, mean in self.means.items()}


@dataclass(frozen=True)
class Laws:
    """How well the laws hold.

    Attributes:
        balance: Largest difference of the contact forces on a slab and its water load along the
            normal, relative to the load.
        penetration: Deepest penetration, m; 0 if there is none.
        coulomb: Largest excess of |t| over mu p at a node, relative to the largest pressure.
    """

    balance: float
    penetration: float
    coulomb: float


def _mean(values: Array, places: Array) -> float:
    """Mean of a function that is linear between places."""
    order = np.argsort(places)
    length = float(np.ptp(places))
    return float(np.trapezoid(values[order], places[order]) / length)


def middle_joint(scene: Scene) -> int:
    """Number of the slab to the left of the joint that is nearest to the middle; at least 2 slabs.

    Raises:
        ValueError: If there is one slab only.
    """
    if scene.model.slabs < 2:
        raise ValueError("a row of one slab has no joint; give at least two slabs")
    return scene.model.slabs // 2


def rotation(scene: Scene) -> float:
    """Mean rotation at mid length of the slabs beside the middle joint, degrees."""
    return _turned(scene, _settled(scene))


def _turned(scene: Scene, settled: Array) -> float:
    """Mean rotation, degrees, of slabs whose sides have settled apart, m."""
    return float(np.degrees(np.mean(np.arctan(settled / scene.model.width))))


def _settled(scene: Scene) -> Array:
    """How much farther the slabs beside the middle joint have settled there than outside, m."""
    left = middle_joint(scene)
    edges, y, w = scene.model.edges, scene.section(), scene.moved()[:, 2]
    lower = []
    for body, joint, outer in ((left, left, left - 1), (left + 1, left, left + 1)):
        inner, far = (scene.at(body, x=edges[i], y=y, top=True) for i in (joint, outer))
        lower.append((w[far] - w[inner]).item())
    return np.array(lower)


def opening(scene: Scene, left: Array, right: Array) -> Array:
    """Distance of nodes of two slabs that face each other, m."""
    x = scene.x[:, 0] + scene.moved()[:, 0]
    return np.asarray(x[right] - x[left])


def faces_of_joint(scene: Scene, y: float | None = None) -> tuple[Array, Array]:
    """Nodes of the two faces of the middle joint, in the same order, at mid length or another y."""
    left, pair = middle_joint(scene), []
    for body, side in ((left, "x1"), (left + 1, "x0")):
        nodes = scene.nodes_on(block_tag(body, side))
        if y is not None:
            nodes = nodes[np.isclose(scene.x[nodes, 1], y, atol=1e-6)]
        pair.append(nodes[np.lexsort((scene.x[nodes, 2].round(9), scene.x[nodes, 1].round(9)))])
    return pair[0], pair[1]


def profile(scene: Scene, stress: Array) -> dict[str, tuple[Array, Array]]:
    """What presses the middle joint at mid length, MPa, and height above the bottom, m, by name.

    Args:
        scene: A solved scene of at least two slabs.
        stress: Compression along the dam at the nodes, MPa, shape (num_nodes,).
    """
    contact = scene.joints[middle_joint(scene) - 1]
    left, _ = faces_of_joint(scene, scene.section())
    multiplier = np.zeros(len(scene.x))
    multiplier[contact.slave_nodes] = contact.discrete.nodes.pressure
    height = scene.x[left, 2]
    return {
        "multiplier": (multiplier[left], height),
        "contact.pressure": (contact.pressure.x.array[left], height),
        "compression beside it": (stress[left], height),
    }


def measure(scene: Scene) -> Measured:
    """Read the results off a solved scene; of one slab alone what needs a joint is NaN."""
    stress, y = -scene.sigma.update(), scene.section()
    nodes = scene.nodes_of_slabs()
    here = nodes[np.isclose(scene.x[nodes, 1], y, atol=1e-6)]
    angle = settled = wide = widest = pressure = crushed = multiplier = np.nan
    means: dict[str, float] = {}
    if scene.model.slabs > 1:
        of_both = _settled(scene)
        angle, settled = _turned(scene, of_both), float(np.mean(of_both))
        wide = float(opening(scene, *(face[0] for face in faces_of_joint(scene, y))))
        widest = float(opening(scene, *faces_of_joint(scene)).max())
        pressing = profile(scene, stress)
        pressure = float(pressing["contact.pressure"][0].max())
        multiplier = float(pressing["multiplier"][0].max())
        crushed = float(scene.joints[middle_joint(scene) - 1].pressure.x.array.max())
        means = _means(scene, stress)
        means["face at the joint"] = _mean(*pressing["contact.pressure"])
    return Measured(
        rotation=angle,
        settled=settled,
        opening=wide,
        widest=widest,
        stress=float(stress[here].max()),
        largest=float(stress[nodes].max()),
        pressure=pressure,
        crushed=crushed,
        multiplier=multiplier,
        means=MappingProxyType(means),
    )


def _means(scene: Scene, stress: Array) -> dict[str, float]:
    """Mean compressions of the slabs beside the joint at mid length, by their places."""
    left, y = middle_joint(scene), scene.section()
    edge, half = scene.model.edges[left], scene.model.width / 2
    found: dict[str, list[float]] = {}
    for body, sign in ((left, -1), (left + 1, 1)):
        own = scene.nodes_of(body)
        own = own[np.isclose(scene.x[own, 1], y, atol=1e-6)]
        off = np.abs(scene.x[own, 0] - edge - sign * half)
        # Cells at a joint that gapes lean by its opening at most
        middle = own[off < off.min() + 1e-9 + max(scene.model.opening)]
        top = scene.at(body, y=y, top=True)
        near = top[np.abs(scene.x[top, 0] - edge) <= half]
        pressed = top[stress[top] > 0]
        for name, nodes, k in (
            ("section through its middle", middle, 2),
            ("half of its top beside the joint", near, 0),
            ("part of its top under compression", pressed, 0),
        ):
            found.setdefault(name, []).append(_mean(stress[nodes], scene.x[nodes, k]))
    return {name: float(np.mean(values)) for name, values in found.items()}


def nodal_forces(scene: Scene, contacts: Sequence[cx.Contact]) -> Array:
    """Contact forces on all nodes along dam, slope and normal, MN, shape (num_nodes, 3)."""
    forces = np.zeros(len(scene.u.x.array))
    for contact in contacts:
        contact.discrete.add_residual(forces)
    return -forces.reshape(-1, 3)[:, list(scene.setting.axes)]


def friction_excess(contact: cx.Contact, mu: float) -> tuple[float, float]:
    """Largest |t| - mu p of a contact's nodes on this rank, and its largest pressure, MPa.

    Coulomb's law is one of the raw multipliers; without friction the excess is minus infinity.
    """
    p, traction = contact.discrete.nodes.pressure, contact.multiplier
    excess = -np.inf
    if traction.ndim == 2:
        shear = np.sqrt(np.maximum(np.sum(traction**2, axis=1) - p**2, 0))
        excess = float(np.max(shear - mu * p, initial=-np.inf))
    return excess, float(p.max(initial=0.0))


def laws(scene: Scene) -> Laws:
    """Check balance, penetration and Coulomb's law of a solved scene."""
    forces = nodal_forces(scene, scene.problem.contacts)
    ds = ufl.Measure("ds", domain=scene.mesh, subdomain_data=scene.tags)
    balance = 0.0
    for i in range(1, 1 + scene.model.slabs):
        load = fem.assemble_scalar(fem.form(scene.pressure * ds(block_tag(i, "top"))))
        force = forces[scene.nodes_of(i), 2].sum()
        balance = max(balance, abs(force - load) / load)
    excess, pressure, gap = -np.inf, 0.0, 0.0
    for contact in scene.problem.contacts:
        mu = scene.setting.joint_friction
        if contact in scene.cushion_contacts:
            mu = scene.setting.cushion_friction
        beyond, highest = friction_excess(contact, mu)
        excess, pressure = max(excess, beyond), max(pressure, highest)
        gap = min(gap, float(np.nanmin(contact.gap.x.array[contact.slave_nodes], initial=0.0)))
    return Laws(balance, max(0.0, -gap), max(excess, 0.0) / pressure)
