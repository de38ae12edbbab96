# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Residual and Jacobian of functions that are solved for together, block by block."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import dolfinx.fem.petsc
import ufl
from contactx._host.parallel import reduce
from contactx.errors import NotFiniteError
from dolfinx import fem, la
from ufl.algorithms.strip_terminal_data import strip_terminal_data
from ufl.utils.sorting import canonicalize_metadata

type Array = npt.NDArray[np.float64]


class Blocks:
    """Forms of a residual and its Jacobian, and what they are assembled into.

    Each function is a block of rows and of columns; a function of a mixed space is the only one.

    Attributes:
        functions: The functions.
        maps: Their dofmaps.
        counts: Number of owned dofs of each.
        F: Residual forms of each function, which sum up.
        J: Jacobian forms of each block, which sum up; none where a block is zero.
        is_linear: Whether the Jacobian depends on none of the functions.
        bcs: Dirichlet conditions.
        markers: 1 at dofs of each function with a Dirichlet condition, ghosts included.
        matrices: Jacobian, by blocks; empty before it is assembled.
    """

    def __init__(
        self,
        F: Sequence[ufl.Form],
        J: Sequence[Sequence[ufl.Form | None]] | None,
        functions: Sequence[fem.Function],
        options: dict[str, Any],
    ):
        """Compile the forms.

        Args:
            F: Residual of each function.
            J: Derivative of each residual by each function; derived if None.
            functions: The functions.
            options: Options of the compilation of forms.
        """
        self.functions = list(functions)
        self.maps = [w.function_space.dofmap for w in functions]
        self.counts = [m.index_map.size_local * m.index_map_bs for m in self.maps]
        derivatives = J if J is not None else _derivatives(F, functions)
        self.F = [[fem.form(part, **options) for part in by_rule(f)] for f in F]
        self.J = [
            [[] if j is None else [fem.form(part, **options) for part in by_rule(j)] for j in row]
            for row in derivatives
        ]
        self._parts = [part for row in self.J for block in row for part in block]
        # Those that are left once UFL has differentiated
        self._coefficients = [c for part in self._parts for c in part._cpp_object.coefficients]
        own = [w._cpp_object for w in functions]
        self.is_linear = not any(c is w for c in self._coefficients for w in own)
        self.comm: MPI.Comm = functions[0].function_space.mesh.comm
        self._b = [la.vector(m.index_map, m.index_map_bs) for m in self.maps]
        self.matrices: list[list[PETSc.Mat]] = []
        self._assembled_with: list[Array] | None = None

    def set_conditions(self, bcs: Sequence[fem.DirichletBC]) -> None:
        """Take other Dirichlet conditions from now on; all ranks must take part.

        Args:
            bcs: The conditions.
        """
        self.bcs = list(bcs)
        self._of_function = [_conditions_of(w.function_space, self.bcs) for w in self.functions]
        self.markers = [np.zeros(len(w.x.array), dtype=np.int8) for w in self.functions]
        for markers, conditions in zip(self.markers, self._of_function, strict=True):
            for bc in conditions:
                markers[bc.dof_indices()[0]] = 1
        self._assembled_with = None

    def residual(self) -> list[Array]:
        """Residual of each function, of which owned dofs count; all ranks must take part."""
        for b, parts in zip(self._b, self.F, strict=True):
            b.array[:] = 0
            for part in parts:
                fem.assemble_vector(b.array, part)
        return self._sums()

    def lifted(self) -> list[Array]:
        """Residual of other rows from Dirichlet values that the functions do not have yet.

        All ranks must take part; see ``residual``.
        """
        values = [w.x.array for w in self.functions]
        for b, row in zip(self._b, self.J, strict=True):
            b.array[:] = 0
            for block, bcs, x in zip(row, self._of_function, values, strict=True):
                for part in block:
                    fem.apply_lifting(b.array, [part], [bcs], [x], alpha=-1.0)
        return self._sums()

    def _sums(self) -> list[Array]:
        for b in self._b:
            b.scatter_reverse(la.InsertMode.add)
        return [b.array for b in self._b]

    def defects(self) -> list[Array]:
        """Values minus Dirichlet values of each function, zero elsewhere, ghosts included."""
        defects = []
        for w, conditions in zip(self.functions, self._of_function, strict=True):
            defect = np.zeros(len(w.x.array))
            for bc in conditions:
                bc.set(defect, w.x.array, alpha=-1.0)
            defects.append(defect)
        return defects

    def assemble(self) -> bool:
        """Assemble the Jacobian where a coefficient or a constant of a form has changed.

        All ranks must take part.

        Returns:
            Whether it was assembled.

        Raises:
            NotFiniteError: If it is not finite.
        """
        constants = (fem.pack_constants(part) for part in self._parts)
        parameters = [*constants, *(c.x.array for c in self._coefficients)]
        same = self._assembled_with is not None and all(
            map(np.array_equal, parameters, self._assembled_with)
        )
        if reduce.everywhere(self.comm, same):
            return False
        if not self.matrices:
            self.matrices = [
                [self._create(i, j, block) for j, block in enumerate(row)]
                for i, row in enumerate(self.J)
            ]
        # Until it is whole, whatever comes in between
        self._assembled_with = None
        for i, (matrices, row) in enumerate(zip(self.matrices, self.J, strict=True)):
            for j, (K, block) in enumerate(zip(matrices, row, strict=True)):
                K.zeroEntries()
                for part in block:
                    # Each part sets the unit diagonal of Dirichlet conditions, and none adds to it
                    K.assemble(PETSc.Mat.AssemblyType.FLUSH)
                    dolfinx.fem.petsc.assemble_matrix(K, part, bcs=self.bcs)
                if not block and i == j:
                    own = np.flatnonzero(self.markers[i][: self.counts[i]])
                    for row_number in own + K.getOwnershipRange()[0]:
                        K.setValue(row_number, row_number, 1.0)
                K.assemble()
                check_jacobian(K)
        self._assembled_with = [values.copy() for values in parameters]
        return True

    def _create(self, i: int, j: int, block: list[fem.Form]) -> PETSc.Mat:
        if block:
            # The first part has an integral wherever another one has
            return dolfinx.fem.petsc.create_matrix(block[0])
        sizes = (self.counts[i], None), (self.counts[j], None)
        K = PETSc.Mat().createAIJ(sizes, nnz=(1 if i == j else 0, 0), comm=self.comm)
        if i == j:
            for row in range(*K.getOwnershipRange()):
                K.setValue(row, row, 0.0)
        K.assemble()
        return K


