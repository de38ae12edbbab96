# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Condensed solvers with other costs and limits."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from contactx._host.linear import Condensed


@contextmanager
def tuned(**values: float) -> Iterator[None]:
    """Within the block condensed solvers are made with some values of their tuning."""
    make = Condensed.__init__

    def init(self: Condensed, *args: Any) -> None:
        make(self, *args)
        for name, value in values.items():
            assert hasattr(self.tuning, name)
            setattr(self.tuning, name, value)

    with patch.object(Condensed, "__init__", init):
        yield
