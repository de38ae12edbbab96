# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact of two deformable surfaces, looked at from the side that the constraints do not see."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.audit.findings import Depth, Findings
from contactx.audit.passage import passages
from contactx.errors import point_text
from contactx.interface import Interface
from contactx.parallel import reduce
from contactx.parallel.halo import Halo
from contactx.search import onlooker, outside
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]

# Part of a facet by which a surface must overlap the other's outer edge: of surface-to-surface the
# larger one of its two bounds
_OVERLAP = 1 / 16
# Part of a facet's size that a node without a pair may be behind it
_BEHIND = 1 / 32
# Part of a facet's size that a node may be behind it and still be in contact
_IN_CONTACT = 1 / 8


class SurfacesAudit:
    """Looks at slave facets from master nodes, and at the master from slave nodes without a pair.

    In small sliding all is seen in the reference configuration, with gaps linear in displacements.
    """

    def __init__(self, interface: Interface, master: core.DeformableMaster, halo: Halo):
        """Prepare the looks.

        Args:
            interface: Discrete side of the contact.
            master: Its master side.
            halo: Nodes of this rank.
        """
        self._interface, self._halo = interface, halo
        self._slave = interface.slave_nodes
        self._own = FacetList(*master.surface.own)
        self._around = FacetList(*master.surface.around)
        self._at_slave = onlooker(halo, self._slave.facets)
        self._extent = float(reduce.extent(halo.comm, halo.x[self._own.nodes]).max())
        self._outside_slave = outside(halo, self._slave.own)
        self._at_master = master.outside.onlooker
        marks = np.zeros(halo.num_nodes)
        marks[self._own.nodes] = 1
        marks[interface.shared_nodes] = 0
        self._owned_master = np.flatnonzero(halo.scatter_reverse(marks) > 0).astype(np.int32)
        self._points = np.setdiff1d(self._own.nodes, interface.shared_nodes)
        self._behind = np.zeros(len(interface.slaves), dtype=bool)

    def __call__(self, name: str, start: Array, findings: Findings) -> None:
        """Look at the state of now; all ranks must take part.

        Args:
            name: Name of the contact, for messages.
            start: Positions of all nodes when the step started.
            findings: What was found is added to it.
        """
        before = len(findings.faults)
        self._look_back(name, start, findings)
        if len(findings.faults) == before:
            self._look_from_slave(name, findings)
        # Where nodes are inside the master their facets are, too
        self._look_from_master(name, findings, is_fault=len(findings.faults) == before)

    def _look_back(self, name: str, start: Array, findings: Findings) -> None:
        """Nodes that are out of contact must not have gone through the other surface."""
        interface, halo = self._interface, self._halo
        if interface.sliding == "small":
            return
        x, slave, master = halo.positions(), self._slave.own, self._own
        # What has a pair faces what it is paired with. A master node has none, and what the other
        # looks see of it is within a facet's size
        loose = interface.slaves[~interface.master.paired & ~interface.is_shared]
        sides = [(slave, master, loose)]
        way = reduce.largest(
            halo.comm,
            [
                np.linalg.norm((x - start)[facets.nodes], axis=1).max(initial=0.0)
                for facets in (slave, master)
            ],
        )
        size = self._facet_size(slave, x)
        if sum(way) > size:
            sides.append((master, slave, self._owned_master))
        overlap = reduce.largest(halo.comm, (-interface.offset()).max(initial=0.0))
        count, at = 0, None
        for own, other, nodes in sides:
            tolerance = np.full(len(nodes), _IN_CONTACT * self._facet_size(other, x) + overlap)
            found = passages(halo, own, other, start, x, nodes, tolerance)
            count, at = count + found.count, found.position if at is None else at
        if count > 0 and at is not None:
            findings.passed += count
            findings.faults.append(
                f"{name}: {count} nodes went through the other surface within the step, the first "
                f"is at {point_text(at, size)}. Take smaller load steps"
            )

    def _facet_size(self, facets: FacetList, x: Array) -> float:
        """Size of the largest facet on any rank."""
        size = core.facet_sizes(facets.offsets, facets.nodes, x, self._halo.gdim)
        return float(reduce.largest(self._halo.comm, size.max(initial=0.0)))

    def _configuration(self) -> tuple[Array, Array | None]:
        """Positions to look in, and displacements since in small sliding."""
        if self._interface.sliding == "small":
            return self._halo.x, self._halo.positions() - self._halo.x
        return self._halo.positions(), None

    def _look_from_master(self, name: str, findings: Findings, *, is_fault: bool) -> None:
        comm, gdim, facets = self._halo.comm, self._halo.gdim, self._slave.facets
        x, ways = self._configuration()
        size = core.facet_sizes(facets.offsets, facets.nodes, x, gdim)
        reach = reduce.largest(comm, size.max(initial=0.0))
        around = self._around
        normals = core.nodal_normals(around.offsets, around.nodes, x, gdim).reshape(-1, gdim)
        curvature = core.nodal_curvatures(around.offsets, around.nodes, x, normals, gdim)
        nodes = self._points
        held = self._interface.nodes.held
        offset = self._slave.scatter_forward(np.array(self._interface.offset()))
        near, offset = self._slave.near(held), self._slave.smallest(offset)
        values = np.column_stack([size, near, offset, self._bent(x, ways)])
        seen = self._at_slave.look(
            x,
            x[nodes],
            normals[nodes],
            reach,
            values,
            None if ways is None else (ways, ways[nodes]),
        )
        height = np.nan_to_num(seen.height)
        outside = self._outside_slave.find(x, x[nodes], -height, seen.values[:, 0])
        # What overlaps the outer edge by less is not in contact
        there = np.flatnonzero(~np.isnan(seen.gap) & (seen.margin > _OVERLAP) & ~outside)
        size, near, offset, bent = seen.values[there].T
        depth = offset - seen.gap[there]
        explained = core.explained_depths(
            np.ascontiguousarray(size),
            curvature[nodes[there]],
            near.astype(np.int8),
            np.full(len(there), self._extent),
        )
        # Linear kinematics see a curved surface as flat along the way
        explained += (curvature[nodes[there]] + bent) * seen.way[there] ** 2
        excess = depth / explained
        worst = int(excess.argmax()) if len(excess) > 0 else -1
        deepest = None
        if worst >= 0:
            at = self._halo.positions()[nodes[there[worst]]]
            deepest = Depth(
                float(excess[worst]), float(depth[worst]), float(size[worst]), near[worst] > 1, at
            )
        advice = "Swap slave and master, or refine the slave surface"
        findings.add_depth(name, "master", deepest, advice, comm, is_fault=is_fault)

    def _bent(self, x: Array, ways: Array | None) -> Array:
        """Curvature of each slave facet, which matters to linear kinematics alone."""
        slave, gdim = self._slave, x.shape[1]
        offsets, corners, at = slave.facets.offsets, slave.corners, x[slave.around]
        if ways is None:
            return np.zeros(len(offsets) - 1)
        normals = core.nodal_normals(offsets, corners, at, gdim).reshape(-1, gdim)
        return slave.largest(core.nodal_curvatures(offsets, corners, at, normals, gdim))

    def accept(self) -> None:
        """Remember which slave nodes lie behind the master before the next step; collective.

        They may do so for good: behind a thin plate, or beside a surface that only part of the body
        is tagged with.
        """
        self._behind = self._find_behind()

    def _find_behind(self) -> npt.NDArray[np.bool_]:
        """Which slave nodes without a pair lie behind the nearest facet, of any normal."""
        comm, gdim = self._halo.comm, self._halo.gdim
        interface, own = self._interface, self._own
        which = ~interface.master.paired & ~interface.nodes.immobile & ~interface.is_shared
        behind = np.zeros(len(which), dtype=bool)
        if not reduce.anywhere(comm, which.any()):
            return behind
        x, ways = self._configuration()
        size = core.facet_sizes(own.offsets, own.nodes, x, gdim)
        nodes = interface.slaves[which]
        # What the search may reach, but in small sliding nodes may have gone farther since
        reach = reduce.largest(comm, size.max(initial=0.0))
        reach = reach if ways is not None else min(reach, interface.master.reach)
        seen = self._at_master.look(
            x,
            x[nodes],
            np.zeros((len(nodes), gdim)),
            reach,
            size[:, None],
            None if ways is None else (ways, ways[nodes]),
        )
        h = seen.values[:, 0]
        allowed = _BEHIND * h
        offset = np.minimum(interface.offset()[which], 0)
        behind[which] = seen.inside & (seen.margin > _OVERLAP) & (seen.gap < offset - allowed)
        return behind

    def _look_from_slave(self, name: str, findings: Findings) -> None:
        """Slave nodes must not come behind the master without a pair."""
        interface = self._interface
        bad = interface.slaves[self._find_behind() & ~self._behind]
        advice = (
            'sliding="small" pairs nodes in the reference configuration, once: give a larger '
            'search_distance, or take sliding="finite"'
        )
        what = "master, and have no pair with it"
        findings.add_far_side(
            name, bad, what, self._halo, advice if interface.sliding == "small" else ""
        )
