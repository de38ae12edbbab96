# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Counts of what a rank sends."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Traffic:
    """Messages and bytes that this rank has sent for contact, by what they were for.

    Attributes:
        messages: Number of messages.
        bytes: Their size.
    """

    messages: dict[str, int] = field(default_factory=dict)
    bytes: dict[str, int] = field(default_factory=dict)

    def add(self, purpose: str, messages: int, size: int) -> None:
        """Count messages of a size in all."""
        self.messages[purpose] = self.messages.get(purpose, 0) + messages
        self.bytes[purpose] = self.bytes.get(purpose, 0) + size

    def clear(self) -> None:
        """Count anew."""
        self.messages.clear()
        self.bytes.clear()
