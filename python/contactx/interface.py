# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: the core's contact with what DOLFINx has of it."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, State
from contactx.nodal import ContactValues
from contactx.parallel.halo import Halo
from dolfinx import cpp


class Interface(core.Contact):
    """Discrete side of a contact: see ``contact/contact.h``.

    The core has slave nodes, pairs, state and law. Here are the forms.

    Attributes:
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        slave_nodes: The same with their facets.
        num_others: Number of slave nodes of other ranks that share facets with these.
        halo: Nodes of this rank.
        values: Friction and offset, which users may change.
        state: Vectors that the forms read.
    """

    def __init__(
        self,
        slaves: core.SlaveNodes,
        master: core.Master,
        halo: Halo,
        *,
        law: core.Law,
        values: ContactValues,
        sliding: str,
        has_means: bool,
        markers: npt.NDArray[np.int8],
        shared: npt.NDArray[np.bool_] | None = None,
        adjust: float | None = None,
    ):
        """Pair the slave nodes in the reference configuration; all ranks must take part.

        Args:
            slaves: Slave nodes.
            master: Master side, without pairs yet.
            halo: Nodes of this rank.
            law: Contact law.
            values: Friction and offset.
            sliding: "finite" or "small".
            has_means: Whether normals are means over facets.
            markers: 1 at dofs of the bulk with a Dirichlet condition, shape (num_dofs,).
            shared: Which nodes of this rank the master surface has, too, owned ones first; None if
                it has none.
            adjust: Gaps and overlaps of the reference configuration that count as none.

        Raises:
            ValueError: If an obstacle's parameters do not fit.
        """
        super().__init__(
            halo.nodes,
            slaves,
            master,
            law,
            is_small=sliding == "small",
            has_means=has_means,
            prescribed=markers,
            shared=None if shared is None else shared[: halo.num_owned],
            adjust=adjust,
        )
        self.halo = halo
        self.slaves, self.slave_nodes = slaves.owned, slaves
        self.num_others = len(slaves.around) - len(slaves.owned)
        self.values = values
        # State is this rank's alone
        slave_map = cpp.common.IndexMap(MPI.COMM_SELF, len(slaves.around))
        self.state = State.of(halo.gdim, slave_map, is_vector=law.is_vector)
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
