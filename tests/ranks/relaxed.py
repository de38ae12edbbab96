# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A problem without contact whose steps need no solver, for what load steps do on several ranks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np

import basix.ufl
import contactx as cx
from contactx._host.checkpoint.snapshot import FunctionValues
from contactx.report import Iteration, Report
from dolfinx import fem, mesh

import meshes


class Relaxed(cx.ContactProblem):
    """Goes half of the way to a displacement that grows with t, and remembers in functions.

    Attributes:
        history: Functions of spaces that a checkpoint can hold: nodes, cells, points of cells.
        fails_above: Difference of t above which a step does not converge.
    """

    def __init__(self, domain: mesh.Mesh, fails_above: float = 1.0):
        dim = domain.geometry.dim
        self.u = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (dim,))))
        self.displacement = self.u
        self.contacts = []
        self.report = Report()
        points = basix.ufl.quadrature_element(domain.basix_cell(), (dim, dim), degree=2)
        spaces: list[Any] = [("Lagrange", 1), ("DG", 0), ("DG", 1, (dim,)), points]
        self.history = [fem.Function(fem.functionspace(domain, s)) for s in spaces]
        self.fails_above = fails_above
        self.t = self.before = 0.0
        self.calls: list[float] = []

    @property
    def beside(self) -> list[fem.Function]:
        """There is a displacement alone."""
        return []

    def find_rigid_modes(self) -> None:
        """Nothing is to be found."""

    def update_ghosts(self) -> None:
        """There are no pairs with nodes of other ranks."""

    def snapshot(self, history: Sequence[fem.Function] = ()) -> Any:
        """The functions are all the state."""
        return FunctionValues([self.u, *history])

    def update(self, t: float) -> None:
        self.calls.append(t)
        self.t = t

    def solve(self) -> fem.Function:
        self.report = Report(history=[Iteration(1, 0.0, 1.0, 7, 0, 0, False, 0.0)])
        if self.t - self.before > self.fails_above:
            raise cx.ConvergenceError("too far", self.report)
        self.before = self.t
        self._step(self.u, 0)
        return self.u

    def set_attempt(self, attempt: Any) -> None:
        """Costs nothing."""

    def commit(self) -> None:
        """What is remembered depends on all steps so far."""
        for k, function in enumerate(self.history, start=1):
            self._step(function, k)

    def _step(self, function: fem.Function, k: int) -> None:
        V = function.function_space
        x = V.tabulate_dof_coordinates() @ np.array([1.0, 0.3, 0.1])
        values = function.x.array.reshape(len(x), V.dofmap.bs)
        parts = 1 + np.arange(values.shape[1])
        values[:] = 0.7 * values + np.cos(x[:, None] * parts + k + self.t)


def blocks(comm: MPI.Comm) -> mesh.Mesh:
    return meshes.blocks(mesh.CellType.tetrahedron, (2, 2, 2), (3, 3, 3), comm=comm).mesh


def one_block(comm: MPI.Comm) -> mesh.Mesh:
    """A mesh of which some ranks have nothing."""
    data = meshes.blocks(mesh.CellType.quadrilateral, (3, 3), (4, 4), comm=comm)
    return meshes.single(data, meshes.Tag.UPPER)[0]


MESHES: dict[str, Callable[[MPI.Comm], mesh.Mesh]] = {"blocks": blocks, "one block": one_block}
