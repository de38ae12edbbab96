# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ctrl-C: raised at once, but never amid what must be done as a whole."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any, Self


class Interrupts:
    """Within a with block an interrupt is raised once; then, and where asked for, it waits.

    So what an error has left can be put back although the user presses Ctrl-C again. What has
    waited is raised at the end of the block. Blocks may be nested. Python delivers signals to its
    main thread alone; in others this does nothing.
    """

    def __init__(self) -> None:
        """Create it; interrupts are raised at once."""
        self._waiting = False
        self._waits: list[tuple[int, FrameType | None]] = []
        self._before: Callable[[int, FrameType | None], Any] | None = None

    def __enter__(self) -> Self:
        """Take over the signal."""
        before = signal.getsignal(signal.SIGINT)
        if callable(before) and threading.current_thread() is threading.main_thread():
            self._before = before
            signal.signal(signal.SIGINT, self._handle)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the signal back, and raise what has waited, unless an error is under way."""
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            if self._waits and error is None:
                self._before(*self._waits[-1])

    @property
    def has_come(self) -> bool:
        """True if an interrupt waits."""
        return bool(self._waits)

    def wait(self) -> None:
        """Let interrupts wait from here on."""
        self._waiting = True

    def come(self) -> None:
        """Raise the interrupt that has waited, if there is one; the next one waits."""
        if self._waits and self._before is not None:
            self._before(*self._waits.pop())

    def allow(self) -> None:
        """Let one interrupt be raised at once again."""
        self._waiting = False
        self.come()

    def _handle(self, number: int, frame: FrameType | None) -> None:
        if self._waiting or self._before is None:
            self._waits.append((number, frame))
            return
        self._waiting = True
        self._before(number, frame)
