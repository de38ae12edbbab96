# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is run on several ranks: the common Hertz problem, and a slab as long as there are ranks."""

from __future__ import annotations

import time
from collections import Counter
from typing import Any

from mpi4py import MPI

import hertz_case
import scenes
from partitions import partitioned
from story import displacement, elasticity, fix

import contactx as cx
from contactx import meshes
from contactx.meshes import Tag
from dolfinx.mesh import CellType

# Cells of a rank along the slab, across it and over its height; those of the base do not match
UPPER = {2: (40, 6), 3: (8, 6, 3)}
LOWER = {2: (52, 6), 3: (10, 7, 3)}
# Length and width of a rank's part, height
SIZE = {2: (4.0, 0.6), 3: (1.6, 1.2, 0.6)}
DOWN, ASIDE = 0.01, 0.15


def strong(path: str, sliding: str) -> dict[str, Any]:
    """Solve the common Hertz problem on all ranks, on the clock from the read mesh on."""
    data = hertz_case.read_mesh(path)
    comm = data.mesh.comm
    comm.Barrier()
    start = time.perf_counter()
    scene = scenes.HertzSphere(data, sliding)
    made = time.perf_counter()
    scene.problem.solve()
    comm.Barrier()
    end = time.perf_counter()
    report = scene.problem.report
    return {
        "dofs": scene.problem.u.function_space.dofmap.index_map.size_global * 3,
        "iterations": report.iterations,
        "krylov": report.krylov,
        "wall": end - start,
        "setup": made - start,
        **{f"{name} s": seconds for name, seconds in report.times.items()},
        "force": 4 * float(scene.contact.force[2]),
    }


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
        held = [fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT), method=method
        )
        self.problem = cx.ContactProblem(
            elasticity(u, 1.0, 0.3),
            u,
            contacts=[self.contact],
            bcs=[*self._moved, *held],
            petsc_options_prefix="slab_",
            # Of any size by the solver that large problems have
            petsc_options={"pc_type": "condensed"},
        )

    def move(self, aside: float) -> int:
        """Press and push the top, and solve; returns the iterations."""
        self._moved[0].g.value[...], self._moved[-1].g.value[...] = aside, -DOWN
        self.problem.solve()
        return self.problem.report.iterations


class SearchTraffic:
    """What this rank sends within searches and outside of them.

    Attributes:
        searches: Number of searches.
        inside: Messages and bytes by purpose, sent within searches.
    """

    def __init__(self, contact: cx.Contact):
        """Count from now on."""
        self._traffic = contact.interface.halo.traffic
        self._traffic.clear()
        self.searches = 0
        self.inside: Counter[tuple[str, str]] = Counter()
        master = contact.interface.master
        self._search = master.search
        master.search = self._counted

    def _counted(self, *arguments: Any) -> Any:
        before = self.all()
        result = self._search(*arguments)
        self.searches += 1
        self.inside += self.all() - before
        return result

    def all(self) -> Counter[tuple[str, str]]:
        """Messages and bytes by purpose."""
        kinds = {"messages": self._traffic.messages, "bytes": self._traffic.bytes}
        return Counter({(kind, p): n for kind, by in kinds.items() for p, n in by.items()})


def weak(dim: int, method: str, partition: str) -> dict[str, Any]:
    """Drag the long slab on all ranks: time, and what the rank that sends most has sent."""
    comm = MPI.COMM_WORLD
    slab = LongSlab(dim, comm.size, method, partition)
    # The first step finds all pairs; what counts is going on
    slab.move(0.0)
    counter = SearchTraffic(slab.contact)
    comm.Barrier()
    start = time.perf_counter()
    iterations = slab.move(ASIDE)
    comm.Barrier()
    wall = time.perf_counter() - start
    outside = counter.all() - counter.inside
    found = {
        "dofs": slab.problem.u.function_space.dofmap.index_map.size_global * dim,
        "iterations": iterations,
        "searches": counter.searches,
        "wall": wall,
        "force": float(slab.contact.force[-1]) / comm.size,
        "halo": comm.allreduce(_halo_size(slab.contact), MPI.MAX),
    }
    for kind in ("messages", "bytes"):
        inside = _sum(counter.inside, kind, comm.size) / max(1, counter.searches)
        rest = _sum(outside, kind, comm.size) / max(1, iterations)
        found[f"{kind} a search"] = comm.allreduce(inside, MPI.MAX)
        found[f"{kind} an iteration"] = comm.allreduce(rest, MPI.MAX)
    return found


def _sum(counts: Counter[tuple[str, str]], kind: str, ranks: int) -> float:
    # What all ranks gather passes through each of them, from one to the next
    passed = {"boxes": ranks - 1}
    return float(sum(n * passed.get(p, 1) for (what, p), n in counts.items() if what == kind))


def _halo_size(contact: cx.Contact) -> int:
    halo = contact.interface.halo
    return int(halo.num_nodes - halo.num_bulk)
