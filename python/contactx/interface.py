# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: the core's contact with what DOLFINx has of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, State
from contactx.nodal import NodalValue
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo, first_node
from dolfinx import cpp


class Interface(core.Contact):
    """Discrete side of a contact: see ``contact/contact.h``.

    The core has slave nodes, pairs, state and law. Here are the values that users may change, and
    the forms.

    Attributes:
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        slave_nodes: The same with their facets.
        num_others: Number of slave nodes of other ranks that share facets with these.
        halo: Nodes of this rank.
        state: Vectors that the forms read.
    """

    def __init__(
        self,
        slaves: core.SlaveNodes,
        master: core.Master,
        halo: Halo,
        *,
        law: core.Law,
        friction: NodalValue | None,
        sliding: str,
        is_mortar: bool,
        offset: NodalValue,
        markers: npt.NDArray[np.int8],
        shared: npt.NDArray[np.bool_] | None = None,
        adjust: float | None = None,
        is_self: bool = False,
    ):
        """Pair the slave nodes in the reference configuration; all ranks must take part.

        Args:
            slaves: Slave nodes.
            master: Master side, without pairs yet.
            halo: Nodes of this rank.
            law: Contact law.
            friction: Coefficient of friction, read at each iterate; None for other laws.
            sliding: "finite" or "small".
            is_mortar: Whether the method is surface-to-surface.
            offset: What is taken off the gap.
            markers: 1 at dofs of the bulk with a Dirichlet condition, shape (num_dofs,).
            shared: Which nodes of this rank the master surface has, too, owned ones first; None if
                it has none.
            adjust: Gaps and overlaps of the reference configuration that count as none.
            is_self: Whether slave and master are the same surface.

        Raises:
            ValueError: If an obstacle's parameters do not fit.
        """
        super().__init__(
            halo.nodes,
            slaves,
            master,
            law,
            is_small=sliding == "small",
            is_mortar=is_mortar,
            prescribed=markers,
            shared=None if shared is None else shared[: halo.num_owned],
            adjust=adjust,
        )
        self.halo = halo
        self.is_self = is_self
        self.slaves, self.slave_nodes = slaves.owned, slaves
        self.num_others = len(slaves.around) - len(slaves.owned)
        self._offset, self._friction = offset, friction
        self._varies = True
        if offset.is_number and (friction is None or friction.is_number):
            self.read_values()
            self._varies = False
        # State is this rank's alone
        slave_map = cpp.common.IndexMap(MPI.COMM_SELF, len(slaves.around))
        self.state = State.of(halo.gdim, slave_map, is_vector=law.is_vector)
        self._forms: list[ContactForms] = []
        self._made_for: tuple[str, int] | None = None
        self._version = -1

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.positions()

    def offset(self) -> npt.NDArray[np.float64]:
        """Current offset, the length that is taken off the gap, shape (n,)."""
        return np.broadcast_to(self._offset.now(), self.nodes.gap.shape)

    def read_values(self) -> None:
        """Hand the core friction and offset as they are now; all ranks must take part.

        Raises:
            ValueError: If a coefficient is negative, or a value is not finite.
        """
        if not self._varies:
            return
        with agreed(self.halo.comm):
            if self._friction is not None and isinstance(self.law, core.Coulomb):
                self.law.set_friction(np.broadcast_to(self._friction.now(), self.slaves.shape))
            self.set_offset(self.offset())

    def update_gap(self) -> None:
        """Evaluate gap, normal and slip with the values of now; all ranks must take part.

        Raises:
            ValueError: As ``read_values`` does.
        """
        self.read_values()
        super().update_gap()

    @property
    def forms(self) -> list[ContactForms]:
        """Forms of the current pairs, one set for each kind of master facet.

        They read the state as it is now: what forms read are copies, so ask anew where it has
        changed since.
        """
        if self._version != self.version:
            self._version = self.version
            self._update_forms()
        self.state.take(self.nodes)
        return self._forms

    def _update_forms(self) -> None:
        """Take over new data of pairs, with new forms where the pairs or the halo are others."""
        groups, made_for = self.pairs, (self.kinematics, self.halo.version)
        same = self._made_for == made_for and len(groups) == len(self._forms)
        if same and all(f.pairs.same(p) for f, p in zip(self._forms, groups, strict=True)):
            for form, pairs in zip(self._forms, groups, strict=True):
                form.update(pairs)
            return
        self._made_for = made_for
        self._forms = [
            ContactForms(self.law.name, self.kinematics, pairs, self.state, self.halo)
            for pairs in groups
        ]


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
    x = halo.x[: halo.num_bulk] + prescribed.reshape(-1, halo.gdim)
    for k, interface in enumerate(interfaces):
        interface.read_values()
        bad = interface.kept_inside(x)
        count = reduce.total(halo.comm, len(bad))
        if count > 0:
            size = reduce.extent(halo.comm, halo.x[interface.slaves]).max()
            first, at = first_node(halo, bad, halo.x)
            raise ValueError(
                f"contact {k} ({names[k]}) is over-constrained: Dirichlet conditions constrain "
                f"{count} slave nodes inside the rigid obstacle, first node {first} of the mesh as "
                f"it was made, at {core.point_text(at, size)}. Take them out of the slave surface, "
                "release them along the obstacle's normal or prescribe values outside of it "
                "(manual: errors/over-constrained)"
            )


def check_drag(interfaces: Sequence[Interface], names: Sequence[Any]) -> None:
    """Check that no obstacle moves along with what touches it, unless it tells how.

    Args:
        interfaces: Discrete sides of the contacts.
        names: The contacts, for the message.

    Raises:
        ValueError: If one does on any rank, on all ranks.
    """
    for k, interface in enumerate(interfaces):
        if interface.moves_untold():
            raise ValueError(
                f"contact {k} ({names[k]}): the LevelSet moves while it is touched, and its "
                "function does not tell how its material moves along its surface, which slip and "
                "ties are measured from. Take a Sphere, Plane or Cylinder, which drag what touches "
                "them, or give it a velocity, or friction=0; or let it come from where nothing "
                "touches it to where it stays (manual: errors/level-set-moves)"
            )
