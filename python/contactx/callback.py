# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Python that PETSc calls."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable
from typing import Concatenate, Protocol


class Keeper(Protocol):
    """Whoever has callbacks.

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
