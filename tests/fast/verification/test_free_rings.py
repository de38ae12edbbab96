# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whole rings that contact alone keeps in each other, and warnings where they are chords."""

import re
from itertools import product

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.free_rings import RADII, FreeRings, lame_pressure
from scenes.materials import neo_hookean
from story import elasticity

pytestmark = pytest.mark.filterwarnings("ignore:contact 0.*facets are chords")


MORTAR = "surface-to-surface"


def moved(rings):
    """What the rings have moved by, no more than they ask for."""
    return np.abs(rings.u.x.array).max()


@covering(
    **{
        "given,swapped": [("offset", False), ("larger", False), ("larger", True)],
        "sliding,method": BOTH,
    },
    fixed=(True, False),
    n=(31, 63),
    friction=(0.0, 0.3),
)
def test_rings_that_match(given, swapped, sliding, method, fixed, n, friction):
    """The pressure is the same at all nodes."""
    rings = FreeRings(
        n, n, fixed=fixed, swapped=swapped, sliding=sliding, friction=friction, **{given: 0.01}
    )
    rings.problem.solve()
    nodes = rings.contact.discrete.nodes
    # Slip over a ridge is measured along a facet, and friction holds what that turns
    spread = 0.06 if friction > 0 and swapped else 1e-6
    assert rings.problem.report.iterations <= (3 if spread < 0.01 else 6)
    assert nodes.closed.all()
    assert np.ptp(nodes.pressure) <= spread * rings.mean_pressure
    # The polygons have less area
    assert rings.mean_pressure == pytest.approx(lame_pressure(0.01, fixed), rel=0.035)
    assert moved(rings) <= 0.011


@covering(
    **{"sliding,method": BOTH},
    fixed=(True, False),
    shift=((0.0, 0.0), (0.01, 0.0), (0.003, 0.01)),
    material=(elasticity, neo_hookean),
)
def test_rings_that_do_not_match(sliding, method, fixed, shift, material):
    """Also where they start off the middle; how far a ring turns, the corners decide."""
    rings = FreeRings(
        61,
        95,
        fixed=fixed,
        shift=shift,
        material=material,
        larger=0.02,
        layers=4,
        sliding=sliding,
    )
    rings.problem.solve()
    print(rings.problem.report.iterations, rings.mean_pressure / lame_pressure(0.02, fixed))
    assert rings.problem.report.iterations <= 9
    assert rings.mean_pressure == pytest.approx(lame_pressure(0.02, fixed), rel=0.06)
    assert moved(rings) <= 0.3


@covering(
    **{
        "counts,given,shift": product(
            ((63, 63), (63, 95)), ("offset", "larger"), ((0.0, 0.0), (0.01, 0.0))
        )
    },
    method=METHODS,
)
def test_what_is_linear_takes_steps_of_the_active_set_alone(counts, given, shift, method):
    """Both rings may turn together for nothing, and no step must be lost on it."""
    rings = FreeRings(*counts, fixed=False, shift=shift, layers=4, sliding="small", **{given: 0.01})
    rings.problem.solve()
    assert rings.problem.report.iterations <= 4
    assert rings.mean_pressure == pytest.approx(lame_pressure(0.01, False), rel=0.08)


@covering(**{"sliding,method": BOTH}, fixed=(True, False), counts=((31, 31), (31, 47)))
def test_clearance(sliding, method, fixed, counts):
    rings = FreeRings(*counts, fixed=fixed, larger=-0.03, shift=(0.01, 0.002), sliding=sliding)
    rings.problem.solve()
    assert rings.problem.report.iterations == 0
    assert not rings.u.x.array.any() and not rings.contact.force.any()


@covering(**{"sliding,method": BOTH}, fixed=(True, False), counts=((63, 63), (63, 95)))
def test_an_overlap_on_one_side_is_pushed_out(sliding, method, fixed, counts):
    """Neither ring is bent for good where there is room on the other side."""
    rings = FreeRings(*counts, fixed=fixed, shift=(0.01, 0.0), sliding=sliding)
    try:
        rings.problem.solve()
    except cx.ConvergenceError as error:
        # Between polygons that are both free to turn rounding decides which way
        assert not fixed and sliding == "finite"
        assert "nothing holds" in error.reason
        return
    # What the corners of one polygon stand out by over the sides of the other one
    assert rings.mean_pressure <= 0.1 * lame_pressure(0.01, fixed)
    assert moved(rings) <= 0.02


@covering(sliding=SLIDINGS, fixed=(True, False), counts=((24, 24), (24, 36)))
def test_tubes(sliding, fixed, counts):
    rings = FreeRings(
        *counts, fixed=fixed, height=1, layers=2, larger=0.05, sliding=sliding, method=MORTAR
    )
    rings.problem.solve()
    print(rings.problem.report.iterations, rings.mean_pressure)
    nodes = rings.contact.discrete.nodes
    assert rings.problem.report.iterations <= 6
    assert nodes.closed.all() and nodes.pressure.min() > 0.5 * nodes.pressure.max()
    assert moved(rings) <= 0.06


