# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A disk that rolls: friction alone keeps it from slipping, its weight alone holds it down."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from stress.blocks import bulk
from stress.check import Check
from stress.families.grid import scenes, variants
from stress.scene import METHODS, Case, Scene
from stress.tools import Floor

_WEIGHT = 1e-3


def rolling() -> Iterator[Scene]:
    """Friction that keeps the disk from slipping.

    The disk is a polygon, which must tip over each of its corners: that asks for some.
    """
    options = list(
        variants(
            cell=(CellType.quadrilateral, CellType.triangle),
            method=METHODS,
            n=(8, 16),
            angle=(0.2, 0.5),
            steps=(10, 40),
        )
    )
    yield from scenes("rolling, friction", (0.15, 0.3, 1.0, 10.0), options, _disk)


def _disk(friction, cell, method, n, angle, steps) -> Case:
    data = meshes.blocks(cell, (n, n), (1, 1), size_upper=(2.0, 2.0))
    domain, tags = meshes.single(data, Tag.UPPER)
    # A square becomes a disk of radius 1 that touches height zero
    a, b = domain.geometry.x[:, 0] - 1, domain.geometry.x[:, 1] - 1
    domain.geometry.x[:, 0] = a * np.sqrt(1 - b**2 / 2)
    domain.geometry.x[:, 1] = b * np.sqrt(1 - a**2 / 2) + 1
    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    u, v = fem.Function(V), ufl.TestFunction(V)
    F = bulk(u, fem.Constant(domain, 1.0), fem.Constant(domain, 0.3), "neo-hooke")
    weight = fem.Constant(domain, np.array([0.0, -_WEIGHT]))
    F -= ufl.inner(weight, v) * ufl.dx
    W, _ = V.sub(0).collapse()
    middle = fem.locate_dofs_geometrical((V.sub(0), W), lambda x: np.hypot(x[0], x[1] - 1) < 1e-9)
    way = fem.Function(W)
    bcs = [fem.dirichletbc(way, middle, V.sub(0))]
    rim = cx.Surface(tags, Tag.UPPER_CONTACT, Tag.UPPER_TOP, Tag.UPPER_X0, Tag.UPPER_X1)
    floor = Floor(domain, (0.0, 0.0))
    contact = cx.Contact(rim, floor.obstacle, friction=friction, method=method)
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="disk_")

    def update(t):
        way.x.array[:] = angle * t

    def answers():
        x = V.tabulate_dof_coordinates()[:, :2]
        right = np.argmax(x[:, 0])
        moved = u.x.array.reshape(-1, 2)
        centre = int(middle[0][0]) // 2
        arm = (x + moved)[right] - (x + moved)[centre]
        turned = -float(np.arctan2(arm[1], arm[0]))
        return [
            Check("it turns by its way", abs(turned - angle), 0.05 * angle + 0.5 / n**2),
            Check("it bears its weight", abs(contact.force[1] / (np.pi * _WEIGHT) - 1), 0.02),
        ]

    return Case(
        problem,
        [contact],
        F,
        bcs,
        update,
        size=2.0,
        steps=steps,
        answers=answers,
        tools=[floor],
    )
