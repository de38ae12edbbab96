# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Masses, loads and strain energy of the bodies, as the core asks for them."""

from __future__ import annotations

from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import dolfinx.fem.petsc
import ufl
from dolfinx import fem, la

type Array = npt.NDArray[np.float64]

_LUMPED = {"quadrature_rule": "vertex", "quadrature_degree": 1}


def mass_measure(kind: str) -> ufl.Measure:
    """Measure that inertia is integrated with.

    Args:
        kind: "lumped": by the values at vertices, so that the matrix of linear elements is diagonal
            (Hughes, The Finite Element Method, 2000, section 7.3.2); or "consistent".
    """
    return ufl.Measure("dx", metadata=_LUMPED) if kind == "lumped" else ufl.dx


class Inertia:
    """The core's ``dynamics::Inertia``.

    Attributes:
        is_lumped: Whether the mass matrix is diagonal.
        diagonal: Its diagonal at owned dofs, shape (num_dofs,).
    """

    def __init__(
        self,
        mass: ufl.Form,
        kind: str,
        loads: ufl.Form | None,
        strain_energy: ufl.Form | None,
        options: dict[str, Any],
    ):
        """Assemble the mass matrix; all ranks must take part.

        Args:
            mass: Bilinear form of the inertia.
            kind: "lumped" or "consistent".
            loads: Virtual work of the loads.
            strain_energy: Strain energy of the current displacement.
            options: Options of the compilation.
        """
        self.is_lumped = kind == "lumped"
        form = fem.form(mass, **options)
        self._V = form.function_spaces[0]
        self._A = dolfinx.fem.petsc.assemble_matrix(form)
        self._A.assemble()
        self.diagonal: Array = self._A.getDiagonal().array.copy()
        self._loads = None if loads is None else fem.form(loads, **options)
        self._strain = None if strain_energy is None else fem.form(strain_energy, **options)
        self._markers: npt.NDArray[np.bool_] | None = None
        self._ksp: PETSc.KSP | None = None

    def product(self, values: Array) -> Array:
        """Multiply values at owned dofs by the masses."""
        x, y = self._A.createVecs()
        x.array[:] = values
        self._A.mult(x, y)
        product: Array = y.array.copy()
        return product

    def constrain(self, markers: npt.NDArray[np.int8]) -> None:
        """Factorise the mass matrix without the rows and columns of prescribed dofs.

        Args:
            markers: 1 at prescribed owned dofs, shape (num_dofs,).
        """
        self._markers = markers == 1
        first, _ = self._A.getOwnershipRange()
        A = self._A.copy()
        A.zeroRowsColumns((first + np.flatnonzero(self._markers)).astype(PETSc.IntType))
        self._ksp = PETSc.KSP().create(self._A.comm)
        self._ksp.setOperators(A)
        self._ksp.setType("preonly")
        self._ksp.getPC().setType("lu")
        self._ksp.getPC().setFactorSolverType("mumps")

    def solve(self, values: Array) -> None:
        """Make velocities of impulses, zero at prescribed dofs.

        Args:
            values: Values at owned dofs, shape (num_dofs,), overwritten.
        """
        assert self._ksp is not None and self._markers is not None
        b, x = self._A.createVecs()
        b.array[:] = np.where(self._markers, 0.0, values)
        self._ksp.solve(b, x)
        values[:] = x.array

    def strain_energy(self) -> float | None:
        """Strain energy of this rank's cells; None where no form was given."""
        return None if self._strain is None else float(fem.assemble_scalar(self._strain))

    def loads(self) -> Array | None:
        """Loads at owned dofs, shape (num_dofs,); None where no form was given."""
        if self._loads is None:
            return None
        b = la.vector(self._V.dofmap.index_map, self._V.dofmap.index_map_bs)
        fem.assemble_vector(b.array, self._loads)
        b.scatter_reverse(la.InsertMode.add)
        loads: Array = b.array[: len(self.diagonal)].copy()
        return loads
