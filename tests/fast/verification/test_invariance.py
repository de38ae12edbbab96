# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Units, axes, place, direction and numbering change neither the answer nor the way to it."""

import functools

import numpy as np
import pytest

import meshes
from meshes import Tag
from scenes import CELLS, dimension
from scenes.covering import covering
from scenes.transforms import (
    Frame,
    Support,
    differences,
    jacobians,
    numbered,
    oriented,
    renumbered,
    rotation,
    solve,
)

TRIANGLE, QUADRILATERAL, TETRAHEDRON, HEXAHEDRON = CELLS
NODES, FACETS = "node-to-surface", "surface-to-surface"
FRICTION = 0.3
# All three of these with one another, and each cell with each value of them
CASES = [
    (TRIANGLE, 0.0, NODES, "finite"),
    (TRIANGLE, FRICTION, FACETS, "small"),
    (QUADRILATERAL, FRICTION, NODES, "finite"),
    (QUADRILATERAL, 0.0, FACETS, "small"),
    (TETRAHEDRON, FRICTION, NODES, "small"),
    (TETRAHEDRON, 0.0, FACETS, "finite"),
    (HEXAHEDRON, 0.0, NODES, "small"),
    (HEXAHEDRON, FRICTION, FACETS, "finite"),
]


def every(cases):
    """Run a test of the cap on each case."""
    ids = [
        f"{cell.name}-{friction}-{method}-{sliding}" for cell, friction, method, sliding in cases
    ]
    names = ("cell", "friction", "method", "sliding")
    return pytest.mark.parametrize(names, cases, ids=ids, indirect=["method"])


@functools.cache
def cap(cell):
    """An upper block with a curved lower face above a wider block; they do not match.

    The cap is no symmetric one and stands where no node of it is on an edge of the lower block.
    """
    gdim = dimension(cell)
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


def run(scene, friction, sliding, frame=None):
    """Press the upper block down and aside; with friction a part of the way back, too."""
    gdim = scene.domain.geometry.dim
    moved = (0.09, -0.08) if gdim == 2 else (0.07, 0.05, -0.08)
    axes = tuple(range(gdim))
    supports = (
        Support((Tag.LOWER_BOTTOM,), axes, (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), axes, moved),
    )
    loads = (0.5, 1.0, 0.96) if friction else (1.0,)
    return solve(scene, supports, frame, sliding=sliding, friction=friction, loads=loads)


@functools.cache
def first_answer(cell, friction, method, sliding):
    answer = run(cap(cell), friction, sliding)
    assert set(answer.status) == ({-1, 0, 1, 2} if friction else {-1, 0, 2})
    return answer


def check(answer, first, tolerance=1e-9):
    """The same way to the same answer; returns the largest difference."""
    assert answer.iterations == first.iterations
    assert answer.closed == first.closed
    return check_answer(answer, first, tolerance)


def check_answer(answer, first, tolerance=1e-9):
    """The same answer, and the same statuses."""
    np.testing.assert_array_equal(answer.status, first.status)
    off = differences(answer, first)
    assert max(off.values()) <= tolerance, off
    return max(off.values())


@every(CASES[4:])
def test_units(cell, friction, method, sliding):
    first = first_answer(cell, friction, method, sliding)
    for length, modulus in ((1e-3, 1e6), (1e3, 1e-6)):
        frame = Frame(np.eye(3), np.zeros(3), length, modulus)
        off = check(run(cap(cell), friction, sliding, frame), first)
        print(f"{first.iterations} iterations, off by {off:.1e}")


@every(CASES)
def test_rotated_translated_and_reflected(cell, friction, method, sliding):
    first, gdim = first_answer(cell, friction, method, sliding), dimension(cell)
    rng = np.random.default_rng(7)
    frames = [Frame(rotation(rng, gdim), rng.uniform(-10, 10, gdim)) for _ in range(2)]
    mirror = np.diag([-1.0, *np.ones(gdim - 1)])
    frames.append(Frame(mirror @ rotation(rng, gdim), np.zeros(gdim)))
    off = [check(run(cap(cell), friction, sliding, frame), first) for frame in frames]
    print(f"{first.iterations} iterations, {first.closed}, off by {max(off):.1e}")


