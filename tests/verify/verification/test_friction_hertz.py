# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem with friction, in one step from a cold start."""

import numpy as np
import pytest

from meshes import Tag
from scenes import hertz_sphere
from scenes.coulomb import check_coulomb, parts
from scenes.covering import METHODS, SLIDINGS, covering

NODES, FACETS = "node-to-surface", "surface-to-surface"
# By surface-to-surface on a coarser mesh, which is cheaper
H = {NODES: 0.02, FACETS: 0.04}


def solve(sliding, method, friction, h=None, **options):
    problem, contact = hertz_sphere(h or H[method], sliding, friction=friction, **options)
    problem.solve()
    report = problem.report
    nodes = contact.discrete.nodes
    tolerance = report.history[-1].tolerance
    inside = nodes.mobile.all(axis=1)
    count = check_coulomb(contact, tolerance, inside)
    # In a plane of symmetry facets lean out of it in finite sliding, the node cannot: its
    # conditions mix by that angle
    p, t = parts(contact)
    edge = nodes.closed & ~inside
    worst = np.abs(nodes.gap[edge]).max()
    if sliding == "small":
        check_coulomb(contact, tolerance)
    assert worst <= 1e-7
    bound = friction * p[edge] * (1 + 1e-4) + tolerance / nodes.area[edge]
    assert np.all(np.linalg.norm(t[edge], axis=1) <= bound)
    force = 4 * contact.force[2]
    print(f"{report.iterations} iterations, {count}, 4F {force:.7f}, edge gap {worst:.1e}")
    assert report.frozen_pairs == 0
    assert np.linalg.norm(report.imbalance) <= 1e-12 * np.linalg.norm(contact.force)
    return report.iterations, contact, count


@pytest.mark.parametrize(
    ("method", "friction", "sliding"),
    [
        (NODES, 0.01, "finite"),
        (NODES, 0.3, "finite"),
        (NODES, 0.3, "small"),
        (NODES, 1.5, "small"),
        (NODES, 10.0, "finite"),
        (FACETS, 0.3, "small"),
        (FACETS, 10.0, "finite"),
    ],
    indirect=["method"],
)
def test_equal_bodies(friction, sliding, method):
    """Sphere and block of one material all but stick: their surfaces move together."""
    iterations, contact, _ = solve(sliding, method, friction)
    assert iterations <= 12
    # What friction adds to the normal force is small
    force = 0.00237 if method == NODES else 0.00243
    assert 4 * contact.force[2] == pytest.approx(force, rel=0.02)


@covering(friction=(0.5, 1.5), body=(Tag.UPPER, Tag.LOWER), sliding=SLIDINGS, method=METHODS)
def test_one_body_is_much_stiffer(friction, body, sliding, method):
    iterations, contact, count = solve(sliding, method, friction, young={body: 1e6})
    assert iterations <= (13 if friction < 1 else 25)
    assert count["stick"] > 0
    p, t = parts(contact)
    # The soft surface wants to flow out from under the stiff one, or in
    assert np.linalg.norm(t, axis=1).max() > 0.05 * p.max()


@pytest.mark.parametrize(
    ("method", "sliding"),
    [(NODES, "finite"), (NODES, "small"), (FACETS, "small")],
    indirect=["method"],
)
def test_stick_grows_with_friction(sliding, method):
    """A soft sphere on a stiff block: a ring slips around a core that sticks."""
    shares = []
    # By surface-to-surface only the pole sticks up to 0.1
    for friction in (0.02, 0.1, 0.3) if method == NODES else (0.1, 0.2, 0.3):
        iterations, _, count = solve(sliding, method, friction, 0.02, young={Tag.LOWER: 1e6})
        shares.append(count["stick"] / (count["stick"] + count["slip"]))
        assert iterations <= 12
    assert np.all(np.diff(shares) > 0)
