# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_scripts.py: checkpoints on n and m ranks, and errors of single ranks."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np

import basix.ufl
import contactx as cx
from contactx._host.checkpoint.checkpoint import Checkpoint
from contactx._host.checkpoint.shared_file import SharedFile
from contactx._host.parallel.reduce import agreed
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from inputs import archive
from ranks.agreeing import refused, some_ranks, wait
from ranks.relaxed import MESHES, Relaxed

WORLD = MPI.COMM_WORLD


# Ranks that write a checkpoint, and those that go on from it
PAIRS = ((1, 1), (1, 3), (1, 4), (2, 4), (3, 1), (3, 2), (3, 3), (4, 1), (4, 3), (4, 4))
MADE: dict[tuple[str, int], mesh.Mesh] = {}


def problem_on(name: str, size: int) -> Relaxed | None:
    """A new problem on the first so many ranks; None on the others."""
    comm = some_ranks(size)
    if comm is None:
        return None
    if (name, size) not in MADE:
        MADE[name, size] = MESHES[name](comm)
    return Relaxed(MADE[name, size], fails_above=0.2)


def run(problem: Relaxed, until: int | None = None, steps: Any = 3, **options: Any) -> cx.LoadSteps:
    """Take steps."""
    options = {"history": problem.history, "progress": False, **options}
    loop = cx.LoadSteps(problem, steps, update=problem.update, **options)
    for step in loop:
        problem.commit()
        if step.index == until:
            break
    return loop


def state(loop: cx.LoadSteps, file: Path, ranks: int) -> dict[str, Any] | None:
    """All arrays of a state but for the wall times, on rank 0."""
    loop.save(file)
    comm = some_ranks(ranks)
    assert comm is not None
    comm.Barrier()
    if comm.rank > 0:
        return None
    arrays = archive.read(file)
    arrays["steps: table"] = arrays["steps: table"].reshape(-1, 5)[:, :-1]
    return arrays


def checkpoints(folder: Path) -> None:
    """Write on n ranks, read on m: files and results are the same."""
    for name in MESHES:
        ends: dict[int, Any] = {}
        for n in range(1, WORLD.size + 1):
            problem = problem_on(name, n)
            if problem is not None:
                loop = run(problem)
                # Each of the three given steps was halved
                assert loop.t == 1 and len(problem.calls) > 6
                ends[n] = state(loop, folder / "end.state", n)
                run(problem_on(name, n), until=3).save(folder / f"{name} {n}.state")
            wait()
        for n, m in PAIRS:
            problem = problem_on(name, m)
            if problem is not None:
                problem.before = 0.5
                loop = run(problem, restart=folder / f"{name} {n}.state")
                assert loop.t == 1
                end = state(loop, folder / "end.state", m)
                if end is not None:
                    compare(end, ends[m], ends[1], n == m)
                    print(f"{name}: {n} ranks, then {m}", flush=True)
            wait()


def compare(end: Any, straight: Any, on_one: Any, same_number: bool) -> None:
    """The bits of a run without a stop, on the same number of ranks; else but for rounding."""
    assert len(end) == 10, list(end)
    assert np.abs(end["u"]).max() > 0.1
    for key, values in end.items():
        if same_number:
            assert values.tobytes() == straight[key].tobytes(), key
        assert np.allclose(values, on_one[key], rtol=0, atol=1e-12), key


class Wrong(Exception):
    pass


def on(rank: int, error: BaseException, call: int = 1) -> Callable[..., None]:
    """A function that raises on one rank when it is called that often."""
    calls = []

    def function(*_: Any) -> None:
        calls.append(1)
        if WORLD.rank == rank and len(calls) == call:
            raise error

    return function


