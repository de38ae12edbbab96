# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: the core's contact with what DOLFINx has of it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms
from contactx.parallel.halo import Halo


class Interface(core.Contact):
    """Discrete side of a contact: see ``contact/contact.h``.

    The core has slave nodes, pairs, state and law. Here are the forms, for those who ask.

    Attributes:
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        num_others: Number of slave nodes of other ranks that share facets with these.
        halo: Nodes of this rank.
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
        self._forms: ContactForms | None = None

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.positions()

    def forms(self) -> ContactForms:
        """Forms of the current pairs, see ``Contact.forms``; all ranks must take part."""
        if self._forms is None:
            self._forms = ContactForms(self)
        self._forms.update()
        return self._forms

    @property
    def current_forms(self) -> ContactForms:
        """The forms as of the last call of ``forms``."""
        assert self._forms is not None
        return self._forms
