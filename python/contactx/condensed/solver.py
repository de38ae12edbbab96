# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Solver of the condensed system."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx.bulk import Bulk
from contactx.condensed.blocks import Array, ContactBlocks
from contactx.condensed.elimination import Elimination, NotCondensable
from contactx.condensed.operator import CondensedOperator
from contactx.options import direct_options, multigrid_options
from contactx.report import Report
from contactx.system import SaddlePointSystem

# A hierarchy is made anew when it needs so many more iterations than at first
_TIRED = 1.6
_SOME = 8
_SLOW = "the iterations did not converge"


class CondensedSolver:
    """Solves the system of the Jacobian.

    The multipliers are eliminated and the displacements found by CG, or GMRES where friction slips,
    with PETSc's algebraic multigrid on the condensed matrix and the rigid modes of the bodies. A
    hierarchy is kept until it converges too slowly, over iterations and steps. What cannot be
    condensed is solved with a direct solver as it is.

    Attributes:
        rtol: Relative tolerance of the next solve.
        iterations: Krylov iterations since ``begin``.
        hierarchies: Hierarchies made since ``begin``.
        direct: Solves that were not condensed since ``begin``, and why.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, modes: Array, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            modes: Rigid modes of the whole, orthonormal, shape (k, num_dofs).
            prefix: Prefix of the options of the inner solver.
        """
        self._bulk = bulk
        self._system = system
        self._modes = modes
        self._prefix = prefix
        self._free = (bulk.markers == 0).astype(np.float64)
        self._ksp: PETSc.KSP | None = None
        self._P: PETSc.Mat | None = None
        self._fresh = 0
        self._last = 0
        self.rtol = 1e-10
        self.springs: Array | None = None
        self.begin(Report())

    def begin(self, report: Report) -> None:
        """Start a step.

        Args:
            report: Report whose times are added to.
        """
        self._report = report
        self.iterations = self.hierarchies = 0
        self.direct: list[str] = []

    def solve(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b.

        Args:
            b: Right-hand side in all unknowns.
            x: Solution, overwritten.
        """
        try:
            with self._report.timing("condensation"):
                contact = self._system.assemble_contact()
                blocks = ContactBlocks(contact, self._system.num_bulk)
                elimination = Elimination(
                    self._system.interfaces, blocks, self._free, self._system.block
                )
                operator = CondensedOperator(
                    self._bulk.jacobian(), blocks, elimination, self.springs
                )
        except NotCondensable as reason:
            self._solve_directly(b, x, str(reason))
            return
        # What does not converge twice will not, and each attempt is dear
        promising = self.direct.count(_SLOW) < 2
        if not (promising and self._solve(operator, elimination, blocks, b, x)):
            self._solve_directly(b, x, _SLOW)

    def _solve(
        self,
        operator: CondensedOperator,
        elimination: Elimination,
        blocks: ContactBlocks,
        b: PETSc.Vec,
        x: PETSc.Vec,
    ) -> bool:
        force, d = np.split(b.array_r, [self._system.num_bulk])
        known = elimination.open_multipliers(d)
        K = self._bulk.jacobian()
        h, w = K.createVecs()
        rhs, v = w.duplicate(), h.duplicate()
        w.array[:] = force
        T = blocks.traction
        np.add.at(w.array, T.rows, -T.values * known[T.columns])
        balance = w.duplicate()
        w.copy(balance)
        h.array[:] = elimination.shift(d)
        work = w.duplicate()
        operator.bulk(h, work)
        w.axpy(-1.0, work)
        operator.combine(w, rhs)
        operator.add_law(h, rhs, -1.0)
        rhs.array[:] += elimination.extra(d)
        rhs.array[elimination.eliminated] = 0
        is_symmetric = elimination.is_symmetric and _is_symmetric(K)
        if not self._krylov(operator, is_symmetric, rhs, v):
            return False
        operator.expand(v, work)
        h.axpy(1.0, work)
        operator.bulk(h, work)
        balance.axpy(-1.0, work)
        elimination.recover(balance.array_r, known)
        x.array[: self._system.num_bulk] = h.array_r
        x.array[self._system.num_bulk :] = known
        return True

    def _krylov(
        self, operator: CondensedOperator, is_symmetric: bool, rhs: PETSc.Vec, v: PETSc.Vec
    ) -> bool:
        size = rhs.getSize()
        A = PETSc.Mat().createPython((size, size), operator, comm=PETSc.COMM_SELF)
        A.setUp()
        fresh = self._ksp is None or self._last > _TIRED * self._fresh + _SOME
        for _ in range(2):
            if fresh:
                self._build(operator)
            assert self._ksp is not None
            self._ksp.setType("cg" if is_symmetric else "gmres")
            self._ksp.setOperators(A, self._P)
            self._ksp.getPC().setReusePreconditioner(True)
            self._ksp.setTolerances(rtol=self.rtol, atol=0, max_it=400)
            with self._report.timing("Krylov"):
                self._ksp.solve(rhs, v)
            count = self._ksp.getIterationNumber()
            self.iterations += count
            # At the tolerance of 1e-10, so that loose solves do not look better than they are
            self._last = round(count * np.log(1e-10) / np.log(min(self.rtol, 0.1)))
            if fresh:
                self._fresh = self._last
            if self._ksp.getConvergedReason() > 0:
                return True
            if fresh:
                break
            fresh = True
        self._ksp = None
        return False

    def _build(self, operator: CondensedOperator) -> None:
        with self._report.timing("hierarchy"):
            if self._ksp is not None:
                # Two hierarchies at once would be the largest part of the memory
                self._ksp.destroy()
                if self._P is not None:
                    self._P.destroy()
                self._ksp = None
            self._P = P = operator.assembled()
            P.setBlockSize(self._system.block)
            vectors = []
            for mode in self._modes:
                vector = P.createVecRight()
                vector.array[:] = mode
                vectors.append(vector)
            P.setNearNullSpace(PETSc.NullSpace().create(vectors=vectors))
            ksp = PETSc.KSP().create(comm=PETSc.COMM_SELF)
            ksp.setOptionsPrefix(self._prefix)
            pc = ksp.getPC()
            pc.setType("gamg")
            ksp.setOperators(P, P)
            with multigrid_options(self._prefix).in_database():
                ksp.setFromOptions()
                ksp.setUp()
            self._ksp = ksp
        self.hierarchies += 1

    def _solve_directly(self, b: PETSc.Vec, x: PETSc.Vec, reason: str) -> None:
        self.direct.append(reason)
        with self._report.timing("direct"):
            ksp = PETSc.KSP().create(comm=b.comm)
            prefix = self._prefix + "direct_"
            ksp.setOptionsPrefix(prefix)
            with direct_options(prefix).in_database():
                ksp.setFromOptions()
                ksp.setOperators(self._system.jacobian(springs=self.springs))
                ksp.solve(b, x)
            ksp.destroy()


def _is_symmetric(K: PETSc.Mat) -> bool:
    """Whether x.Ky = y.Kx for two random vectors: any asymmetry shows, but for chance."""
    x, y = K.createVecs()
    work = y.duplicate()
    rng = np.random.default_rng(0)
    for vector in (x, y):
        vector.array[:] = rng.standard_normal(vector.getSize())
    K.mult(y, work)
    one, size = x.dot(work), work.norm() * x.norm()
    K.mult(x, work)
    return bool(abs(one - y.dot(work)) <= 1e-12 * size)