def errors(folder: Path) -> None:
    """What one rank raises all raise, and go on from where they were."""
    last = WORLD.size - 1
    problem = Relaxed(MADE["blocks", WORLD.size])

    def steps(**options: Any) -> cx.LoadSteps:
        options = {"update": problem.update, "history": problem.history, **options}
        return cx.LoadSteps(problem, options.pop("steps", 4), progress=False, **options)

    def take(loop: cx.LoadSteps) -> None:
        for _ in loop:
            problem.commit()

    fails = on(last, Wrong("loads"), 3)
    loop = steps(update=fails)
    refused(Wrong, "loads", lambda: take(loop))
    assert loop.t == 0.5
    take(loop)
    assert loop.t == 1

    loop = steps(update=on(0, KeyboardInterrupt("stopped"), 2))
    refused(KeyboardInterrupt, "stopped", lambda: take(loop))
    assert loop.t == 0.25
    loop = steps(output=on(last, OSError("no place"), 2))
    refused(OSError, "no place", lambda: take(loop))
    # An output comes after the step was accepted
    assert loop.t == 0.5

    class Unpicklable(Exception):
        def __init__(self) -> None:
            super().__init__("has no copy")
            self.file = open(__file__)

        def __reduce__(self) -> Any:
            raise TypeError

    loop = steps(update=on(last, Unpicklable()))
    try:
        take(loop)
    except Exception as error:
        assert "has no copy" in str(error)
    assert loop.t == 0

    # One rank's failure to converge in update cuts the step on all
    short = steps(steps=1, update=on(last, cx.ConvergenceError("inner", problem.report)))
    taken = [step.t for step in short]
    assert WORLD.allgather(taken) == [[0.5, 1.0]] * WORLD.size

    file = folder / "errors.state"
    loop = steps(checkpoint=file)
    next(iter(loop))
    loop.save(file)
    before = file.read_bytes()
    WORLD.Barrier()
    whole = SharedFile.write

    def half(self: SharedFile, at: int, values: Any) -> None:
        whole(self, at, values)
        with agreed(WORLD):
            if WORLD.rank == last:
                raise OSError(28, "disk full")

    SharedFile.write = half
    refused(OSError, "disk full", lambda: take(loop))
    refused(OSError, "disk full", lambda: loop.save(file))
    SharedFile.write = whole
    assert file.read_bytes() == before
    assert sorted(p.name for p in folder.glob("errors*")) == ["errors.state"]
    refused(ValueError, "is the folder", lambda: loop.save(folder))
    refused(ValueError, "is the folder", lambda: steps(checkpoint=folder))
    refused(FileNotFoundError, "there is no checkpoint", lambda: steps(restart=folder / "none"))
    if WORLD.rank == 0:
        (folder / "part.state").write_bytes(before[:999])
    refused(ValueError, "is truncated", lambda: steps(restart=folder / "part.state"))
    other = Relaxed(MADE["one block", WORLD.size])
    refused(ValueError, "3 values of type f8 a row", lambda: run(other, restart=file))
    other = Relaxed(MESHES["blocks"](WORLD))
    x = other.u.function_space.mesh.geometry.x
    x[: 1 if WORLD.rank == last else 0] += 1e-3
    refused(ValueError, "'mesh: coordinates' is another one", lambda: run(other, restart=file))
    assert not other.u.x.array.any()
    u = problem.u.x.array.copy()
    refused(Wrong, "loads", lambda: steps(restart=file, update=on(1, Wrong("loads"))))
    assert np.array_equal(problem.u.x.array, u)

    cubic = fem.Function(fem.functionspace(problem.u.function_space.mesh, ("P", 3)))
    inside = steps(history=[cubic])
    next(iter(inside))
    message = "history[0] is of"
    refused(ValueError, message, lambda: inside.save(file))
    refused(ValueError, message, lambda: steps(history=[cubic], checkpoint=file))
    refused(ValueError, "has other steps", lambda: steps(steps=2 + (WORLD.rank == last)))
    refused(TypeError, "must be a function", lambda: steps(update=3 if WORLD.rank == 1 else print))


def mixed(folder: Path) -> None:
    """Mixed and enriched spaces are saved as on one rank."""
    for cell in (CellType.triangle, CellType.tetrahedron):
        made = [Mixed(comm, cell) for comm in (WORLD, MPI.COMM_SELF)]
        for k in range(len(made[0].functions)):
            before = [m.functions[k].x.array.copy() for m in made]
            made[0].points[k].write(folder / "all.state", {})
            made[1].points[k].write(folder / f"{WORLD.rank}.state", {})
            files = [archive.read(folder / f"{name}.state") for name in ("all", WORLD.rank)]
            for name, values in files[0].items():
                assert np.abs(values - files[1][name]).max() < 1e-14, name
            for m, values in zip(made, before, strict=True):
                m.functions[k].x.array[:] = 0
                m.points[k].apply(m.points[k].read(folder / "all.state"))
                assert np.abs(m.functions[k].x.array - values).max() < 1e-14
            assert np.array_equal(made[0].functions[k].x.array, before[0])
            wait()


class Mixed:
    """Functions of mixed spaces, and their checkpoints."""

    def __init__(self, comm: MPI.Comm, cell: CellType):
        domain = (
            mesh.create_unit_square(comm, 5, 4)
            if cell == CellType.triangle
            else mesh.create_unit_cube(comm, 3, 2, 2, cell)
        )
        name, dim = domain.basix_cell(), domain.geometry.dim
        linear = basix.ufl.element("Lagrange", name, 1)
        bubble = basix.ufl.element("Bubble", name, dim + 1)
        mini = basix.ufl.enriched_element([linear, bubble])
        self.functions = []
        for u in (
            basix.ufl.element("Lagrange", name, 2, shape=(dim,)),
            basix.ufl.blocked_element(mini, shape=(dim,)),
        ):
            W = fem.functionspace(domain, basix.ufl.mixed_element([u, linear]))
            w = fem.Function(W)
            V, dofs = W.sub(1).collapse()
            p = fem.Function(V)
            p.interpolate(lambda x: np.cos(x[0] + 2 * x[1]))
            w.x.array[:] = 2
            w.x.array[np.ravel(dofs)] = p.x.array
            w.x.scatter_forward()
            self.functions.append(w)
        self.points = [Checkpoint(Relaxed(domain), [w]) for w in self.functions]


def print_nothing(t: float) -> None:
    """No loads."""


if __name__ == "__main__":
    place = Path(sys.argv[1])
    checkpoints(place)
    errors(place)
    mixed(place)
    # Nothing is left to be shown but a table, by one rank
    list(cx.LoadSteps(Relaxed(MADE["blocks", WORLD.size]), 2, update=print_nothing))
