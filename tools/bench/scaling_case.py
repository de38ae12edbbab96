# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is run on several ranks: a slab as long as there are ranks."""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from ranks.partitions import partitioned
from story import displacement, elasticity, fix

# Cells of a rank along the slab, across it and over its height; those of the base do not match
UPPER = {2: (40, 6), 3: (8, 6, 3)}
LOWER = {2: (52, 6), 3: (10, 7, 3)}
# Length and width of a rank's part, height
SIZE = {2: (4.0, 0.6), 3: (1.6, 1.2, 0.6)}
DOWN, ASIDE, REACH = 0.02, 0.25, 0.2
_TAG = 7080


class LongSlab:
    """A slab pressed on a base and dragged along it, as long as there are ranks.

    Attributes:
        problem: The problem.
        contact: The contact.
    """

    def __init__(self, dim: int, ranks: int, method: str, partition: str):
        """Mesh the bodies and set the problem up."""
        cell = CellType.quadrilateral if dim == 2 else CellType.hexahedron
        longer = (ranks, *[1] * (dim - 1))
        upper, lower, size = (
            [part * n for part, n in zip(table[dim], longer, strict=True)]
            for table in (UPPER, LOWER, SIZE)
        )
        with partitioned(partition):
            data = meshes.blocks(cell, upper, lower, size_upper=size, size_lower=size)
        tags, u = data.facet_tags, displacement(data.mesh)
        self._moved = [fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(dim)]
        fixed = [fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Surface(tags, Tag.LOWER_CONTACT),
            method=method,
            # By default it is as long as the surface
            search_distance=REACH,
        )
        self.problem = cx.ContactProblem(
            elasticity(u, 1.0, 0.3),
            u,
            contacts=[self.contact],
            bcs=[*self._moved, *fixed],
            petsc_options_prefix="slab_",
            # Of any size by the solver that large problems have
            petsc_options={"pc_type": "condensed"},
        )

    def move(self, aside: float) -> int:
        """Press and push the top, and solve; returns the iterations."""
        self._moved[0].g.value[...], self._moved[-1].g.value[...] = aside, -DOWN
        self.problem.solve()
        return self.problem.report.iterations


class Collectives:
    """Counts the collective calls that Python makes on communicators.

    Attributes:
        count: Number of calls so far.
    """

    _NAMES = (
        "allreduce",
        "Allreduce",
        "allgather",
        "Allgather",
        "Allgatherv",
        "bcast",
        "gather",
        "Ibarrier",
    )

    def __init__(self) -> None:
        """Nothing is counted yet."""
        self.count = 0

    @contextmanager
    def counting(self) -> Iterator[None]:
        """Count inside."""
        call, tool = sys.monitoring.events.CALL, sys.monitoring.PROFILER_ID
        sys.monitoring.use_tool_id(tool, "collectives")
        sys.monitoring.register_callback(tool, call, self._called)
        sys.monitoring.set_events(tool, call)
        try:
            yield
        finally:
            sys.monitoring.set_events(tool, 0)
            sys.monitoring.free_tool_id(tool)

    def _called(self, _code: Any, _offset: int, function: Any, argument: Any) -> None:
        owners = (argument, getattr(function, "__self__", None))
        if any(isinstance(owner, MPI.Intracomm) and owner.size > 1 for owner in owners):
            self.count += function.__name__ in self._NAMES


