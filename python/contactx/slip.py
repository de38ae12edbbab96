# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slip over the steps."""

from __future__ import annotations

import numpy as np

from contactx.law.nodes import Nodes


class SlipHistory:
    """What the accepted steps have slipped.

    Attributes:
        slip: Increment of the last step, shape (n, gdim).
        total: Accumulated length, shape (n,).
        dissipation: Work of friction of each node in all steps, at least 0: energy, shape (n,).
    """

    def __init__(self, n: int, gdim: int):
        """Start without slip.

        Args:
            n: Number of slave nodes.
            gdim: Geometric dimension.
        """
        self.slip = np.zeros((n, gdim))
        self.total = np.zeros(n)
        self.dissipation = np.zeros(n)

    def add(self, nodes: Nodes) -> None:
        """Add a converged step.

        Args:
            nodes: Slave nodes.
        """
        self.slip = np.where(nodes.closed[:, None], nodes.slip, 0.0)
        self.total = self.total + np.linalg.norm(self.slip, axis=1)
        traction = nodes.multiplier.reshape(-1, nodes.size)
        work = -nodes.area * np.einsum("ij,ij->i", traction, self.slip)
        self.dissipation = self.dissipation + work
