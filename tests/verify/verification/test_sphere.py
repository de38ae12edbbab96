# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem: an elastic sphere on an elastic block, linear tetrahedra.

Two independent codes with exact node-to-surface multipliers give the first of the total forces
below; those of surface-to-surface are what contactx has found once.
"""

import hertz_sphere
import numpy as np
import pytest

from scenes import hertz_of, pressure_error
from scenes import hertz_sphere as sphere_with

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
MOST = {0.04: 7, 0.02: 8, 0.01: 9}
# L2 error of the multipliers; by surface-to-surface at h = 0.02 a fifth less
PRESSURE_ERRORS = {
    **{(NODES, h): error for h, error in ((0.04, 0.17), (0.02, 0.13), (0.01, 0.07))},
    **{(FACETS, h): error for h, error in ((0.04, 0.17), (0.02, 0.096), (0.01, 0.07))},
}
# Errors of the recovered pressure, L2 and peak, and the least L2 error of the multipliers
RECOVERED = {
    (NODES, "finite", 0.02): (0.063, 0.022, 0.120),
    (NODES, "small", 0.02): (0.063, 0.022, 0.120),
    (NODES, "finite", 0.01): (0.035, 0.022, 0.060),
    (NODES, "small", 0.01): (0.035, 0.022, 0.060),
    (FACETS, "finite", 0.02): (0.056, 0.020, 0.080),
    (FACETS, "small", 0.02): (0.056, 0.020, 0.080),
    (FACETS, "finite", 0.01): (0.028, 0.005, 0.045),
    (FACETS, "small", 0.01): (0.031, 0.005, 0.045),
}
MU = 0.3


@pytest.mark.parametrize(("method", "sliding", "h"), FORCES, indirect=["method"])
def test_sphere(sliding, h, method):
    problem, contact, F = hertz_sphere.create(h, sliding)
    problem.solve()
    report = problem.report
    force = hertz_sphere.reaction(problem, F)
    error = pressure_error(problem, contact)
    print(
        f"{method} {sliding} h={h}: 4F {force:.7f}, {report.iterations} iterations, "
        f"p_l2 {error:.4f}, gap {np.nanmin(contact.discrete.nodes.gap):.1e}"
    )
    assert force == pytest.approx(FORCES[method, sliding, h], rel=3e-4 if method == NODES else 4e-5)
    assert 4 * contact.force[2] == pytest.approx(force, rel=1e-10)
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-12
    assert report.iterations <= (10 if method == NODES else MOST[h])
    assert error <= PRESSURE_ERRORS[method, h]
    if h < 0.04:
        check_recovered(problem, contact, error, sliding, method, RECOVERED[method, sliding, h])
    assert report.history[-1].pair_changes == 0
    assert report.frozen_pairs == 0
    assert contact.multiplier.min() >= 0
    assert np.linalg.norm(report.imbalance) <= 1e-13 * np.linalg.norm(contact.force)
    # A linear bulk is assembled once, however many iterations there are
    assert problem.assembler.bulk.assemblies == 1
    # Starting from the solution there is nothing to do
    problem.solve()
    assert problem.report.iterations == 0


def check_recovered(problem, contact, raw_l2, sliding, method, bounds):
    """How much better recovered pressures are than multipliers, and what they cost."""
    p, raw = contact.pressure.x.array[contact.slave_nodes], contact.multiplier
    l2 = pressure_error(problem, contact, pressure=p)
    peak, raw_peak = (v.max() / hertz_of(contact).peak_pressure - 1 for v in (p, raw))
    (change,) = problem.report.recovery
    print(
        f"p_l2 {raw_l2:.4f} -> {l2:.4f}, peak {raw_peak:+.4f} -> {peak:+.4f}, "
        f"force changed by {change:.1e}"
    )
    most, most_peak, least_raw = bounds
    assert l2 <= most
    assert abs(peak) <= most_peak
    assert raw_l2 >= least_raw
    assert contact.area @ p == pytest.approx(contact.area @ raw, rel=1e-13)
    # Only the direction of normals that turn from node to node changes the force
    assert change <= (1e-15 if sliding == "small" and method == NODES else 1e-3)
    assert f"which changes it by {change:.1e}" in " ".join(str(problem.report).split())


@pytest.mark.parametrize("method", [NODES, FACETS])
def test_recovered_traction_with_friction(method):
    problem, contact = sphere_with(0.04, "finite", method=method, friction=MU)
    problem.solve()
    nodes = contact.discrete.nodes
    p = contact.pressure.x.array[contact.slave_nodes]
    traction = contact.traction.x.array.reshape(-1, 3)[contact.slave_nodes]
    t = traction - p[:, None] * nodes.normal
    size = np.linalg.norm(t, axis=1)
    assert np.einsum("ij,ij->i", traction, nodes.normal) == pytest.approx(p, abs=1e-15)
    assert np.all(size <= MU * p + 1e-12 * p.max())
    assert np.all((p > 0) == nodes.closed)
    assert not traction[~nodes.closed].any()
    raw = contact.multiplier - nodes.pressure[:, None] * nodes.normal
    assert np.abs(t - raw).max() > 0.01 * size.max() > 0
    change = np.linalg.norm((contact.area[:, None] * traction).sum(axis=0) - contact.force)
    assert change <= 2e-3 * contact.force[2]
