# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""All forms of one contact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.forms import AnyPairs, ContactForms, State
from contactx.law.nodes import Nodes
from contactx.parallel.halo import Halo
from dolfinx import fem


class Assembly:
    """Forms over the current pairs, one set for each kind of master facet.

    Attributes:
        forms: The forms.
    """

    def __init__(self, law: str, state: State, halo: Halo):
        """Create an assembly without pairs.

        Args:
            law: Name of the contact law.
            state: Vectors that the forms read at each assembly.
            halo: Nodes of this rank.
        """
        self._law = law
        self._state = state
        self._halo = halo
        self.forms: list[ContactForms] = []
        self._sliding = ""
        self._version = 0

    def rebuild(self, groups: Sequence[AnyPairs], sliding: str) -> None:
        """Make the forms of new pairs.

        Args:
            groups: Pairs by the kind of their facets.
            sliding: Kinematics, "finite" or "small".
        """
        self._sliding = sliding
        self._version = self._halo.version
        self.forms = [
            ContactForms(self._law, sliding, pairs, self._state, self._halo) for pairs in groups
        ]

    def update(self, groups: Sequence[AnyPairs]) -> None:
        """Take over new data, with new forms where the pairs or the halo are others."""
        same = self._version == self._halo.version and len(groups) == len(self.forms)
        if not same or not all(
            form.pairs.same(pairs) for form, pairs in zip(self.forms, groups, strict=True)
        ):
            self.rebuild(groups, self._sliding)
            return
        for form, pairs in zip(self.forms, groups, strict=True):
            form.update(pairs)

    def kinematics(self, nodes: Nodes) -> None:
        """Assemble gap and normal of the slave nodes; zero where there is no pair."""
        self._assemble(nodes.gap, "gap")
        self._assemble(nodes.normal, "normal")
        if nodes.mean is not None:
            nodes.mean.normalise(nodes.normal, nodes.mobile)

    def slip(self, nodes: Nodes, origin: npt.NDArray[np.float64]) -> None:
        """Assemble the slip of the slave nodes.

        Args:
            nodes: Slave nodes, with their normals.
            origin: What is taken off movements over several facets, shape (n, gdim), or zero.
        """
        self._assemble(nodes.slip, "slip")
        if nodes.mean is not None and self._law != "tied":
            nodes.slip -= origin
            nodes.mean.project(nodes.normal, nodes.slip, nodes.mobile)

    def _assemble(self, values: npt.NDArray[np.float64], term: str) -> None:
        """Set values of this rank's slave nodes; what is assembled for those of others is part."""
        every = np.zeros((len(self._state.area.array), *values.shape[1:]))
        for form in self.forms:
            if getattr(form, term) is not None:
                fem.assemble_vector(every.reshape(-1), getattr(form, term))
        values[:] = every[: len(values)]

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Add this rank's contact forces to those of all nodes, shape (num_nodes * gdim,)."""
        for form in self.forms:
            if form.residual is not None:
                fem.assemble_vector(b, form.residual)
