# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What goes wrong on one rank, or on all: each function returns what the ranks made of it.

Run under mpiexec it lets things go wrong and writes down what came of it, for test_errors.py.
"""

from __future__ import annotations

import json
import sys
import traceback
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from unittest import mock

from mpi4py import MPI

import numpy as np

import contactx as cx
from contactx import cpp as core
from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from ranks import watch
from ranks.partitions import partitioned
from scenes import NU, Blocks
from scenes.held_sheet import HeldSheet, limit
from scenes.materials import st_venant_kirchhoff
from scenes.punched_block import PunchedBlock
from scenes.refilled import sizes
from scenes.steps import SlidingBlocks
from scenes.two_tips import TwoTips
from story import elasticity, traction

# Seconds for each
LIMIT = 60
QUADRILATERAL, HEXAHEDRON = CellType.quadrilateral, CellType.hexahedron


class Wrong(Exception):
    """What a user's function may raise."""


def _raised(comm: Any, call: Callable[[], object]) -> list[str]:
    """What a call raises on each rank; an empty text where it returns."""
    text = ""
    try:
        call()
    except Exception as error:
        text = f"{type(error).__name__}: {error}".splitlines()[0]
    return comm.allgather(text)


def _blocks(kind: Callable[..., Any] = Blocks, **options: Any) -> tuple[Any, Any]:
    """Blocks in the plane, and their communicator."""
    scene = kind(QUADRILATERAL, **options)
    return scene, scene.u.function_space.mesh.comm


def _begun(scene: Blocks) -> cx.ContactAssembler:
    """An assembler that has begun a step."""
    contact = scene.contact()
    assembler = cx.ContactAssembler(scene.F, scene.u, contacts=[contact], bcs=scene.bcs)
    assembler.begin_step()
    return assembler


def _last_with_slaves(contact: cx.Contact, comm: Any) -> int:
    """The highest rank that owns a slave node."""
    return max(comm.allgather(comm.rank if len(contact.slave_nodes) else -1))


def factors_fail(folder: Path) -> dict[str, Any]:
    """Twice in turn for the same pattern, and not afterwards."""
    found = sizes([False, True, True, False])
    return {"sizes": MPI.COMM_WORLD.allgather(found)}


def update_throws(folder: Path) -> dict[str, Any]:
    """On the last rank, once; afterwards the loop goes on."""
    scene, comm = _blocks(SlidingBlocks)
    armed = [comm.rank == comm.size - 1]

    def update(t: float) -> None:
        if t > 0.6 and armed[0]:
            armed[0] = False
            raise Wrong("in update")
        scene.update(t)

    steps = cx.LoadSteps(scene.problem, 4, update=update, progress=False)
    errors = _raised(comm, lambda: list(steps))
    place = comm.allgather(steps.t)
    return {"errors": errors, "t": place, "left": [step.t for step in steps]}


def level_set_throws(folder: Path) -> dict[str, Any]:
    """On one rank, amid the iterations; once."""
    armed = [False]

    def ball(x: np.ndarray) -> np.ndarray:
        if armed[0] and x.shape[1] > 0:
            armed[0] = False
            raise Wrong("in a level set")
        return (x[0] - 0.7) ** 2 + (x[1] - 0.6) ** 2 + (x[2] + 2) ** 2 - 4

    def gradient(x: np.ndarray) -> np.ndarray:
        return 2 * np.stack([x[0] - 0.7, x[1] - 0.6, x[2] + 2])

    scene = Blocks(HEXAHEDRON, n_upper=3)
    comm = scene.u.function_space.mesh.comm
    contact = scene.contact(master=cx.LevelSet(ball, gradient))
    problem = scene.problem(contact)
    armed[0] = comm.rank == _last_with_slaves(contact, comm)
    errors = _raised(comm, problem.solve)
    clean = comm.allgather(not scene.u.x.array.any())
    problem.solve()
    return {"errors": errors, "clean": clean, "converged": problem.report.converged}


def material_fails(folder: Path) -> dict[str, Any]:
    """Young's modulus is not a number in one cell; then it is."""
    scene = Blocks(QUADRILATERAL)
    domain = scene.u.function_space.mesh
    E = fem.Function(fem.functionspace(domain, ("DG", 0)))
    E.x.array[:] = 1.0
    if domain.comm.rank == domain.comm.size - 1:
        E.x.array[:1] = np.nan
    scene.F = elasticity(scene.u, E, NU)
    problem = scene.problem(scene.contact())
    errors = _raised(domain.comm, problem.solve)
    E.x.array[:] = 1.0
    problem.solve()
    return {"errors": errors, "converged": problem.report.converged}


