# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A loop on forms alone against ContactProblem: prints the largest difference of all scenes."""

from mpi4py import MPI

import numpy as np
import own_forms
import own_newton

import contactx as cx
from dolfinx import fem

from ranks.partitions import partitioned
from scenes.problems import make_problem
from story import METHODS


class Scene(own_newton.Scene):
    """The blocks of the demo; nodes of the lower one's contact surface are moved, too."""

    def __init__(self, method):
        super().__init__()
        contact = self.contact
        self.contact = cx.Contact(contact.slave, contact.master, friction=0.2, method=method)
        V = self.u.function_space
        dofs = fem.locate_dofs_topological(V.sub(0), 1, contact.master.facets)
        x = V.tabulate_dof_coordinates()[dofs // 2, 0]
        self.shift = fem.Constant(V.mesh, 0.0)
        self.bcs.append(fem.dirichletbc(self.shift, dofs[(x > 0.2) & (x < 0.6)], V.sub(0)))

    def load(self, t):
        super().load(t)
        self.shift.value = -0.01 * t


def difference(method):
    """Largest relative difference of displacements and multipliers on any rank; collective."""
    scene, other = Scene(method), Scene(method)
    counts = own_forms.solve(scene)
    problem = make_problem(other.F, other.u, [other.contact], other.bcs)
    for step, count in enumerate(counts):
        other.load((step + 1) / own_newton.STEPS)
        problem.solve()
        assert problem.report.iterations == count > 1
    assert abs(other.shift.value) > 0
    comm, largest = other.u.function_space.mesh.comm, 0.0
    for a, b in (
        (scene.u.x.array, other.u.x.array),
        (scene.contact.multiplier, other.contact.multiplier),
        (scene.contact.force, other.contact.force),
    ):
        size = max(comm.allgather(np.abs(b).max(initial=0)))
        assert size > 0
        largest = max(largest, *(d / size for d in comm.allgather(np.abs(a - b).max(initial=0))))
    return largest


def main():
    found = []
    # Masters on other ranks than their slaves, and cells anywhere
    for partition in ("default", "opposed", "scattered"):
        with partitioned(partition):
            found += [difference(method) for method in METHODS]
    return max(found)


if __name__ == "__main__":
    most = main()
    if MPI.COMM_WORLD.rank == 0:
        print(most)
