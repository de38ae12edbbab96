# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""CG or GMRES with PETSc's algebraic multigrid, kept from one condensed matrix to the next."""

from __future__ import annotations

from contextlib import nullcontext
from types import SimpleNamespace

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx._host.bulk import Bulk
from contactx._host.callbacks import Quiet, weakly
from contactx._host.condensed.galerkin import Galerkin
from contactx._host.condensed.numbering import Array, Index
from contactx._host.condensed.operator import CondensedOperator, ContactUpdate
from contactx._host.options import ROUNDING, multigrid_options, product_options
from contactx._host.parallel import reduce
from contactx.report import Report

# Cost of a hierarchy, in Krylov iterations, as measured from 7,000 to 160,000 dofs
_HIERARCHY_COST = 40
# Krylov iterations for a reduction of the residual by e, from which on a direct solver is faster:
# thin stiff bodies
SLOW_RATE = 12
# Preconditioned from where the norm of the residual itself is at hand
_SIDES = {"cg": PETSc.PC.Side.LEFT, "gmres": PETSc.PC.Side.RIGHT}
_INDEFINITE = (
    PETSc.KSP.ConvergedReason.DIVERGED_INDEFINITE_MAT,
    PETSc.KSP.ConvergedReason.DIVERGED_INDEFINITE_PC,
)


