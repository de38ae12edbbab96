# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz's sphere on any number of ranks: the answer of one, and who does what.

The scene of hertz_sphere.py: a quarter of a hemisphere on a quarter of a block, E = 1, nu = 0.3,
pressed together by 0.02. Nothing in it knows of ranks: DOLFINx distributes the mesh as it does
without contact. A rank pairs the slave nodes that it owns; master nodes of other ranks that its
pairs need become further ghosts, the contact halo. Rank 0 solves the scene once more, alone: the
same iterations and pressures to nine digits. Hertz gives force and radius besides.

    mpiexec -n 2 python demos/parallel.py --h 0.04
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mpi4py import MPI

import hertz_sphere
import numpy as np
from hertz_sphere import NU, E
from rich.table import Table

import contactx as cx
from dolfinx import fem, la

import reference
import story


@dataclass
class Answer:
    """What a run found, on rank 0.

    Attributes:
        iterations: Iterations of the step.
        force: Vertical force on the whole sphere.
        reaction: The same from the block's supports.
        radius: Contact radius by the area of closed nodes.
        pressure: Nodal pressures in the order of the mesh as it was made, shape (num_nodes,).
    """

    iterations: int
    force: float
    reaction: float
    radius: float
    pressure: np.ndarray


def solve(h: float, sliding: str, comm: MPI.Comm) -> tuple[cx.ContactProblem, Answer]:
    """Solve on the ranks of a communicator."""
    problem, contact, F = hertz_sphere.create(h, sliding, comm)
    if comm == MPI.COMM_WORLD:
        story.solve(problem)
    else:
        problem.solve()
    forces = fem.assemble_vector(F)
    # What ranks have for nodes of others goes to their owners
    forces.scatter_reverse(la.InsertMode.add)
    V = problem.u.function_space
    owned = V.dofmap.index_map.size_local
    below = np.isclose(V.tabulate_dof_coordinates()[:owned, 2], -1)
    reaction = comm.allreduce(4 * float(forces.array.reshape(-1, 3)[:owned][below, 2].sum()))
    area = comm.allreduce(float(contact.area[contact.multiplier > 0].sum()))
    radius = float(np.sqrt(4 * area / np.pi))
    pressure = in_order(contact.pressure)
    force = 4 * float(contact.force[2])
    return problem, Answer(problem.report.iterations, force, reaction, radius, pressure)


def in_order(function: fem.Function) -> np.ndarray:
    """Nodal values on rank 0, in the order of the mesh as it was made."""
    V = function.function_space
    owned, geometry, dofs = V.dofmap.index_map.size_local, V.mesh.geometry, V.dofmap.list
    number = np.empty(len(function.x.array), dtype=np.int64)
    number[dofs] = geometry.input_global_indices[geometry.dofmaps[0][:, : dofs.shape[1]]]
    parts = V.mesh.comm.gather((number[:owned], function.x.array[:owned]))
    if V.mesh.comm.rank > 0:
        return np.zeros(0)
    numbers, values = (np.concatenate(part) for part in zip(*parts, strict=True))
    return np.asarray(values[np.argsort(numbers)])


def shares(problem: cx.ContactProblem) -> None:
    """Print what each rank has."""
    contact, halo = problem.contacts[0], problem.contacts[0].discrete.halo
    rank = {
        "rank": halo.comm.rank,
        "cells": problem.u.function_space.mesh.topology.index_map(3).size_local,
        "nodes": halo.num_owned,
        "ghosts": halo.num_bulk - halo.num_owned,
        "contact halo": halo.num_nodes - halo.num_bulk,
        "slave nodes": len(contact.slave_nodes),
        "pairs": int(contact.discrete.master.paired.sum()),
    }
    rows = halo.comm.gather(rank) or []
    table = Table(*rank, title="Who has what")
    for row in rows:
        table.add_row(*(f"{value:.4g}" for value in row.values()))
    story.console.print(table)


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve on all ranks and on one, compare with each other and with Hertz."""
    args = story.arguments("Hertz's sphere on any number of ranks", 0.04, "in radii", argv)
    comm = MPI.COMM_WORLD
    problem, many = solve(args.h, args.sliding, comm)
    shares(problem)
    results = []
    if comm.rank == 0:
        _, one = solve(args.h, args.sliding, MPI.COMM_SELF)
        hertz = reference.HertzSphere(
            force=many.reaction,
            radius=1.0,
            modulus=reference.contact_modulus(E, NU, E, NU),
        )
        results = [
            story.Result("iterations, one rank's", one.iterations, many.iterations),
            story.Result("force, one rank's", one.force, many.force),
            story.Result("force against the reaction", many.reaction, many.force),
            story.Result("contact radius, Hertz", hertz.contact_radius, many.radius),
            story.Result("peak pressure, Hertz", hertz.peak_pressure, many.pressure.max()),
        ]
        story.show(f"Hertz's sphere, ranks: {comm.size}", results)
        off = np.abs(many.pressure - one.pressure).max() / one.pressure.max()
        story.console.print(f"nodal pressures are those of one rank within {off:.1e} of the peak")
    return results


if __name__ == "__main__":
    main()
