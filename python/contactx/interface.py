# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: its slave nodes, pairs, state and forms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, Pairs, State
from contactx.master.facets import FacetMaster
from contactx.master.master import Master
from contactx.master.obstacle import ObstacleMaster
from contactx.nodal import NodalValue
from contactx.obstacles import Obstacle
from contactx.surface import Surface
from dolfinx import cpp, fem, la


class Interface:
    """Discrete side of a contact.

    State belongs to the slave nodes, so that a new search loses nothing.

    Attributes:
        sliding: "finite" or "small".
        slaves: Slave nodes, numbered as the blocks of the displacement's dofmap, shape (n,).
        state: Vectors that the forms read.
        status: Status of each slave node, shape (n,).
        gap: Gap of each slave node, NaN where it has no pair, shape (n,).
        c: Factor of the gap in the complementarity, traction/length, shape (n,).
        value: Complementarity function, a force, shape (n,).
        d_pressure: Its derivative with respect to the pressure, shape (n,).
        forms: Forms, one set for each kind of facet that has pairs.
        master: Pairs with the master side.
        active: Whether the contact is switched on.
        immobile: Whether Dirichlet conditions leave neither a slave node nor its master anything
            to yield along the normal; such a node stays open, shape (n,).
    """

    def __init__(
        self,
        slave: Surface,
        master: Surface | Obstacle,
        u: fem.Function,
        X: la.Vector,
        *,
        sliding: str,
        search_distance: float | None,
        offset: float | fem.Function,
        markers: npt.NDArray[np.int8],
    ):
        """Find the slave nodes and pair them in the reference configuration.

        Args:
            slave: Slave surface.
            master: Master surface or rigid obstacle.
            u: Displacement.
            X: Reference positions of the nodes of ``u``.
            sliding: "finite" or "small".
            search_distance: Largest distance of a pair; chosen if None.
            offset: What is taken off the gap: a number, or a function in a scalar linear space.
            markers: 1 at dofs with a Dirichlet condition, shape (num_dofs,).

        Raises:
            ValueError: If the surfaces share nodes, or an obstacle's parameters do not fit.
        """
        V = u.function_space
        self._comm = V.mesh.comm
        self._gdim = V.mesh.geometry.dim
        self.sliding = sliding
        self._held = sliding == "small"
        self._u = u
        self._bulk_map = V.dofmap.index_map
        facets = slave.facet_nodes(V)
        self.slaves = np.unique(facets.nodes)
        x = X.array.reshape(-1, self._gdim)
        self.master: Master
        if isinstance(master, Obstacle):
            self.master = ObstacleMaster(self.slaves, master, search_distance)
        else:
            others = master.facet_nodes(V)
            shared = np.intersect1d(facets.nodes, others.nodes)
            if len(shared) > 0:
                raise ValueError(
                    f"slave and master overlap: {slave} and {master} share {len(shared)} nodes. "
                    "Give each body its own nodes and each surface its own facets"
                )
            self.master = FacetMaster(facets, others, x, search_distance)
        n = len(self.slaves)
        self._slave_map = cpp.common.IndexMap(self._comm, n)
        vector = la.vector
        self.state = State(
            displacement=u.x,
            position=X,
            multiplier=vector(self._slave_map, 1),
            area=vector(self._slave_map, 1),
            gap_derivative=vector(self._slave_map, 1),
        )
        self.state.area.array[:] = core.nodal_areas(facets.offsets, facets.nodes, x, self._gdim)[
            self.slaves
        ]
        self.status = np.full(n, core.OPEN, dtype=np.int8)
        self.gap = np.full(n, np.nan)
        self.c = np.ones(n)
        self.value = np.zeros(n)
        self.d_pressure = np.zeros(n)
        self.active = True
        self.immobile = np.zeros(n, dtype=bool)
        self._offset = NodalValue(offset, "offset", V, self.slaves)
        self.forms: list[ContactForms] = []
        self._free = markers.reshape(-1, self._gdim) == 0
        self.master.search(x, self.status)
        self._make_forms()
        self._find_immobile()

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of the bulk's nodes, shape (num_nodes, gdim)."""
        x: npt.NDArray[np.float64] = self.state.position.array + self._u.x.array
        return x.reshape(-1, self._gdim)

    def begin_step(self) -> None:
        """Start a step: pairs are released, and a moved obstacle of small sliding is seen."""
        self.hold(False)
        self.master.forget_flips()
        if self.sliding == "small" and self.master.is_rigid:
            self._pair(self.state.position.array.reshape(-1, self._gdim))

    def search(self) -> int:
        """Pair the slave nodes in the current configuration, unless pairs are held.

        Returns:
            Number of nodes in contact whose facet has changed.
        """
        return 0 if self._held else self._pair(self.positions())

    def _pair(self, x: npt.NDArray[np.float64]) -> int:
        closed = (self.status != core.OPEN).astype(np.int8)
        changed, new = self.master.search(x, closed)
        if new:
            self._make_forms()
        else:
            self._update_forms(self.master.pairs())
        self._find_immobile()
        return changed

    def _find_immobile(self) -> None:
        self.immobile = self.master.paired & (self.master.mobility(self._free) < 1e-8)

    def _update_forms(self, groups: list[Pairs]) -> None:
        for form, pairs in zip(self.forms, groups, strict=True):
            form.update(pairs)

    def hold(self, held: bool) -> None:
        """Hold the pairs of finite sliding with their normals and projections, or release them.

        Held pairs make the contact conditions linear. Small sliding always holds its pairs.

        Args:
            held: Whether to hold them.
        """
        if self.sliding == "finite" and held != self._held:
            self._held = held
            self._make_forms()

    def _make_forms(self) -> None:
        """Make the forms of the current pairs."""
        kinematics = "small" if self._held else "finite"
        self.forms = [
            ContactForms(self._comm, kinematics, pairs, self.state, self._bulk_map, self._slave_map)
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
        self.c[:] = 1 / np.median(total[usable]) if usable.any() else 1.0
        self.c[usable] = 1 / total[usable]

    def update_gap(self) -> None:
        """First pass: assemble the gap of each slave node."""
        fresh = self.master.refresh(self.positions(), self._held)
        if fresh is not None:
            self._update_forms(fresh)
        self.gap[:] = 0
        for form in self.forms:
            fem.assemble_vector(self.gap, form.gap)
        self.gap -= self._offset.now()
        self.gap[~self.master.paired] = np.nan
        if not self.active:
            self.gap[:] = np.nan

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
        gap = self.master.inside(x) - self._offset.now()
        size = np.ptp(x[self.slaves], axis=0).max(initial=0.0)
        inside: npt.NDArray[np.int32] = self.slaves[self.immobile & (gap < -1e-9 * size)]
        return inside

    def update_status(self) -> int:
        """Set each slave node's status from its pressure and gap.

        Returns:
            Number of nodes that changed.
        """
        gap = np.where(self.immobile, np.nan, self.gap)
        return core.normal_status(self.state.multiplier.array, gap, self.c, self.status)

    def drop_open_pressures(self) -> None:
        """Take the pressure off open nodes.

        The pressures of an iterate whose active set is far too large are wild, and the stiffness
        that they would give to nodes that have just opened throws the next iterate off.
        """
        self.state.multiplier.array[self.status == core.OPEN] = 0

    def evaluate_law(self) -> None:
        """Second pass: the complementarity function and its derivatives."""
        core.normal_complementarity(
            self.state.multiplier.array,
            self.gap,
            self.c,
            self.state.area.array,
            self.status,
            self.value,
            self.d_pressure,
            self.state.gap_derivative.array,
        )

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Third pass: add the contact forces.

        Args:
            b: Residual of the bulk, shape (num_nodes * gdim,).
        """
        for form in self.forms:
            fem.assemble_vector(b, form.residual)

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """Copy of all that the next step depends on.

        Returns:
            Arrays by their names, with shapes and types that never change.
        """
        return {
            "active": np.array(self.active),
            "multiplier": self.state.multiplier.array.copy(),
            "status": self.status.copy(),
            "gap": self.gap.copy(),
            **{f"master_{name}": values for name, values in self.master.save().items()},
        }

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """Go on from what ``save`` gave for the same contact.

        Args:
            saved: Arrays by their names, of the same shapes and types.

        Raises:
            ValueError: If a pair is with a facet that does not exist; nothing has changed.
        """
        self.master.load({name.removeprefix("master_"): saved[name] for name in saved})
        self.active = bool(saved["active"])
        self.state.multiplier.array[:] = saved["multiplier"]
        self.status[:] = saved["status"]
        self.gap[:] = saved["gap"]
        self._held = self.sliding == "small"
        self._make_forms()
        self._find_immobile()
