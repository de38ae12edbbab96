# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A stiff round die dragged over a soft block: forces of both methods and how they swing."""

import pytest
from ironing import FRICTIONS, WAY, Ironing

from story import METHODS

# Largest deviation from a cubic along the drag over the mean vertical force, by dimension
BANDS = {2: (0.03, 0.015), 3: (0.05, 0.02)}


def iron(h, dim, friction, method, slave):
    run = Ironing(h, dim, friction, method, slave)
    run.run()
    along, down = run.means()
    swings = [run.swing(component) / down for component in (0, -1)]
    print(
        f"{dim}D mu {friction} {method} {slave}: {len(run.iterations)} steps, "
        f"{max(run.iterations)} iterations, down {down:.5f}, along {along:+.5f}, swings {swings}"
    )
    assert run.frozen_steps == 0
    assert max(swings) < BANDS[dim][METHODS.index(method)]
    assert max(run.iterations) <= 12
    assert run.way[-1] == pytest.approx(WAY)
    return run, along, down


@pytest.mark.parametrize("slave", ["die", "block"])
@pytest.mark.parametrize("friction", FRICTIONS)
def test_plane(friction, slave):
    """Over 13 facets; the methods' vertical forces agree, and friction is mu times them."""
    downs = []
    for method in METHODS:
        _, along, down = iron(0.1, 2, friction, method, slave)
        assert along == pytest.approx(friction * down, abs=0.02 * down)
        downs.append(down)
    assert downs[1] == pytest.approx(downs[0], rel=0.03)


def test_space():
    """On cells so coarse that the methods are 8 % apart."""
    downs = []
    for method in METHODS:
        run, along, down = iron(0.2, 3, 0.3, method, "die")
        assert along == pytest.approx(0.3 * down, abs=0.02 * down)
        # By symmetry
        assert abs(run.forces[:, 1]).max() < 1e-6 * down
        downs.append(down)
    assert downs[1] == pytest.approx(downs[0], rel=0.1)