def friction_is_negative(folder: Path) -> dict[str, Any]:
    """At one slave node."""
    scene = Blocks(QUADRILATERAL)
    domain = scene.u.function_space.mesh
    friction = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
    friction.x.array[:] = 0.3
    contact = scene.contact(friction=friction)
    problem = scene.problem(contact)
    if domain.comm.rank == _last_with_slaves(contact, domain.comm):
        friction.x.array[contact.status.x.array >= 0] = -0.3
    return {"errors": _raised(domain.comm, problem.solve)}


def law_of_friction_is_wrong(folder: Path) -> dict[str, Any]:
    """Its bound is negative where one rank has slave nodes."""
    scene, comm = _blocks()
    signs = [0.3, 0.3]
    law = cx.FrictionLaw(lambda p, s: signs[0] * p + 1e-3 * signs[1], lambda p, s: (signs[0], 0.0))
    contact = scene.contact(friction=law)
    problem = scene.problem(contact)
    if comm.rank == _last_with_slaves(contact, comm):
        signs[1] = -1.0
    errors = _raised(comm, problem.solve)
    signs[1] = 0.3
    problem.solve()
    return {"errors": errors, "converged": problem.report.converged}


def calls_differ(folder: Path) -> dict[str, Any]:
    """One rank goes on with a loop of its own that the others have ended."""
    scene, comm = _blocks()
    assembler = _begun(scene)
    assembler.settle()
    last = comm.rank == comm.size - 1
    call = assembler.accept if comm.size == 1 or not last else assembler.settle
    return {"errors": _raised(comm, call)}


def arguments_differ(folder: Path) -> dict[str, Any]:
    """The last rank has another tolerance."""
    scene, comm = _blocks()
    assembler = _begun(scene)
    rtol = 1e-11 if comm.rank < comm.size - 1 else 1e-6
    return {"errors": _raised(comm, lambda: assembler.settle(rtol=rtol))}


def argument_is_no_number(folder: Path) -> dict[str, Any]:
    """On the last rank."""
    scene, comm = _blocks()
    assembler = _begun(scene)
    max_it: Any = 50 if comm.rank < comm.size - 1 else "many"
    return {"errors": _raised(comm, lambda: assembler.settle(max_it=max_it))}


def displacement_is_infinite(folder: Path) -> dict[str, Any]:
    """At one node of the last rank."""
    scene, comm = _blocks()
    problem = scene.problem(scene.contact())
    if comm.rank == comm.size - 1:
        scene.u.x.array[0] = np.inf
    return {"errors": _raised(comm, problem.solve)}


def tag_is_missing(folder: Path) -> dict[str, Any]:
    """Of tags that no rank has all of; those that only some have are fine."""
    with partitioned("layers"):
        scene = Blocks(HEXAHEDRON)
    comm = scene.u.function_space.mesh.comm
    errors = _raised(comm, lambda: cx.Surface(scene.tags, Tag.UPPER_CONTACT, 99))
    return {"errors": errors}


def surfaces_share_nodes(folder: Path) -> dict[str, Any]:
    """Of which some ranks have none."""
    with partitioned("layers"):
        scene = Blocks(HEXAHEDRON)
    comm = scene.u.function_space.mesh.comm
    foot = cx.Surface(scene.tags, Tag.UPPER_CONTACT)
    both = cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0)
    return {"errors": _raised(comm, lambda: scene.problem(cx.Contact(foot, both)))}


def node_is_constrained_inside(folder: Path) -> dict[str, Any]:
    """The whole block is constrained where the plane would push it."""
    scene, comm = _blocks()
    foot = scene.tags.find(Tag.UPPER_CONTACT)
    dofs = fem.locate_dofs_topological(scene.u.function_space, 1, foot)
    scene.bcs.append(fem.dirichletbc(np.zeros(2), dofs, scene.u.function_space))
    problem = scene.problem(scene.contact(master=cx.Plane((0.0, 0.1), (0.0, 1.0))))
    return {"errors": _raised(comm, problem.solve)}


def nothing_in_reach(folder: Path) -> dict[str, Any]:
    """No rank finds a pair: a warning, and the solve goes on without contact."""
    scene, comm = _blocks(gap=1.0)
    contact = scene.contact(search_distance=0.1)
    problem = scene.problem(contact)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        errors = _raised(comm, problem.solve)
    texts = comm.allgather(" ".join(str(warning.message) for warning in caught))
    return {"errors": errors, "warnings": texts, "force": contact.force.tolist()}


