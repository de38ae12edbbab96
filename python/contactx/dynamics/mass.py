# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Masses of the bodies."""

from __future__ import annotations

from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import dolfinx.fem.petsc
import ufl
from contactx.parallel import reduce
from dolfinx import fem

_LUMPED = {"quadrature_rule": "vertex", "quadrature_degree": 1}


def mass_measure(kind: str) -> ufl.Measure:
    """Measure that inertia is integrated with.

    Args:
        kind: "lumped": by the values at vertices, so that the matrix of linear elements is diagonal
            (Hughes, The Finite Element Method, 2000, section 7.3.2); or "consistent".
    """
    return ufl.Measure("dx", metadata=_LUMPED) if kind == "lumped" else ufl.dx


class Mass:
    """The matrix of the masses: products with it, and with its inverse at free dofs."""

    def __init__(self, form: ufl.Form, kind: str, options: dict[str, Any]):
        """Assemble the matrix; all ranks must take part.

        Args:
            form: Bilinear form of the inertia.
            kind: "lumped" or "consistent".
            options: Options of the compilation.

        Raises:
            ValueError: If a mass is not positive and finite, or lumping leaves none.
        """
        self._form = fem.form(form, **options)
        self._kind = kind
        self._A = dolfinx.fem.petsc.assemble_matrix(self._form)
        self._A.assemble()
        self._comm = self._A.comm.tompi4py()
        self._diagonal: npt.NDArray[np.float64] = self._A.getDiagonal().array.copy()
        none = reduce.total(self._comm, int((self._diagonal == 0).sum()))
        some = reduce.anywhere(self._comm, bool((self._diagonal > 0).any()))
        if kind == "lumped" and none > 0 and some and self._all(self._diagonal >= 0):
            raise ValueError(
                f'mass "lumped" leaves {none} dofs without a mass: it takes density, with factors '
                "such as 2 pi r, at vertices, and it is zero at some, as on the axis of an "
                'axisymmetric model. Give mass="consistent"'
            )
        if not self._all(np.isfinite(self._diagonal) & (self._diagonal > 0)):
            raise ValueError(
                "density gives masses that are not positive and finite: give a density above 0 "
                "everywhere"
            )
        self._markers: npt.NDArray[np.bool_] | None = None
        self._inverse = np.zeros(0)
        self._ksp: PETSc.KSP | None = None

    def _all(self, are: npt.NDArray[np.bool_]) -> bool:
        return reduce.everywhere(self._comm, bool(are.all()))

    def product(self, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Multiply by the masses; all ranks must take part.

        Args:
            values: Values at owned dofs, shape (num_dofs,).
        """
        x, y = self._A.createVecs()
        x.array[:] = values
        self._A.mult(x, y)
        product: npt.NDArray[np.float64] = y.array.copy()
        return product

    def hold(self, markers: npt.NDArray[np.int8]) -> None:
        """Take which dofs cannot move; all ranks must take part.

        Args:
            markers: 1 at prescribed owned dofs, shape (num_dofs,).
        """
        held = markers == 1
        same = self._markers is not None and np.array_equal(held, self._markers)
        if reduce.everywhere(self._comm, same):
            return
        self._markers = held.copy()
        self._inverse = np.where(held, 0.0, 1 / self._diagonal)
        if self._kind == "lumped":
            return
        first, _ = self._A.getOwnershipRange()
        A = self._A.copy()
        A.zeroRowsColumns((first + np.flatnonzero(held)).astype(PETSc.IntType))
        self._ksp = PETSc.KSP().create(self._A.comm)
        self._ksp.setOperators(A)
        self._ksp.setType("preonly")
        self._ksp.getPC().setType("lu")
        self._ksp.getPC().setFactorSolverType("mumps")

    def solve(self, values: npt.NDArray[np.float64]) -> None:
        """Make velocities of impulses, zero at prescribed dofs; all ranks must take part.

        Args:
            values: Values at owned dofs, shape (num_dofs,), overwritten.
        """
        assert self._markers is not None
        if self._ksp is None:
            values *= self._inverse
            return
        b, x = self._A.createVecs()
        b.array[:] = np.where(self._markers, 0.0, values)
        self._ksp.solve(b, x)
        values[:] = x.array
