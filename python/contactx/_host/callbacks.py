# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Python functions that PETSc calls, and Ctrl-C, which must not end them halfway."""

from __future__ import annotations

import functools
import signal
import threading
import weakref
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any, Concatenate, Protocol, Self

from petsc4py import PETSc

import numpy as np


class Keeper(Protocol):
    """Object with callbacks.

    Attributes:
        error: Error that one of them raised.
    """

    error: BaseException | None


def keeps_its_error[K: Keeper, **P, R](
    callback: Callable[Concatenate[K, P], R],
) -> Callable[Concatenate[K, P], R]:
    """Keep an error of Python that is to pass through PETSc, where Python may lose it.

    While it is under way garbage may be collected, and what that calls drops the error.

    Args:
        callback: Method that PETSc calls.

    Returns:
        The method, which leaves its error in ``error`` before it raises it.
    """

    @functools.wraps(callback)
    def call(self: K, *args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return callback(self, *args, **kwargs)
        except BaseException as error:
            self.error = error
            raise

    return call


def weakly[**P, R](method: Callable[P, R]) -> Callable[P, R]:
    """A method for PETSc to call that does not keep its object alive.

    Python does not see what PETSc holds on to: an object that its own solver refers to would stay
    for ever, and destroying it by hand is collective, which garbage collection is not.

    Args:
        method: Bound method.
    """
    reference = weakref.WeakMethod(method)

    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        bound = reference()
        assert bound is not None
        return bound(*args, **kwargs)

    return call


class Quiet:
    """With block around a PETSc solver that calls Python: errors raised there come at its end.

    An error that passes through a solver amid its iterations leaves it with pointers to what is no
    longer there, and destroying it ends the program.
    """

    def __init__(self) -> None:
        """Create it."""
        self._error: BaseException | None = None
        self._interrupts = Interrupts()

    def __enter__(self) -> Self:
        """Let interrupts wait."""
        self._interrupts.__enter__().wait()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Raise what was raised inside, or has waited."""
        first = error or self._error
        self._interrupts.__exit__(None if first is None else type(first), first, trace)
        if error is None and self._error is not None:
            raise self._error

    def call(self, function: Callable[[], object], result: PETSc.Vec) -> None:
        """Call a function; after an error the solver gets NaN, with which it soon ends.

        Args:
            function: Writes into the result.
            result: Vector that PETSc waits for.
        """
        if self._error is None and not self._interrupts.has_come:
            try:
                function()
                return
            except BaseException as error:
                self._error = error
        result.set(np.nan)


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