def load_is_not_balanced(folder: Path) -> dict[str, Any]:
    """A block that nothing holds is pulled away."""
    scene = Blocks(QUADRILATERAL, gap=0.01)
    domain = scene.u.function_space.mesh
    scene.bcs = scene.bcs[:2]
    load = fem.Constant(domain, (0.0, 0.01))
    scene.F += traction(scene.u, scene.tags, Tag.UPPER_TOP, load)
    problem = scene.problem(scene.contact())
    errors = _raised(domain.comm, problem.solve)
    return {"errors": errors, "clean": domain.comm.allgather(not scene.u.x.array.any())}


def checkpoint_is_damaged(folder: Path) -> dict[str, Any]:
    scene, comm = _blocks(SlidingBlocks)
    path = folder / "damaged.state"
    if comm.rank == 0:
        path.write_bytes(b"no archive")
    comm.Barrier()
    steps = lambda: cx.LoadSteps(scene.problem, 2, update=scene.update, restart=path)  # noqa: E731
    return {"errors": _raised(comm, steps)}


def checkpoint_cannot_be_written(folder: Path) -> dict[str, Any]:
    """Its folder is gone when it is written."""
    scene, comm = _blocks(SlidingBlocks)
    path = folder / "gone" / "run.state"
    steps = cx.LoadSteps(scene.problem, 2, update=scene.update, checkpoint=path, progress=False)
    comm.Barrier()
    if comm.rank == 0:
        path.parent.rmdir()
        path.parent.write_text("a file in its place")
    comm.Barrier()
    return {"errors": _raised(comm, lambda: list(steps))}


def column_fails_on_one_rank(folder: Path) -> dict[str, Any]:
    """Such as a largest value of nodes that it has none of."""
    scene, comm = _blocks(SlidingBlocks)
    scene.problem.solve()

    def column() -> float:
        if comm.rank == comm.size - 1:
            raise ValueError("no slave node here")
        return 0.0

    totals = cx.CSVOutput(folder / "totals.csv", scene.problem.contacts, columns={"none": column})
    return {"errors": _raised(comm, lambda: totals.write(1.0))}


def slave_is_too_coarse(folder: Path) -> dict[str, Any]:
    """A punch reaches through a facet whose nodes other ranks may have."""
    block = PunchedBlock(2, n=4, punch=8, x0=0.25)
    comm = block.u.function_space.mesh.comm
    return {"errors": _raised(comm, block.problem.solve), "clean": not block.u.x.array.any()}


def ball_is_between_nodes(folder: Path) -> dict[str, Any]:
    """Of a facet that one rank has."""
    block = PunchedBlock(3, n=4, ball=0.1, x0=0.25)
    return {"errors": _raised(block.u.function_space.mesh.comm, block.problem.solve)}


def tips_pass_each_other(folder: Path) -> dict[str, Any]:
    """Of which each may be on a rank of its own."""
    tips = TwoTips(method="surface-to-surface", whole=True, overlap=0.2)
    tips.push(12.0)
    return {"errors": _raised(tips.u.function_space.mesh.comm, tips.problem.solve)}


def tool_goes_through(folder: Path) -> dict[str, Any]:
    """A sheet, part of which each rank has."""
    sheet = HeldSheet(n=12)
    comm = sheet.u.function_space.mesh.comm
    sheet.push(2.5)
    return {"errors": _raised(comm, sheet.problem.solve)}


def cells_are_turned_inside_out(folder: Path) -> dict[str, Any]:
    """Of a few of one rank."""
    block = HeldSheet(n=24, thickness=1.0, on_ground=True, material=st_venant_kirchhoff)
    comm = block.u.function_space.mesh.comm
    block.push(0.55)
    # As a loop would go whose steps nothing shortens
    with mock.patch.object(core.Loop, "limit", limit):
        return {"errors": _raised(comm, block.problem.solve)}


def main(argv: Sequence[str]) -> None:
    """Run the functions named, and write what they return into the folder named first."""
    comm, folder = MPI.COMM_WORLD, Path(argv[0])
    for name in argv[1:]:
        watch.begin(name, LIMIT)
        found = None
        try:
            found = globals()[name](folder)
        except Exception:
            # Not where it is expected to be raised
            traceback.print_exc()
        comm.Barrier()
        if comm.rank == 0 and found is not None:
            (folder / f"{name}-{comm.size}.json").write_text(json.dumps(found))
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
