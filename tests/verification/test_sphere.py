# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem: an elastic sphere on an elastic block, linear tetrahedra.

Two independent codes with exact node-to-surface multipliers give the first of the total forces
below; those of surface-to-surface are what contactx has found once.
"""

import hertz_sphere
import numpy as np
import pytest

from scenes import pressure_error

NODES, FACETS = "node-to-surface", "surface-to-surface"
FORCES = {
    (NODES, "finite", 0.04): 0.0024350,
    (NODES, "finite", 0.02): 0.0023729,
    (NODES, "finite", 0.01): 0.0023524,
    (NODES, "small", 0.04): 0.0024371,
    (NODES, "small", 0.02): 0.0023736,
    (NODES, "small", 0.01): 0.0023530,
    (FACETS, "finite", 0.04): 0.0024260,
    (FACETS, "finite", 0.02): 0.0023711,
    (FACETS, "finite", 0.01): 0.0023514,
    (FACETS, "small", 0.04): 0.0024258,
    (FACETS, "small", 0.02): 0.0023709,
    (FACETS, "small", 0.01): 0.0023514,
}
# Iterations of surface-to-surface
MOST = {0.04: 7, 0.02: 8, 0.01: 8}
PRESSURE_ERRORS = {0.04: 0.17, 0.02: 0.13, 0.01: 0.07}


@pytest.mark.parametrize(("method", "sliding", "h"), FORCES, indirect=["method"])
def test_sphere(sliding, h, method):
    problem, contact, F = hertz_sphere.create(h, sliding)
    problem.solve()
    report = problem.report
    force = hertz_sphere.reaction(problem, F)
    error = pressure_error(problem, contact)
    print(
        f"{method} {sliding} h={h}: 4F {force:.7f}, {report.iterations} iterations, "
        f"p_l2 {error:.4f}, gap {np.nanmin(contact.interface.nodes.gap):.1e}"
    )
    assert force == pytest.approx(FORCES[method, sliding, h], rel=3e-4 if method == NODES else 4e-5)
    assert 4 * contact.force[2] == pytest.approx(force, rel=1e-10)
    assert np.nanmin(contact.interface.nodes.gap) > -1e-12
    assert report.iterations <= (10 if method == NODES else MOST[h])
    assert error <= PRESSURE_ERRORS[h]
    assert report.history[-1].pair_changes == 0
    assert report.frozen_pairs == 0
    assert contact.multiplier.min() >= 0
    assert np.linalg.norm(report.imbalance) <= 1e-13 * np.linalg.norm(contact.force)
    # A linear bulk is assembled once, however many iterations there are
    assert problem._bulk.assemblies == 1
    # Starting from the solution there is nothing to do
    problem.solve()
    assert problem.report.iterations == 0
