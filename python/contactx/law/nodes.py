# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of the slave nodes of one contact."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import State
from contactx.law.mean_normal import MeanNormal
from contactx.parallel.reduce import largest, total
from dolfinx import la

type Array = npt.NDArray[np.float64]


class Nodes:
    """What a contact law reads and writes, one row a slave node that this rank owns.

    Attributes:
        size: Components of the multiplier: 1, or the geometric dimension.
        multiplier: Multiplier, a view of what the forms read, shape (n * size,).
        area: Reference area, shape (n,).
        status: Status, shape (n,).
        gap: Gap, NaN where there is no pair, shape (n,).
        normal: Unit normal of the master; empty for scalar multipliers, shape (n, gdim).
        slip: Slip increment of the step; empty for scalar multipliers, shape (n, gdim).
        c: Factor of the gap in the complementarity, traction/length, shape (n,).
        immobile: Whether Dirichlet conditions keep slave node and master from moving along the
            normal; such a node stays open, shape (n,).
        mobile: 1 in directions in which slave node or master can move, else 0; empty for scalar
            multipliers, shape (n, gdim).
        ceded: Whether a node leaves this contact to another one that it closes, shape (n,).
        softness: Compliance of a layer between the surfaces, over 1 / c; zero but on a soft path.
        smooth: Whether friction is left out because a node closes several contacts, shape (n,).
        turns: How often slip has turned back in this step, shape (n,).
        closings: How often nodes have closed with slip in this step, shape (n,).
        value: Complementarity function, a force, shape (n * size,).
        by_multiplier: Its derivative, shape (n, size, size).
        by_gap: Its derivative, a view of what the forms read, shape (n * size,).
        by_slip: Its derivative; empty for scalar multipliers, shape (n * gdim**2,).
        by_normal: Its derivative; empty for scalar multipliers, shape (n * gdim**2,).
        mean: Normals that are means over facets; None where a node has one of its own.
    """

    def __init__(self, state: State, n: int, gdim: int, *, has_means: bool = False):
        """Create the state: every node open.

        Args:
            state: Vectors that the forms read.
            n: Number of slave nodes.
            gdim: Geometric dimension.
            has_means: Whether normals are means over facets.
        """
        self.size: int = state.multiplier.block_size
        self.multiplier: Array = state.multiplier.array[: n * self.size]
        self.area: Array = state.area.array[:n]
        # What is divided by it goes nowhere for slave nodes of other ranks
        state.area.array[n:] = 1
        self.by_gap: Array = state.gap_derivative.array[: n * self.size]
        rows = n if state.slip_derivative is not None else 0
        self.mean = MeanNormal(n, gdim) if has_means and rows > 0 else None
        self.status = np.full(n, core.OPEN, dtype=np.int8)
        self.gap = np.full(n, np.nan)
        self.normal = np.zeros((rows, gdim))
        self.slip = np.zeros((rows, gdim))
        self.c = np.ones(n)
        self.immobile = np.zeros(n, dtype=bool)
        self.mobile = np.ones((rows, gdim))
        self.ceded = np.zeros(n, dtype=bool)
        self.smooth = np.zeros(n, dtype=bool)
        self.turns = np.zeros(n, dtype=np.int32)
        self.closings = np.zeros(n, dtype=np.int32)
        self.softness = 0.0
        self.value = np.zeros(n * self.size)
        self.by_multiplier = np.zeros((n, self.size, self.size))

        def rows_of(vector: la.Vector | None) -> Array:
            return np.zeros(0) if vector is None else vector.array[: n * gdim * gdim]

        self.by_slip = rows_of(state.slip_derivative)
        self.by_normal = rows_of(state.normal_derivative)

    def set_factor(self, compliance: Array, comm: MPI.Comm) -> None:
        """Set the factor c to the stiffness of a pair over the slave node's area.

        Any c > 0 has the same solution. All ranks must take part.

        Args:
            compliance: Compliance of each node's pair, length/force, zero where it is unknown;
                shape (n,).
            comm: Communicator.
        """
        product = compliance * self.area
        usable = product[product > 0]
        logs, count = total(comm, np.array([np.log(usable).sum(), len(usable)]))
        # Where nothing can move: the geometric mean of the others
        usual = np.exp(logs / count) if count > 0 else 1.0
        self.c[:] = 1 / np.where(product > 0, product, usual)

    @property
    def closed(self) -> npt.NDArray[np.bool_]:
        """Whether each node is in contact, shape (n,)."""
        closed: npt.NDArray[np.bool_] = self.status != core.OPEN
        return closed

    @property
    def held(self) -> npt.NDArray[np.bool_]:
        """Whether each node is in contact, or would be if another condition let it, shape (n,)."""
        held: npt.NDArray[np.bool_] = self.closed | self.immobile | self.ceded
        return held

    @property
    def closable_gap(self) -> Array:
        """Gap, NaN where a node cannot close, shape (n,)."""
        return np.where(self.immobile | self.ceded, np.nan, self.gap)

    @property
    def pressure(self) -> Array:
        """Pressure, force/area, shape (n,)."""
        if self.size == 1:
            return self.multiplier
        pressure: Array = np.einsum("ij,ij->i", self.normal, self.multiplier.reshape(-1, self.size))
        return pressure

    def closing(self, tie: float = -1.0) -> npt.NDArray[np.bool_]:
        """Which nodes the complementarity closes, or a gap of at most a tie.

        As ``pressure_hat`` of the core has it: a closed node only opens without pressure.

        Args:
            tie: Gap, of either sign, up to which nodes touch; none if negative.

        Returns:
            Which ones, shape (n,).
        """
        gap = self.closable_gap
        # False for the gap NaN, too
        above = np.where(self.closed, np.minimum(gap, 0), gap)
        closing: npt.NDArray[np.bool_] = self.pressure - self.c * above > 0
        return closing | (np.abs(gap) <= tie)

    def close(self, which: npt.NDArray[np.integer]) -> None:
        """Close nodes, whatever their pressures: they stick where there is friction.

        Args:
            which: Nodes by their number in the contact.
        """
        sticks = (self.size > 1) & ~self.smooth[which]
        self.status[which] = np.where(sticks, core.STICK, core.SLIP)

    def drop_open(self) -> None:
        """Take the multiplier off open nodes.

        Those of an iterate whose active set is far too large are wild, and the stiffness that they
        would give to nodes that have just opened throws the next iterate off.
        """
        self.multiplier.reshape(-1, self.size)[~self.closed] = 0


def touching_gap(comm: MPI.Comm, x: Array) -> float:
    """Gap up to which nodes touch but for rounding; all ranks must take part.

    Args:
        comm: Communicator.
        x: Their positions on this rank, shape (n, gdim).
    """
    high, low = (f(axis=0, initial=-np.inf) for f in (x.max, (-x).max))
    ends = largest(comm, np.concatenate([high, low]))
    if not np.isfinite(ends).all():
        return 0.0
    size = (ends[: x.shape[1]] + ends[x.shape[1] :]).max()
    rounding = 16 * np.finfo(np.float64).eps * np.abs(ends).max()
    return float(1e-12 * size + rounding)
