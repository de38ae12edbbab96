# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Round surfaces that fit each other, of chords: what is warned of, and in which figures."""

import re

import numpy as np
import pytest

from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.free_rings import RADII, FreeRings

R = RADII[1]
pytestmark = pytest.mark.filterwarnings("ignore:contact 0.*facets are chords")


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
