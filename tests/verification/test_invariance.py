# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Units, axes, place, direction and numbering change neither the answer nor the way to it."""

import functools

import numpy as np
import pytest
from scene_transforms import Frame, Support, differences, numbered, renumbered, rotation, solve

from contactx import meshes
from contactx.meshes import Tag
from dolfinx.mesh import CellType

SLIDING = pytest.mark.parametrize("sliding", ["finite", "small"])
CELLS = pytest.mark.parametrize(
    "cell", [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]
)

HERTZ = (
    Support((Tag.UPPER_X0, Tag.LOWER_X0), (0,), (0.0,)),
    Support((Tag.UPPER_Y0, Tag.LOWER_Y0), (1,), (0.0,)),
    Support((Tag.LOWER_BOTTOM,), (0, 1, 2), (0.0, 0.0, 0.0)),
    Support((Tag.UPPER_TOP,), (2,), (-0.02,)),
)


@functools.cache
def hertz():
    return numbered(meshes.hertz_sphere(0.04))


@functools.cache
def hertz_answer(sliding):
    return solve(hertz(), HERTZ, sliding=sliding)


@functools.cache
def cap(cell):
    """An upper block with a curved lower face above a wider block; they do not match.

    The cap is no symmetric one and stands where no node of it is on an edge of the lower block.
    """
    gdim = 2 if cell in (CellType.triangle, CellType.quadrilateral) else 3
    data = meshes.blocks(
        cell,
        ((16,) if gdim == 2 else (6, 6)) + (4,),
        ((13,) if gdim == 2 else (7, 7)) + (4,),
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


def cap_supports(gdim):
    """The lower block stands; the upper one is pressed down and aside."""
    moved = (0.03, -0.08) if gdim == 2 else (0.03, 0.02, -0.08)
    axes = tuple(range(gdim))
    return (
        Support((Tag.LOWER_BOTTOM,), axes, (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), axes, moved),
    )


@functools.cache
def cap_answer(cell, sliding):
    scene = cap(cell)
    return solve(scene, cap_supports(scene.domain.geometry.dim), sliding=sliding)


def check(answer, first, tolerance=1e-9):
    """The same way to the same answer; returns the largest difference."""
    assert answer.iterations == first.iterations
    assert answer.closed == first.closed
    np.testing.assert_array_equal(answer.status, first.status)
    return check_answer(answer, first, tolerance)


def check_answer(answer, first, tolerance=1e-9):
    off = differences(answer, first)
    assert max(off.values()) <= tolerance, off
    return max(off.values())


@SLIDING
@pytest.mark.parametrize("length", [1e-3, 1e3])
@pytest.mark.parametrize("modulus", [1e-6, 1e6])
def test_units(length, modulus, sliding):
    first = hertz_answer(sliding)
    frame = Frame(np.eye(3), np.zeros(3), length, modulus)
    off = check(solve(hertz(), HERTZ, frame, sliding=sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


@SLIDING
def test_axes_permuted(sliding):
    first = hertz_answer(sliding)
    to_yzx = Frame(np.eye(3)[[1, 2, 0]], np.zeros(3))
    off = check(solve(hertz(), HERTZ, to_yzx, sliding=sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


@SLIDING
@CELLS
def test_rotated_and_translated(cell, sliding):
    scene, first = cap(cell), cap_answer(cell, sliding)
    gdim = scene.domain.geometry.dim
    rng = np.random.default_rng(7)
    off = []
    for _ in range(10):
        frame = Frame(rotation(rng, gdim), rng.uniform(-10, 10, gdim))
        off.append(check(solve(scene, cap_supports(gdim), frame, sliding=sliding), first))
    print(f"{first.iterations} iterations, {first.closed}, off by {max(off):.1e}")


@SLIDING
@CELLS
def test_reflected(cell, sliding):
    scene, first = cap(cell), cap_answer(cell, sliding)
    gdim = scene.domain.geometry.dim
    mirror = np.eye(gdim)
    mirror[0, 0] = -1
    frame = Frame(mirror @ rotation(np.random.default_rng(8), gdim), np.zeros(gdim))
    off = check(solve(scene, cap_supports(gdim), frame, sliding=sliding), first)
    print(f"off by {off:.1e}")


@SLIDING
@CELLS
def test_renumbered(cell, sliding):
    scene, first = cap(cell), cap_answer(cell, sliding)
    gdim = scene.domain.geometry.dim
    off = []
    for seed in range(3):
        other = renumbered(scene, seed)
        off.append(check(solve(other, cap_supports(gdim), sliding=sliding), first))
    print(f"off by {max(off):.1e}")


@SLIDING
def test_renumbered_hertz(sliding):
    """The sphere touches the block in nodes of both, so that its first gap is a tie."""
    first = hertz_answer(sliding)
    off = check(solve(renumbered(hertz(), 1), HERTZ, sliding=sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")
