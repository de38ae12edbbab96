# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""When a residual is small enough."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.bulk import Bulk
from contactx.cell_forces import CellForces
from contactx.errors import NotFiniteError
from contactx.interface import Interface
from contactx.parallel.reduce import everywhere, extent, largest, norm
from contactx.system import SaddlePointSystem

# Rounding errors of a sum of a few terms
_EPS = 16 * np.finfo(np.float64).eps
# Displacement over the size of the scene, or what is prescribed
_FAR = 1e3
# Residual over forces that would deform bodies by their own size, below which it may be no more
# than the rounding error of forces that cancel
_TINY = 1e-8


class ConvergenceCriterion:
    """Compares the residual with the forces of the problem.

    Rows of Dirichlet conditions are differences of displacements. They are compared apart from the
    forces, so that the criterion does not depend on the units.

    Attributes:
        extent: Size of the scene.
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
        self._stiff = 0.0
        # Where strains are differences of 1 and the deformation gradient, they have its rounding
        self._size = np.zeros(1) if bulk.is_linear else bulk.cell_sizes()
        self.extent: float = extent(self._comm, system.halo.x).max()
        self._least_scale: float | None = None
        self._cell_forces = CellForces(bulk.residual_form, bulk.u, system.halo, bulk.form_options)
        # Sizes of the forces that cancel, and the residual before
        self._cancelling: npt.NDArray[np.float64] | None = None
        self._before: float | None = None
        # Forces of the bulk at the last solution, and what its residual was relative to
        self._accepted: tuple[npt.NDArray[np.float64], float] | None = None

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
        self._stiff = norm(self._comm, self._stiffness)
        self._least_scale = None
        self._cancelling = None
        self._before = None
        self._look_into_cells(self.scale())

    def __call__(self, rtol: float, atol: float) -> tuple[float, float, float]:
        """Evaluate the criterion for the system's residual.

        The residual is relative to the forces of the bulk: in equilibrium the bulk's residual is
        what supports and contacts carry. Multipliers are no measure of the forces: far from the
        solution they may be huge, and where a constraint is redundant they are arbitrary.

        The tolerance is not below the rounding errors of the forces of stiff bodies. These errors
        must not hide a residual elsewhere: once the whole residual is below the tolerance, what
        exceeds the rounding error at each node must be below a tolerance without rounding errors.

        Where all forces cancel, as in a stress-free thermal strain, nothing but rounding errors is
        left to measure the residual by. It is small then if it is no larger than the rounding error
        at each node.

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
            self._least_scale = max(scale, 1e-6 * residual, self._scale_of_accepted())
        scale = max(scale, self._least_scale)
        of_gaps, of_forces = self._rounding()
        strict = float(max(rtol * scale, atol, of_gaps))
        excused = np.minimum(of_forces, 1e-6 * scale)
        whole = min(norm(self._comm, of_forces), 1e-6 * scale)
        tolerance = float(max(rtol * scale, atol, of_gaps + whole))
        sizes = np.linalg.norm(force.reshape(-1, self._system.block), axis=1)
        if residual > tolerance:
            errors = self._rounding_of_cancelling(residual)
            if errors is None or residual > of_gaps + norm(self._comm, errors):
                return residual, tolerance, defect
            excused, whole = errors, norm(self._comm, errors)
        if self._has_run_away():
            return residual, 0.0, defect
        rest = norm(self._comm, np.maximum(sizes - excused, 0.0), *constraints)
        if rest <= strict:
            return residual, float(max(tolerance, of_gaps + whole)), defect
        return (rest, strict, defect) if residual <= tolerance else (residual, tolerance, defect)

    def _rounding_of_cancelling(self, residual: float) -> npt.NDArray[np.float64] | None:
        """Rounding errors of forces that cancel, at each owned node; None where they are smaller.

        Args:
            residual: Norm of the residual.
        """
        before, self._before = self._before, residual
        # A residual that still falls is more than that
        if residual > self._largest_error() and (before is None or residual > 0.1 * before):
            self._look_into_cells(residual)
        return None if residual > self._largest_error() else self._errors()

    def _largest_error(self) -> float:
        """What the norm of the rounding errors cannot exceed, which costs little."""
        most = largest(
            self._comm, self._displacements().max(initial=0.0) + self._size.max(initial=0.0)
        )
        forces = self._stiff * most
        if self._cancelling is not None:
            forces += norm(self._comm, self._cancelling)
        return float(_EPS * forces)

    def may_be_rounding(self, residual: float) -> bool:
        """Whether a residual would deform bodies by less than anyone asks for."""
        return residual <= _TINY * self._stiff * self.extent

    def _look_into_cells(self, force: float) -> None:
        """Assemble the forces that cancel between cells and terms, once a step at most.

        Args:
            force: Norm of what is left of them; if it is not tiny they do not matter.
        """
        if self._cancelling is None and self.may_be_rounding(force) and force > 0:
            self._cancelling = self._cell_forces.magnitudes()

    def _errors(self) -> npt.NDArray[np.float64]:
        forces = self._stiffness * (self._around(self._displacements()) + self._size)
        return _EPS * (forces if self._cancelling is None else forces + self._cancelling)

    def scale_of_balance(self) -> float:
        """Forces that those on a free body are balanced relative to.

        Rounding errors of forces that cancel push no body anywhere.
        """
        return max(self.scale(), 1e6 * norm(self._comm, self._errors()))

    def _displacements(self) -> npt.NDArray[np.float64]:
        """Sizes of the displacements of all nodes, shape (num_nodes,)."""
        u: npt.NDArray[np.float64] = np.linalg.norm(
            self._bulk.u.x.array.reshape(-1, self._system.block), axis=1
        )
        return u

    def _around(self, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Mean, over the cells around each owned node, of the largest value in each cell.

        A node that stays where it is has the rounding errors of forces from those around it.

        Args:
            values: Values of all nodes, shape (num_nodes,).
        """
        V, halo = self._bulk.u.function_space, self._system.halo
        topology = V.mesh.topology
        cells = V.dofmap.list[: topology.index_map(topology.dim).size_local]
        most = np.repeat(values[cells].max(axis=1, initial=0.0), cells.shape[1])
        nodes = cells.ravel()
        sums = [np.bincount(nodes, of, halo.num_nodes) for of in (most, None)]
        total, count = (halo.scatter_reverse(of.astype(np.float64)) for of in sums)
        mean: npt.NDArray[np.float64] = total / np.maximum(count, 1)
        return mean

    def accept(self) -> None:
        """Take the converged state as the start of the next step."""
        assert self._least_scale is not None
        scale = max(self.scale(), self._least_scale)
        self._accepted = self._system.bulk_residual().copy(), scale

    def _scale_of_accepted(self) -> float:
        """What the last solution was relative to, while nothing has changed since; else zero.

        It was large enough for these forces, and the same solve again must have nothing to do.
        """
        if self._accepted is None:
            return 0.0
        forces, scale = self._accepted
        same = np.array_equal(forces, self._system.bulk_residual())
        return scale if everywhere(self._comm, same) else 0.0

    def _has_run_away(self) -> bool:
        """Whether a body is so far away that its forces are but rounding errors."""
        most = largest(self._comm, np.abs(self._bulk.u.x.array).max(initial=0.0))
        return bool(most > _FAR * self.farthest())

    def farthest(self) -> float:
        """How far bodies may have to move; all ranks must take part.

        The size of the scene, or the largest Dirichlet value, which may take a body anywhere.
        """
        given = self._bulk.prescribed()[self._bulk.markers == 1]
        prescribed = largest(self._comm, float(np.abs(given).max(initial=0.0)))
        return float(max(self.extent, prescribed))

    def scale(self) -> float:
        """Forces of the problem: norm of the bulk's residual."""
        return norm(self._comm, self._system.bulk_residual())

    def _rounding(self) -> tuple[float, npt.NDArray[np.float64]]:
        """Residual that rounding leaves: of the contact conditions, and of the forces at each node.

        A gap is a difference of positions, the forces of a stiff body sums of stiffness times
        displacement that cancel. Displacements count only while what they leave is small against
        the forces: a body that has run away is no solution.
        """
        u = self._displacements()[: self._system.halo.num_owned]
        farthest, most = largest(
            self._comm,
            np.array([np.abs(self._system.halo.x).max(initial=0.0), u.max(initial=0.0)]),
        )
        nodes = [i.nodes for i in self._interfaces]
        weights = [np.where(n.closed, n.area * n.c, 0.0) for n in nodes]
        gaps = norm(self._comm, *(w * (farthest + most) for w in weights))
        return _EPS * gaps, _EPS * self._stiffness * (u + self._size)
