# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: its slave nodes, pairs, state and forms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, Pairs, State
from contactx.surface import FacetList, Surface
from dolfinx import cpp, fem, la


@dataclass(frozen=True)
class Checkpoint:
    """State of a contact that a failed step returns to."""

    pairing: core.Pairing
    multiplier: npt.NDArray[np.float64]
    status: npt.NDArray[np.int8]
    gap: npt.NDArray[np.float64]


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
        reach: Largest distance of a pair.
    """

    def __init__(
        self, slave: Surface, master: Surface, sliding: str, u: fem.Function, X: la.Vector
    ):
        """Find the slave nodes and pair them in the reference configuration.

        Args:
            slave: Slave surface.
            master: Master surface.
            sliding: "finite" or "small".
            u: Displacement.
            X: Reference positions of the nodes of ``u``.

        Raises:
            ValueError: If the surfaces share nodes.
        """
        V = u.function_space
        self._comm = V.mesh.comm
        self._gdim = V.mesh.geometry.dim
        self.sliding = sliding
        self._held = sliding == "small"
        self._u = u
        self._bulk_map = V.dofmap.index_map
        slave_facets, master_facets = slave.facet_nodes(V), master.facet_nodes(V)
        shared = np.intersect1d(slave_facets.nodes, master_facets.nodes)
        if len(shared) > 0:
            raise ValueError(
                f"slave and master overlap: {slave} and {master} share {len(shared)} nodes. "
                "Give each body its own nodes and each surface its own facets"
            )
        self._master = master_facets
        self._pairing = core.Pairing(
            slave_facets.offsets,
            slave_facets.nodes,
            master_facets.offsets,
            master_facets.nodes,
            self._gdim,
        )
        self.slaves = self._pairing.slaves
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
        self.state.area.array[:] = core.nodal_areas(
            slave_facets.offsets, slave_facets.nodes, X.array, self._gdim
        )[self.slaves]
        self.status = np.full(n, core.OPEN, dtype=np.int8)
        self.gap = np.full(n, np.nan)
        self.c = np.ones(n)
        self.value = np.zeros(n)
        self.d_pressure = np.zeros(n)
        self.forms: list[ContactForms] = []
        self._facet = np.full(n, -1, dtype=np.int32)
        self._feature = np.zeros(n, dtype=np.int32)
        self.reach = _default_reach(X.array.reshape(-1, self._gdim), slave_facets, master_facets)
        self._pairing.update(X.array, self.reach, self.status)
        self._make_forms()

    @property
    def num_pairs(self) -> int:
        """Number of slave nodes that have a pair."""
        return int(np.count_nonzero(self._facet >= 0))

    @property
    def frozen(self) -> npt.NDArray[np.int32]:
        """Slave nodes whose pair was frozen in this step."""
        return self._pairing.frozen()

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of the bulk's nodes, flattened."""
        x: npt.NDArray[np.float64] = self.state.position.array + self._u.x.array
        return x

    def forget_flips(self) -> None:
        """Let frozen pairs move again and count anew how often pairs go back and forth."""
        self._pairing.begin_step()

    def search(self) -> int:
        """Pair the slave nodes in the current configuration, unless pairs are held.

        Returns:
            Number of nodes in contact whose facet has changed.
        """
        if self._held:
            return 0
        closed = (self.status != core.OPEN).astype(np.int8)
        changed = self._pairing.update(self.positions(), self.reach, closed)
        same = np.array_equal(self._pairing.facet, self._facet) and np.array_equal(
            self._pairing.feature, self._feature
        )
        if same:
            for form, pairs in zip(self.forms, self._pairs(), strict=True):
                form.update(pairs)
        else:
            self._make_forms()
        return changed

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
        self._facet, self._feature = self._pairing.facet, self._pairing.feature
        kinematics = "small" if self._held else "finite"
        self.forms = [
            ContactForms(self._comm, kinematics, pairs, self.state, self._bulk_map, self._slave_map)
            for pairs in self._pairs()
        ]

    def _pairs(self) -> list[Pairs]:
        """Pairs by the number of nodes of their facets."""
        found = self._pairing
        data = np.column_stack([found.feature, found.xi, found.cone, found.normal])
        sizes = np.diff(self._master.offsets)[self._facet]
        groups = []
        for size in np.unique(sizes[self._facet >= 0]):
            slaves = np.flatnonzero((self._facet >= 0) & (sizes == size)).astype(np.int32)
            first = self._master.offsets[self._facet[slaves]]
            facets = self._master.nodes[first[:, None] + np.arange(size)]
            nodes = np.column_stack([self.slaves[slaves], facets])
            groups.append(Pairs(slaves, nodes, data[slaves]))
        return groups

    def set_factor(self, stiffness: npt.NDArray[np.float64]) -> None:
        """Set the factor c of the gap: the stiffness of a pair over the slave node's area.

        Slave node and master facet are springs in series: where one is much stiffer than the
        other, the softer one decides how fast a gap closes. Any c > 0 has the same solution.

        Args:
            stiffness: Stiffness of each node of the bulk, NaN where it cannot move.
        """
        compliance = np.zeros_like(stiffness)
        np.divide(1, stiffness, out=compliance, where=stiffness > 0)
        total = compliance[self.slaves]
        master = np.full(len(total), np.median(compliance[self._master.nodes]))
        for pairs in self._pairs():
            master[pairs.slaves] = compliance[pairs.nodes[:, 1:]].mean(axis=1)
        total = (total + master) * self.state.area.array
        usable = total > 0
        self.c[:] = 1 / np.median(total[usable]) if usable.any() else 1.0
        self.c[usable] = 1 / total[usable]

    def update_gap(self) -> None:
        """First pass: assemble the gap of each slave node."""
        self.gap[:] = 0
        for form in self.forms:
            fem.assemble_vector(self.gap, form.gap)
        self.gap[self._facet < 0] = np.nan

    def update_status(self) -> int:
        """Set each slave node's status from its pressure and gap.

        Returns:
            Number of nodes that changed.
        """
        return core.normal_status(self.state.multiplier.array, self.gap, self.c, self.status)

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

    def checkpoint(self) -> Checkpoint:
        """Copy what a step changes."""
        return Checkpoint(
            self._pairing.copy(),
            self.state.multiplier.array.copy(),
            self.status.copy(),
            self.gap.copy(),
        )

    def restore(self, checkpoint: Checkpoint) -> None:
        """Return to a checkpoint."""
        self._pairing = checkpoint.pairing.copy()
        self.state.multiplier.array[:] = checkpoint.multiplier
        self.status[:] = checkpoint.status
        self.gap[:] = checkpoint.gap
        self._held = self.sliding == "small"
        self._make_forms()

    def distance(self) -> float:
        """Distance from the nearest slave node to the master, now."""
        return self._pairing.distance(self.positions())

    def deepest_frozen(self) -> float:
        """Smallest gap that the frozen pairs hide: what a search without memory finds for them."""
        if len(self.frozen) == 0:
            return 0.0
        gaps = self._pairing.natural_gaps(self.positions(), self.reach, self.frozen)
        return float(np.nanmin(gaps, initial=0.0))


def _default_reach(x: npt.NDArray[np.float64], slave: FacetList, master: FacetList) -> float:
    """Half the diagonal of the larger surface's bounding box.

    A body that has moved into another within one iteration must still be found.
    """
    diagonals = [np.linalg.norm(np.ptp(x[f.nodes], axis=0)) for f in (slave, master)]
    return float(max(diagonals)) / 2
