# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A known answer."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Check:
    """A known answer: how far the computed one is from it, and how far it may be."""

    name: str
    error: float
    allowed: float

    @property
    def holds(self) -> bool:
        """Whether it is met; NaN is not."""
        return self.error <= self.allowed