class Multigrid:
    """A Krylov solver with a hierarchy of the bulk that is updated with the contact.

    Aggregates and prolongations are those of the bulk without contact, made once. What contact
    changes in the condensed matrix is few rows, and its projections are added to the matrices of
    the coarser levels, so these are always the Galerkin products of the current matrix. On the
    finest level the condensed matrix is applied as it is.

    Where the bulk's own matrix changes the hierarchy is made anew once it has cost as many
    iterations too many as a new one costs, or where the iterations do not converge with it.

    Attributes:
        iterations: Krylov iterations.
        hierarchies: Hierarchies made.
    """

    def __init__(self, bulk: Bulk, x: Array, prefix: str):
        """Create a solver.

        Args:
            bulk: The bulk.
            x: Reference positions of the owned nodes, shape (num_owned, gdim).
            prefix: Prefix of the PETSc options.
        """
        self._bulk = bulk
        self._comm: MPI.Comm = bulk.comm
        self._x = x
        self._prefix = prefix
        self._ksp: PETSc.KSP | None = None
        # Iterations for a reduction by e while the hierarchy was new, and those lost since
        self._rate = self._lost = 0.0
        self._built_at = 0
        self._smoothers: list[PETSc.KSP] = []
        self.iterations = self.hierarchies = 0
        size = (x.size, None)
        self._operator: CondensedOperator | None = None
        # What the hierarchy was brought up to, and whether without its coarser levels
        self._updated_for: CondensedOperator | None = None
        self._serves = False
        self._slow = SLOW_RATE
        self._quiet = Quiet()
        called = SimpleNamespace(mult=weakly(self._multiply))
        self._A = PETSc.Mat().createPython((size, size), called, comm=self._comm)
        self._A.setUp()

    def solve(
        self,
        operator: CondensedOperator,
        rhs: PETSc.Vec,
        v: PETSc.Vec,
        target: float,
        report: Report,
        slow: int = SLOW_RATE,
    ) -> bool:
        """Solve operator v = rhs.

        Args:
            operator: The condensed matrix.
            rhs: Right-hand side.
            v: Start of the iterations, overwritten by the solution.
            target: What the norm of the residual must fall below.
            report: Report whose times are added to.
            slow: Krylov iterations for a reduction by e from which on another solver is faster.

        Returns:
            Whether the iterations converged.
        """
        self._operator, self._slow = operator, slow
        if self._lost > _HIERARCHY_COST:
            self.reset()
        if self._ksp is None:
            self._build(operator.slave_dofs, report)
        if self._updated_for is not operator:
            change = operator.contact_update()
            self._serves = self._galerkin.nearly_serves(change)
            self._update(change, report, coarse=not self._serves)
        if self._iterate(operator, rhs, v, target, report):
            return True
        if self._serves:
            self._serves = False
            self._update(operator.contact_update(), report)
            if self._iterate(operator, rhs, v, target, report):
                return True
        if self._built_at != self._bulk.assemblies:
            self._build(operator.slave_dofs, report)
            self._update(operator.contact_update(), report)
            if self._iterate(operator, rhs, v, target, report):
                return True
        self.reset()
        return False

    def reset(self) -> None:
        """Drop the hierarchy: two at once would be the largest part of the memory."""
        if self._ksp is not None:
            self._ksp.destroy()
        self._ksp = self._updated_for = None

    def _iterate(
        self,
        operator: CondensedOperator,
        rhs: PETSc.Vec,
        v: PETSc.Vec,
        target: float,
        report: Report,
    ) -> bool:
        ksp = self._ksp
        assert ksp is not None
        reduction = operator.reduction(rhs, v, target)
        # Pressures on turning normals and bodies without support may leave a matrix indefinite
        for method in ("cg", "gmres") if operator.is_symmetric else ("gmres",):
            ksp.setType(method)
            ksp.setPCSide(_SIDES[method])
            ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
            # A start of zero costs no product
            ksp.setInitialGuessNonzero(v.norm() > 0)
            ksp.setTolerances(rtol=ROUNDING, atol=target, max_it=20 + int(self._slow * reduction))
            with report.timing("Krylov"), Quiet() as self._quiet:
                ksp.solve(rhs, v)
            count = ksp.getIterationNumber()
            self.iterations += count
            if self._built_at == self._bulk.assemblies:
                self._rate = max(self._rate, count / reduction)
            else:
                self._lost += max(0.0, count - self._rate * reduction)
            reason = ksp.getConvergedReason()
            if reason > 0:
                return True
            v.set(0.0)
            if reason not in _INDEFINITE:
                break
        return False

    def _multiply(self, mat: PETSc.Mat, v: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the condensed matrix; PETSc calls this."""
        operator = self._operator
        assert operator is not None
        self._quiet.call(lambda: operator.mult(v, y), y)

    def _build(self, slave_dofs: Index, report: Report) -> None:
        with report.timing("hierarchy"):
            self._make(slave_dofs)
        self._built_at = self._bulk.assemblies
        self._rate = self._lost = 0.0
        self.hierarchies += 1

    def _make(self, slave_dofs: Index) -> None:
        self.reset()
        P = self._bulk.copy()
        P.setBlockSize(self._x.shape[1])
        # Rows of prescribed displacements have a one and no neighbours
        prescribed = self._bulk.markers[: self._x.size] == 1
        P.setNearNullSpace(near_null_space(self._x, prescribed, self._comm))
        ksp = PETSc.KSP().create(comm=self._comm)
        ksp.setOptionsPrefix(self._prefix)
        pc = ksp.getPC()
        pc.setType("gamg")
        ksp.setOperators(self._A, P)
        # Of several ranks PETSc knows others
        products = product_options().in_database() if self._comm.size == 1 else nullcontext()
        with products, multigrid_options(self._prefix).in_database():
            ksp.setFromOptions()
            if pc.getType() != "gamg":
                raise ValueError(
                    f"option {self._prefix}pc_type: the condensed solver knows gamg and bodies, "
                    f"not {pc.getType()}; for a direct solver of the whole set pc_type to lu"
                )
            with Quiet() as self._quiet:
                ksp.setUp()
        # From here on the finest level needs a diagonal alone
        self._D = PETSc.Mat().createDiagonal(P.getDiagonal())
        ksp.setOperators(self._A, self._D)
        levels = pc.getMGLevels()
        if levels == 1:
            # A handful of unknowns
            pc.setType("jacobi")
            self._smoothers = [ksp]
        else:
            pc.setReusePreconditioner(True)
            smoothers = [pc.getMGSmoother(level) for level in range(levels - 1, 0, -1)]
            self._smoothers = [*smoothers, pc.getMGCoarseSolve()]
            if self._comm.size == 1:
                # Of several ranks the first has all of the coarsest level, as one block
                direct = self._smoothers[-1].getPC()
                direct.setType("lu")
                direct.setFactorShift(PETSc.Mat.FactorShiftType.INBLOCKS)
        for level, smoother in enumerate(self._smoothers):
            smoother.getPC().setReusePreconditioner(False)
            if 0 < level < levels - 1:
                # Contact adds eigenvalues that no estimate of the bulk foresees; this needs none
                smoother.setType("richardson")
                smoother.getPC().setType("sor")
        self._smoothers[0].setOperators(self._A, self._D)
        # PETSc keeps the matrix, but nothing in it is used again
        P.setPreallocationNNZ(0)
        P.setNearNullSpace(PETSc.NullSpace())
        self._galerkin = Galerkin(
            self._comm,
            self._bulk.rows(slave_dofs),
            [pc.getMGInterpolation(level) for level in range(levels - 1, 0, -1)],
        )
        self._ksp = ksp

    def _update(self, change: ContactUpdate, report: Report, *, coarse: bool = True) -> None:
        """Bring the hierarchy up to what contact makes of the matrix.

        Args:
            change: What contact changes in the bulk's matrix.
            report: Report whose times are added to.
            coarse: Whether on the coarser levels too.
        """
        self._updated_for = self._operator
        finest, *coarser = self._smoothers
        with report.timing("condensation"):
            self._D.setDiagonal(change.bound)
            # PETSc reads a matrix that has changed in place only where it is set again
            finest.setOperators(self._A, self._D)
            if not coarse or not coarser:
                return
            matrices = [smoother.getOperators()[0] for smoother in coarser]
            self._galerkin.update(change, matrices)
            # Nor does it see that a pattern has changed
            coarser[-1].getPC().reset()
            for smoother, A in zip(coarser, matrices, strict=True):
                smoother.setOperators(A, A)


def near_null_space(x: Array, prescribed: npt.NDArray[np.bool_], comm: MPI.Comm) -> PETSc.NullSpace:
    """Rigid modes of all nodes, zero where displacements are prescribed; all ranks must take part.

    Hertz takes up to 15 % more iterations where they are not zero there.

    Args:
        x: Positions of the owned nodes, shape (num_owned, gdim).
        prescribed: Whether a displacement is prescribed, shape (num_owned * gdim,).
        comm: Communicator.

    Returns:
        Three modes in 2D, six in 3D.
    """
    # About the origin of a far body rotations are all but translations, and lost in round-off
    middle = reduce.total(comm, x.sum(axis=0)) / reduce.total(comm, len(x))
    nodes = PETSc.Vec().createWithArray((x - middle).ravel(), bsize=x.shape[1], comm=comm)
    # PETSc lets nobody change its own
    modes = [mode.copy() for mode in PETSc.NullSpace().createRigidBody(nodes).getVecs()]
    for mode in modes:
        mode.array[prescribed] = 0
    return PETSc.NullSpace().create(vectors=modes, comm=comm)
