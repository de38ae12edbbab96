# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Gaps and overlaps of the mesh that count as none: Contact(..., adjust=length)."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.free_rings import FreeRings, lame_pressure
from scenes.problems import make_problem

pytestmark = pytest.mark.usefixtures("method")
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


@pytest.mark.parametrize("sliding", SLIDING)
def test_a_larger_gap_stays(sliding):
    as_it_is, _ = solved(0.02, sliding=sliding)
    adjusted, contact = solved(0.02, sliding=sliding, adjust=0.01)
    np.testing.assert_array_equal(adjusted.u.x.array, as_it_is.u.x.array)
    # From 0.05 together, 0.02 are left before they touch
    assert abs(contact.force[1]) < abs(solved(0.02, sliding=sliding, adjust=0.03)[1].force[1])


@pytest.mark.parametrize("sliding", SLIDING)
@pytest.mark.parametrize("gap", [0.02, -0.02])
def test_interference_comes_on_top(gap, sliding):
    flush, right = solved(0.0, sliding=sliding, offset=0.01)
    blocks, contact = solved(gap, sliding=sliding, offset=0.01, adjust=0.03)
    near = TOLERANCE[sliding]
    np.testing.assert_allclose(blocks.u.x.array, flush.u.x.array, rtol=0, atol=near)
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
def test_a_shrink_fit_of_chords_is_that_of_circles():
    """Pressure of Lame's thick rings, where chords alone would have been five times as much."""
    rings = FreeRings(24, 36, fixed=True, layers=6, adjust=0.05, offset=0.005, friction=0.1)
    rings.problem.solve()
    contact = rings.contact
    mean = np.average(contact.pressure.x.array[contact.slave_nodes], weights=contact.area)
    assert mean == pytest.approx(lame_pressure(0.005), rel=0.03)
    assert contact.pressure.x.array.max() < 1.1 * mean
