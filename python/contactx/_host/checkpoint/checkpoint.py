# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem as named arrays, and back, on any number of ranks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.checkpoint.rows import FunctionRows, Rows, cell_nodes
from contactx._host.discrete_contact import DiscreteContact
from contactx._host.nodes import reference_positions
from contactx._host.parallel.mpi_host import original_nodes
from contactx._host.parallel.reduce import agreed
from contactx.problem import ContactProblem
from dolfinx import fem

type Arrays = dict[str, npt.NDArray[Any]]

# Starts of the names of arrays that stay the same as long as a problem is the same
_INVARIANT_PREFIXES = ("mesh: ", "surface ")


class Checkpoint:
    """Brings the state of a problem to rank 0, in an order of the mesh as it was made, and back."""

    def __init__(self, problem: ContactProblem, history: Sequence[fem.Function]):
        """Find the order; all ranks must take part.

        Args:
            problem: The problem.
            history: Functions that belong to its state.

        Raises:
            ValueError: If such a function is of a space that several ranks cannot save.
        """
        V = problem.displacement.function_space
        self._problem = problem
        self._history = list(history)
        self._comm: MPI.Comm = V.mesh.comm
        self._owned: int = V.dofmap.index_map.size_local
        self._u = FunctionRows(problem.displacement, "u")
        self._functions = [FunctionRows(f, f"history[{k}]") for k, f in enumerate(history)]
        self._discrete_contacts: list[DiscreteContact] = [c.discrete for c in problem.contacts]
        # What slip starts from; a problem of one's own may have no contacts
        self._nodes: core.Halo | None = next((i.halo.nodes for i in self._discrete_contacts), None)
        original = original_nodes(V)
        self._slaves = [
            Rows(self._comm, original[i.slaves][:, None]) for i in self._discrete_contacts
        ]
        self._cells = Rows(self._comm, cell_nodes(V)).digest

    def save(self) -> Arrays:
        """Copy all that the next step's answer depends on; all ranks must take part.

        Returns:
            Arrays of all ranks by their names; none but on rank 0.
        """
        arrays = self._identity() | {"u": self._u.gather()}
        if self._nodes is not None:
            arrays["start"] = self._u.rows.gather(self._nodes.start[: self._owned])
            arrays["before"] = self._u.rows.gather(self._nodes.before)
        for k, discrete in enumerate(self._discrete_contacts):
            kinds = discrete.saved_rows
            for name, values in discrete.save().items():
                arrays[f"contact {k}: {name}"] = self._gather(kinds[name], k, values)
        arrays |= {f"history {k}": f.gather() for k, f in enumerate(self._functions)}
        return {n: a for n, a in arrays.items() if a is not None and self._comm.rank == 0}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """Go on from what ``save`` gave for the same problem, be it another object.

        All ranks must take part.

        Args:
            saved: Arrays of all ranks by their names; only those of rank 0 count.

        Raises:
            ValueError: If they are of another problem or not finite; nothing has changed.
        """
        present = self.save()
        with agreed(self._comm):
            if self._comm.rank == 0:
                _check_fit(saved, present)
        before = self._problem.snapshot(self._history)
        try:
            self._u.scatter(saved.get("u"))
            self._problem.update_ghosts()
            if self._nodes is not None:
                self._nodes.set_start(self._u.rows.scatter(saved.get("start")))
                self._nodes.set_before(self._u.rows.scatter(saved.get("before")))
            for k, function in enumerate(self._functions):
                function.scatter(saved.get(f"history {k}"))
            for k, discrete in enumerate(self._discrete_contacts):
                discrete.load(
                    {
                        name: self._scatter(kind, k, saved.get(f"contact {k}: {name}"))
                        for name, kind in discrete.saved_rows.items()
                    }
                )
                self._problem.contacts[k].fields.evaluate()
        except BaseException:
            before.restore()
            raise

    def _identity(self) -> dict[str, npt.NDArray[Any] | None]:
        """Arrays that tell a problem from others to which its state would not fit."""
        V = self._problem.displacement.function_space
        x = reference_positions(V)[: self._owned]
        arrays = {"mesh: coordinates": self._u.rows.gather(x), "mesh: cells": self._cells}
        arrays |= {f"history {k}: rows": f.rows.digest for k, f in enumerate(self._functions)}
        for k, discrete in enumerate(self._discrete_contacts):
            arrays[f"surface {k}: slaves"] = self._slaves[k].digest
            arrays[f"surface {k}: sliding"] = np.array(discrete.sliding)
            for name, numbers in discrete.master.identity().items():
                arrays[f"surface {k}: master {name}"] = Rows(self._comm, numbers).digest
        return arrays

    def _gather(self, kind: str, contact: int, values: npt.NDArray[Any]) -> npt.NDArray[Any] | None:
        if kind == "global":
            return values
        if kind == "slave":
            return self._slaves[contact].gather(values)
        return self._u.rows.gather(values[: self._owned])

    def _scatter(
        self, kind: str, contact: int, values: npt.NDArray[Any] | None
    ) -> npt.NDArray[Any]:
        if kind == "global":
            same: npt.NDArray[Any] = self._comm.bcast(values)
            return same
        rows = self._slaves[contact] if kind == "slave" else self._u.rows
        return rows.scatter(values)


def _check_fit(saved: Mapping[str, npt.NDArray[Any]], present: Arrays) -> None:
    """Check that saved arrays are those of a problem.

    Args:
        saved: Arrays of a file.
        present: The same of the problem as it is.

    Raises:
        ValueError: If they are of another problem or not finite.
    """
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
    for name, array in present.items():
        if name == "mesh: coordinates":
            # Another machine may round them differently
            same = np.allclose(saved[name], array, rtol=0, atol=1e-12 * np.ptp(array))
        elif name.startswith(_INVARIANT_PREFIXES) or name.endswith(": rows"):
            same = np.array_equal(saved[name], array)
        else:
            continue
        if not same:
            raise ValueError(f"{name!r} is another one here: restart the same problem")
    for name, array in saved.items():
        if name in ("u", "start", "before") or name.endswith(": multiplier"):
            bad = np.count_nonzero(~np.isfinite(array))
            if bad:
                raise ValueError(f"{name!r} is not finite at {bad} dofs")