ENDS = "no convergence|no step is short enough|cannot be balanced"


@pytest.mark.parametrize(
    ("turned", "ends"), [(1e-3, ENDS), (0.01, f"{ENDS}|hide a penetration"), (0.1, ENDS)]
)
def test_pairs_far_beyond_their_facets_are_no_solution(turned, ends):
    """A facet for each node, turned by a part of a facet: no place balances their moment.

    Rounding decides whether the iterations or the length of their steps come to an end.
    """
    rings = FreeRings(63, 63, fixed=True, offset=0.01, turned=turned)
    with pytest.raises(cx.ConvergenceError, match=ends):
        rings.problem.solve()
    assert not rings.u.x.array.any()


@pytest.mark.parametrize("turned", [1e-3, 0.01])
def test_a_ring_that_has_run_away_is_no_solution(turned):
    """Rounding decides whether it is seen to have moved, or to have turned."""
    rings = FreeRings(31, 31, fixed=False, offset=0.04, turned=turned, layers=4)
    gone = r"nothing holds has (moved by .* than the size|turned by .* degrees)"
    with pytest.raises(cx.ConvergenceError, match=gone):
        rings.problem.solve()
    assert not rings.u.x.array.any()


@pytest.mark.parametrize("turned", [0.004432, 0.005085, 0.007, 0.0115])
def test_a_ring_that_has_grown_in_a_turn_is_no_solution(turned):
    """Linear strains let the outer one turn until it is too large to be pressed."""
    rings = FreeRings(31, 31, fixed=False, offset=0.04, turned=turned, layers=4)
    with pytest.raises(cx.ConvergenceError, match=r"nothing holds has (turned|moved) by"):
        rings.problem.solve()
    assert not rings.u.x.array.any()


R = RADII[1]


def sagitta(n):
    return R * (1 - np.cos(np.pi / n))


def shrunk(n, n_outer, method="node-to-surface", offset=0.005, **options):
    rings = FreeRings(n, n_outer, fixed=True, method=method, offset=offset, friction=0.1, **options)
    rings.problem.solve()
    return rings.problem.report.audit


def test_chords_are_warned_of_once_with_their_figures():
    rings = FreeRings(24, 36, fixed=True, offset=0.005, friction=0.1)
    with pytest.warns(UserWarning, match=r"chords, up to 0\.0057 off .*errors/chords"):
        rings.problem.solve()
    (warning,) = rings.problem.report.audit.warnings
    assert f"{sagitta(36):.2g}" == "0.0057"
    # Of the nodes every second one is at a node of the other side, the others at the middle
    assert "off by 0.0028 in the mean and by 0.0028 from node to node" in warning
    rings.problem.solve()
    assert not rings.problem.report.audit.warnings
    assert rings.problem.report.audit.chords > 1


def test_means_of_both_sides_count_in_surface_to_surface_contact():
    with pytest.warns(UserWarning) as warned:
        shrunk(24, 36, "surface-to-surface")
    mean = float(re.search(r"off by (\S+) in the mean", str(warned[0].message))[1])
    # Two thirds of the sagittas are the chords' means
    assert mean == pytest.approx(2 / 3 * (sagitta(24) - sagitta(36)), rel=0.06)


def test_chords_that_keep_all_nodes_from_touching_are_warned_of():
    """The interference is less than what chords take away: nothing is pressed."""
    with pytest.warns(UserWarning, match="and keep nodes from touching"):
        assert shrunk(24, 36, "surface-to-surface", offset=0.0005).chords == np.inf


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_finer_chords_and_the_same_on_both_sides_are_not(method, recwarn):
    coarse, fine = (shrunk(n, 3 * n // 2, method, 0.05).chords for n in (48, 96))
    assert fine < 0.7 * coarse
    assert 0 < coarse < 0.25
    # Node to node, gaps are those of circles
    assert shrunk(48, 48, method).chords < 1e-9
    assert shrunk(24, 36, method, smooth=True).chords == 0
    assert not recwarn.list


def test_flat_surfaces_and_their_edges_have_no_chords(recwarn):
    for cell in (CellType.quadrilateral, CellType.tetrahedron):
        blocks = Blocks(cell)
        problem = blocks.problem(blocks.contact())
        problem.solve()
        assert problem.report.audit.chords == 0


def test_chords_of_tubes(recwarn):
    """In space edges across the axis count, and no diagonals."""
    audit = shrunk(24, 36, height=2)
    assert audit.chords == pytest.approx(shrunk(24, 36).chords, rel=0.2)
