# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results of a scene that do not depend on how its mesh is numbered and distributed."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
from contactx._host.nodes import original_nodes
from dolfinx import fem

type Array = npt.NDArray[Any]

FIELDS = ("pressure", "master_pressure", "traction", "gap", "status")


class Outcome:
    """What is kept of each step, and of the end."""

    def __init__(self) -> None:
        self._steps: list[dict[str, Any]] = []

    def add(self, problem: cx.ContactProblem) -> None:
        """Keep the numbers of a step (collective)."""
        report, comm = problem.report, problem.displacement.function_space.mesh.comm
        counts = []
        for contact in problem.contacts:
            status = owned(contact.status)
            counts.append([comm.allreduce(int((status == k).sum())) for k in (0, 1, 2)])
        self._steps.append(
            {
                "iterations": report.iterations,
                "discarded": report.discarded,
                "counts": counts,
                "frozen pairs": report.frozen_pairs,
                "corners": report.corners,
                "force": [contact.force for contact in problem.contacts],
                "slip": report.slip,
                "dissipation": report.dissipation,
                "chords": report.audit.chords,
                "edges": report.audit.edges,
            }
        )

    def gather(self, problem: cx.ContactProblem) -> dict[str, Array]:
        """All that was kept and the nodal fields in the order of the mesh as made (collective).

        Returns:
            Arrays by name on rank 0, nothing elsewhere.
        """
        found = {f"step {key}": np.array([s[key] for s in self._steps]) for key in self._steps[0]}
        found["u"] = in_order(problem.displacement)
        for k, contact in enumerate(problem.contacts):
            names = list(FIELDS)
            if not contact.tied and not contact.discrete.law.name.startswith("frictionless"):
                names += ["slip", "slip_total"]
            for name in names:
                found[f"{name} {k}"] = in_order(getattr(contact, name))
        for k, conductance in enumerate(problem.assembler.conductances):
            found[f"field {k}"] = in_order(conductance.field)
            found[f"across {k}"] = in_order(conductance.contact.across(conductance.field))
            found[f"flow {k}"] = np.array([conductance.flow])
        return found if problem.displacement.function_space.mesh.comm.rank == 0 else {}


def owned(function: fem.Function) -> Array:
    """Values at the nodes that this rank owns, shape (n,) or (n, k)."""
    dofmap = function.function_space.dofmap
    values = function.x.array[: dofmap.index_map.size_local * dofmap.index_map_bs]
    return values if dofmap.index_map_bs == 1 else values.reshape(-1, dofmap.index_map_bs)


def in_order(function: fem.Function) -> Array:
    """Nodal values on rank 0 in the order of the mesh as it was made (collective)."""
    V = function.function_space
    comm, original = V.mesh.comm, original_nodes(V)
    values = owned(function)
    parts = comm.gather((original[: len(values)], values))
    if comm.rank != 0:
        return np.zeros(0)
    numbers, values = (np.concatenate(part) for part in zip(*parts, strict=True))
    return np.asarray(values[np.argsort(numbers)])


def differences(found: dict[str, Array], expected: dict[str, Array], tolerance: float) -> list[str]:
    """What differs, in words; fields by more than a part of their largest value.

    Args:
        expected: The same of another run.
    """
    if set(found) != set(expected):
        return [f"{sorted(set(found) ^ set(expected))} in one of them"]
    # Gaps that are closed and slip of nodes that stick are rounding of displacements
    moved = np.abs(expected["u"]).max()
    smallest = dict.fromkeys(("gap", "slip", "slip_total", "step slip"), moved)
    smallest["step edges"] = 1.0
    smallest["step dissipation"] = moved * np.abs(expected["step force"]).max()
    texts = []
    for name, a in found.items():
        b = expected[name]
        if a.shape != b.shape:
            texts.append(f"{name}: shape {a.shape} instead of {b.shape}")
        elif a.dtype.kind in "iu" or name.startswith("status"):
            wrong = int((a != b).sum())
            if wrong:
                texts.append(f"{name}: {wrong} of {a.size} differ: {_some(a, b, a != b)}")
        elif not np.array_equal(np.isnan(a), np.isnan(b)):
            texts.append(f"{name}: NaN at other nodes")
        elif a.size:
            off = np.abs(np.nan_to_num(a) - np.nan_to_num(b))
            least = smallest.get(name.rstrip(" 0123456789"), 0.0)
            size = max(np.abs(np.nan_to_num(b)).max(), least)
            if off.max() > tolerance * size:
                texts.append(f"{name}: off by {off.max():.1e} of {size:.1e}")
    return texts


def _some(a: Array, b: Array, which: Array) -> str:
    return f"{a[which][:8].tolist()} instead of {b[which][:8].tolist()}"