@every(CASES)
def test_renumbered(cell, friction, method, sliding):
    first = first_answer(cell, friction, method, sliding)
    off = check(run(renumbered(cap(cell), 0), friction, sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


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
def hertz_answer(sliding, method):
    return solve(hertz(), HERTZ, sliding=sliding)


@covering(method=(NODES, FACETS), sliding=("finite", "small"))
def test_axes_permuted(sliding, method):
    """Slave nodes lie on planes of symmetry, which constrain one axis each."""
    first = hertz_answer(sliding, method)
    to_yzx = Frame(np.eye(3)[[1, 2, 0]], np.zeros(3), 1e-3, 1e6)
    off = check(solve(hertz(), HERTZ, to_yzx, sliding=sliding), first)
    print(f"{first.iterations} iterations, off by {off:.1e}")


@pytest.mark.parametrize(
    ("method", "sliding", "seed"),
    [(NODES, "finite", 1), (NODES, "small", 2), (FACETS, "finite", 1)],
    indirect=["method"],
)
def test_renumbered_hertz(seed, sliding, method):
    """The sphere's lowest node is on the block's corner node, where facets meet.

    Which of them it has is a tie. The dented corner makes their normals differ, and so the force
    that the supports in the planes of symmetry take; the displacement does not notice.
    """
    first, answer = (
        hertz_answer(sliding, method),
        solve(renumbered(hertz(), seed), HERTZ, sliding=sliding),
    )
    assert answer.iterations == first.iterations
    # Rounding decides whether the first gap of the lowest node is below zero
    assert answer.closed[1:] == first.closed[1:]
    np.testing.assert_array_equal(answer.status, first.status)
    off = differences(answer, first)
    print(f"{first.iterations} iterations, off by {off}")
    assert off["u"] <= 1e-9
    assert answer.force[2] == pytest.approx(first.force[2], rel=1e-9)
    tip = np.all(np.abs(hertz().x) < 1e-12, axis=1)
    p = first.pressure.max()
    np.testing.assert_allclose(answer.pressure[~tip], first.pressure[~tip], rtol=0, atol=1e-9 * p)
    one = 1e-9 if sliding == "small" else 1e-4
    np.testing.assert_allclose(answer.pressure[tip], first.pressure[tip], rtol=0, atol=one * p)


def touching(cell, n_lower, size, shift):
    """Flat blocks that touch: the sign of every first gap is left to rounding."""
    gdim = dimension(cell)
    return numbered(
        meshes.blocks(
            cell,
            (3,) * gdim,
            (n_lower,) * gdim,
            size_lower=(size,) * (gdim - 1) + (1.0,),
            shift=(shift,) * (gdim - 1),
        )
    )


def answers_of_ties(scene, sliding):
    """A first answer, and those of the scene turned and renumbered."""
    gdim = scene.domain.geometry.dim
    axes = tuple(range(gdim))
    supports = (
        Support((Tag.LOWER_BOTTOM,), axes, (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), axes, (0.0,) * (gdim - 1) + (-0.05,)),
    )
    first = solve(scene, supports, sliding=sliding)
    rng = np.random.default_rng(3)
    turned = Frame(rotation(rng, gdim), rng.uniform(-10, 10, gdim))
    return first, [
        solve(scene, supports, turned, sliding=sliding),
        solve(renumbered(scene, 0), supports, sliding=sliding),
    ]


@covering(cell=CELLS, method=(NODES, FACETS), sliding=("finite", "small"))
def test_first_gaps_are_ties(cell, sliding, method):
    """All nodes that touch but for rounding start closed."""
    first, others = answers_of_ties(touching(cell, 5, 1.5, 0.23), sliding)
    off = [check_answer(answer, first) for answer in others]
    iterations = {answer.iterations for answer in (first, *others)}
    starts = {answer.closed[0] for answer in (first, *others)}
    print(f"{iterations} iterations from {starts} closed nodes, off by {max(off):.1e}")
    assert len(starts) == len(iterations) == 1


@covering(cell=CELLS, method=(NODES, FACETS), sliding=("finite", "small"))
def test_nodes_on_nodes(cell, sliding, method):
    """Pairs are ties: a slave node on a master's node may have any of the facets there.

    They lie in one plane at first. In finite sliding they bend, and the node goes on with the
    normal of the facet that rounding gave it: the answers differ as far as these normals do.
    """
    first, others = answers_of_ties(touching(cell, 3, 1.0, 0.0), sliding)
    off = [differences(answer, first) for answer in others]
    print({name: f"{max(d[name] for d in off):.1e}" for name in off[0]})
    for answer, d in zip(others, off, strict=True):
        np.testing.assert_array_equal(answer.status, first.status)
        assert answer.force[-1] == pytest.approx(first.force[-1], rel=1e-3)
        assert max(d["u"], d["pressure"]) <= (1e-9 if sliding == "small" else 0.05)
        if sliding == "small":
            assert d["force"] <= 1e-9


@pytest.mark.parametrize("sliding", ["finite", "small"])
@pytest.mark.parametrize(
    "cell",
    CELLS,
    ids=lambda c: c.name,
)
def test_inverted_cells_have_the_same_contact(cell, sliding):
    """Facets point outward by where their cells are, whatever the order of nodes."""
    gdim = dimension(cell)
    first = numbered(
        meshes.blocks(
            cell,
            (3,) * gdim,
            (4,) * gdim,
            size_lower=(1.5,) * (gdim - 1) + (1.0,),
            shift=(0.217, 0.243)[: gdim - 1],
            gap=0.01,
        )
    )
    supports = (
        Support((Tag.LOWER_BOTTOM,), tuple(range(gdim)), (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), tuple(range(gdim)), (0.0,) * (gdim - 1) + (-0.06,)),
    )
    answer = {}
    for sign in (1, -1):
        scene = oriented(first, sign)
        assert np.all(jacobians(scene) == sign)
        answer[sign] = solve(scene, supports, sliding=sliding)
    assert (answer[1].pressure > 0).sum() > 3
    assert answer[-1].iterations == answer[1].iterations
    np.testing.assert_array_equal(answer[-1].status, answer[1].status)
    off = differences(answer[-1], answer[1])
    print(off)
    assert max(off.values()) <= 1e-9
