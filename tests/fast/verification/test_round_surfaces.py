# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Round surfaces of chords that stay round, and gaps and overlaps of the mesh that count as none.

Contact(..., smooth=True) and Contact(..., adjust=length)
"""

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.free_rings import FreeRings, lame_pressure, pulled
from scenes.problems import make_problem

pytestmark = pytest.mark.usefixtures("method")


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("n,n_outer", [(24, 36), (63, 95)])
def test_a_perfect_fit_of_chords_is_one(n, n_outer, swapped):
    """Chords of 24 and 36 are up to 0.9 % of the radius off the circle, on either side."""
    rings = FreeRings(n, n_outer, fixed=True, swapped=swapped, smooth=True, friction=0.1)
    rings.problem.solve()
    sagitta = 1.5 * (1 - np.cos(np.pi / n))
    assert np.abs(rings.u.x.array).max() < 0.003 * sagitta


@pytest.mark.parametrize("turned", [0.0, 0.3])
def test_nothing_has_slipped_where_nothing_has_moved(turned):
    """Facets are projected along their normals, and slip is across those of patches."""
    rings = FreeRings(60, 36, fixed=True, turned=turned, smooth=True, adjust=0.02, friction=0.1)
    rings.problem.solve()
    assert np.abs(rings.u.x.array).max() < 1e-12


@pytest.mark.parametrize("turned", [0.0, 0.3])
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("height", [0, 2])
def test_a_shrink_fit_of_chords_is_that_of_circles(height, swapped, turned):
    """Pressure of Lame's thick rings, in plane strain; short tubes are but near to it."""
    interference = 0.005
    rings = FreeRings(
        24,
        36,
        fixed=True,
        layers=6 if height == 0 else 3,
        height=height,
        swapped=swapped,
        turned=turned,
        smooth=True,
        offset=interference,
        friction=0.1,
    )
    rings.problem.solve()
    pressure = lame_pressure(interference)
    assert rings.mean_pressure == pytest.approx(pressure, rel=0.02 if height == 0 else 0.15)
    # By chords as they are it would be from zero to five times the mean
    recovered = rings.contact.pressure.x.array
    closed = rings.contact.status.x.array > 0
    assert np.abs(recovered[closed] / rings.mean_pressure - 1).max() < 0.01
    assert rings.contact.discrete.nodes.closed.all()


def loaded(n, n_outer):
    """Pressures of an inner ring that is pulled to one side."""
    rings = FreeRings(
        n, n_outer, fixed=True, friction=0.05, smooth=True, adjust=0.02, material=pulled
    )
    rings.problem.solve()
    return rings.contact.discrete.nodes.pressure


def test_a_ring_that_is_pulled_aside_in_a_perfect_fit():
    """Coarse chords that do not match, next to fine ones that do."""
    fine, coarse = loaded(192, 192), loaded(48, 80)
    assert coarse.max() == pytest.approx(fine.max(), rel=0.08)
    assert (coarse > 0).mean() == pytest.approx((fine > 0).mean(), abs=0.06)


@pytest.mark.parametrize("options,why", [({"tied": True}, "ties"), ({}, "obstacle")])
def test_what_it_is_not_for(options, why):
    blocks = Blocks(CellType.quadrilateral)
    contact = blocks.contact(smooth=True, **options)
    if not options:
        contact = cx.Contact(contact.slave, cx.Plane([0, 0], [0, 1]), smooth=True)
    with pytest.raises(ValueError, match=f"smooth .*{why}"):
        make_problem(blocks.F, blocks.u, [contact], blocks.bcs)


SLIDING = ["finite", "small"]
# In finite sliding forces turn with the surfaces, and act across what is between them
TOLERANCE = {"small": 1e-9, "finite": 2e-4}


def solved(gap, *, sliding="finite", cell=CellType.quadrilateral, **options):
    """Blocks that are so far apart and move towards each other by 0.05, and their contact."""
    blocks = Blocks(cell, gap=gap)
    contact = blocks.contact(sliding, **options)
    make_problem(blocks.F, blocks.u, [contact], blocks.bcs).solve()
    return blocks, contact


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.tetrahedron])
@pytest.mark.parametrize("sliding", SLIDING)
@pytest.mark.parametrize("gap", [0.02, -0.02])
def test_bodies_apart_or_overlapping_are_as_if_they_touched(gap, sliding, cell):
    flush, right = solved(0.0, sliding=sliding, cell=cell)
    blocks, contact = solved(gap, sliding=sliding, cell=cell, adjust=0.03)
    near = TOLERANCE[sliding]
    np.testing.assert_allclose(blocks.u.x.array, flush.u.x.array, rtol=0, atol=near)
    np.testing.assert_allclose(contact.multiplier, right.multiplier, rtol=0, atol=20 * near)
    np.testing.assert_allclose(contact.force, right.force, rtol=near, atol=2 * near)


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("n,n_outer", [(24, 36), (63, 95)])
def test_chords_of_a_perfect_fit_put_no_strain_on_it(n, n_outer, swapped):
    """Chords of 24 and 36 are up to 0.9 % of the radius off the circle, on either side."""
    rings = FreeRings(n, n_outer, fixed=True, swapped=swapped, adjust=0.02)
    rings.problem.solve()
    assert np.abs(rings.u.x.array).max() < 1e-12
    assert np.abs(rings.contact.multiplier).max() < 1e-12


@pytest.mark.filterwarnings("ignore:contact 0.*facets are chords")
def test_an_adjusted_shrink_fit_of_chords_is_that_of_circles():
    """Pressure of Lame's thick rings, where chords alone would have been five times as much."""
    rings = FreeRings(24, 36, fixed=True, layers=6, adjust=0.05, offset=0.005, friction=0.1)
    rings.problem.solve()
    contact = rings.contact
    mean = np.average(contact.pressure.x.array[contact.slave_nodes], weights=contact.area)
    assert mean == pytest.approx(lame_pressure(0.005), rel=0.03)
    assert contact.pressure.x.array.max() < 1.1 * mean
