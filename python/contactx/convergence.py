# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""When a residual is small enough."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.bulk import Bulk
from contactx.errors import NotFiniteError
from contactx.interface import Interface
from contactx.parallel.reduce import extent, largest, norm
from contactx.system import SaddlePointSystem

# Rounding errors of a sum of a few terms
_EPS = 16 * np.finfo(np.float64).eps
# Displacement over the size of the scene, or what is prescribed
_FAR = 1e3


class ConvergenceCriterion:
    """Compares the residual with the forces of the problem.

    Rows of Dirichlet conditions are differences of displacements. They are compared apart from the
    forces, so that the criterion does not depend on the units.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], system: SaddlePointSystem):
        """Create the criterion.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            system: The coupled system.
        """
        self._bulk = bulk
        self._interfaces = interfaces
        self._system = system
        self._comm = system.halo.comm
        self._stiffness = np.zeros(0)
        # Where strains are differences of 1 and the deformation gradient, they have its rounding
        self._size = 0.0 if bulk.is_linear else bulk.cell_sizes()
        self._extent: float = extent(self._comm, system.halo.x).max()
        self._least_scale: float | None = None

    def check_start(self) -> None:
        """Check the residual at the start of a step; all ranks must take part.

        Raises:
            NotFiniteError: If it is NaN or infinite.
        """
        if not np.isfinite(self.scale()):
            raise NotFiniteError(
                "the residual is not finite: the material fails at the start of the step, or a "
                "load or coefficient of F is NaN or infinite"
            )

    def begin_step(self, stiffness: npt.NDArray[np.float64]) -> None:
        """Start a step.

        Args:
            stiffness: Stiffness of each node of this rank, NaN where it cannot move.
        """
        self._stiffness = np.nan_to_num(stiffness)
        self._least_scale = None

    def __call__(self, rtol: float, atol: float) -> tuple[float, float, float]:
        """Evaluate the criterion for the system's residual.

        The residual is relative to the forces of the bulk: in equilibrium the bulk's residual is
        what supports and contacts carry. Multipliers are no measure of the forces: far from the
        solution they may be huge, and where a constraint is redundant they are arbitrary.

        The tolerance is not below the rounding errors of the forces of stiff bodies. These errors
        must not hide a residual elsewhere: once the whole residual is below the tolerance, what
        exceeds the rounding error at each node must be below a tolerance without rounding errors.

        Args:
            rtol: Tolerance relative to the forces.
            atol: Absolute tolerance.

        Returns:
            Norm of the residual, what it must not exceed, and the largest difference from a
            Dirichlet value.
        """
        force, *constraints = self._system.blocks(self._system.b.array_r)
        prescribed = self._bulk.markers[: len(force)] == 1
        defect = largest(self._comm, float(np.abs(force[prescribed]).max(initial=0.0)))
        force = np.where(prescribed, 0.0, force)
        residual = norm(self._comm, force, *constraints)
        scale = self.scale()
        if self._least_scale is None:
            # Unloading ends without forces. What the first change of the Dirichlet values asks
            # for says little: a stiff body that moves as a whole asks for much and gets nothing
            self._least_scale = max(scale, 1e-6 * residual)
        scale = max(scale, self._least_scale)
        of_gaps, of_forces = self._rounding()
        excused = np.minimum(of_forces, 1e-6 * scale)
        whole = min(norm(self._comm, of_forces), 1e-6 * scale)
        tolerance = float(max(rtol * scale, atol, of_gaps + whole))
        if residual <= tolerance:
            if self._has_run_away():
                return residual, 0.0, defect
            sizes = np.linalg.norm(force.reshape(-1, self._system.block), axis=1)
            rest = norm(self._comm, np.maximum(sizes - excused, 0.0), *constraints)
            strict = float(max(rtol * scale, atol, of_gaps))
            if rest > strict:
                return rest, strict, defect
        return residual, tolerance, defect

    def _has_run_away(self) -> bool:
        """Whether a body is so far away that its forces are but rounding errors.

        Dirichlet values may take a body anywhere, so that they count for its distance.
        """
        given = self._bulk.prescribed()[self._bulk.markers == 1]
        sizes = [np.abs(a).max(initial=0.0) for a in (self._bulk.u.x.array, given)]
        most, prescribed = largest(self._comm, np.array(sizes))
        return bool(most > _FAR * max(self._extent, prescribed))

    def scale(self) -> float:
        """Forces of the problem: norm of the bulk's residual."""
        return norm(self._comm, self._system.bulk_residual())

    def _rounding(self) -> tuple[float, npt.NDArray[np.float64]]:
        """Residual that rounding leaves: of the contact conditions, and of the forces at each node.

        A gap is a difference of positions, the forces of a stiff body sums of stiffness times
        displacement that cancel. Displacements count only while what they leave is small against
        the forces: a body that has run away is no solution.
        """
        block = self._bulk.u.function_space.dofmap.index_map_bs
        owned = self._bulk.u.x.array[: self._bulk.num_dofs]
        u = np.linalg.norm(owned.reshape(-1, block), axis=1)
        farthest, most = largest(
            self._comm,
            np.array([np.abs(self._system.halo.x).max(initial=0.0), u.max(initial=0.0)]),
        )
        nodes = [i.nodes for i in self._interfaces]
        weights = [np.where(n.closed, n.area * n.c, 0.0) for n in nodes]
        gaps = norm(self._comm, *(w * (farthest + most) for w in weights))
        return _EPS * gaps, _EPS * self._stiffness * (u + self._size)
