# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""PETSc's sparse linear algebra, as the condensed solver of the C++ core asks for it.

What functions do is said in ``condense/solver/algebra.h``. Arrays that come in are those of the
core: they are read or written to while a function runs, and not kept.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from types import SimpleNamespace

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.bulk import Bulk
from contactx._host.callbacks import Quiet, weakly
from contactx._host.options import (
    aggregation_options,
    block_options,
    direct_options,
    multigrid_options,
    product_options,
)
from contactx._host.parallel import reduce
from contactx._host.system import SaddlePointSystem

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.integer]
type Apply = Callable[[Array, Array], None]

_DIFFERENT = PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN
# Preconditioned from where the norm of the residual itself is at hand
_SIDES = {"cg": PETSc.PC.Side.LEFT, "gmres": PETSc.PC.Side.RIGHT}
_REASON = PETSc.KSP.ConvergedReason
_INDEFINITE = (_REASON.DIVERGED_INDEFINITE_MAT, _REASON.DIVERGED_INDEFINITE_PC)


class Algebra:
    """Operations on PETSc's matrices, and the bulk's matrix."""

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, prefix: str):
        """Create it.

        Args:
            bulk: The bulk.
            system: The coupled system.
            prefix: Prefix of the PETSc options.
        """
        self._bulk, self._system, self._prefix = bulk, system, prefix
        self._comm = bulk.comm

    @property
    def assemblies(self) -> int:
        """Assemblies of the bulk's Jacobian so far."""
        return self._bulk.assemblies

    @property
    def is_symmetric(self) -> bool:
        """Whether it is symmetric."""
        return self._bulk.is_symmetric

    @property
    def prescribed(self) -> npt.NDArray[np.int8]:
        """1 at owned displacements that are prescribed, else 0."""
        return self._bulk.markers[: self._system.num_displacements]

    @property
    def preconditioner(self) -> str:
        """Which preconditioner the options ask for."""
        return str(PETSc.Options(self._prefix).getString("pc_type", ""))

    def update_bulk(self) -> None:
        """Assemble the bulk's Jacobian."""
        self._bulk.update()

    def bulk(self) -> PETSc.Mat:
        """The bulk's Jacobian."""
        return self._bulk.stiffness()

    def bulk_copy(self) -> PETSc.Mat:
        """A copy of it; of one that stays no more than half is kept from then on."""
        A = self._bulk.copy()
        self._bulk.keep_half()
        return A

    def lent_bulk(self) -> PETSc.Mat:
        """The Jacobian for ``hierarchy``."""
        return self._bulk.lend()

    def bulk_rows(self, dofs: Index) -> PETSc.Mat:
        """Some of its rows."""
        return self._bulk.rows(dofs)

    def field_blocks(self) -> tuple[PETSc.Mat, PETSc.Mat, PETSc.Mat]:
        """What of it concerns other fields."""
        return self._bulk.of_other_fields()

    def matrix(
        self, num_rows: int, num_columns: int, rows: Index, columns: Index, values: Array
    ) -> PETSc.Mat:
        """Make a matrix of entries."""
        A = PETSc.Mat().createAIJ(((num_rows, None), (num_columns, None)), comm=self._comm)
        A.setPreallocationCOO(_integers(rows), _integers(columns))
        A.setValuesCOO(values, PETSc.InsertMode.ADD)
        return A

    def layout(self, A: PETSc.Mat) -> tuple[int, int, int, int]:
        """Local sizes, and the first row and column."""
        rows, columns = A.getLocalSize()
        return rows, columns, A.getOwnershipRange()[0], A.getOwnershipRangeColumn()[0]

    def multiply(self, A: PETSc.Mat, x: Array, y: Array) -> None:
        """Multiply, y = A x."""
        of_x, of_y = self._vectors(A)
        with _Placed(of_x, x) as u, _Placed(of_y, y) as w:
            A.mult(u, w)

    def multiply_transposed(self, A: PETSc.Mat, x: Array, y: Array) -> None:
        """Multiply, y = A^T x."""
        of_y, of_x = self._vectors(A)
        with _Placed(of_x, x) as u, _Placed(of_y, y) as w:
            A.multTranspose(u, w)

    def _vectors(self, A: PETSc.Mat) -> tuple[PETSc.Vec, PETSc.Vec]:
        """Vectors that a matrix multiplies, and gives; made once, which is collective."""
        vectors: tuple[PETSc.Vec, PETSc.Vec] | None = A.getAttr("vectors")
        if vectors is None:
            vectors = A.createVecs()
            A.setAttr("vectors", vectors)
        return vectors

    def copy(self, A: PETSc.Mat) -> PETSc.Mat:
        """Copy a matrix."""
        return A.copy()

    def add(self, Y: PETSc.Mat, factor: float, X: PETSc.Mat) -> None:
        """Add, Y += factor X."""
        Y.axpy(factor, X, _DIFFERENT)

    def scale(self, A: PETSc.Mat, left: Array, right: Array) -> None:
        """Scale rows and columns."""
        of_rows, of_columns = A.createVecLeft(), A.createVecRight()
        of_rows.array[:], of_columns.array[:] = left, right
        A.diagonalScale(of_rows, of_columns)

    def product(self, A: PETSc.Mat, B: PETSc.Mat) -> PETSc.Mat:
        """A B."""
        return A.matMult(B)

    def transposed_product(self, A: PETSc.Mat, B: PETSc.Mat) -> PETSc.Mat:
        """A^T B."""
        return A.transposeMatMult(B)

    def projection(self, A: PETSc.Mat, P: PETSc.Mat) -> PETSc.Mat:
        """P^T A P."""
        return A.ptap(P)

    def transpose(self, A: PETSc.Mat) -> PETSc.Mat:
        """A^T."""
        return A.transpose(PETSc.Mat())

    def submatrix(self, A: PETSc.Mat, rows: Index, columns: Index) -> PETSc.Mat:
        """Some rows and columns."""
        return A.createSubMatrix(self._index_set(rows), self._index_set(columns))

    def _index_set(self, numbers: Index) -> PETSc.IS:
        return PETSc.IS().createGeneral(_integers(numbers), comm=self._comm)

    def diagonal(self, A: PETSc.Mat) -> Array:
        """The diagonal."""
        values: Array = A.getDiagonal().array_r
        return values

    def set_diagonal(self, A: PETSc.Mat, values: Array) -> None:
        """Set the diagonal."""
        diagonal = A.createVecLeft()
        diagonal.array[:] = values
        A.setDiagonal(diagonal)

    def set_identity(self, A: PETSc.Mat, rows: Index) -> None:
        """Make some rows and columns those of the identity."""
        A.zeroRowsColumns(_integers(rows), diag=1.0)

    def norm(self, A: PETSc.Mat) -> float:
        """Frobenius norm."""
        return float(A.norm())

    def num_entries(self, A: PETSc.Mat) -> int:
        """Number of entries on all ranks."""
        return int(A.getInfo(PETSc.Mat.InfoType.GLOBAL_SUM)["nz_used"])

    def entries_of_rows(self, A: PETSc.Mat) -> npt.NDArray[np.int32]:
        """Number of entries of each row."""
        counts: npt.NDArray[np.int32] = np.diff(A.getValuesCSR()[0]).astype(np.int32)
        return counts

    def absolute_sums(self, A: PETSc.Mat) -> Array:
        """Sum of the absolute values of each row."""
        offsets, _, values = A.getValuesCSR()
        rows = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
        return np.bincount(rows, np.abs(values), len(offsets) - 1)

    def join(self, blocks: list[list[PETSc.Mat | None]]) -> PETSc.Mat:
        """Join blocks to one matrix."""
        return PETSc.Mat().createNest(blocks, comm=self._comm).convert("aij", PETSc.Mat())

    def factorise(
        self, A: PETSc.Mat, name: str, is_symmetric: bool, group: int, is_rough: bool
    ) -> _Factors:
        """Factorise a matrix, whose entries are dropped."""
        ksp = PETSc.KSP().create(comm=self._comm)
        vectors = A.createVecs()
        options: AbstractContextManager[None] = nullcontext()
        if is_rough:
            prefix = f"{self._prefix}{name}_"
            ksp.setOptionsPrefix(prefix)
            options = block_options(prefix, is_symmetric=is_symmetric, group=group).in_database()
        else:
            # Iterations would wait for one another in every product
            ksp.setType("preonly")
            ksp.getPC().setType("lu" if self._comm.size == 1 else "redundant")
        with options:
            if is_rough:
                ksp.setFromOptions()
            if is_symmetric:
                A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
            ksp.setOperators(A)
            ksp.setUp()
        pc = ksp.getPC()
        pc.setReusePreconditioner(True)
        is_good = not reduce.anywhere(self._comm, pc.getFailedReason() != 0)
        if is_rough:
            # PETSc keeps the matrix, but nothing in it is used again
            A.setPreallocationNNZ(0)
        return _Factors(ksp, vectors, is_good)

    def hierarchy(
        self, A: PETSc.Mat, near_null_space: Sequence[Array], block_size: int, multiply: Apply
    ) -> Hierarchy:
        """Make a multigrid hierarchy; of a bulk that is lent half is kept from then on."""
        self._set_near_null_space(A, near_null_space, block_size)
        hierarchy = Hierarchy(A, multiply, self._prefix)
        A.setNearNullSpace(PETSc.NullSpace())
        # PETSc keeps the matrix, but nothing in it is used again
        if A.handle == self._bulk.stiffness().handle:
            self._bulk.keep_half()
        else:
            A.setPreallocationNNZ(0)
        return hierarchy

    def _set_near_null_space(self, A: PETSc.Mat, vectors: Sequence[Array], block_size: int) -> None:
        A.setBlockSize(block_size)
        modes = []
        for values in vectors:
            modes.append(A.createVecLeft())
            modes[-1].array[:] = values
        A.setNearNullSpace(PETSc.NullSpace().create(vectors=modes, comm=self._comm))

    def aggregate(
        self, A: PETSc.Mat, near_null_space: Sequence[Array], block_size: int
    ) -> tuple[PETSc.Mat, PETSc.Mat] | None:
        """Make a coarse space: its prolongation, and the matrix on it."""
        self._set_near_null_space(A, near_null_space, block_size)
        prefix = self._prefix + "bodies_model_"
        ksp = PETSc.KSP().create(comm=self._comm)
        ksp.setOptionsPrefix(prefix)
        ksp.setOperators(A)
        with aggregation_options(prefix, A.getSize()[0]).in_database():
            ksp.setFromOptions()
            ksp.setUp()
        pc = ksp.getPC()
        if pc.getMGLevels() < 2:
            return None
        return pc.getMGInterpolation(1), pc.getMGCoarseSolve().getOperators()[0].copy()

    def flexible_gmres(
        self, size: int, multiply: Apply, precondition: Apply, restart: int
    ) -> _FlexibleGMRES:
        """Make a flexible GMRES."""
        shape = (size, None)
        A = PETSc.Mat().createPython((shape, shape), comm=self._comm)
        return _FlexibleGMRES(A, multiply, precondition, restart, self._prefix + "bodies_")

    def direct_solver(self) -> _DirectSolver:
        """Make a solver of the system of all unknowns."""
        return _DirectSolver(self._system, self._prefix + "direct_")


