# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Units, axes, place, direction and numbering do not change what friction does."""

import functools

import numpy as np
import pytest

from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.transforms import Frame, Support, differences, numbered, renumbered, rotation, solve

SLIDING = pytest.mark.parametrize("sliding", ["finite", "small"])
CELLS = pytest.mark.parametrize(
    "cell", [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]
)
# Load on, slide on, a part of the way back
LOADS = (0.5, 1.0, 0.96)
FRICTION = 0.3


@functools.cache
def cap(cell):
    """An upper block with a curved lower face above a wider block; they do not match."""
    gdim = 2 if cell in (CellType.triangle, CellType.quadrilateral) else 3
    data = meshes.blocks(
        cell,
        ((12,) if gdim == 2 else (5, 5)) + (3,),
        ((11,) if gdim == 2 else (6, 6)) + (3,),
        size_lower=(1.6,) * (gdim - 1) + (1.0,),
        shift=(0.263, 0.219)[: gdim - 1],
        gap=0.01,
    )
    x = data.mesh.geometry.x
    upper = x[:, gdim - 1] > 0.005
    for axis, (middle, bend) in enumerate(zip((0.76, 0.73), (0.2, 0.25), strict=True)):
        if axis < gdim - 1:
            rise = bend * (x[upper, axis] - middle) ** 2
            x[upper, gdim - 1] += (1.01 - x[upper, gdim - 1]) * rise
    return numbered(data)


def run(scene, frame=None, sliding="finite"):
    """Press the upper block down and aside."""
    gdim = scene.domain.geometry.dim
    moved = (0.09, -0.08) if gdim == 2 else (0.07, 0.05, -0.08)
    axes = tuple(range(gdim))
    supports = (
        Support((Tag.LOWER_BOTTOM,), axes, (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), axes, moved),
    )
    return solve(scene, supports, frame, sliding=sliding, friction=FRICTION, loads=LOADS)


@functools.cache
def first_answer(cell, sliding, method):
    answer = run(cap(cell), sliding=sliding)
    assert {0, 1, 2} <= set(answer.status)
    return answer


def check(answer, first):
    """The same way to the same answer; returns the largest difference."""
    np.testing.assert_array_equal(answer.status, first.status)
    off = differences(answer, first)
    assert max(off.values()) <= 1e-9, off
    assert answer.closed == first.closed
    assert answer.iterations == first.iterations
    return max(off.values())


@SLIDING
@pytest.mark.parametrize(
    ("method", "length", "modulus"),
    [
        *(("node-to-surface", length, E) for length in (1e-3, 1e3) for E in (1e-6, 1e6)),
        ("surface-to-surface", 1e-3, 1e6),
    ],
    indirect=["method"],
)
def test_units(length, modulus, sliding, method):
    first = first_answer(CellType.tetrahedron, sliding, method)
    frame = Frame(np.eye(3), np.zeros(3), length, modulus)
    off = check(run(cap(CellType.tetrahedron), frame, sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


@SLIDING
def test_axes_permuted(sliding, method):
    first = first_answer(CellType.hexahedron, sliding, method)
    to_yzx = Frame(np.eye(3)[[1, 2, 0]], np.zeros(3))
    off = check(run(cap(CellType.hexahedron), to_yzx, sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


@SLIDING
@CELLS
def test_rotated_and_translated(cell, sliding, method):
    scene, first = cap(cell), first_answer(cell, sliding, method)
    gdim = scene.domain.geometry.dim
    rng = np.random.default_rng(7)
    off = []
    for _ in range(10 if method == "node-to-surface" else 1):
        frame = Frame(rotation(rng, gdim), rng.uniform(-10, 10, gdim))
        off.append(check(run(scene, frame, sliding), first))
    print(f"{first.iterations} iterations, {first.closed}, off by {max(off):.1e}")


@SLIDING
@CELLS
def test_renumbered(cell, sliding, method):
    scene, first = cap(cell), first_answer(cell, sliding, method)
    seeds = range(3 if method == "node-to-surface" else 1)
    off = [check(run(renumbered(scene, seed), None, sliding), first) for seed in seeds]
    print(f"{first.iterations} iterations, off by {max(off):.1e}")
