# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: its slave nodes, pairs, state and forms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.assembly import Assembly
from contactx.errors import point_text
from contactx.forms import ContactForms, Pairs, State
from contactx.nodal import NodalValue
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo, first_node
from contactx.parallel.slaves import SlaveNodes
from dolfinx import cpp

# Share of a relative movement that must be free for a constraint on it
_MOBILE = 0.05


class Interface:
    """Discrete side of a contact.

    State belongs to the slave nodes, so that a new search loses nothing.

    Attributes:
        sliding: "finite" or "small".
        law: Contact law.
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        slave_nodes: The same with their facets.
        is_shared: Which slave nodes the master surface has, too, shape (n,).
        shared_nodes: Nodes of this rank that both surfaces have.
        num_others: Number of slave nodes of other ranks that share facets with these.
        state: Vectors that the forms read.
        nodes: State of the slave nodes.
        history: Slip of the accepted steps; None where none is measured.
        master: Pairs with the master side.
        active: Whether the contact is switched on.
        skipped_searches: Iterates of this step that needed no search.
    """

    def __init__(
        self,
        slaves: SlaveNodes,
        master: core.Master,
        halo: Halo,
        *,
        law: core.Law,
        friction: NodalValue | None,
        sliding: str,
        has_means: bool,
        offset: NodalValue,
        markers: npt.NDArray[np.int8],
        shared: npt.NDArray[np.bool_] | None = None,
    ):
        """Pair the slave nodes in the reference configuration; all ranks must take part.

        Args:
            slaves: Slave nodes.
            master: Master side, without pairs yet.
            halo: Nodes of this rank.
            law: Contact law.
            friction: Coefficient of friction, read at each iterate; None for other laws.
            sliding: "finite" or "small".
            has_means: Whether normals are means over facets.
            offset: What is taken off the gap.
            markers: 1 at dofs of the bulk with a Dirichlet condition, shape (num_dofs,).
            shared: Which owned nodes the master surface has, too, shape (num_owned,); None if it
                has none.

        Raises:
            ValueError: If an obstacle's parameters do not fit.
        """
        self._halo = halo
        self._gdim = gdim = halo.gdim
        self.law = law
        self.sliding = sliding
        self._frozen_kinematics = sliding == "small"
        self.slaves = slaves.owned
        self.num_others = len(slaves.around) - len(slaves.owned)
        self.master = master
        self._markers = markers.reshape(-1, gdim)
        halo.on_change(self._halo_changed)
        self._halo_changed()
        n = len(self.slaves)
        # State is this rank's alone
        slave_map = cpp.common.IndexMap(MPI.COMM_SELF, len(slaves.around))
        self.state = State.of(gdim, slave_map, is_vector=law.is_vector)
        self.nodes = core.NodeState(n, gdim, law.is_vector, has_means)
        self._assembly = Assembly(law.name, self.nodes, self.state, halo)
        self.slave_nodes = slaves
        slips = law.is_vector and not law.is_tied
        self.history = core.SlipHistory(n, gdim) if slips else None
        self._touched = np.zeros(n, dtype=bool)
        self.active, self.skipped_searches = True, 0
        self._offset, self._friction = offset, friction
        # A crack's tip: nodes of both sides have no gap
        self.is_shared = np.zeros(n, dtype=bool) if shared is None else shared[self.slaves]
        self.shared_nodes = np.flatnonzero([] if shared is None else shared)
        self._accept()
        self._search(halo.x)
        self._find_front()
        self.master.begin_step()
        self._make_forms()
        self._find_immobile()

    def _halo_changed(self) -> None:
        """Make what is kept of all nodes fit a halo that has changed."""
        self._free = self._halo.scatter_forward(self._markers) == 0
        self.master.nodes_changed()

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of all nodes, shape (num_nodes, gdim)."""
        return self._halo.positions()

    @property
    def halo(self) -> Halo:
        """Nodes of this rank, and what was sent for them."""
        return self._halo

    @property
    def updates_kinematics(self) -> bool:
        """Whether pairs, normals and projections are those of the current iterate."""
        return self.sliding == "finite" and not self.law.is_tied

    def begin_step(self) -> None:
        """Start a step: pairs may change again, and in small sliding an obstacle may have moved.

        All ranks must take part.
        """
        self.skipped_searches = 0
        self.law.begin_step()
        self.master.rebuild()
        self.freeze_kinematics(False)
        self._turn_tractions()
        self.master.begin_step()
        self._touched = self.nodes.closed
        self.nodes.turns[:] = self.nodes.closings[:] = 0
        if self.sliding == "small" and self.master.is_rigid:
            self._pair(self._halo.x)
        else:
            self._take(self.master.pairs())

    def _turn_tractions(self) -> None:
        """Turn the tractions with a master that has turned since, as a better start."""
        if self.history is None or not self.updates_kinematics:
            return
        turn = self.master.turn(self.positions())
        if turn is not None:
            traction = self.nodes.multiplier.reshape(-1, self._gdim)
            traction[:] = np.einsum("ijk,ik->ij", turn, traction)

    def accept(self) -> None:
        """Take the converged state as the start of the next step; all ranks must take part."""
        self._accept()
        front, area = self._front, self.nodes.area.copy()
        self._find_front()
        if reduce.anywhere(self._halo.comm, (self._front != front).any()):
            self._take(self.master.pairs())
            # Forces stay
            tractions = self.nodes.multiplier.reshape(len(area), -1)
            tractions *= (area / self.nodes.area)[:, None]
        if self.history is not None:
            self.history.add(self.nodes)

    def _accept(self) -> None:
        with agreed(self._halo.comm):
            self.master.accept(self.positions())

    def _find_front(self) -> None:
        """Find which part of the slave nodes' area is in front of the master."""
        reference = self._halo.x
        x = reference if self.sliding == "small" else self.positions()
        normals = self.master.normals()[:, : self._gdim]
        corners = self.slave_nodes.facing_areas(reference, x, normals)
        self._front: npt.NDArray[np.float64] = self.slave_nodes.sums(corners)
        with agreed(self._halo.comm):
            self.master.take_front(corners > 0)

    def set_factor(self, compliance: npt.NDArray[np.float64]) -> None:
        """Set the factor c of the complementarity from the compliance of the pairs.

        Slave node and master facet are springs in series: where one is much stiffer than the other,
        the softer one decides how fast a gap closes. All ranks must take part.

        Args:
            compliance: Compliance of all nodes, length/force, zero where one cannot move.
        """
        of_pairs = compliance[self.slaves] + self.master.compliance(compliance)
        self.nodes.set_factor(of_pairs, self._halo.nodes)

    def search(self) -> int:
        """Pair the slave nodes in the current configuration, unless kinematics are frozen.

        All ranks must take part.

        Returns:
            Number of this rank's nodes in contact whose facet has changed.
        """
        if self._frozen_kinematics or not self.updates_kinematics:
            self.skipped_searches += 1
            return 0
        return self._pair(self.positions())

    def _pair(self, x: npt.NDArray[np.float64]) -> int:
        changed = self._search(x)
        self._take(self.master.pairs())
        self._find_immobile()
        return changed

    def _search(self, x: npt.NDArray[np.float64]) -> int:
        closed = self.nodes.closed.astype(np.int8)
        if not self.master.is_rigid:
            return self.master.search(x, closed)
        with agreed(self._halo.comm):
            self.master.search(x, closed)
        return 0

    def _find_immobile(self) -> None:
        along, each = self.master.mobility(self._free)
        self.nodes.immobile[:] = self.master.paired & (along < 1e-8)
        if self.law.is_vector:
            # A projection over an open gap on a tilted facet leaves a symmetry plane by a little
            self.nodes.mobile[:] = np.where(each < _MOBILE, 0.0, 1.0)

    def freeze_kinematics(self, frozen: bool) -> None:
        """Freeze pairs, normals and projections of finite sliding, or update them again.

        Frozen kinematics make the contact conditions linear. Those of small sliding always are.

        Args:
            frozen: Whether to freeze them.
        """
        if self.updates_kinematics and frozen != self._frozen_kinematics:
            self._frozen_kinematics = frozen
            self._make_forms()

    def _take(self, groups: Sequence[Pairs]) -> None:
        """Take over new data of pairs."""
        self.nodes.area[:] = self.master.area(self._front)
        self._assembly.update(groups)

    def _make_forms(self) -> None:
        self.nodes.area[:] = self.master.area(self._front)
        sliding = "small" if self._frozen_kinematics else "finite"
        self._assembly.rebuild(self.master.pairs(), sliding)

    @property
    def forms(self) -> list[ContactForms]:
        """Forms of the current pairs, one set for each kind of master facet.

        They read the state as it is now: ask anew where it has changed since.
        """
        return self._assembly.forms

    def update_gap(self) -> None:
        """First pass: assemble gap, normal and slip of each slave node; all ranks take part."""
        with agreed(self._halo.comm):
            self._read_friction()
            offset = self.offset()
            fresh = self.master.update(self.positions(), self._frozen_kinematics, offset)
        if fresh is not None:
            self._take(fresh)
        self._assembly.kinematics()
        self._assembly.slip(self.master.origin)
        gap = self.nodes.gap
        gap -= offset
        gap[~(self.master.paired & self.active) | self.is_shared] = np.nan

    def _read_friction(self) -> None:
        """Hand the law the coefficients of now.

        Raises:
            ValueError: If one is negative or not finite.
        """
        if self._friction is not None and isinstance(self.law, core.Coulomb):
            friction = np.broadcast_to(self._friction.now(), self.slaves.shape)
            self.law.set_friction(friction)

    def offset(self) -> npt.NDArray[np.float64]:
        """What is taken off the gap now, shape (n,)."""
        return np.broadcast_to(self._offset.now(), self.nodes.gap.shape)

    def update_status(self, first: bool = False) -> int:
        """Set each slave node's status from its multiplier, gap and slip.

        All ranks must take part.

        Args:
            first: Whether the iterate is the step's start.

        Returns:
            Number of this rank's nodes that changed.
        """
        nodes, before = self.nodes, self.nodes.status.copy()
        closing = self.closing(first)
        if self.history is not None:
            with agreed(self._halo.comm):
                self._measure_from_touching(closing & ~self._touched)
        self.law.set_status(nodes, self._halo.nodes)
        if first:
            # Nor does rounding decide between stick and slip where nothing presses yet
            loose = ~nodes.closed | ~nodes.multiplier.reshape(-1, nodes.size).any(axis=1)
            nodes.close(np.flatnonzero(closing & loose))
        return int(np.count_nonzero(nodes.status != before))

    def _measure_from_touching(self, which: npt.NDArray[np.bool_]) -> None:
        if not which.any():
            return
        x, offset = self.positions(), self.offset()
        self.master.touch(which, x, offset)
        self._touched = self._touched | which
        fresh = self.master.update(x, self._frozen_kinematics, offset)
        self._take(self.master.pairs() if fresh is None else fresh)
        self._assembly.slip(self.master.origin)

    def closing(self, first: bool = False) -> npt.NDArray[np.bool_]:
        """Which nodes the complementarity closes; all ranks must take part at a step's start.

        At a step's start also those that touch but for rounding errors: these must not decide which
        nodes carry a body that rests on another one.

        Args:
            first: Whether the iterate is the step's start.

        Returns:
            Which ones, shape (n,).
        """
        if not first:
            return self.nodes.closing()
        tie = core.touching_gap(self._halo.nodes, self.positions()[self.slaves])
        return self.nodes.closing(tie)

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Third pass: add this rank's contact forces.

        Args:
            b: Forces on all nodes, shape (num_nodes * gdim,).
        """
        self._assembly.add_residual(b)

    def rebuild(self) -> None:
        """Make the forms of pairs that were loaded; kinematics are not frozen."""
        self._frozen_kinematics = self.sliding == "small"
        self._find_front()
        self._make_forms()


def check_over_constrained(
    interfaces: Sequence[Interface],
    names: Sequence[Any],
    prescribed: npt.NDArray[np.float64],
    halo: Halo,
) -> None:
    """Check that Dirichlet conditions keep no slave node inside a rigid obstacle.

    Args:
        interfaces: Discrete sides of the contacts.
        names: The contacts, for the message.
        prescribed: Displacement with the Dirichlet values, shape (num_dofs,).
        halo: Nodes on this rank.

    Raises:
        ValueError: If they do on any rank, on all ranks.
    """
    for k, interface in enumerate(interfaces):
        bad = _constrained_inside(interface, prescribed, halo)
        count = reduce.total(halo.comm, len(bad))
        if count > 0 and interface.active:
            size = reduce.extent(halo.comm, halo.x[interface.slaves]).max()
            first, at = first_node(halo, bad, halo.x)
            raise ValueError(
                f"contact {k} ({names[k]}) is over-constrained: Dirichlet conditions constrain "
                f"{count} slave nodes inside the rigid obstacle, first node {first} of the mesh as "
                f"it was made, at {point_text(at, size)}. Take them out of the slave surface, "
                "release them along the obstacle's normal or prescribe values outside of it"
            )


def check_drag(interfaces: Sequence[Interface], names: Sequence[Any], halo: Halo) -> None:
    """Check that no obstacle moves along with what touches it, unless it tells how.

    Args:
        interfaces: Discrete sides of the contacts.
        names: The contacts, for the message.
        halo: Nodes on this rank.

    Raises:
        ValueError: If one does on any rank, on all ranks.
    """
    for k, interface in enumerate(interfaces):
        master = interface.master
        if not isinstance(master, core.ObstacleMaster) or not interface.active:
            continue
        size = reduce.extent(halo.comm, halo.x[interface.slaves]).max()
        with agreed(halo.comm):
            moves = master.moves_untold(1e-12 * size)
        touched = reduce.anywhere(halo.comm, interface.nodes.closed.any())
        if touched and reduce.anywhere(halo.comm, moves):
            raise ValueError(
                f"contact {k} ({names[k]}): the LevelSet moves while it is touched, and its "
                "function does not tell how its material moves along its surface, which slip and "
                "ties are measured from. Take a Sphere, Plane or Cylinder, which drag what touches "
                "them, or friction=0; or let it come from where nothing touches it to where it "
                "stays"
            )


def _constrained_inside(
    interface: Interface, prescribed: npt.NDArray[np.float64], halo: Halo
) -> npt.NDArray[np.int32]:
    """Constrained slave nodes of this rank inside an obstacle, as blocks of the dofmap."""
    master = interface.master
    if not isinstance(master, core.ObstacleMaster) or interface.law.is_tied:
        return np.array([], dtype=np.int32)
    x = halo.x[: halo.num_bulk] + prescribed.reshape(-1, halo.gdim)
    with agreed(halo.comm):
        gap = master.inside(x) - interface.offset()
    size = reduce.extent(halo.comm, x[interface.slaves]).max()
    inside: npt.NDArray[np.int32] = interface.slaves[
        interface.nodes.immobile & (gap < -1e-9 * size)
    ]
    return inside
