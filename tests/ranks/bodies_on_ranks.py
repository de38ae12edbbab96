# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_scripts.py under mpiexec: bodies, free ones, checks, audits."""

from mpi4py import MPI

import numpy as np

from contactx import cpp as core
from contactx._host.bulk_host import BulkHost

from ranks.audit_on_ranks import check_audit
from ranks.checks_on_ranks import check_errors, nested
from scenes.free_block import FreeBlock
from scenes.numbered_blocks import PARTITIONS, TwoBlocks, alone

COMM = MPI.COMM_WORLD


def check_bodies(one, scene):
    bodies, halo = scene.bodies, scene.halo
    of_node = one.everywhere(one.bodies.of_node)[:, 0]
    names = sorted([scene.lower, scene.upper])
    assert bodies.names.tolist() == one.bodies.names.tolist() == names

    def follows():
        np.testing.assert_array_equal(bodies.of_node, of_node[halo.original])
        np.testing.assert_array_equal(bodies.names[bodies.number], bodies.of_node)

    follows()
    scene.see_all()
    follows()
    halo.shrink()
    follows()
    np.testing.assert_array_equal(
        bodies.of_cell, bodies.of_node[scene.u.function_space.dofmap.list[:, 0]]
    )
    for body in names:
        assert bodies.count(body) == np.count_nonzero(of_node == body)
        cells = len(bodies.cells(body))
        assert COMM.allreduce(cells) == len(one.bodies.cells(body))
        # Of one node that one rank knows of
        node = np.flatnonzero(halo.original[: halo.num_owned] == body).astype(np.int32)
        assert bodies.carrying(node) == [body]
    some = np.array(names[::-1])
    boxes, expected = (s.bodies.boxes_of(some, s.halo.x, s.dim) for s in (scene, one))
    np.testing.assert_array_equal(boxes, expected)
    assert bodies.carrying(np.zeros(0, dtype=np.int32)).size == 0


def check_modes(one, scene):
    found = []
    for s in (one, scene):
        side = BulkHost(s.bulk, s.halo)
        modes = core.RigidModes(s.bodies, side, s.halo.x)
        modes.update(side, s.halo.x)
        owned = np.arange(s.halo.num_owned, dtype=np.int32)
        found.append((modes, s.everywhere(modes.at(owned, s.halo.x))))
    (serial, fields), (modes, ours) = found
    assert np.abs(ours - fields).max() <= 1e-14
    assert modes.count == 2 and modes.any_free
    assert abs(modes.size - serial.size) <= 1e-14
    m = 3 if scene.dim == 2 else 6
    free = [0 if name == one.lower else m for name in one.bodies.names]
    assert [basis.shape[1] for basis in modes.free] == free
    for a, b in zip(modes.free, serial.free, strict=True):
        assert np.abs(a @ a.T - b @ b.T).max() <= 1e-12
    # Halo nodes have modes, too
    scene.see_all()
    every = np.arange(scene.halo.num_nodes, dtype=np.int32)
    seen = modes.at(every, scene.halo.x).reshape(len(every), -1)
    assert np.abs(seen - fields[scene.halo.original]).max(initial=0.0) <= 1e-14


def same(one, scene, run, **options):
    """Whether what holds a block is the same as on one rank; what that is."""
    counts, status, stiffness = run(FreeBlock(one, **options))
    ours = run(FreeBlock(scene, **options))
    assert ours[0] == counts
    np.testing.assert_array_equal(ours[1], status)
    assert np.abs(ours[2] - stiffness).max() <= 1e-12 * max(stiffness.max(), 1e-300)
    return counts, status, stiffness


def check_free_bodies(one, scene):
    dim, both = scene.dim, (one, scene)
    scene.see_all()
    m = 3 if dim == 2 else 6
    along = (0.0,) * (dim - 2)
    # No load: springs alone, as many as modes, and weak
    counts, _, springs = same(*both, lambda b: b.stabilise(0.0, *along, 0.0))
    assert counts == (False, m, 0, 0)
    assert np.count_nonzero(springs) == m and springs.max() < 1e-4
    # Pressed down: nodes close until they balance the load, the first at small x
    counts, status, springs = same(*both, lambda b: b.stabilise(0.0, *along, -1.0))
    assert counts[0] and counts[2] == np.count_nonzero(status == 2) >= dim
    assert counts[1] == np.count_nonzero(springs) == m - (1 + len(along)) - 1
    # All nodes are as near: more close than are needed
    counts, *_ = same(*both, lambda b: b.stabilise(0.0, *along, -1.0, growth=0.0), slope=0.0)
    assert counts[2] == 4 ** (dim - 1)
    # Pulled up: nothing is in the way, and the springs are as stiff as the bulk
    counts, _, springs = same(*both, lambda b: b.stabilise(0.0, *along, 1.0))
    assert counts == (False, m, 0, 1) and springs.max() > 1e-4

    # Slipping nodes stick until they balance a push back
    def pushed(block):
        block.slip()
        return block.stabilise(-0.01, *along, 0.0)

    counts, status, _ = same(*both, pushed, friction=0.3)
    sticking = np.count_nonzero(status == 1)
    assert counts[0] and counts[2] == 0 and 0 < sticking < np.count_nonzero(status >= 0)

    # What they lack to the cone balances this push on the 16 nodes of the block: a spring is enough
    def balanced(block):
        block.slip(aside=0.02)
        return block.stabilise(4 * 0.1 * (0.3 - 0.02) / 16, 0.0, growth=0.0)

    if dim == 2:
        counts, *_ = same(*both, balanced, friction=0.3)
        assert counts == (False, 1, 0, 0)


def check_all():
    # On more ranks than cores all waits take long
    some = PARTITIONS if COMM.size <= 3 else ("pieces", "last")
    for partition in ("slabs", "blocks"):
        nested(COMM, partition)
    for dim, partitions in ((2, some), (3, ["slabs"])):
        for partition in partitions:
            scene = TwoBlocks(COMM, dim, partition)
            for check in (
                check_bodies,
                check_modes,
                check_free_bodies,
                check_errors,
                check_audit,
            ):
                check(alone(dim), scene)
    COMM.Barrier()
    if COMM.rank == 0:
        print("as on one rank")


if __name__ == "__main__":
    check_all()
