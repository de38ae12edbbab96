# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rates of convergence in h against exact solutions; the benchmark has finer meshes and 3D."""

import numpy as np
import pytest

from scenes import exact, exact_blocks
from story import METHODS

MORTAR = "surface-to-surface"


def rates(solve, cells, method):
    """Errors on the finer of two meshes, and rates between them."""
    coarse, fine = (solve(cells, n, method) for n in (24, 48))
    found = {key: np.log2(coarse[key] / fine[key]) for key in ("H1", "L2", "raw", "best")}
    print(solve.__name__, cells, method, {key: f"{rate:.2f}" for key, rate in found.items()})
    return fine, found


@pytest.mark.parametrize("cells", ["triangle", "quadrilateral"])
@pytest.mark.parametrize("method", METHODS)
def test_smooth_solution(method, cells):
    """Linear elements; a pressure by dual multipliers converges at least as h."""
    fine, rate = rates(exact_blocks.smooth, cells, method)
    assert rate["H1"] > 0.97 and rate["L2"] > 1.9
    if method == MORTAR:
        assert rate["raw"] > 1 and rate["best"] > 1
        assert fine["raw"] < 0.01
    else:
        # Nodes that do not match: swings of two per cent stay, which recovery takes out
        assert 0.01 < fine["raw"] < 0.03
        assert rate["best"] > 1 and fine["best"] < 0.01


@pytest.mark.parametrize("cells", ["triangle", "quadrilateral"])
@pytest.mark.parametrize("method", METHODS)
def test_hertz(method, cells):
    """The end of the contact takes up to half a power of the displacement's error in L2."""
    fine, rate = rates(exact_blocks.hertz, cells, method)
    assert rate["H1"] > 0.95 and rate["L2"] > 1.5
    if method == MORTAR:
        assert rate["raw"] > 0.85 and rate["best"] > 0.85
        assert fine["raw"] < 0.02


@pytest.mark.parametrize("cells", ["triangle", "quadrilateral"])
@pytest.mark.parametrize("tied", [False, True])
def test_quadratic_displacements(cells, tied):
    """Surface to surface: what theory gives, h^2 and h^3; the pressure as h^2 at nodes."""
    coarse, fine = (exact_blocks.smooth(cells, n, MORTAR, degree=2, tied=tied) for n in (12, 24))
    rate = {key: np.log2(coarse[key] / fine[key]) for key in ("H1", "L2", "raw", "field")}
    assert rate["H1"] > 1.95 and rate["L2"] > 2.9
    assert rate["raw"] > 1.9 and rate["field"] > 1.45


@pytest.mark.parametrize("cells", ["tetrahedron", "hexahedron"])
@pytest.mark.parametrize("tied", [False, True])
def test_quadratic_displacements_in_space(cells, tied):
    coarse, fine = (exact_blocks.smooth(cells, n, MORTAR, degree=2, tied=tied) for n in (3, 6))
    rate = {key: np.log2(coarse[key] / fine[key]) for key in ("H1", "L2")}
    assert rate["H1"] > 1.9 and rate["L2"] > 2.8


@pytest.mark.parametrize("cells", ["triangle", "quadrilateral"])
def test_hertz_by_quadratic_displacements(cells):
    """The mean over several places of the contact: what a facet at its end errs by varies."""

    def error(n):
        found = [
            exact_blocks.hertz(cells, n, MORTAR, degree=2, middle=exact.MIDDLE + place / 73)
            for place in range(6)
        ]
        return float(np.sqrt(np.mean([f["field"] ** 2 for f in found])))

    assert np.log(error(12) / error(48)) / np.log(4) > 0.9


def test_in_space():
    """On hexahedra, which do not match along both directions."""
    coarse, fine = (exact_blocks.smooth("hexahedron", n, MORTAR) for n in (6, 12))
    rate = {key: np.log2(coarse[key] / fine[key]) for key in ("H1", "L2", "raw")}
    print(rate)
    assert rate["H1"] > 1 and rate["L2"] > 1.9 and rate["raw"] > 1.3