def check_jacobian(K: PETSc.Mat) -> None:
    """Check that a Jacobian, or a block of it, is finite; all ranks must take part.

    Raises:
        NotFiniteError: If it is not.
    """
    if not np.isfinite(K.norm(PETSc.NormType.FROBENIUS)):
        raise NotFiniteError(
            "the Jacobian of F is not finite: its derivative does not exist at this displacement, "
            "or a coefficient of F, or of J, is NaN or infinite. Start from another displacement, "
            "or repair the coefficient (manual: errors/jacobian-not-finite)"
        )


def by_rule(form: ufl.Form) -> list[ufl.Form]:
    """Forms that sum up to a form, none with two quadrature rules in the same place.

    FFCx 0.11 makes one kernel of the integrals over a subdomain. Where these have different rules,
    what depends on the first one's points, such as the Jacobian of a quadrilateral or the value of
    a coefficient, has the same name in all of them and is mistaken for the others'. Kernels of
    forms of their own are right, and so are those of different subdomains.

    Args:
        form: Any form.

    Returns:
        The forms; most often there is one, with the integrals as they were. The first one has an
        integral over each subdomain.
    """
    parts: list[list[ufl.Integral]] = []
    rules: list[dict[Any, Any]] = []
    for integral in form.integrals():
        place = (integral.ufl_domain(), integral.integral_type(), integral.subdomain_id())
        # No rule given means that of the degree which UFL estimates for all such integrals together
        rule = canonicalize_metadata(integral.metadata())
        for part, taken in zip(parts, rules, strict=True):
            if taken.setdefault(place, rule) == rule:
                part.append(integral)
                break
        else:
            parts.append([integral])
            rules.append({place: rule})
    return [ufl.Form(part) for part in parts]


def _derivatives(
    F: Sequence[ufl.Form], functions: Sequence[fem.Function]
) -> list[list[ufl.Form | None]]:
    """Derivative of each residual by each function; None where there is none."""
    rows: list[list[ufl.Form | None]] = []
    for f in F:
        row: list[ufl.Form | None] = []
        integrals = _with_degrees(f)
        for w in functions:
            # Loads drop out, so that a constant of theirs that changes does not count as one of J
            terms = [
                i for i in integrals if w in ufl.algorithms.extract_coefficients(i.integrand())
            ]
            J = ufl.derivative(ufl.Form(terms), w, ufl.TrialFunction(w.function_space))
            is_zero = len(functions) > 1 and ufl.algorithms.expand_derivatives(J).empty()
            row.append(None if not terms or is_zero else J)
        rows.append(row)
    return rows


def _with_degrees(form: ufl.Form) -> list[ufl.Integral]:
    """Integrals of a form with the degree of the quadrature that each is compiled with.

    UFL estimates a higher one for what is derived from them, where they are no polynomials; but the
    derivative of a sum over points is that over the same points.
    """
    # UFL keeps what it has seen, and would keep meshes and functions
    bare, _ = strip_terminal_data(form)
    # Of what FFCx asks for only this one raises the degree, that of an integral's scaling
    data: Any = ufl.algorithms.compute_form_data(
        bare, do_apply_integral_scaling=True, do_append_everywhere_integrals=False
    )
    degrees: dict[tuple[Any, ...], int] = {}
    for group in data.integral_data:
        estimates = [
            int(np.max(integral.metadata()["estimated_polynomial_degree"]))
            for integral in group.integrals
            if "quadrature_degree" not in integral.metadata()
        ]
        for subdomain in group.subdomain_id if estimates else ():
            place = "everywhere" if subdomain == "otherwise" else subdomain
            degrees[group.domain.ufl_id(), group.integral_type, place] = max(estimates)
    integrals = []
    for integral in form.integrals():
        domain: Any = integral.ufl_domain()
        places: Any = integral.subdomain_id()
        for place in places if isinstance(places, tuple) else (places,):
            estimated = degrees.get((domain.ufl_id(), integral.integral_type(), place))
            metadata = {"quadrature_degree": estimated, **integral.metadata()}
            integrals.append(integral.reconstruct(metadata=metadata, subdomain_id=place))
    return integrals


def _conditions_of(V: fem.FunctionSpace, bcs: Sequence[fem.DirichletBC]) -> list[Any]:
    """Conditions on a space or a part of it."""
    return [bc for bc in bcs if V._cpp_object.contains(bc.function_space)]
