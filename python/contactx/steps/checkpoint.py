# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem as named arrays, and back."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import saving
from contactx.interface import Interface
from contactx.problem import ContactProblem
from contactx.steps.snapshot import Snapshot
from dolfinx import fem

type Arrays = dict[str, npt.NDArray[Any]]


def save(problem: ContactProblem, history: Sequence[fem.Function]) -> Arrays:
    """Copy all that the next step's answer depends on.

    Args:
        problem: The problem.
        history: Functions that belong to its state.

    Returns:
        Arrays by their names.
    """
    arrays = {**_identity(problem), "u": problem.u.x.array.copy()}
    for k, contact in enumerate(problem.contacts):
        arrays |= {f"contact {k}: {name}": a for name, a in saving.save(contact.interface).items()}
    return arrays | {f"history {k}": f.x.array.copy() for k, f in enumerate(history)}


def load(
    saved: Mapping[str, npt.NDArray[Any]], problem: ContactProblem, history: Sequence[fem.Function]
) -> None:
    """Go on from what ``save`` gave for the same problem, be it another object.

    Args:
        saved: Arrays by their names.
        problem: The problem.
        history: Functions that belong to its state.

    Raises:
        ValueError: If they are of another problem or not finite; nothing has changed.
    """
    _check(saved, save(problem, history), problem)
    before = Snapshot(problem, history)
    try:
        problem.u.x.array[:] = saved["u"]
        for k, function in enumerate(history):
            function.x.array[:] = saved[f"history {k}"]
        for k, contact in enumerate(problem.contacts):
            start = f"contact {k}: "
            saving.load(
                contact.interface,
                {n.removeprefix(start): a for n, a in saved.items() if n.startswith(start)},
            )
            contact.fields.update()
    except BaseException:
        before.restore()
        raise


def _identity(problem: ContactProblem) -> Arrays:
    """Arrays that tell a problem from others to which its state would not fit."""
    V = problem.u.function_space
    digest = hashlib.sha256(np.ascontiguousarray(V.dofmap.list).tobytes()).digest()
    arrays = {
        "mesh: coordinates": V.tabulate_dof_coordinates(),
        "mesh: cells": np.frombuffer(digest, dtype=np.uint8),
    }
    for k, contact in enumerate(problem.contacts):
        arrays |= {f"surface {k}: {n}": a for n, a in _surfaces(contact.interface).items()}
    return arrays


def _surfaces(interface: Interface) -> Arrays:
    master = {f"master {name}": a for name, a in interface.master.identity().items()}
    return {"slaves": interface.slaves, "sliding": np.array(interface.sliding), **master}


def _check(
    saved: Mapping[str, npt.NDArray[Any]],
    present: Mapping[str, npt.NDArray[Any]],
    problem: ContactProblem,
) -> None:
    """Check that saved arrays are those of a problem."""
    for kind, what in (("contact", "contacts"), ("history", "functions of history")):
        there, here = (
            len({name.split(":")[0] for name in arrays if name.startswith(f"{kind} ")})
            for arrays in (saved, present)
        )
        if there != here:
            raise ValueError(f"it holds {there} {what}, but there are {here} here")
    for name in sorted(saved.keys() ^ present.keys()):
        side = "only in the file" if name in saved else "missing in the file"
        raise ValueError(f"{name!r} is {side}: were the options of the contacts others?")
    for name, array in present.items():
        other = saved[name]
        if other.shape != array.shape or other.dtype.kind != array.dtype.kind:
            raise ValueError(
                f"{name!r} is {other.dtype} of shape {other.shape} in the file, but {array.dtype} "
                f"of shape {array.shape} here: is it of another mesh or other surfaces?"
            )
    for name, array in _identity(problem).items():
        if name == "mesh: coordinates":
            # Another machine may round them in another way
            same = np.allclose(saved[name], array, rtol=0, atol=1e-12 * np.ptp(array))
        else:
            same = np.array_equal(saved[name], array)
        if not same:
            raise ValueError(f"{name!r} is another one here: restart the same problem")
    for name, array in saved.items():
        if name == "u" or name.endswith(": multiplier"):
            bad = np.count_nonzero(~np.isfinite(array))
            if bad:
                raise ValueError(f"{name!r} is not finite at {bad} dofs")
