# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: the core's contact with what DOLFINx has of it."""

from __future__ import annotations

from collections.abc import Callable

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, State
from contactx.parallel.halo import Halo
from dolfinx import cpp


class Interface(core.Contact):
    """Discrete side of a contact: see ``contact/contact.h``.

    The core has slave nodes, pairs, state and law. Here are the forms.

    Attributes:
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        num_others: Number of slave nodes of other ranks that share facets with these.
        halo: Nodes of this rank.
        state: Vectors that the forms read.
    """

    def __init__(
        self,
        contact_mesh: core.ReferenceMesh,
        slave: core.NamedSurface,
        master: core.NamedSurface | core.Obstacle,
        halo: Halo,
        *,
        options: core.ContactOptions,
        is_self: bool,
        level: npt.NDArray[np.int8],
        weight: Callable[[npt.NDArray[np.int32]], npt.NDArray[np.float64]] | None,
        markers: npt.NDArray[np.int8],
    ):
        """Pair the slave nodes in the reference configuration; all ranks must take part.

        Args:
            contact_mesh: The mesh on this rank.
            slave: Name, offsets and nodes of the slave facets.
            master: The same of the master, or an obstacle.
            halo: Nodes of this rank.
            options: Options of the contact.
            is_self: Whether slave and master are the same surface.
            level: Where nodes are on quadratic facets, shape (num_bulk,), or none.
            weight: Factor of contact's integrals at some nodes; None for one.
            markers: 1 at dofs of the bulk with a Dirichlet condition, shape (num_dofs,).

        Raises:
            ValueError: As ``problem/make_contact.h`` says.
        """
        super().__init__(
            contact_mesh,
            slave,
            master,
            options,
            is_self=is_self,
            level=level,
            weight=weight,
            prescribed=markers,
        )
        self.halo = halo
        slaves = self.slave_nodes
        self.slaves = slaves.owned
        self.num_others = len(slaves.around) - len(slaves.owned)
        # State is this rank's alone
        slave_map = cpp.common.IndexMap(MPI.COMM_SELF, len(slaves.around))
        self.state = State.of(halo.gdim, slave_map, is_vector=self.law.is_vector)
        self._forms: list[ContactForms] = []
        self._made_for: tuple[str, int] | None = None
        self._version = -1

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.positions()

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
