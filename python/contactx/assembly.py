# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kinematics of one contact, assembled by the core, and its forms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import ContactForms, Pairs, State
from contactx.parallel.halo import Halo
from dolfinx import fem


class Assembly:
    """Forms over the current pairs, one set for each kind of master facet."""

    def __init__(self, law: str, nodes: core.NodeState, state: State, halo: Halo):
        """Create an assembly without pairs.

        Args:
            law: Name of the contact law.
            nodes: State of the slave nodes.
            state: Vectors that the forms read at each assembly.
            halo: Nodes of this rank.
        """
        self._law = law
        self._nodes = nodes
        self._state = state
        self._halo = halo
        self._forms: list[ContactForms] = []
        self._sliding = ""
        self._version = halo.version
        self._arrays = self._look()

    @property
    def forms(self) -> list[ContactForms]:
        """The forms, which read the state of the slave nodes as it is now.

        All who assemble them ask here, each time: what forms read are copies.
        """
        self._state.take(self._nodes)
        return self._forms

    def rebuild(self, groups: Sequence[Pairs], sliding: str) -> None:
        """Make the forms of new pairs.

        Args:
            groups: Pairs by the kind of their facets.
            sliding: Kinematics, "finite" or "small".
        """
        self._sliding = sliding
        if self._version != self._halo.version:
            self._version = self._halo.version
            self._arrays = self._look()
        self._forms = [
            ContactForms(self._law, sliding, pairs, self._state, self._halo) for pairs in groups
        ]

    def _look(self) -> core.NodalArrays:
        """Views of what the forms read, for the core."""
        return core.NodalArrays(
            displacement=self._halo.displacement.array,
            position=self._halo.position.array,
            **{
                name: vector.array
                for name, vector in vars(self._state).items()
                if vector is not None
            },
        )

    def update(self, groups: Sequence[Pairs]) -> None:
        """Take over new data, with new forms where the pairs or the halo are others."""
        same = self._version == self._halo.version and len(groups) == len(self._forms)
        if not same or not all(
            form.pairs.same(pairs) for form, pairs in zip(self._forms, groups, strict=True)
        ):
            self.rebuild(groups, self._sliding)
            return
        for form, pairs in zip(self._forms, groups, strict=True):
            form.update(pairs)

    def kinematics(self) -> None:
        """Assemble gap and normal of the slave nodes; zero where there is no pair."""
        self._assemble(self._nodes.gap, "gap")
        self._assemble(self._nodes.normal, "normal")
        self._nodes.normalise()

    def slip(self, origin: npt.NDArray[np.float64]) -> None:
        """Assemble the slip of the slave nodes, whose normals are known.

        Args:
            origin: What is taken off movements over several facets, shape (n, gdim), or zero.
        """
        self._assemble(self._nodes.slip, "slip")
        if self._law == "frictional":
            self._nodes.project(np.broadcast_to(origin, self._nodes.slip.shape))

    def _assemble(self, values: npt.NDArray[np.float64], term: str) -> None:
        """Set values of this rank's slave nodes; those of other ranks are left out."""
        values[:] = 0
        for form in self.forms:
            core.add_vector(
                self._law, self._sliding, term, form.pairs, self._arrays, self._halo.gdim, values
            )

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Add this rank's contact forces to those of all nodes, shape (num_nodes * gdim,)."""
        for form in self.forms:
            if form.residual is not None:
                fem.assemble_vector(b, form.residual)
