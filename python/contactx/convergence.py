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


class Judge:
    """Measures the residual against the forces of the problem.

    Displacements enter the Dirichlet rows and are judged apart from the forces, so that the
    judgement does not depend on the units.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], system: SaddlePointSystem):
        """Create the judge.

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

    def begin(self, stiffness: npt.NDArray[np.float64]) -> None:
        """Start a step.

        Args:
            stiffness: Stiffness of each node of this rank, NaN where it cannot move.
        """
        self._stiffness = np.nan_to_num(stiffness)
        self._least_scale = None

    def __call__(self, rtol: float, atol: float) -> tuple[float, float, float]:
        """Judge the system's residual.

        The forces of the problem are those of the bulk: in equilibrium its residual is what
        supports and contacts carry. Multipliers are no measure, they may be wild or, where a
        constraint is redundant, without meaning.

        What rounding leaves of the forces of a stiff body excuses nothing elsewhere: once the whole
        is small, softer bodies are judged without it, and so are the contact conditions.

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
        """Whether a body is so far off that its forces are rounding of its distortion.

        Dirichlet values may take it anywhere.
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
