# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that contact alone holds: pressed, rocking, ten on each other."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh

import meshes
from meshes import block_tag
from scenes import dimension
from stress.alone import Alone
from stress.blocks import bulk
from stress.check import Check
from stress.families.grid import ALL_CELLS, divisions, scenes, variants
from stress.scene import METHODS, SLIDINGS, Case, Scene, relative
from stress.tools import Floor

_PRESSURE = 0.01


def _floor(domain: mesh.Mesh) -> Floor:
    return Floor(domain, np.zeros(domain.geometry.dim))


def pressed() -> Iterator[Scene]:
    """A free block on a plane under a load that has a part aside, as a part of friction's limit."""
    values = (0.0, 0.1, 0.5, 0.9, 0.99, 0.999)
    options = list(
        variants(
            cell=ALL_CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.1, 0.5),
            n=(1, 4),
            steps=(1, 4),
        )
    )

    def make(part, cell, friction, n, steps, **options):
        dim = dimension(cell)
        # Flat, so that it does not tip over
        scene = Alone(
            cell,
            _floor,
            n=(n,) * dim,
            size=(1.0,) * (dim - 1) + (0.2,),
            moved=False,
            friction=friction,
            **options,
        )
        force = np.zeros(dim)
        force[-1], force[0] = -_PRESSURE, part * friction * _PRESSURE

        def update(t):
            scene.load.value[:] = t * force

        case = scene.case
        case.update, case.steps = update, steps
        case.answers = lambda: [relative("force is the load", scene.contact.force, -force, 1e-8)]
        return case

    yield from scenes("free block, part of friction", values, options, make)


def rocking() -> Iterator[Scene]:
    """A free high block that its weight holds, pushed at its top until it almost tips over."""
    values = (0.0, 0.3, 0.6, 0.9, 0.95)
    options = list(
        variants(
            cell=ALL_CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.6, 2.0),
            steps=(1, 5),
        )
    )

    def make(part, cell, steps, **options):
        dim = dimension(cell)
        scene = Alone(
            cell,
            _floor,
            n=divisions(cell, (6, 8), (4, 1, 4)),
            size=(1.0, 2.0) if dim == 2 else (1.0, 0.5, 2.0),
            moved=False,
            **options,
        )
        weight = 2.0 * _PRESSURE * (1.0 if dim == 2 else 0.5)
        push = part * weight * 0.5 / 2.0
        across = 1.0 if dim == 2 else 0.5

        def update(t):
            # The weight is there from the start, in the first step at the latest
            scene.weight.value[-1] = -_PRESSURE
            scene.load.value[0] = t * push / across

        def answers():
            held = np.zeros(dim)
            held[0], held[-1] = -push, weight
            x = scene.u.function_space.tabulate_dof_coordinates()[scene.contact.slave_nodes]
            up = scene.contact.area * scene.contact.multiplier[:, -1]
            arm = float(up @ (x[:, 0] - 0.5)) / weight
            return [
                relative("force is the load", scene.contact.force, held, 1e-8),
                # In its first place: displacements move forces by a little
                Check("place of the force", abs(arm - part * 0.5), 0.1),
            ]

        scene.case.update, scene.case.steps, scene.case.answers = update, steps, answers
        return scene.case

    yield from scenes("rocking, part of tipping over", values, options, make)


def stacked() -> Iterator[Scene]:
    """Free blocks on each other on a plane, one finer than the other."""
    values = (1, 2, 3, 5, 7, 10)
    options = [
        *variants(cell=ALL_CELLS, method=METHODS, sliding=SLIDINGS, shear=(0.0, 0.1, 0.25)),
    ]
    yield from scenes("free blocks stacked", values, options, _stack)


def _stack(number, cell, shear, **options) -> Case:
    dim = dimension(cell)
    divisions_ = [(*[2 + i % 3] * (dim - 1), 1) for i in range(number)]
    data = meshes.stack(cell, divisions_, sizes=[(*[1.0] * (dim - 1), 0.1)] * number)
    tags = data.facet_tags
    V = fem.functionspace(data.mesh, ("Lagrange", 1, (dim,)))
    u, v = fem.Function(V), ufl.TestFunction(V)
    load = fem.Constant(data.mesh, np.zeros(dim))
    ds = ufl.Measure("ds", domain=data.mesh, subdomain_data=tags)
    F = bulk(u, fem.Constant(data.mesh, 1.0), fem.Constant(data.mesh, 0.3), "linear")
    F -= ufl.inner(load, v) * ds(block_tag(number - 1, "top"))
    floor = _floor(data.mesh)
    masters = [floor.obstacle, *(cx.Surface(tags, block_tag(i, "top")) for i in range(number - 1))]
    contacts = [
        cx.Contact(cx.Surface(tags, block_tag(i, "bottom")), master, friction=0.3, **options)
        for i, master in enumerate(masters)
    ]
    problem = cx.ContactProblem(F, u, contacts=contacts, petsc_options_prefix="stack_")
    force = np.zeros(dim)
    force[0], force[-1] = shear * _PRESSURE, -_PRESSURE

    def update(t):
        load.value[:] = t * force

    def answers():
        return [relative("force is the load", c.force, -force, 1e-8) for c in contacts]

    return Case(problem, contacts, F, [], update, size=0.1, answers=answers, tools=[floor])
