# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A coarse model of soft bodies, on which stiff ones lie by springs."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx._host.bulk import Bulk
from contactx._host.condensed.diagonal_blocks import DofBlock
from contactx._host.condensed.multigrid import near_null_space
from contactx._host.condensed.numbering import (
    Array,
    Index,
    Numbering,
    diagonal_matrix,
    index_set,
    own_columns,
)
from contactx._host.options import aggregation_options
from contactx._host.parallel import reduce

# Stiffness of a spring, relative to the diagonal of the soft body's matrix where it acts: of 0.02,
# 0.05, 0.1 and 0.3 the one with the fewest iterations on slabs of a dam's face
_SPRING_STIFFNESS = 0.1
# Relative increase of the diagonal, so that a body that contact alone supports leaves no singular
# block
_DIAGONAL_SHIFT = 1e-6


class CoarseModel:
    """Stands for soft bodies where stiff ones are solved for.

    Smoothed aggregation gives the soft bodies few unknowns g, with u_c = P g and the stiffness
    K_g = P^T K_cc P. At each eliminated displacement of theirs, which follows the masters' by R, a
    spring joins both, of stiffness D. With the springs' forces q as unknowns the matrix

        [ A_mm   0     R^T  ]
        [  0    K_g   -P^T  ]
        [  R    -P   -D^-1  ]

    has few entries, where R^T D R would couple all masters of a slave node.

    Attributes:
        group: Number of successive unknowns that belong together, those of a node or of an
            aggregate; one if there are none such.
    """

    def __init__(
        self,
        numbering: Numbering,
        stiffness: PETSc.Mat,
        P: PETSc.Mat,
        soft: DofBlock,
        slaves: Index,
    ):
        """Create a model; see ``of``.

        Args:
            numbering: Displacements on this rank.
            stiffness: Stiffness of the model.
            P: What its unknowns move the displacements of soft slave nodes by.
            soft: Displacements of the soft bodies.
            slaves: Those of slave nodes among them, owned.
        """
        self._rows = numbering.index_set(slaves)
        self._comm = numbering.comm
        self._K = stiffness
        self._P = P
        diagonal = np.zeros(numbering.num_owned)
        diagonal[soft.dofs] = np.abs(soft.K.getDiagonal().array_r)
        self._springs: Array = _SPRING_STIFFNESS * diagonal[slaves]
        is_grouped = stiffness.getLocalSize()[0] % soft.group == 0
        self.group = soft.group if reduce.everywhere(numbering.comm, is_grouped) else 1

    @classmethod
    def of(
        cls,
        numbering: Numbering,
        bulk: Bulk,
        x: Array,
        soft: DofBlock,
        slave_dofs: Index,
        prefix: str,
    ) -> CoarseModel | None:
        """Make a model of soft bodies; all ranks must take part.

        Args:
            numbering: Displacements on this rank.
            bulk: The bulk.
            x: Reference positions of the owned nodes, shape (n, gdim).
            soft: Displacements of the soft bodies.
            slave_dofs: Displacements of all slave nodes.
            prefix: Prefix of the PETSc options.

        Returns:
            The model; None where there are too few unknowns to aggregate.
        """
        gdim = numbering.gdim
        nodes = np.unique(soft.dofs // gdim)
        # Prescribed ones of their slave nodes are in the other block
        dofs = (nodes[:, None] * gdim + np.arange(gdim)).ravel()
        every = numbering.index_set(dofs)
        whole = bulk.copy()
        A = whole.createSubMatrix(every, every)
        whole.destroy()
        A.setBlockSize(gdim)
        A.setNearNullSpace(near_null_space(x[nodes], bulk.markers[dofs] == 1, numbering.comm))
        ksp = PETSc.KSP().create(comm=numbering.comm)
        ksp.setOptionsPrefix(prefix)
        ksp.setOperators(A)
        with aggregation_options(prefix, A.getSize()[0]).in_database():
            ksp.setFromOptions()
            ksp.setUp()
        pc = ksp.getPC()
        if pc.getMGLevels() < 2:
            return None
        P = pc.getMGInterpolation(1)
        slaves = np.intersect1d(soft.dofs, slave_dofs)
        places = np.searchsorted(dofs, slaves)
        at_slaves = P.createSubMatrix(index_set(places, P), own_columns(P))
        stiffness = pc.getMGCoarseSolve().getOperators()[0].copy()
        diagonal = stiffness.getDiagonal()
        diagonal.scale(1 + _DIAGONAL_SHIFT)
        stiffness.setDiagonal(diagonal)
        return cls(numbering, stiffness, at_slaves, soft, slaves)

    def block(
        self, A: PETSc.Mat, right: PETSc.Mat, stiff: DofBlock, eliminated: Index
    ) -> PETSc.Mat:
        """The matrix of stiff bodies, the model and the springs; all ranks must take part.

        Args:
            A: A_mm, without couplings of what is eliminated; its unknowns come first.
            right: Eliminated displacements by the others, (num_dofs, num_dofs).
            stiff: Displacements of the stiff bodies.
            eliminated: Owned displacements that are eliminated.
        """
        R = right.createSubMatrix(self._rows, stiff.index_set)
        is_active = np.diff(R.getValuesCSR()[0]) > 0
        # A group of which one is active is taken as a whole
        is_taken = np.repeat(is_active.reshape(-1, self.group).any(axis=1), self.group)
        taken = index_set(np.flatnonzero(is_taken), R)
        R = R.createSubMatrix(taken, own_columns(R))
        P = self._P.createSubMatrix(taken, own_columns(self._P))
        roots, kept = R.createVecLeft(), R.createVecRight()
        roots.array[:] = np.sqrt(np.where(is_active, self._springs, 0.0)[is_taken])
        kept.set(1.0)
        kept.array[stiff.places(eliminated)] = 0
        R.diagonalScale(roots, kept)
        P.diagonalScale(roots)
        P.scale(-1.0)
        forces = diagonal_matrix(-np.ones(P.getLocalSize()[0]), self._comm)
        of_R, of_P = R.transpose(PETSc.Mat()), P.transpose(PETSc.Mat())
        rows = [[A, None, of_R], [None, self._K, of_P], [R, P, forces]]
        return PETSc.Mat().createNest(rows, comm=self._comm).convert("aij", PETSc.Mat())
