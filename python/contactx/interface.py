# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: its slave nodes, pairs, state and forms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, Pairs, State
from contactx.law.law import Law
from contactx.law.nodes import Nodes
from contactx.master.make import make_master
from contactx.master.master import Master
from contactx.master.obstacle import ObstacleMaster
from contactx.nodal import NodalValue
from contactx.obstacles import Obstacle
from contactx.slip import SlipHistory
from contactx.surface import Surface
from dolfinx import cpp, fem, la

# Share of a relative movement that must be free for a constraint on it
_MOBILE = 0.05


@dataclass(frozen=True)
class Checkpoint:
    """State of a contact that a failed step returns to."""

    master: Master
    multiplier: npt.NDArray[np.float64]
    status: npt.NDArray[np.int8]
    gap: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    slip: npt.NDArray[np.float64]


class Interface:
    """Discrete side of a contact.

    State belongs to the slave nodes, so that a new search loses nothing.

    Attributes:
        sliding: "finite" or "small".
        law: Contact law.
        slaves: Slave nodes, numbered as the blocks of the displacement's dofmap, shape (n,).
        state: Vectors that the forms read.
        nodes: State of the slave nodes.
        history: Slip of the accepted steps; None where none is measured.
        forms: Forms, one set for each kind of facet that has pairs.
        master: Pairs with the master side.
        active: Whether the contact is switched on.
    """

    def __init__(
        self,
        slave: Surface,
        master: Surface | Obstacle,
        u: fem.Function,
        X: la.Vector,
        *,
        law: Law,
        sliding: str,
        search_distance: float | None,
        offset: NodalValue,
        markers: npt.NDArray[np.int8],
    ):
        """Find the slave nodes and pair them in the reference configuration.

        Args:
            slave: Slave surface.
            master: Master surface or rigid obstacle.
            u: Displacement.
            X: Reference positions of the nodes of ``u``.
            law: Contact law.
            sliding: "finite" or "small".
            search_distance: Largest distance of a pair; chosen if None.
            offset: What is taken off the gap.
            markers: 1 at dofs with a Dirichlet condition, shape (num_dofs,).

        Raises:
            ValueError: If the surfaces share nodes, or an obstacle's parameters do not fit.
        """
        V = u.function_space
        self._comm = V.mesh.comm
        self._gdim = gdim = V.mesh.geometry.dim
        self.law = law
        self.sliding = sliding
        self._held = sliding == "small"
        self._u = u
        self._bulk_map = V.dofmap.index_map
        facets = slave.facet_nodes(V)
        self.slaves = np.unique(facets.nodes)
        x = X.array.reshape(-1, gdim)
        self.master: Master = make_master(
            facets, master, V, x, law, sliding=sliding, search_distance=search_distance
        )
        n = len(self.slaves)
        self._slave_map = cpp.common.IndexMap(self._comm, n)
        self.state = _make_state(u, X, self._slave_map, law)
        self.state.area.array[:] = core.nodal_areas(facets.offsets, facets.nodes, x, gdim)[
            self.slaves
        ]
        self.nodes = Nodes(self.state, gdim)
        self.history = SlipHistory(n, gdim) if law.is_vector and not law.is_tied else None
        self._touched = np.zeros(n, dtype=bool)
        self.active = True
        self._offset = offset
        self.forms: list[ContactForms] = []
        self._free = markers.reshape(-1, gdim) == 0
        self.master.accept(self.positions())
        self.master.begin_step()
        self.master.search(x, self.nodes.status)
        self._make_forms()
        self._find_immobile()

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of the bulk's nodes, shape (num_nodes, gdim)."""
        x: npt.NDArray[np.float64] = self.state.position.array + self._u.x.array
        return x.reshape(-1, self._gdim)

    @property
    def follows(self) -> bool:
        """Whether pairs, normals and projections follow the deformation."""
        return self.sliding == "finite" and not self.law.is_tied

    def begin_step(self) -> None:
        """Start a step: pairs are released, and a moved obstacle of small sliding is seen."""
        self.hold(False)
        self.master.begin_step()
        self._touched = self.nodes.closed
        if self.sliding == "small" and self.master.is_rigid:
            self._pair(self.state.position.array.reshape(-1, self._gdim))
        elif self.history is not None:
            self._update_forms(self.master.pairs())

    def accept(self) -> None:
        """Take the converged state as the start of the next step."""
        self.master.accept(self.positions())
        if self.history is not None:
            self.history.add(self.nodes)

    def search(self) -> int:
        """Pair the slave nodes in the current configuration, unless pairs are held.

        Returns:
            Number of nodes in contact whose facet has changed.
        """
        return self._pair(self.positions()) if self.follows and not self._held else 0

    def _pair(self, x: npt.NDArray[np.float64]) -> int:
        changed, new = self.master.search(x, self.nodes.closed.astype(np.int8))
        if new:
            self._make_forms()
        else:
            self._update_forms(self.master.pairs())
        self._find_immobile()
        return changed

    def _find_immobile(self) -> None:
        along, each = self.master.mobility(self._free)
        self.nodes.immobile = self.master.paired & (along < 1e-8)
        if self.law.is_vector:
            # A projection over an open gap on a tilted facet leaves a symmetry plane by a little
            self.nodes.mobile = np.where(each < _MOBILE, 0.0, 1.0)

    def _update_forms(self, groups: list[Pairs]) -> None:
        for form, pairs in zip(self.forms, groups, strict=True):
            form.update(pairs)

    def hold(self, held: bool) -> None:
        """Hold the pairs of finite sliding with their normals and projections, or release them.

        Held pairs make the contact conditions linear. Small sliding always holds its pairs.

        Args:
            held: Whether to hold them.
        """
        if self.follows and held != self._held:
            self._held = held
            self._make_forms()

    def _make_forms(self) -> None:
        """Make the forms of the current pairs."""
        kinematics = "small" if self._held else "finite"
        self.forms = [
            ContactForms(
                self._comm,
                self.law.name,
                kinematics,
                pairs,
                self.state,
                self._bulk_map,
                self._slave_map,
            )
            for pairs in self.master.pairs()
        ]

    def set_factor(self, stiffness: npt.NDArray[np.float64]) -> None:
        """Set the factor c of the gap: the stiffness of a pair over the slave node's area.

        Slave node and master facet are springs in series: where one is much stiffer than the
        other, the softer one decides how fast a gap closes. Any c > 0 has the same solution.

        Args:
            stiffness: Stiffness of each node of the bulk, NaN where it cannot move.
        """
        compliance = np.zeros_like(stiffness)
        np.divide(1, stiffness, out=compliance, where=stiffness > 0)
        total = compliance[self.slaves] + self.master.compliance(compliance)
        total *= self.state.area.array
        usable = total > 0
        self.nodes.c[:] = 1 / np.median(total[usable]) if usable.any() else 1.0
        self.nodes.c[usable] = 1 / total[usable]

    def update_gap(self) -> None:
        """First pass: assemble gap, normal and slip of each slave node."""
        offset = self._offset_now()
        fresh = self.master.refresh(self.positions(), self._held, offset)
        if fresh is not None:
            self._update_forms(fresh)
        nodes = self.nodes
        nodes.gap[:] = nodes.normal[:] = nodes.slip[:] = 0
        for form in self.forms:
            fem.assemble_vector(nodes.gap, form.gap)
            if form.normal is not None:
                fem.assemble_vector(nodes.normal.reshape(-1), form.normal)
        self._assemble_slip()
        nodes.gap -= offset
        nodes.gap[~self.master.paired] = np.nan
        if not self.active:
            nodes.gap[:] = np.nan

    def _assemble_slip(self) -> None:
        self.nodes.slip[:] = 0
        for form in self.forms:
            if form.slip is not None:
                fem.assemble_vector(self.nodes.slip.reshape(-1), form.slip)

    def _offset_now(self) -> npt.NDArray[np.float64]:
        return np.broadcast_to(self._offset.now(), self.nodes.gap.shape)

    def held_inside(self, prescribed: npt.NDArray[np.float64]) -> npt.NDArray[np.int32]:
        """Slave nodes that Dirichlet conditions hold inside a rigid obstacle.

        Args:
            prescribed: Displacement with the Dirichlet values, shape (num_dofs,).

        Returns:
            The nodes, numbered as the blocks of the displacement's dofmap.
        """
        if not isinstance(self.master, ObstacleMaster):
            return np.array([], dtype=np.int32)
        x = (self.state.position.array + prescribed).reshape(-1, self._gdim)
        gap = self.master.inside(x) - self._offset_now()
        size = np.ptp(x[self.slaves], axis=0).max(initial=0.0)
        inside: npt.NDArray[np.int32] = self.slaves[self.nodes.immobile & (gap < -1e-9 * size)]
        return inside

    def update_status(self) -> int:
        """Set each slave node's status from its pressure and gap.

        Returns:
            Number of nodes that changed.
        """
        nodes = self.nodes
        if self.history is not None:
            # False for the gap NaN, too
            closing = nodes.pressure - nodes.c * nodes.closable_gap > 0
            first = closing & ~self._touched
            if first.any():
                self.master.touch(first, self.positions(), self._offset_now())
                self._touched = self._touched | first
                fresh = self.master.refresh(self.positions(), self._held, self._offset_now())
                self._update_forms(self.master.pairs() if fresh is None else fresh)
                self._assemble_slip()
        return self.law.set_status(nodes)

    def drop_open_pressures(self) -> None:
        """Take the pressure off open nodes.

        The pressures of an iterate whose active set is far too large are wild, and the stiffness
        that they would give to nodes that have just opened throws the next iterate off.
        """
        self.nodes.multiplier.reshape(-1, self.nodes.size)[~self.nodes.closed] = 0

    def evaluate_law(self) -> None:
        """Second pass: the complementarity function and its derivatives."""
        self.law.evaluate(self.nodes)

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Third pass: add the contact forces.

        Args:
            b: Residual of the bulk, shape (num_nodes * gdim,).
        """
        for form in self.forms:
            fem.assemble_vector(b, form.residual)

    def checkpoint(self) -> Checkpoint:
        """Copy what a step changes."""
        return Checkpoint(
            self.master.copy(),
            self.nodes.multiplier.copy(),
            self.nodes.status.copy(),
            self.nodes.gap.copy(),
            self.nodes.normal.copy(),
            self.nodes.slip.copy(),
        )

    def restore(self, checkpoint: Checkpoint) -> None:
        """Return to a checkpoint."""
        self.master = checkpoint.master.copy()
        self.nodes.multiplier[:] = checkpoint.multiplier
        self.nodes.status[:] = checkpoint.status
        self.nodes.gap[:] = checkpoint.gap
        self.nodes.normal[:] = checkpoint.normal
        self.nodes.slip[:] = checkpoint.slip
        self._held = self.sliding == "small"
        self._make_forms()


def _make_state(u: fem.Function, X: la.Vector, slave_map: Any, law: Law) -> State:
    """Vectors that the forms read, zero on the slave nodes."""
    gdim = X.block_size
    size = gdim if law.is_vector else 1

    def vector(block: int) -> la.Vector:
        return la.vector(slave_map, block)

    return State(
        displacement=u.x,
        position=X,
        multiplier=vector(size),
        area=vector(1),
        gap_derivative=vector(size),
        slip_derivative=vector(gdim * gdim) if law.is_vector else None,
        normal_derivative=vector(gdim * gdim) if law.is_vector else None,
    )
