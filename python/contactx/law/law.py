# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a contact law does for a contact."""

from __future__ import annotations

from abc import ABC, abstractmethod

from contactx import cpp as core
from contactx.law.nodes import Nodes


class Law(ABC):
    """Complementarity of the slave nodes.

    Attributes:
        name: Name of the kernels.
        is_vector: Whether the multiplier is a vector, and slip is measured.
        is_tied: Whether pairs are those of the reference for ever.
    """

    name: str
    is_vector = False
    is_tied = False

    def check(self, nodes: Nodes) -> None:
        """Look at what a user may have changed.

        Args:
            nodes: Slave nodes.

        Raises:
            ValueError: If it is out of its range.
        """

    def begin_step(self) -> None:
        """Start a step: what iterates of the last one have shown does not count."""

    def allow_larger_friction(self) -> None:
        """Accept larger trial frictions, where iterates go round in a circle."""

    @abstractmethod
    def set_status(self, nodes: Nodes) -> int:
        """Set each node's status from its multiplier, gap and slip; all ranks must take part.

        Args:
            nodes: Slave nodes.

        Returns:
            Number of this rank's nodes that changed.
        """

    @abstractmethod
    def evaluate(self, nodes: Nodes) -> None:
        """Compute the complementarity function and its derivatives for the status.

        Args:
            nodes: Slave nodes.
        """


class Frictionless(Law):
    """Unilateral contact: p >= 0, g >= 0, p g = 0."""

    name = "frictionless"

    def set_status(self, nodes: Nodes) -> int:
        """See ``Law``."""
        return core.normal_status(nodes.multiplier, nodes.closable_gap, nodes.c, nodes.status)

    def evaluate(self, nodes: Nodes) -> None:
        """See ``Law``."""
        core.normal_complementarity(
            nodes.multiplier,
            nodes.gap,
            nodes.c,
            nodes.area,
            nodes.status,
            nodes.value,
            nodes.by_multiplier.reshape(-1),
            nodes.by_gap,
            nodes.softness,
        )
