# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""FGMRES with a block triangular preconditioner: factors of the soft bodies and the stiff ones."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from contactx._host.bodies import Bodies
from contactx._host.bulk import Bulk
from contactx._host.callbacks import Quiet, weakly
from contactx._host.condensed.coarse_model import CoarseModel
from contactx._host.condensed.diagonal_blocks import DofBlock, Transforms, change_of
from contactx._host.condensed.numbering import DIFFERENT, Array
from contactx._host.condensed.operator import CondensedOperator
from contactx._host.options import ROUNDING, block_options
from contactx._host.parallel import reduce
from contactx.report import Report

# Krylov iterations after which a solve with the coarse model, or with springs, is given up
_MAX_ITERATIONS = _MAX_ITERATIONS_WITH_SPRINGS = 120
# Difference between what contact adds to the soft block now and what it added when this was
# factorised, relative in the Frobenius norm, up to which the factors are kept
_MAX_CHANGE_OF_SOFT = 0.03
# The same for the stiff block, times ln(residual / target) of a solve: iterations with old factors
# grow with both
_MAX_CHANGE_OF_STIFF = 0.15
# The same difference below which matrices count as equal: one node that slips where it stuck makes
# more, and costs iterations
_ROUND_OFF = 1e-6
# Cost of factorising a block, in Krylov iterations, at 200,000 to 400,000 dofs
_FACTORISATION_COST = 15
# Number of last Krylov iterations by whose mean reduction the remaining ones are estimated
_RATE_WINDOW = 10
# Displacement under a uniform traction, as a fraction of the largest one, that a spring's stiffness
# is limited to
_MIN_MOVED_FRACTION = 0.1
# Exponent of the stiffness for the shortest waves in the geometric mean of a spring's: on slabs of
# a dam's face 0 takes a fifth to two fifths more iterations, and one half between a tenth less and
# a quarter more
_SHORT_WAVE_EXPONENT = 1 / 3