class _Placed:
    """A with block in which a vector has other values than its own."""

    def __init__(self, vector: PETSc.Vec, values: Array):
        self._vector, self._values = vector, values

    def __enter__(self) -> PETSc.Vec:
        self._vector.placeArray(self._values)
        return self._vector

    def __exit__(self, *error: object) -> None:
        self._vector.resetArray()


class _Callbacks:
    """Functions of the core that PETSc calls in the iterations of a solver."""

    def __init__(self, **functions: Apply):
        self._functions, self._quiet = functions, Quiet()

    def context(self) -> SimpleNamespace:
        """Context of a matrix or preconditioner that PETSc calls."""
        return SimpleNamespace(mult=weakly(self._mult), apply=weakly(self._apply))

    def solving(self) -> Quiet:
        """With block around a solver."""
        self._quiet = Quiet()
        return self._quiet

    def _mult(self, mat: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        self._quiet.call(lambda: self._functions["mult"](x.array_r, y.array), y)

    def _apply(self, pc: PETSc.PC, x: PETSc.Vec, y: PETSc.Vec) -> None:
        self._quiet.call(lambda: self._functions["apply"](x.array_r, y.array), y)


class _Factors:
    """Factors of a matrix."""

    def __init__(self, ksp: PETSc.KSP, vectors: tuple[PETSc.Vec, PETSc.Vec], is_good: bool):
        self._ksp, self._vectors, self.is_good = ksp, vectors, is_good

    def solve(self, b: Array, x: Array, transposed: bool) -> None:
        """Solve with them."""
        of_x, of_b = self._vectors
        with _Placed(of_b, b) as f, _Placed(of_x, x) as u, np.errstate(all="ignore"):
            if transposed:
                self._ksp.solveTranspose(f, u)
            else:
                self._ksp.solve(f, u)


class Hierarchy:
    """PETSc's multigrid of a matrix, kept for others near it.

    Attributes:
        prolongations: To the finest level, to the next coarser one, and so on.
        matrices: Matrices of the coarser levels, in this order.
    """

    def __init__(self, P: PETSc.Mat, multiply: Apply, prefix: str):
        """Make the hierarchy; all ranks must take part.

        Args:
            P: Matrix that it is made of.
            multiply: The matrix that is solved with.
            prefix: Prefix of the PETSc options.

        Raises:
            ValueError: If the options ask for another preconditioner.
        """
        comm = P.comm.tompi4py()
        self._callbacks = _Callbacks(mult=multiply)
        size = P.getSizes()[0]
        self._A = PETSc.Mat().createPython((size, size), self._callbacks.context(), comm=comm)
        self._A.setUp()
        self._ksp = ksp = PETSc.KSP().create(comm=comm)
        ksp.setOptionsPrefix(prefix)
        pc = ksp.getPC()
        pc.setType("gamg")
        ksp.setOperators(self._A, P)
        # Of several ranks PETSc knows others
        products = product_options().in_database() if comm.size == 1 else nullcontext()
        with products, multigrid_options(prefix).in_database():
            ksp.setFromOptions()
            if pc.getType() != "gamg":
                raise ValueError(
                    f"option {prefix}pc_type: the condensed solver knows gamg and bodies, "
                    f"not {pc.getType()}; for a direct solver of the whole set pc_type to lu"
                )
            with self._callbacks.solving():
                ksp.setUp()
        # From here on the finest level needs a diagonal alone
        self._D = PETSc.Mat().createDiagonal(P.getDiagonal())
        ksp.setOperators(self._A, self._D)
        levels = pc.getMGLevels()
        coarser = []
        if levels == 1:
            # A handful of unknowns
            pc.setType("jacobi")
            self._finest = ksp
        else:
            pc.setReusePreconditioner(True)
            self._finest = pc.getMGSmoother(levels - 1)
            coarser = [pc.getMGSmoother(level) for level in range(levels - 2, 0, -1)]
            coarser.append(pc.getMGCoarseSolve())
            if comm.size == 1:
                # Of several ranks the first has all of the coarsest level, as one block
                direct = coarser[-1].getPC()
                direct.setType("lu")
                direct.setFactorShift(PETSc.Mat.FactorShiftType.INBLOCKS)
        self._coarser = coarser
        for smoother in [self._finest, *coarser]:
            smoother.getPC().setReusePreconditioner(False)
        for smoother in coarser[:-1]:
            # Contact adds eigenvalues that no estimate of the bulk foresees; this needs none
            smoother.setType("richardson")
            smoother.getPC().setType("sor")
        self._finest.setOperators(self._A, self._D)
        self.prolongations = [pc.getMGInterpolation(k) for k in range(levels - 1, 0, -1)]
        self.matrices = [smoother.getOperators()[0] for smoother in coarser]
        self._b, self._x = self._A.createVecs()

    def set_diagonal(self, diagonal: Array) -> None:
        """Set the diagonal of the finest level."""
        values = self._D.createVecLeft()
        values.array[:] = diagonal
        self._D.setDiagonal(values)
        # PETSc reads a matrix that has changed in place only where it is set again
        self._finest.setOperators(self._A, self._D)

    def update(self) -> None:
        """Take over what the matrices of the coarser levels are."""
        # Nor does PETSc see that a pattern has changed
        self._coarser[-1].getPC().reset()
        for smoother, A in zip(self._coarser, self.matrices, strict=True):
            smoother.setOperators(A, A)

    def cycle(self, b: Array, x: Array) -> None:
        """Apply one cycle."""
        with self._callbacks.solving(), _Placed(self._b, b) as f, _Placed(self._x, x) as u:
            self._ksp.getPC().apply(f, u)

    def solve(
        self, b: Array, x: Array, is_symmetric: bool, target: float, most: int
    ) -> tuple[int, core.End]:
        """Solve with the matrix."""
        ksp, method = self._ksp, "cg" if is_symmetric else "gmres"
        ksp.setType(method)
        ksp.setGMRESRestart(core.gmres_restart)
        ksp.setPCSide(_SIDES[method])
        ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
        self._b.array[:], self._x.array[:] = b, x
        # A start of zero costs no product
        ksp.setInitialGuessNonzero(self._x.norm() > 0)
        ksp.setTolerances(rtol=core.round_off, atol=target, max_it=most)
        with self._callbacks.solving():
            ksp.solve(self._b, self._x)
        x[:] = self._x.array_r
        return ksp.getIterationNumber(), _end(ksp)


class _FlexibleGMRES:
    """PETSc's FGMRES with functions of the core."""

    def __init__(
        self, A: PETSc.Mat, multiply: Apply, precondition: Apply, restart: int, prefix: str
    ):
        self._callbacks = _Callbacks(mult=multiply, apply=precondition)
        context = self._callbacks.context()
        A.setPythonContext(context)
        A.setUp()
        self._ksp = ksp = PETSc.KSP().create(comm=A.comm)
        ksp.setOptionsPrefix(prefix)
        ksp.setType("fgmres")
        ksp.setGMRESRestart(restart)
        ksp.setConvergenceTest(weakly(self._test))
        ksp.setOperators(A)
        ksp.getPC().setType("python")
        ksp.getPC().setPythonContext(context)
        self._goes_on: Callable[[int, float], core.End | None] = lambda _, __: None
        self._b, self._x = A.createVecs()

    def _test(self, ksp: PETSc.KSP, count: int, residual: float) -> PETSc.KSP.ConvergedReason:
        """Whether iterations have ended; PETSc calls this."""
        end = self._goes_on(count, residual)
        if end is None:
            return _REASON.ITERATING
        return _REASON.CONVERGED_ATOL if end == core.End.CONVERGED else _REASON.DIVERGED_DTOL

    def solve(
        self, b: Array, x: Array, test: Callable[[int, float], core.End | None], most: int
    ) -> tuple[int, core.End]:
        """Solve with the matrix."""
        ksp = self._ksp
        self._goes_on = test
        self._b.array[:], self._x.array[:] = b, x
        ksp.setTolerances(max_it=most)
        ksp.setInitialGuessNonzero(self._x.norm() > 0)
        # Factors of a singular block are not finite
        with self._callbacks.solving(), np.errstate(all="ignore"):
            ksp.solve(self._b, self._x)
        x[:] = self._x.array_r
        return ksp.getIterationNumber(), _end(ksp)


class _DirectSolver:
    """PETSc's GMRES on the whole system, with factors of an older one."""

    def __init__(self, system: SaddlePointSystem, prefix: str):
        self._system, self._prefix = system, prefix
        self._ksp: PETSc.KSP | None = None
        self._A: PETSc.Mat | None = None
        # Patterns so far, and that of the factors
        self._pattern = self._factorised = 0

    def reset(self) -> None:
        """Drop matrix and factors."""
        self._ksp = self._A = None

    def assemble(self, springs: Array | None) -> None:
        """Assemble the Jacobian."""
        A = self._system.jacobian(self._A, springs)
        if A is not self._A:
            self._A = A
            self._pattern += 1
        if self._ksp is not None:
            self._ksp.setOperators(A)

    def factorise(self) -> bool:
        """Factorise it; whether it has factors."""
        A = self._A
        assert A is not None
        if self._ksp is not None and self._factorised != self._pattern:
            # Two factorisations at once would be the largest part of the memory
            self._ksp.destroy()
            self._ksp = None
        # The options of factors are read from the database when they are made
        with direct_options(self._prefix).in_database():
            if self._ksp is None:
                self._ksp = PETSc.KSP().create(comm=A.comm)
                self._ksp.setOptionsPrefix(self._prefix)
                self._ksp.setFromOptions()
            # A matrix of the same pattern needs no new analysis
            pc = self._ksp.getPC()
            pc.setReusePreconditioner(False)
            self._ksp.setOperators(A)
            self._ksp.setUp()
            pc.setReusePreconditioner(True)
        if reduce.anywhere(A.comm.tompi4py(), pc.getFailedReason() != 0):
            # PETSc would keep the failure for matrices of this pattern, or solve without factors
            self._ksp.destroy()
            self._ksp = None
            return False
        self._factorised = self._pattern
        return True

    def solve(self, b: Array, x: Array, target: float, most: int) -> tuple[int, core.End]:
        """Solve with the factors."""
        ksp, A = self._ksp, self._A
        assert ksp is not None and A is not None
        u, f = A.createVecs()
        f.array[:] = b
        ksp.setTolerances(rtol=core.round_off, atol=target, max_it=most)
        ksp.solve(f, u)
        x[:] = u.array_r
        return ksp.getIterationNumber(), _end(ksp)


def _end(ksp: PETSc.KSP) -> core.End:
    """How the iterations of a solver ended."""
    reason = ksp.getConvergedReason()
    if reason > 0:
        return core.End.CONVERGED
    return core.End.INDEFINITE if reason in _INDEFINITE else core.End.FAILED


def _integers(numbers: Index) -> npt.NDArray[np.integer]:
    return numbers.astype(PETSc.IntType)
