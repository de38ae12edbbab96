# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The coupled system of bulk and contacts: one vector, one matrix.

Each rank's unknowns are its displacements followed by the multipliers of each contact. All rows are
forces: the complementarity of a slave node is scaled by its area and the stiffness of its node. All
unknowns are lengths: a multiplier is divided by its node's factor c, a traction per length. So all
entries are stiffnesses, and pivots do not depend on the units. The factor is rounded to a power of
two, which changes no digit of a multiplier.
"""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.bulk import Bulk
from contactx.interface import Interface
from contactx.layout import Layout, Rows
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, everywhere, largest

# Relative difference from a Dirichlet value that has no share in the other rows
_ROUNDING = 1e-15


class SaddlePointSystem:
    """Residual and Jacobian of the displacement and the multipliers.

    Unknowns and rows of a rank are those of the nodes that it owns. What is assembled from its
    pairs concerns all nodes that it has.

    Attributes:
        x: Unknowns.
        b: Residual.
        interfaces: Discrete sides of the contacts.
        halo: Nodes of this rank.
        num_bulk: Number of displacements of this rank.
        block: Displacements a node.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], halo: Halo):
        """Lay out the unknowns.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._bulk = bulk
        self.interfaces = list(interfaces)
        self.halo = halo
        self._comm = halo.comm
        self.block = halo.gdim
        self.num_bulk = halo.num_owned * halo.gdim
        sizes = [self.num_bulk, *(len(i.nodes.multiplier) for i in self.interfaces)]
        self._offsets = np.cumsum([0, *sizes])
        # Multipliers over unknowns
        self._factors = np.ones(self._offsets[-1] - self.num_bulk)
        self._make_vectors()
        self._layout = Layout(halo, self._offsets[-1])
        self._bulk_residual = np.zeros(self.num_bulk)
        self._bulk_at: npt.NDArray[np.float64] | None = None
        # Rows of the bulk, and the number of its assemblies when they were taken
        self._rows: tuple[int, Rows] | None = None
        # Places of the entries of the last Jacobian
        self._pattern: tuple[npt.NDArray[np.int64], ...] = ()

    @property
    def num_local(self) -> int:
        """Number of displacements of all nodes that this rank has."""
        return int(self.halo.num_nodes * self.block)

    def begin_step(self) -> None:
        """Start a step: loads, constants and coefficients may have changed."""
        self._bulk_at = None
        # An error inside PETSc leaves the old ones locked
        self._make_vectors()

    def _make_vectors(self) -> None:
        self.x = PETSc.Vec().createMPI((self._offsets[-1], None), comm=self._comm)
        self.b = self.x.duplicate()

    def blocks(self, array: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
        """Views of the displacement's part of a vector's values and of each contact's."""
        return [array[i:j] for i, j in zip(self._offsets, self._offsets[1:], strict=False)]

    def take_factors(self) -> None:
        """Take the contacts' factors c as the units of their multipliers."""
        for part, interface in zip(self._parts(self._factors), self.interfaces, strict=True):
            nodes = interface.nodes
            part[:] = np.repeat(np.ldexp(1.0, np.frexp(nodes.c)[1]), nodes.size)

    def _parts(self, values: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
        """Views of each contact's part of the values of all multipliers."""
        return np.split(values, self._offsets[1:-1] - self.num_bulk)[1:]

    def multipliers(self, x: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
        """Multipliers of each contact by a vector's values."""
        return self._parts(x[self.num_bulk :] * self._factors)

    def put_multipliers(
        self, x: npt.NDArray[np.float64], multipliers: npt.NDArray[np.float64]
    ) -> None:
        """Write multipliers of all contacts into a vector's values."""
        x[self.num_bulk :] = multipliers / self._factors

    def pack(self) -> None:
        """Write the unknowns from the functions into ``x``."""
        x = self.x.array
        x[: self.num_bulk] = self._bulk.u.x.array[: self.num_bulk]
        self.put_multipliers(x, np.hstack([[], *(i.nodes.multiplier for i in self.interfaces)]))

    def unpack(self, x: PETSc.Vec) -> None:
        """Write the unknowns from a vector into the functions; all ranks must take part."""
        self._bulk.u.x.array[: self.num_bulk] = x.array_r[: self.num_bulk]
        self.halo.update_ghosts()
        for part, interface in zip(self.multipliers(x.array_r), self.interfaces, strict=True):
            interface.nodes.multiplier[:] = part

    def bulk_residual(self) -> npt.NDArray[np.float64]:
        """Residual of the bulk alone, assembled anew only where the displacement has changed."""
        u = self._bulk.u.x.array
        same = self._bulk_at is not None and np.array_equal(u, self._bulk_at)
        if not everywhere(self._comm, same):
            self._bulk_residual = self._bulk.residual()
            self._bulk_at = u.copy()
        return self._bulk_residual

    def residual(self, b: PETSc.Vec) -> None:
        """Assemble the residual at the functions' state; pairs and status are as they stand.

        Args:
            b: Vector that is overwritten.
        """
        force, *constraints = self.blocks(b.array)
        force[:] = self.bulk_residual()
        pushed = np.zeros(self.num_local)
        for interface, row in zip(self.interfaces, constraints, strict=True):
            interface.update_gap()
            interface.law.evaluate(interface.nodes)
            interface.add_residual(pushed)
            row[:] = interface.nodes.value
        defect = self._bulk.dirichlet_defect()
        size = np.abs(self._bulk.u.x.array).max(initial=0.0)
        largest_, size = largest(self._comm, np.array([np.abs(defect).max(initial=0.0), size]))
        if largest_ > _ROUNDING * size:
            self._lift(force, pushed, constraints, defect)
        force += self._sums(pushed)
        prescribed = self._bulk.markers[: self.num_bulk] == 1
        force[prescribed] = defect[: self.num_bulk][prescribed]

    def _sums(self, pushed: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Forces on this rank's nodes from what the ranks have for theirs, shape (num_bulk,)."""
        return self.halo.scatter_reverse(pushed.reshape(-1, self.block)).ravel()

    def _lift(
        self,
        force: npt.NDArray[np.float64],
        pushed: npt.NDArray[np.float64],
        constraints: list[npt.NDArray[np.float64]],
        defect: npt.NDArray[np.float64],
    ) -> None:
        """Take Dirichlet values that the displacement does not have yet to the other rows."""
        force += self._bulk.lifted()
        contact = core.ContactBlock(self.interfaces)
        v = np.concatenate([self._to_all(defect), np.zeros(self._offsets[-1] - self.num_bulk)])
        lifted, *rows = np.split(
            contact.multiply(v), self.num_local + self._offsets[1:-1] - self.num_bulk
        )
        pushed -= lifted
        for row, part in zip(constraints, rows, strict=True):
            row -= part

    def _to_all(self, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Values of all nodes from those of this rank's, shape (num_local,)."""
        return self.halo.scatter_forward(values.reshape(-1, self.block)).ravel()

    def displacement_residual(self) -> npt.NDArray[np.float64]:
        """Forces of bulk and contacts at the functions' state, without Dirichlet conditions."""
        pushed = np.zeros(self.num_local)
        for interface in self.interfaces:
            interface.add_residual(pushed)
        return self.bulk_residual() + self._sums(pushed)

    def jacobian(
        self, A: PETSc.Mat | None = None, springs: npt.NDArray[np.float64] | None = None
    ) -> PETSc.Mat:
        """Assemble the Jacobian at the functions' state.

        Args:
            A: What the last call returned: it is written to if it has the right places.
            springs: What is added to the diagonal of the displacements, shape (num_bulk,).

        Returns:
            The Jacobian.
        """
        contact = core.ContactBlock(self.interfaces, self._markers(), keeps_zeros=True)
        places = self._layout.places()
        rows, others, added = core.coupled_rows(*self._bulk_rows(), contact, places, self.num_local)
        pattern = (*rows[:2], others, *added[:2])
        same = A is not None and all(map(np.array_equal, pattern, self._pattern))
        if A is None or not everywhere(self._comm, same):
            self._pattern = pattern
            A = self._layout.matrix(rows)
        else:
            A.zeroEntries()
            _add(A, rows, None)
        if anywhere(self._comm, len(others) > 0):
            A.assemble(PETSc.Mat.AssemblyType.FLUSH)
            A.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
            _add(A, added, others)
        A.assemble()
        if springs is not None:
            diagonal = self.x.duplicate()
            self.blocks(diagonal.array)[0][:] = springs
            A.setDiagonal(diagonal, addv=PETSc.InsertMode.ADD)
        factors = self.x.duplicate()
        factors.array[: self.num_bulk] = 1
        factors.array[self.num_bulk :] = self._factors
        A.diagonalScale(None, factors)
        return A

    def _bulk_rows(self) -> Rows:
        """Rows of the bulk's Jacobian, which are kept where it does not change."""
        K = self._bulk.jacobian()
        if self._rows is None or not self._bulk.is_linear or self._rows[0] != self._bulk.assemblies:
            self._rows = self._bulk.assemblies, self._layout.rows(K)
        return self._rows[1]

    def contact_block(self, b: PETSc.Vec | None = None) -> core.ContactBlock:
        """Assemble this rank's pairs.

        Args:
            b: Right-hand side; where it is zero the multipliers of open nodes are, and nothing is
                assembled for them. Any right-hand side if None.
        """
        d = None if b is None else b.array_r[self.num_bulk :]
        return core.ContactBlock(self.interfaces, self._markers(), d=d)

    def multiply_contact(self, contact: core.ContactBlock, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the contacts' part of the Jacobian; all ranks must take part.

        Args:
            contact: What ``contact_block`` gave.
            x: Vector of all unknowns.
            y: Product, overwritten.
        """
        n = self.num_bulk
        v = np.concatenate([self._to_all(x.array_r[:n]), *self.multipliers(x.array_r)])
        w = contact.multiply(v)
        y.array[:n] = self._sums(w[: self.num_local])
        y.array[n:] = w[self.num_local :]

    def _markers(self) -> npt.NDArray[np.int8]:
        """1 at prescribed displacements of all nodes, shape (num_local,)."""
        markers = self._bulk.markers.reshape(-1, self.block)
        return self.halo.scatter_forward(markers).ravel().astype(np.int8)


def _add(A: PETSc.Mat, rows: Rows, which: npt.NDArray[np.int64] | None) -> None:
    """Add rows to a matrix: those of this rank, or some by their places."""
    offsets, columns, values = rows
    A.setValuesIJV(
        offsets.astype(PETSc.IntType),
        columns.astype(PETSc.IntType),
        values,
        addv=PETSc.InsertMode.ADD,
        rowmap=None if which is None else which.astype(PETSc.IntType),
    )
