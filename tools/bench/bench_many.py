# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A thousand steps of a small scene, counted in linear solves of its mesh.

A block of quadrilaterals, pressed on a longer one, is dragged along it in finite sliding. What
repeats in each step, and Python, dominate such runs. The measure is one linear elastic solve of the
same mesh without contact: assembly, factorisation by MUMPS, solution. Process CPU seconds.

    python tools/bench/bench_many.py 1000
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from typing import Any

import runner
import tables

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import apply_lifting, assemble_matrix, assemble_vector, set_bc
from dolfinx.mesh import CellType

import meshes
import scenes
import story
from meshes import Tag

STEPS, FRICTION = 1000, (0.0, 0.3)
# 2,000 cells
UPPER, LOWER = (40, 20), (60, 20)
LENGTH, DOWN, WAY = 2.0, 0.005, 0.5
SOLVES = 20

COLUMNS = [
    ("method", "method", "s"),
    ("friction", "friction", "g"),
    ("steps", "steps", "d"),
    ("Newton", "iterations", ".2f"),
    ("ms a step", "step", ".1f"),
    ("ms a linear solve", "solve", ".1f"),
    ("ratio", "ratio", ".2f"),
    ("MB over the second half", "grown", ".1f"),
]


def measure(method: str, friction: float, steps: int) -> dict[str, Any]:
    """Solve in this process.

    Args:
        method: Method of contact.
        friction: Coefficient.
        steps: Number of load steps.
    """
    data = meshes.blocks(
        CellType.quadrilateral, UPPER, LOWER, size_lower=(LENGTH, 1.0), shift=(0.2,)
    )
    tags, u = data.facet_tags, story.displacement(data.mesh)
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT),
        cx.Surface(tags, Tag.LOWER_CONTACT),
        sliding="finite",
        friction=friction,
        method=method,
    )
    aside, down = (story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(2))
    bcs = [aside, down, *(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2))]
    problem = cx.ContactProblem(
        story.elasticity(u, 1.0, scenes.NU),
        u,
        contacts=[contact],
        bcs=bcs,
        petsc_options_prefix="many_",
    )
    # A tenth of the steps presses
    pressed = 0.1

    def update(t: float) -> None:
        down.g.value[...] = -DOWN * min(1.0, t / pressed)
        aside.g.value[...] = WAY * max(0.0, t - pressed) / (1 - pressed)

    F = story.elasticity(u, 1.0, scenes.NU)
    forms = fem.form(ufl.derivative(F, u)), fem.form(F)
    linear(*forms, bcs)
    start = time.process_time()
    for _ in range(SOLVES):
        linear(*forms, bcs)
    solve = (time.process_time() - start) / SOLVES

    iterations, half = 0, 0.0
    start = time.process_time()
    for number, _ in enumerate(cx.LoadSteps(problem, steps, update=update, progress=False)):
        iterations += problem.report.iterations
        if number == steps // 2:
            half = runner.memory("VmRSS")
    step = (time.process_time() - start) / steps
    return {
        "iterations": iterations / steps,
        "step": 1e3 * step,
        "solve": 1e3 * solve,
        "ratio": step / solve,
        "grown": runner.memory("VmRSS") - half,
        "force": [float(f) for f in contact.force],
    }


def linear(a: fem.Form, L: fem.Form, bcs: Sequence[fem.DirichletBC]) -> None:
    """One linear elastic solve with the supports of the blocks."""
    from petsc4py import PETSc

    A = assemble_matrix(a, bcs=bcs)
    A.assemble()
    b = assemble_vector(L)
    apply_lifting(b, [a], [bcs])
    set_bc(b, bcs)
    ksp = PETSc.KSP().create(A.comm)
    ksp.setOperators(A)
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    ksp.solve(b, b.duplicate())
    for thing in (ksp, A, b):
        thing.destroy()


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    steps = int(argv[0]) if argv else STEPS
    rows = [
        runner.alone("bench_many:measure", method=method, friction=friction, steps=steps)
        for method in story.METHODS
        for friction in FRICTION
    ]
    tables.show(f"{steps} steps of a sliding block", COLUMNS, rows, runner.OUTPUT / "many.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