class Sent:
    """Counts from outside what this rank sends for a contact, by the function that sends it.

    Attributes:
        counts: Messages and bytes of the exchange, of the halo's scatters and of the boxes.
    """

    def __init__(self, contact: cx.Contact):
        """Count from now on."""
        self.counts: Counter[tuple[str, str]] = Counter()
        self._host = host = contact.discrete.halo.host
        self._gdim = contact.discrete.halo.gdim
        # Index map of the halo, and with how many ranks it shares how many owned nodes
        self._shared: tuple[Any, int, int] = None, 0, 0
        for name, count in (
            ("exchange", self._exchanged),
            ("forward", self._forward),
            ("reverse", self._reverse),
        ):
            setattr(host, name, self._counting(getattr(host, name), count))
        host.gather = self._gathering(host.gather)

    def _add(self, purpose: str, messages: int, size: int) -> None:
        self.counts["messages", purpose] += messages
        self.counts["bytes", purpose] += size

    def _counting(self, operation: Any, count: Any) -> Any:
        def counted(*arguments: Any) -> Any:
            if self._host.size > 1:
                count(*arguments)
            return operation(*arguments)

        return counted

    def _exchanged(self, outgoing: Mapping[int, bytes]) -> None:
        for rank, item in outgoing.items():
            if rank != self._host.rank:
                self._add("exchange", 1, len(item))

    def _gathering(self, gather: Any) -> Any:
        def counted(mine: bytes) -> bytes:
            every: bytes = gather(mine)
            # A box has a rank, two corners, an axis and a sine; else it is the audit that asks
            is_box = len(mine) == 8 * (3 * self._gdim + 2)
            # What others have, and before how much it is, passes through each rank, in larger and
            # larger packages
            messages = 2 * math.ceil(math.log2(self._host.size))
            size = 8 * (self._host.size - 1) + len(every) - len(mine)
            self.counts["calls", "boxes"] += is_box
            self._add("boxes" if is_box else "audit", messages, size)
            return every

        return counted

    def _forward(self, values: Any, width: int) -> None:
        index_map = self._host.full_map
        if self._shared[0] is not index_map:
            ranks = index_map.index_to_dest_ranks(_TAG).array
            self._shared = index_map, len(np.unique(ranks)), len(ranks)
        _, messages, nodes = self._shared
        self._add("halo", messages, nodes * width * values.itemsize)

    def _reverse(self, values: Any, width: int) -> None:
        owners = self._host.full_map.owners
        self._add("halo", len(np.unique(owners)), len(owners) * width * values.itemsize)


def weak(dim: int, method: str, partition: str) -> dict[str, Any]:
    """Drag the long slab on all ranks: time, and what the rank that sends most has sent."""
    comm = MPI.COMM_WORLD
    PETSc.Log.begin()
    slab = LongSlab(dim, comm.size, method, partition)
    # The first step finds all pairs; what counts is going on
    slab.move(0.0)
    comm.Barrier()
    start = time.perf_counter()
    slab.move(ASIDE)
    comm.Barrier()
    wall = time.perf_counter() - start
    before = _petsc_traffic()
    sent, collectives = Sent(slab.contact), Collectives()

    def all_sent() -> Counter[tuple[str, str]]:
        """Messages and bytes by purpose, and collective calls."""
        counts = sent.counts.copy()
        counts["collectives", "all"] = collectives.count
        return counts

    with collectives.counting():
        iterations = slab.move(2 * ASIDE)
        solver = _petsc_traffic() - before
    whole = all_sent()
    # Nothing but a search asks for boxes, once, and sends by exchange
    searches = max(1, whole["calls", "boxes"])
    search = Counter({at: n for at, n in whole.items() if at[1] in ("boxes", "exchange")})
    found = {
        "dofs": slab.problem.u.function_space.dofmap.index_map.size_global * dim,
        "iterations": iterations,
        "wall": wall,
        "force": float(slab.contact.force[-1]) / comm.size,
        "krylov": slab.problem.report.krylov,
        **{
            f"PETSc's {name} an iteration": comm.allreduce(solver[name] / iterations, MPI.MAX)
            for name in ("messages", "bytes")
        },
        "halo": comm.allreduce(_halo_size(slab.contact), MPI.MAX),
    }
    for kind in ("messages", "bytes", "collectives"):
        of_search = _sum(search, kind) / searches
        rest = _sum(whole - search, kind) / max(1, iterations)
        found[f"{kind} an iteration"] = comm.allreduce(rest, MPI.MAX)
        if kind != "collectives":
            found[f"{kind} a search"] = comm.allreduce(of_search, MPI.MAX)
    found["of boxes"] = comm.allreduce(search["bytes", "boxes"] / searches, MPI.MAX)
    return found


def _sum(counts: Counter[tuple[str, str]], kind: str) -> float:
    return float(sum(n for (what, _), n in counts.items() if what == kind))


def _petsc_traffic() -> Counter[str]:
    """What PETSc has sent in solves, not counting what MUMPS sends inside of it."""
    found = PETSc.Log.Event("SNESSolve").getPerfInfo()
    return Counter({"messages": found["numMessages"], "bytes": found["messageLength"]})


def _halo_size(contact: cx.Contact) -> int:
    halo = contact.discrete.halo
    return int(halo.num_nodes - halo.num_bulk)
