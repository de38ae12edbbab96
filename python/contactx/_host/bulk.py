# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The bulk: a UFL residual with its Jacobian and Dirichlet conditions."""

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
from ufl.utils.sorting import canonicalize_metadata


class Bulk:
    """Residual and Jacobian of the bodies without contact.

    Attributes:
        u: Displacement.
        residual_form: Residual as the user gave it.
        form_options: Options of the compilation of forms.
        bcs: Dirichlet conditions.
        F: Residual form, in parts that sum up to it.
        J: Jacobian form, in parts that sum up to it.
        has_own_jacobian: Whether the user gave the Jacobian.
        is_linear: Whether the Jacobian does not depend on u.
        comm: Communicator; what assembles or asks for the matrix needs all ranks.
        num_dofs: Number of dofs of this rank.
        markers: 1 at dofs with a Dirichlet condition, those of other ranks last.
        assemblies: How often the Jacobian was assembled.
        skipped: How often an assembled Jacobian served again.
    """

    def __init__(
        self,
        F: ufl.Form,
        u: fem.Function,
        bcs: Sequence[fem.DirichletBC],
        J: ufl.Form | None,
        form_compiler_options: dict[str, Any] | None,
        jit_options: dict[str, Any] | None,
    ):
        """Compile the forms.

        Args:
            F: Residual.
            u: Displacement.
            bcs: Dirichlet conditions.
            J: Jacobian; derived from F if None.
            form_compiler_options: Options of FFCx.
            jit_options: Options of the compilation.
        """
        self.u = u
        self.residual_form: ufl.Form | None = F
        V = u.function_space
        self.has_own_jacobian = J is not None
        if J is None:
            # Loads drop out, so that a constant of theirs that changes does not count as one of J
            internal = [
                i for i in F.integrals() if u in ufl.algorithms.extract_coefficients(i.integrand())
            ]
            J = ufl.derivative(ufl.Form(internal or list(F.integrals())), u, ufl.TrialFunction(V))
        options = {"form_compiler_options": form_compiler_options, "jit_options": jit_options}
        self.form_options: dict[str, Any] = options
        self.F = [fem.form(part, **options) for part in by_rule(F)]
        self.J = [fem.form(part, **options) for part in by_rule(J)]
        # Those that are left once UFL has differentiated: none is u where the bulk is linear
        self._coefficients = [c for part in self.J for c in part._cpp_object.coefficients]
        self.is_linear = all(c is not u._cpp_object for c in self._coefficients)
        self.comm: MPI.Comm = V.mesh.comm
        self.num_dofs = V.dofmap.index_map.size_local * V.dofmap.index_map_bs
        self._b = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
        self._A: PETSc.Mat = None
        self._rows: PETSc.Mat | None = None
        self._symmetric: bool | None = None
        self._assembled_with: list[npt.NDArray[np.float64]] | None = None
        self.markers = np.zeros(len(u.x.array), dtype=np.int8)
        self.set_conditions(bcs)
        self.assemblies = 0
        self.skipped = 0
        # Other fields: see coupled.py
        self.fields: Any = None

    def read(self) -> None:
        """Take the displacement of the user's function, where u is a copy."""

    def write(self) -> None:
        """Give it to the user's function."""

    def diagonal(self) -> npt.NDArray[np.float64]:
        """Diagonal of the Jacobian at the displacement's owned dofs; all ranks must take part."""
        diagonal: npt.NDArray[np.float64] = self.matrix().getDiagonal().array
        return diagonal

    def products(self, fields: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Products of the displacement's block with fields; all ranks must take part.

        Args:
            fields: Displacements at owned dofs, shape (count, num_dofs).
        """
        K = self.matrix()
        x, y = K.createVecs()
        results = np.empty_like(fields)
        for field, result in zip(fields, results, strict=True):
            x.array[:] = field
            K.mult(x, y)
            result[:] = y.array
        return results

    def set_conditions(self, bcs: Sequence[fem.DirichletBC]) -> None:
        """Take other Dirichlet conditions from now on; all ranks must take part.

        Args:
            bcs: The conditions.
        """
        self.bcs = list(bcs)
        self.markers[:] = 0
        for bc in self.bcs:
            self.markers[bc.dof_indices()[0]] = 1
        self._assembled_with = None

    def residual(self) -> npt.NDArray[np.float64]:
        """Residual on this rank's dofs, without Dirichlet conditions; all ranks must take part."""
        self._b.array[:] = 0
        for part in self.F:
            fem.assemble_vector(self._b.array, part)
        return self._sums()

    def lifted(self) -> npt.NDArray[np.float64]:
        """Residual of other rows from Dirichlet values that the displacement does not have yet.

        All ranks must take part.
        """
        self._b.array[:] = 0
        for part in self.J:
            fem.apply_lifting(self._b.array, [part], [self.bcs], [self.u.x.array], alpha=-1.0)
        return self._sums()

    def _sums(self) -> npt.NDArray[np.float64]:
        self._b.scatter_reverse(la.InsertMode.add)
        owned: npt.NDArray[np.float64] = self._b.array[: self.num_dofs].copy()
        return owned

    def dirichlet_defect(self) -> npt.NDArray[np.float64]:
        """Displacement minus Dirichlet values, zero elsewhere, ghosts included."""
        defect = np.zeros(len(self.u.x.array))
        for bc in self.bcs:
            bc.set(defect, self.u.x.array, alpha=-1.0)
        return defect

    def update(self) -> None:
        """Assemble the Jacobian where a coefficient or a constant of the form has changed.

        One that does not depend on the displacement is assembled once.
        """
        if not self._assemble():
            self.skipped += 1

    def jacobian(self) -> PETSc.Mat:
        """Jacobian, with unit rows and columns at Dirichlet conditions."""
        self.update()
        return self._A if self._is_whole else self.copy()

    def copy(self) -> PETSc.Mat:
        """Copy of the Jacobian in rows."""
        A = self.matrix()
        return A.copy() if self._is_whole else A.convert("aij", PETSc.Mat())

    def matrix(self) -> PETSc.Mat:
        """Jacobian for products, of whatever matrix type it is stored as."""
        self._assemble()
        return self._A

    @property
    def _is_whole(self) -> bool:
        """True if all entries are stored, not half of a symmetric matrix."""
        return self._A.getType() in ("seqaij", "mpiaij")

    def rows(self, dofs: npt.NDArray[np.integer]) -> PETSc.Mat:
        """Some rows of the Jacobian, for nobody to change.

        Args:
            dofs: Which owned ones, in order; the same ones every time.
        """
        A = self.matrix()
        if self._rows is None:
            first, last = A.getOwnershipRange()
            some = PETSc.IS().createGeneral((first + dofs).astype(PETSc.IntType), comm=self.comm)
            every = PETSc.IS().createStride(last - first, first, comm=self.comm)
            self._rows = A.createSubMatrix(some, every)
        return self._rows

    @property
    def is_symmetric(self) -> bool:
        """True if the Jacobian is symmetric."""
        self._assemble()
        if self._symmetric is None:
            self._symmetric = _is_symmetric(self._A)
        return self._symmetric

    def keep_half(self) -> None:
        """Keep only half of a Jacobian that stays and is symmetric: half the memory to pass."""
        if self.is_linear and self._is_whole and self.is_symmetric:
            whole = self._A
            whole.setOption(PETSc.Mat.Option.SYMMETRIC, True)
            self._A = whole.convert("sbaij", PETSc.Mat())
            whole.destroy()

    def _assemble(self) -> bool:
        constants = (fem.pack_constants(part) for part in self.J)
        parameters = [*constants, *(c.x.array for c in self._coefficients)]
        same = self._assembled_with is not None and all(
            map(np.array_equal, parameters, self._assembled_with)
        )
        if reduce.everywhere(self.comm, same):
            return False
        if self._A is None or not self._is_whole:
            # The first part has an integral wherever another one has
            self._A = dolfinx.fem.petsc.create_matrix(self.J[0])
        # Until it is whole, whatever comes in between
        self._assembled_with = None
        self._A.zeroEntries()
        for part in self.J:
            # Each part sets the unit diagonal of the Dirichlet conditions, and none adds to it
            self._A.assemble(PETSc.Mat.AssemblyType.FLUSH)
            dolfinx.fem.petsc.assemble_matrix(self._A, part, bcs=self.bcs)
        self._A.assemble()
        check_jacobian(self._A)
        self._assembled_with = [values.copy() for values in parameters]
        self._symmetric = self._rows = None
        self.assemblies += 1
        return True

    def cell_sizes(self) -> npt.NDArray[np.float64]:
        """Size of the largest cell of this rank around each owned node, shape (num_owned,)."""
        V = self.u.function_space
        cells = V.dofmap.list
        sizes = V.mesh.h(V.mesh.topology.dim, np.arange(len(cells), dtype=np.int32))
        result = np.zeros(len(self.markers) // V.dofmap.index_map_bs)
        np.maximum.at(result, cells, sizes[:, None])
        owned: npt.NDArray[np.float64] = result[: V.dofmap.index_map.size_local]
        return owned


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


def _is_symmetric(K: PETSc.Mat) -> bool:
    """True if x.Ky = y.Kx for two random vectors, which an asymmetric K fails but for chance."""
    x, y = K.createVecs()
    work = y.duplicate()
    rng = np.random.default_rng(K.comm.rank)
    for vector in (x, y):
        vector.array[:] = rng.standard_normal(vector.getLocalSize())
    K.mult(y, work)
    one, size = x.dot(work), work.norm() * x.norm()
    K.mult(x, work)
    return bool(abs(one - y.dot(work)) <= 1e-12 * size)


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
