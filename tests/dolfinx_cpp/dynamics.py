# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block that falls on a plane and on another block, as dynamics.cpp has it.

It writes falling_block.xdmf, which dynamics.cpp reads.
"""

from __future__ import annotations

from typing import Any

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np

import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from shared import LU, read, sentence, show, texts, write  # isort: skip

import meshes
import story

GAP, DT, STEPS = 0.0135, 0.01, 20


def make() -> None:
    """Write the mesh: a block above a wider one."""
    data = meshes.blocks(
        CellType.quadrilateral,
        (6, 6),
        (8, 4),
        size_lower=(1.5, 1.0),
        shift=(0.23,),
        gap=GAP,
        comm=MPI.COMM_SELF,
    )
    write("falling_block", data.mesh, data.facet_tags)


def figures(dynamics: cx.ContactDynamics, *values: float) -> None:
    """Print numbers, then what the balance of the step has."""
    balance = dynamics.report.balance
    numbers = [
        *values,
        *balance.impulse[0] / balance.dt,
        balance.kinetic,
        balance.strain,
        *balance.momentum,
        balance.angular_momentum,
        balance.work_of_loads,
        balance.work_of_supports,
        balance.contact_loss,
    ]
    show(*texts(numbers))


def create(domain: Any, tags: Any, master: Any, **options: Any) -> cx.ContactDynamics:
    """A problem at its start."""
    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    u, v = fem.Function(V), ufl.TestFunction(V)

    def stress(w: Any) -> Any:
        strain = ufl.sym(ufl.grad(w))
        return 2 * 100 / 2.6 * strain + 30 / (1.3 * 0.4) * ufl.tr(strain) * ufl.Identity(2)

    friction = {k: options.pop(k) for k in ("friction",) if k in options}
    weight = fem.Constant(domain, (0.0, -1.0))
    dynamics = cx.ContactDynamics(
        lambda w: ufl.inner(stress(w), ufl.grad(v)) * ufl.dx,
        u,
        density=1.0,
        contacts=[cx.Contact(cx.Surface(tags, 11), master, **friction)],
        petsc_options_prefix="dynamics_",
        petsc_options=LU,
        loads=ufl.inner(weight, v) * ufl.dx,
        strain_energy=lambda w: ufl.inner(stress(w), ufl.sym(ufl.grad(w))) / 2 * ufl.dx,
        bcs=[story.fix(u, tags, i, 0.0, 22) for i in range(2)],
        **options,
    )
    dynamics.velocity.interpolate(
        lambda x: np.where(x[1] > GAP / 2, np.stack([0 * x[0] + 0.3, -1 - 0.2 * x[0]]), 0.0)
    )
    return dynamics


def main() -> None:
    """Take the steps of all scenes."""
    if MPI.COMM_WORLD.rank == 0:
        make()
    MPI.COMM_WORLD.barrier()
    domain, tags = read("falling_block")
    plane, base = cx.Plane((0.0, 0.0), (0.0, 1.0)), cx.Surface(tags, 21)
    scenes: dict[str, Any] = {
        "plane": {"master": plane},
        "plane, friction, consistent": {"master": plane, "friction": 0.2, "mass": "consistent"},
        "block, friction": {"master": base, "friction": 0.2},
    }
    for name, options in scenes.items():
        dynamics = create(domain, tags, **options)
        show(name)
        for _ in range(STEPS):
            dynamics.dt = DT
            dynamics.solve()
            figures(dynamics)

    show("steps that are short at the impact")
    dynamics = create(domain, tags, plane, impact_travel=0.02)
    dynamics.dt = 2 * DT
    try:
        dynamics.solve()
    except cx.ConvergenceError as error:
        show(sentence(error.reason))
    # As it was before
    show(*(f"{f:.13f}" for f in (dynamics.kinetic_energy(), dynamics.strain_energy())))
    for step in cx.LoadSteps(dynamics, 4, lambda t: None, t_end=8 * DT, max_cuts=8, progress=False):
        figures(dynamics, step.t)


if __name__ == "__main__":
    main()
