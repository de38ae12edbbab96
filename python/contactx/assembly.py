# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""All forms of one contact."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx.forms import ContactForms, Pairs, State
from contactx.law.nodes import Nodes
from dolfinx import fem


class Assembly:
    """Forms over the current pairs, one set for each kind of master facet.

    Attributes:
        forms: The forms.
    """

    def __init__(self, comm: MPI.Comm, law: str, state: State, bulk_map: Any, slave_map: Any):
        """Create an assembly without pairs.

        Args:
            comm: Communicator.
            law: Name of the contact law.
            state: Vectors that the forms read at each assembly.
            bulk_map: Index map of the bulk's nodes.
            slave_map: Index map of the slave nodes.
        """
        self._comm = comm
        self._law = law
        self._state = state
        self._maps = bulk_map, slave_map
        self.forms: list[ContactForms] = []
        self._sliding = ""

    def renew(self, groups: Sequence[Pairs], sliding: str) -> None:
        """Make the forms of new pairs.

        Args:
            groups: Pairs by the kind of their facets.
            sliding: Kinematics, "finite" or "small".
        """
        self._sliding = sliding
        self.forms = [
            ContactForms(self._comm, self._law, sliding, pairs, self._state, *self._maps)
            for pairs in groups
        ]

    def update(self, groups: Sequence[Pairs]) -> None:
        """Take over new data, with new forms where the pairs are others."""
        if len(groups) != len(self.forms) or not all(
            form.pairs.same(pairs) for form, pairs in zip(self.forms, groups, strict=True)
        ):
            self.renew(groups, self._sliding)
            return
        for form, pairs in zip(self.forms, groups, strict=True):
            form.update(pairs)

    def kinematics(self, nodes: Nodes) -> None:
        """Assemble gap and normal of the slave nodes; zero where there is no pair."""
        nodes.gap[:] = nodes.normal[:] = 0
        for form in self.forms:
            if form.gap is not None:
                fem.assemble_vector(nodes.gap, form.gap)
            if form.normal is not None:
                fem.assemble_vector(nodes.normal.reshape(-1), form.normal)

        if nodes.mean is not None:
            nodes.mean.normalise(nodes.normal, nodes.mobile)

    def slip(self, nodes: Nodes, origin: npt.NDArray[np.float64]) -> None:
        """Assemble the slip of the slave nodes.

        Args:
            nodes: Slave nodes, with their normals.
            origin: What is taken off movements over several facets, shape (n, gdim), or zero.
        """
        nodes.slip[:] = 0
        for form in self.forms:
            if form.slip is not None:
                fem.assemble_vector(nodes.slip.reshape(-1), form.slip)
        if nodes.mean is not None and self._law != "tied":
            nodes.slip -= origin
            nodes.mean.project(nodes.normal, nodes.slip, nodes.mobile)

    def add_residual(self, b: npt.NDArray[np.float64]) -> None:
        """Add the contact forces to a vector of the bulk, shape (num_nodes * gdim,)."""
        for form in self.forms:
            if form.residual is not None:
                fem.assemble_vector(b, form.residual)