class SoftStiffSolver:
    """Block preconditioner of soft and stiff bodies, with an approximate Schur complement.

    Once the multipliers are eliminated contact couples the unknowns c of soft bodies and m of stiff
    ones, which are their masters. With factors of A_cc the block triangular matrix

        M = [A_cc A_cm; 0 S]

    leaves A M^-1 with the eigenvalues of the Schur complement A_mm - A_mc A_cc^-1 A_cm times S^-1
    alone. S is A_mm with springs in the place of the soft bodies. For each unit of area these are
    as stiff as 1 / u for the longest waves, where a traction of one all over the contact moves a
    node by u, and as sum d / sum a for the shortest ones, d being the bulk's diagonal and a the
    contact area of closed nodes. A spring is a weighted geometric mean of both, as the condition of
    an optimised Schwarz method is (Gander 2006). The larger the contact the more long waves differ
    from short ones, and the more iterations that takes: once these are too many, a coarse model of
    the soft bodies takes the place of the ground. It takes fewer, but its factors and each
    iteration cost more.

    Multipliers that stay unknowns belong to m. Where no bodies differ all unknowns are in c.

    Factors serve until contact has changed their block much, and for as long as that costs fewer
    iterations than new ones.

    Attributes:
        iterations: Krylov iterations.
        factorisations: Factorisations of blocks.
    """

    def __init__(self, bulk: Bulk, bodies: Bodies, prefix: str):
        """Create a solver.

        Args:
            bulk: The bulk.
            bodies: The bodies.
            prefix: Prefix of the PETSc options.
        """
        self._bulk = bulk
        self._bodies = bodies
        self._prefix = prefix
        self._comm: MPI.Comm = bulk.comm
        self.iterations = self.factorisations = 0
        self._operator: CondensedOperator | None = None
        self._quiet = Quiet()
        self._has_model = False
        self.reset()

    def reset(self) -> None:
        """Drop all factors."""
        self._soft: _BlockFactors | None = None
        self._stiff: _BlockFactors | None = None
        self._built_at = -1
        self._ksp: PETSc.KSP | None = None
        self._updated_for: CondensedOperator | None = None
        self._per_area: Array | None = None
        self._model: CoarseModel | None = None
        # Iterations that new factors cost where those at hand are of another matrix, else zero, and
        # those lost since they were new
        self._renewal = 0
        self._lost = 0.0
        # Iterations for a reduction of the residual by e with new factors, the last ones most
        self._rate = 0.0
        # Residual that the iterations must fall below, what new factors would take to it, and
        # residuals of these iterations
        self._goal = self._otherwise = 0.0
        self._residuals: list[float] = []

    def tells_apart(self, operator: CondensedOperator) -> bool:
        """Whether there are stiff bodies and soft ones; all ranks must take part.

        Args:
            operator: The condensed matrix.
        """
        _, stiff = operator.parts(self._bodies)
        return reduce.anywhere(self._comm, len(stiff) > 0)

    def solve(
        self,
        operator: CondensedOperator,
        rhs: PETSc.Vec,
        v: PETSc.Vec,
        target: float,
        report: Report,
    ) -> bool:
        """Solve operator v = rhs.

        Args:
            operator: The condensed matrix.
            rhs: Right-hand side.
            v: Start of the iterations, overwritten by the solution.
            target: What the norm of the residual must fall below.
            report: Report whose times are added to.

        Returns:
            Whether the iterations converged.
        """
        self._operator = operator
        reduction = operator.reduction(rhs, v, target)
        if self._updated_for is not operator:
            self._update(operator, reduction, report)
        while not self._iterate(rhs, v, target, reduction, report):
            # What the iterations have reached is a start for those that follow
            reduction = operator.reduction(rhs, v, target)
            if self._renewal == 0:
                if self._stiff is None or self._has_model:
                    self.reset()
                    v.set(0.0)
                    return False
                self._has_model = True
                self._stiff.drop()
                self._rate = 0.0
            self._update(operator, None, report)
        return True

    def _iterate(
        self, rhs: PETSc.Vec, v: PETSc.Vec, target: float, reduction: float, report: Report
    ) -> bool:
        ksp = self._ksp
        assert ksp is not None
        most = (
            _MAX_ITERATIONS if self._stiff is None or self._model else _MAX_ITERATIONS_WITH_SPRINGS
        )
        self._goal = max(target, ROUNDING * rhs.norm())
        self._otherwise = self._renewal + self._rate * reduction
        self._residuals = []
        ksp.setTolerances(max_it=most)
        ksp.setInitialGuessNonzero(v.norm() > 0)
        # Factors of a singular block are not finite
        with report.timing("Krylov"), Quiet() as self._quiet, np.errstate(all="ignore"):
            ksp.solve(rhs, v)
        count = ksp.getIterationNumber()
        self.iterations += count
        if ksp.getConvergedReason() > 0:
            if self._renewal == 0:
                rate = count / reduction
                self._rate = (self._rate + rate) / 2 if self._rate > 0 else rate
            else:
                self._lost += max(0.0, count - self._rate * reduction)
            return True
        if not np.isfinite(v.norm()):
            v.set(0.0)
        return False

    def _test_convergence(
        self, ksp: PETSc.KSP, count: int, residual: float
    ) -> PETSc.KSP.ConvergedReason:
        """Whether iterations have converged, or are to go on; PETSc calls this.

        With old factors they end where those that are left by their last ones are more than new
        factors cost and take: what is left then are the slow parts.
        """
        reason = PETSc.KSP.ConvergedReason
        if not np.isfinite(residual):
            return reason.DIVERGED_NANORINF
        if residual <= self._goal:
            return reason.CONVERGED_ATOL
        self._residuals.append(residual)
        if self._renewal > 0 and count >= _RATE_WINDOW:
            left = np.log(residual / self._goal)
            reached = np.log(self._residuals[-1 - _RATE_WINDOW] / residual) / _RATE_WINDOW
            if left > reached * self._otherwise:
                return reason.DIVERGED_DTOL
        return reason.ITERATING

    def _update(self, operator: CondensedOperator, reduction: float | None, report: Report) -> None:
        """Bring the blocks up to what contact makes of the matrix; all ranks must take part.

        Args:
            operator: The condensed matrix.
            reduction: Logarithm of what the residual is to be reduced by; None if no factors of
                another matrix are to serve.
            report: Report whose times are added to.
        """
        # Vectors of the iterations before go first: factors are made where memory is fullest
        if self._ksp is not None:
            self._ksp.destroy()
        with report.timing("condensation"):
            transforms = operator.transforms()
            self._part(operator)
            soft, stiff = self._soft, self._stiff
            assert soft is not None
            change, is_symmetric = change_of(soft.part, transforms)
            is_symmetric = is_symmetric and self._bulk.is_symmetric
        if reduction is None or self._lost > self._renewal:
            max_of_soft = max_of_stiff = 0.0
        else:
            max_of_soft, max_of_stiff = _MAX_CHANGE_OF_SOFT, _MAX_CHANGE_OF_STIFF / reduction
        is_new = soft.update(
            change,
            lambda: soft.part.block(change, operator.eliminated),
            is_symmetric,
            soft.part.group,
            max_of_soft,
            report,
        )
        self.factorisations += is_new
        blocks = [soft]
        if stiff is not None:
            blocks.append(stiff)
            is_new = self._update_stiff(operator, stiff, transforms, max_of_stiff, report)
            self.factorisations += is_new
        self._renewal = _FACTORISATION_COST * sum(block.is_old for block in blocks)
        if self._renewal == 0:
            self._lost = 0.0
        self._updated_for = operator
        self._make(operator)

    def _update_stiff(
        self,
        operator: CondensedOperator,
        block: _BlockFactors,
        transforms: Transforms,
        max_change: float,
        report: Report,
    ) -> bool:
        """Bring the stiff block up to date; whether it was factorised."""
        part = block.part
        with report.timing("condensation"):
            change, is_symmetric = change_of(part, transforms)
            is_symmetric = is_symmetric and self._bulk.is_symmetric
            model = self._model_of(operator)
            if model is None:
                part.add_diagonal(change, self._springs(operator, report))

        def make() -> PETSc.Mat:
            A = part.block(change, operator.eliminated)
            if model is None:
                return A
            return model.block(A, transforms.right, part, operator.eliminated)

        group = part.group if model is None else min(part.group, model.group)
        return block.update(change, make, is_symmetric, group, max_change, report)

    def _model_of(self, operator: CondensedOperator) -> CoarseModel | None:
        """The coarse model, if there is to be one; all ranks must take part."""
        if self._has_model and self._model is None:
            assert self._soft is not None
            self._model = CoarseModel.of(
                operator.numbering,
                self._bulk,
                self._bodies.x[: operator.numbering.num_owned // operator.numbering.gdim],
                self._soft.part,
                operator.slave_dofs,
                self._prefix + "model_",
            )
        return self._model

    def _part(self, operator: CondensedOperator) -> None:
        """Split the unknowns, anew where the bodies or the bulk are others."""
        dofs = operator.parts(self._bodies)
        soft = self._soft
        same = soft is not None and np.array_equal(dofs[0], soft.part.dofs)
        if not reduce.everywhere(self._comm, same):
            self._per_area = None
        elif self._built_at == self._bulk.assemblies:
            return
        self._soft = self._stiff = self._model = None
        K = self._bulk.copy()
        numbering = operator.numbering
        self._soft = _BlockFactors(DofBlock(numbering, dofs[0], K), self._prefix + "soft_")
        if reduce.anywhere(self._comm, len(dofs[1]) > 0):
            self._stiff = _BlockFactors(DofBlock(numbering, dofs[1], K), self._prefix + "stiff_")
        K.destroy()
        self._built_at = self._bulk.assemblies

    def _springs(self, operator: CondensedOperator, report: Report) -> Array:
        """Springs that stand for soft bodies at their masters; all ranks must take part.

        Args:
            operator: The condensed matrix.
            report: Report whose times are added to.

        Returns:
            Springs at owned displacements, shape (num_owned,).
        """
        if self._per_area is None:
            with report.timing("factorisation"):
                self._per_area = self._soft_stiffness(operator)
        return operator.master_springs(self._per_area)

    def _soft_stiffness(self, operator: CondensedOperator) -> Array:
        """Stiffness of soft bodies for each unit of area, between that of long and short waves.

        All ranks must take part.

        Args:
            operator: The condensed matrix.

        Returns:
            Stiffness at owned displacements, zero in stiff bodies and where it is not known,
            shape (num_owned,).
        """
        assert self._soft is not None
        part = self._soft.part
        areas = operator.areas()[part.dofs]
        areas[self._bulk.markers[part.dofs] == 1] = 0
        axis = part.dofs % operator.numbering.gdim
        # PETSc may change what it factorises
        prefix = self._prefix + "soft_"
        ksp = _factorised(part.K.copy(), prefix, self._bulk.is_symmetric, part.group)
        f, u = part.K.createVecs()
        diagonal = np.abs(part.K.getDiagonal().array_r[areas > 0])
        closed = reduce.total(self._comm, np.array([diagonal.sum(), areas.sum()]))
        short = closed[0] / closed[1] if closed[1] > 0 else 0.0
        stiffness = np.zeros(operator.numbering.num_owned)
        for k in range(operator.numbering.gdim):
            f.array[:] = np.where(axis == k, areas, 0.0)
            with np.errstate(all="ignore"):
                ksp.solve(f, u)
            moved = np.where(axis == k, u.array_r, 0.0)
            moved[~np.isfinite(moved)] = 0
            most = reduce.largest(self._comm, float(moved.max(initial=0.0)))
            # Near supports no traction moves much, though short waves are no stiffer there
            known = moved > 0
            long = 1 / np.maximum(moved[known], _MIN_MOVED_FRACTION * most)
            mean = (
                long ** (1 - _SHORT_WAVE_EXPONENT) * np.maximum(short, long) ** _SHORT_WAVE_EXPONENT
            )
            stiffness[part.dofs[known]] = mean
        ksp.destroy()
        return stiffness

    def _make(self, operator: CondensedOperator) -> None:
        size = (operator.numbering.num_owned, None)
        called = SimpleNamespace(mult=weakly(self._multiply), apply=weakly(self._apply))
        A = PETSc.Mat().createPython((size, size), called, comm=self._comm)
        A.setUp()
        ksp = PETSc.KSP().create(comm=self._comm)
        ksp.setOptionsPrefix(self._prefix)
        ksp.setType("fgmres")
        ksp.setGMRESRestart(_MAX_ITERATIONS)
        ksp.setConvergenceTest(weakly(self._test_convergence))
        ksp.setOperators(A)
        pc = ksp.getPC()
        pc.setType("python")
        pc.setPythonContext(called)
        self._w = A.createVecLeft()
        self._ksp = ksp

    def _multiply(self, mat: PETSc.Mat, v: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the condensed matrix; PETSc calls this."""
        operator = self._operator
        assert operator is not None
        self._quiet.call(lambda: operator.mult(v, y), y)

    def _apply(self, pc: PETSc.PC, r: PETSc.Vec, z: PETSc.Vec) -> None:
        """Solve M z = r; PETSc calls this."""
        self._quiet.call(lambda: self._precondition(r, z), z)

    def _precondition(self, r: PETSc.Vec, z: PETSc.Vec) -> None:
        operator, soft, stiff = self._operator, self._soft, self._stiff
        assert operator is not None and soft is not None
        z.set(0.0)
        if stiff is None:
            z.array[soft.part.dofs] = soft.at(r.array_r)
            return
        z.array[stiff.part.dofs] = stiff.at(r.array_r)
        operator.mult(z, self._w)
        self._w.aypx(-1.0, r)
        z.array[soft.part.dofs] = soft.at(self._w.array_r)


class _BlockFactors:
    """Factors of a block.

    Attributes:
        part: Its dofs.
        is_old: Whether they are of another matrix.
    """

    def __init__(self, part: DofBlock, prefix: str):
        self.part = part
        self.is_old = False
        self._prefix = prefix
        self._change: PETSc.Mat | None = None
        self._ksp: PETSc.KSP | None = None

    def drop(self) -> None:
        """Drop the factors."""
        if self._ksp is not None:
            self._ksp.destroy()
        self._ksp = self._change = None

    def update(
        self,
        change: PETSc.Mat,
        make: Callable[[], PETSc.Mat],
        is_symmetric: bool,
        group: int,
        max_change: float,
        report: Report,
    ) -> bool:
        """Factorise it where contact has changed it; all ranks must take part.

        Args:
            change: What contact adds to the bulk's block.
            make: Makes the whole block; its first unknowns are those of the part.
            is_symmetric: Whether the block is symmetric.
            group: Number of successive unknowns that belong together.
            max_change: Relative difference to the change in the factors up to which they are kept.
            report: Report whose times are added to.

        Returns:
            Whether it was factorised.
        """
        if self._change is not None:
            difference = change.copy()
            difference.axpy(-1.0, self._change, DIFFERENT)
            size = change.norm()
            other = float(difference.norm())
            self.is_old = other > _ROUND_OFF * size
            if other <= max(max_change, _ROUND_OFF) * size:
                return False
        self.is_old = False
        # Factors are the largest part of the memory: those of before go first
        self.drop()
        with report.timing("condensation"):
            A = make()
            self._b, self._x = A.createVecs()
        with report.timing("factorisation"):
            self._ksp = _factorised(A, self._prefix, is_symmetric, group)
        self._change = change
        return True

    def at(self, values: Array) -> Array:
        """Solve for the values of all displacements, shape (num_owned,), at those of the block."""
        assert self._ksp is not None
        n = len(self.part.dofs)
        self._b.array[:n] = values[self.part.dofs]
        self._b.array[n:] = 0
        self._ksp.solve(self._b, self._x)
        found: Array = self._x.array_r[:n].copy()
        return found


def _factorised(A: PETSc.Mat, prefix: str, is_symmetric: bool, group: int) -> PETSc.KSP:
    """Factors of a matrix, whose entries are dropped; all ranks must take part.

    Args:
        A: The matrix.
        prefix: Prefix of the options.
        is_symmetric: Whether it is symmetric.
        group: Number of successive unknowns that belong together.
    """
    with block_options(prefix, is_symmetric=is_symmetric, group=group).in_database():
        ksp = PETSc.KSP().create(comm=A.comm)
        ksp.setOptionsPrefix(prefix)
        ksp.setFromOptions()
        if is_symmetric:
            A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        ksp.setOperators(A)
        ksp.setUp()
    ksp.getPC().setReusePreconditioner(True)
    # PETSc keeps the matrix, but nothing in it is used again
    A.setPreallocationNNZ(0)
    return ksp
