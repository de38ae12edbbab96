# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How much better recovered pressures are than multipliers, and what they cost."""

import numpy as np
import pytest

from scenes import hertz_of, hertz_sphere, pressure_error

NODES, FACETS = "node-to-surface", "surface-to-surface"
MU = 0.3
# Errors of the recovered pressure, L2 and peak, and the L2 error of the multipliers
HERTZ = {
    (NODES, "finite", 0.02): (0.063, 0.022, 0.120),
    (NODES, "finite", 0.01): (0.035, 0.022, 0.060),
    (NODES, "small", 0.01): (0.035, 0.022, 0.060),
    (FACETS, "finite", 0.02): (0.056, 0.020, 0.080),
    (FACETS, "finite", 0.01): (0.028, 0.005, 0.045),
    (FACETS, "small", 0.01): (0.031, 0.005, 0.045),
}


@pytest.mark.parametrize(("method", "sliding", "h"), HERTZ)
def test_hertz(method, sliding, h):
    problem, contact = hertz_sphere(h, sliding, method=method)
    problem.solve()
    p, raw = contact.pressure.x.array[contact.slave_nodes], contact.multiplier
    l2, raw_l2 = (pressure_error(problem, contact, pressure=v) for v in (p, raw))
    peak, raw_peak = (v.max() / hertz_of(contact).peak_pressure - 1 for v in (p, raw))
    (change,) = problem.report.recovery
    print(
        f"{method}, {sliding}, h = {h}: p_l2 {raw_l2:.4f} -> {l2:.4f}, peak {raw_peak:+.4f} -> "
        f"{peak:+.4f}, force changed by {change:.1e}"
    )
    most, most_peak, least_raw = HERTZ[method, sliding, h]
    assert l2 <= most
    assert abs(peak) <= most_peak
    assert raw_l2 >= least_raw
    assert contact.area @ p == pytest.approx(contact.area @ raw, rel=1e-13)
    # Only the direction of normals that turn from node to node changes the force
    assert change <= (1e-15 if sliding == "small" and method == NODES else 1e-3)
    assert f"which changes it by {change:.1e}" in " ".join(str(problem.report).split())


@pytest.mark.parametrize("method", [NODES, FACETS])
def test_friction(method):
    problem, contact = hertz_sphere(0.04, "finite", method=method, friction=MU)
    problem.solve()
    nodes = contact.interface.nodes
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
