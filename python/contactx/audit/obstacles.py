# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact with a rigid obstacle, looked at between the slave nodes and along their way."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.audit.findings import Depth, Findings
from contactx.geometry.facets import facet_middles
from contactx.interface import Interface
from contactx.obstacles import Plane
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo

type Array = npt.NDArray[np.float64]

# An obstacle as narrow as this part of a slave facet is still seen: 2^-7
_LEVELS = 7
# Points on the way of a node that may have gone through
_WAY = 64
# Rounding and what is no matter, by the size of a facet
_NEGLIGIBLE = 4e-3


class ObstacleAudit:
    """Looks at an obstacle from all of the slave facets, and whether nodes came to its far side."""

    def __init__(self, interface: Interface, master: core.ObstacleMaster, halo: Halo):
        """Prepare the looks.

        Args:
            interface: Discrete side of the contact.
            master: Its master side.
            halo: Nodes of this rank.
        """
        self._interface, self._master, self._halo = interface, master, halo
        self._slave = interface.slave_nodes
        self._corners = self._slave.corners
        self._before: tuple[Array, Array, Array] | None = None

    def accept(self) -> None:
        """Remember how slave nodes and facets lie before the next step; collective."""
        points, own = self._look_out()
        with agreed(self._halo.comm):
            self._placed = self._master.obstacle.placement(points.shape[1])
            self._before = points, own, self._master.obstacle.evaluate(points).normal

    def _look_out(self) -> tuple[Array, Array]:
        """Slave nodes and middles of facets, and unit normals there."""
        x, facets, around = self._halo.positions(), self._slave.facets, self._slave.around
        owned, gdim = len(self._slave.owned), x.shape[1]
        nodal = core.nodal_normals(facets.offsets, self._corners, x[around], gdim)
        # Each facet on one rank
        middles, normals = facet_middles(self._slave.own, x)
        points = np.concatenate([x[around][:owned], middles])
        return points, np.concatenate([nodal.reshape(-1, gdim)[:owned], normals])

    def __call__(self, name: str, findings: Findings) -> None:
        """Look at the state of now; all ranks must take part.

        Args:
            name: Name of the contact, for messages.
            findings: What was found is added to it.
        """
        interface, nodes, comm = self._interface, self._interface.nodes, self._halo.comm
        small = _NEGLIGIBLE * self._size()
        offset = self._slave.scatter_forward(np.minimum(interface.offset(), 0))
        # A user's function may fail on one rank
        with agreed(comm):
            gap = self._gaps(self._halo.positions()[interface.slaves])
            inside = self._look_inside(gap, small)
            passed = self._look_back(small)
        near = self._slave.near(nodes.held)
        # A gap that is a mean may be closed although the node is beside the obstacle
        touches = self._slave.near(nodes.held & ~(gap - interface.offset() > small))
        near = np.where(touches == 2, near, np.minimum(near, 1)).astype(np.int8)
        with agreed(comm):
            deepest = self._look_between(near, offset)
        kind = f"rigid {type(self._master.obstacle).__name__}"
        before = len(findings.faults)
        passed = int(reduce.total(comm, passed))
        if passed > 0:
            findings.passed += passed
            findings.faults.append(
                f"{name}: {passed} slave nodes and facets went through the {kind} within the step "
                "and are on its far side. Take smaller load steps"
            )
        else:
            what = f"{kind}, which they face away from"
            findings.add_far_side(name, inside, what, self._halo)
        # Where nodes are inside the obstacle their facets are, too
        is_fault = len(findings.faults) == before
        advice = "Refine the slave surface"
        findings.add_depth(name, kind, deepest, advice, comm, is_fault=is_fault, place="around")

    def _look_inside(self, gap: Array, small: float) -> npt.NDArray[np.int32]:
        """Slave nodes that face away from the obstacle and are inside it."""
        interface, nodes = self._interface, self._interface.nodes
        is_inside = gap < np.minimum(interface.offset(), 0) - small
        is_inside &= ~self._master.paired & ~nodes.immobile & ~nodes.ceded
        inside: npt.NDArray[np.int32] = interface.slaves[is_inside]
        return inside

    def _size(self) -> float:
        """Size of the largest slave facet."""
        return float(reduce.largest(self._halo.comm, self._sizes().max(initial=0.0)))

    def _sizes(self) -> Array:
        x, facets = self._halo.positions(), self._slave.facets
        return core.facet_sizes(facets.offsets, self._corners, x[self._slave.around], x.shape[1])

    def _gaps(self, points: Array) -> Array:
        """Gaps of points."""
        return self._seen(points, self._master.obstacle.distance)

    def _seen(self, points: Array, function: Callable[[Array], Array]) -> Array:
        """Values of a function of the obstacle at points.

        As many at a time as there are slave nodes: for so many a function of UFL is compiled.
        """
        n, at_a_time = len(points), max(1, len(self._slave.owned))
        if n == 0:
            return function(points)
        parts = []
        for first in range(0, n, at_a_time):
            part = points[first : first + at_a_time]
            rows = np.resize(np.arange(len(part)), at_a_time)
            parts.append(function(part[rows])[: len(part)])
        return np.concatenate(parts)

    def _look_between(self, near: npt.NDArray[np.int8], offset: Array) -> Depth | None:
        """Where the obstacle reaches deepest through a slave facet, by what the mesh explains.

        Args:
            near: How near each facet is to contact, shape (num_facets,).
            offset: What their gap may fall to, shape (m,).

        Returns:
            It, with the middle of the facet as its place; None where nothing is looked at.
        """
        if isinstance(self._master.obstacle, Plane) or len(self._corners) == 0:
            # A plane is deepest at a node
            return None
        x, offsets = self._halo.positions()[self._slave.around], self._slave.facets.offsets
        size = self._sizes()
        extent = np.full(len(size), self._master.obstacle.size(x.shape[1]))
        curvature, normal = self._curvatures(x)
        explained = core.explained_depths(size, curvature, near, extent)
        sampling = core.FacetSampling(offsets, self._corners, x, x.shape[1], explained, _LEVELS)
        while len(sampling.points) > 0:
            sampling.take(self._gaps(sampling.points))
        depth = self._slave.smallest(offset) - sampling.gaps
        # Between nodes whose normals tell nothing of it may be a punch
        deep = np.flatnonzero(depth > 0)
        turn = self._turns(deep, sampling.deepest[deep], x, normal)
        curvature[deep] = np.maximum(curvature[deep], turn)
        # What is not in contact sees no more of the obstacle than that place
        steep = np.flatnonzero((near < 2) & (curvature * size > 1))
        extent[steep] = np.minimum(extent[steep], 2 / curvature[steep])
        explained = core.explained_depths(size, curvature, near, extent)
        worst = int((depth / explained).argmax())
        middle = x[self._corners[offsets[worst] : offsets[worst + 1]]].mean(axis=0)
        ratio = float(depth[worst] / explained[worst])
        return Depth(ratio, float(depth[worst]), float(size[worst]), bool(near[worst] > 1), middle)

    def _curvatures(self, x: Array) -> tuple[Array, Array]:
        """Curvature of the obstacle before each slave facet, and its normals at the slave nodes."""
        geometry = self._master.obstacle.evaluate(x)
        offsets, gdim = self._slave.facets.offsets, x.shape[1]
        at_nodes = np.abs(geometry.curvature).sum(axis=2).max(axis=1)
        turn = core.facet_turns(offsets, self._corners, x, geometry.normal, gdim)
        return np.maximum(turn, self._slave.largest(at_nodes)), geometry.normal

    def _turns(self, which: npt.NDArray[np.integer], at: Array, x: Array, normal: Array) -> Array:
        """How much the obstacle's normal turns on the way from nodes of facets to points in them.

        Args:
            which: Facets, shape (n,).
            at: A point of each, shape (n, gdim).
            x: Positions of the slave nodes around, shape (m, gdim).
            normal: The obstacle's normals there, shape (m, gdim).
        """
        turn = np.zeros(len(which))
        if len(which) == 0:
            return turn
        there = self._seen(at, self._master.obstacle.normals)
        offsets = self._slave.facets.offsets
        sizes = np.diff(offsets)[which]
        for k in range(int(sizes.max())):
            has = np.flatnonzero(sizes > k)
            node = self._corners[offsets[which[has]] + k]
            way = np.linalg.norm(at[has] - x[node], axis=1)
            angle = np.linalg.norm(there[has] - normal[node], axis=1)
            steep = np.divide(angle, way, out=np.zeros(len(has)), where=way > 0)
            turn[has] = np.maximum(turn[has], steep)
        return turn

    def _look_back(self, small: float) -> int:
        """Number of nodes and facets of this rank that have gone through the obstacle."""
        if self._before is None:
            return 0
        points, own = self._look_out()
        obstacle, gdim = self._master.obstacle, points.shape[1]
        start, own_before, before = self._before
        now = obstacle.placement(gdim)
        before = before @ self._placed.turn(now).T
        after = obstacle.evaluate(points).normal
        before = np.ascontiguousarray(before)
        passed = np.flatnonzero(core.far_side(own_before, own, before, after, gdim))
        if obstacle.tells_movement and len(passed) > 0:
            way = self._placed.carry(start[passed], now)
            t = np.linspace(0, 1, _WAY)[:, None, None]
            along = (way + t * (points[passed] - way)).reshape(-1, gdim)
            inside = self._gaps(along).reshape(_WAY, -1) < -small
            passed = passed[inside.any(axis=0)]
        return len(passed)
