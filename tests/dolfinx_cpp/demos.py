# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos of demos/cpp in Python, on their mesh files: the same lines to the last digit."""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import Any

import contactx as cx  # isort: skip

import numpy as np

import ufl
from dolfinx import fem

from shared import LU, direct, newton_step, read  # isort: skip

import reference
import story


def displacement(name: str) -> Any:
    """Displacement and facet tags on a mesh file."""
    domain, tags = read(name)
    return story.displacement(domain), tags


def hertz() -> None:
    """An elastic sphere on an elastic block."""
    u, tags = displacement("hertz")
    bcs = [
        story.fix(u, tags, 0, 0.0, 13, 23),
        story.fix(u, tags, 1, 0.0, 14, 24),
        story.fix(u, tags, 2, -0.02, 12),
        *(story.fix(u, tags, i, 0.0, 22) for i in range(3)),
    ]
    contact = cx.Contact(slave=cx.Surface(tags, 11), master=cx.Surface(tags, 21))
    problem = cx.ContactProblem(
        story.elasticity(u, 1.0, 0.3),
        u,
        contacts=[contact],
        bcs=bcs,
        petsc_options_prefix="hertz_",
        petsc_options=LU,
    )
    problem.solve()
    for row in problem.report.history[:-1]:
        print(f"{row.number:2d}  residual {row.residual:.3e}  closed {row.closed}")
    force = 4 * contact.force[2]
    modulus = reference.contact_modulus(1.0, 0.3, 1.0, 0.3)
    peak = reference.HertzSphere(force=force, radius=1.0, modulus=modulus).peak_pressure
    print(
        f"iterations {problem.report.iterations}, force {force:.12g}, "
        f"largest pressure {contact.pressure.x.array.max():.12g}, "
        f"largest multiplier {contact.multiplier.max():.12g} (Hertz {peak:.4g})"
    )


def block_on_base() -> tuple[cx.ContactProblem, Any]:
    """A block on its base with a load, and the condition that pushes it."""
    u, tags = displacement("sliding_block")
    load = fem.Constant(u.function_space.mesh, np.array([0, -0.01]))
    push = story.fix(u, tags, 0, 0.0, 12)
    contact = cx.Contact(
        slave=cx.Surface(tags, 11), master=cx.Surface(tags, 21), friction=0.3, offset=1e-8
    )
    problem = cx.ContactProblem(
        story.elasticity(u, 1.0, 0.3) + story.traction(u, tags, 12, load),
        u,
        contacts=[contact],
        bcs=[*(story.fix(u, tags, i, 0.0, 22) for i in range(2)), push],
        petsc_options_prefix="block_",
        petsc_options=LU,
    )
    return problem, push


def sliding_block() -> None:
    """A block that is pushed to and fro."""
    problem, push = block_on_base()
    (contact,) = problem.contacts
    for step in range(21):
        way = step if step <= 4 else 8 - step if step <= 12 else step - 16
        push.g.value[...] = 0.06 * way / 4
        problem.solve()
        sticking = int((contact.discrete.nodes.status == 1).sum())
        print(
            f"push {float(push.g.value):6.3f}  force {-contact.force[0]:.10f} of 0.0060  "
            f"sticking {sticking:2d}  iterations {problem.report.iterations}"
        )


def own_forms() -> None:
    """The block, pushed until it slides."""
    problem, push = block_on_base()
    for step in range(7):
        push.g.value[...] = 0.015 * step
        problem.solve()
        print(
            f"push {float(push.g.value):6.3f}  force {-problem.contacts[0].force[0]:.10f}  "
            f"iterations {problem.report.iterations}"
        )


def pressed_block() -> None:
    """A block between a disk and its base."""
    u, tags = displacement("sliding_block")
    v = ufl.TestFunction(u.function_space)
    G = ufl.Identity(2) + ufl.grad(u)
    log = ufl.ln(ufl.det(G))
    F = ufl.derivative((0.5 * (ufl.tr(G.T * G) - 2 - 2 * log) + log**2) * ufl.dx, u, v)
    centre = fem.Constant(u.function_space.mesh, np.array([1.5, 1.6]))
    below = cx.Contact(cx.Surface(tags, 11), cx.Surface(tags, 21), friction=0.2, offset=1e-8)
    above = cx.Contact(cx.Surface(tags, 12), cx.Sphere(centre, 0.6), friction=0.2)
    bcs = [story.fix(u, tags, i, 0.0, 22) for i in range(2)]
    assembler = cx.ContactAssembler(F, u, contacts=[below, above], bcs=bcs)
    ksp = direct()
    b, dx = assembler.create_vector(), assembler.create_vector()
    t, dt = 0.0, 1.0
    while t < 1:
        centre.value[1] = 1.6 - 0.5 * (t + dt)
        assembler.begin_step()
        it = assembler.settle()
        with suppress(cx.ConvergenceError):
            while not it.converged and it.number < 8:
                newton_step(assembler, ksp, b, dx)
                it = assembler.settle()
        if not it.converged:
            assembler.restore()
            dt /= 2
            print(f"t {t:.4f}: a shorter step, {dt:.4f}")
            continue
        assembler.accept()
        t += dt
        print(
            f"t {t:.4f}  iterations {it.number}  force of the disk {above.force[1]:.10f}  "
            f"on the base {below.force[1]:.10f}"
        )


if __name__ == "__main__":
    for demo in (hertz, sliding_block, own_forms, pressed_block):
        if demo.__name__ == sys.argv[1]:
            demo()
