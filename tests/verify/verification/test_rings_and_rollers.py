# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Round things: Lame's rings, the NAFEMS roller and punch by quadratic displacements, and ironing.

The value for the punch is that of a quarter with quadratic cells. On its section, where the mesh
can be fine, the displacement comes to rest 1.1 % beyond it.
"""

import numpy as np
import press_fit
import pytest
from ironing import FRICTIONS, WAY, Ironing

from scenes import nafems
from story import METHODS


def errors(h, sliding, young_outer):
    """Relative errors of mean pressure, bore displacement and the worst nodal pressure."""
    problem, contact = press_fit.create(h, sliding, young_outer)
    problem.solve()
    assert problem.report.iterations <= 5
    assert np.all(contact.multiplier > 0)
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-12
    results = press_fit.compare(problem, contact, press_fit.lame(young_outer))
    result = np.abs([r.error for r in results])
    print(
        f"{sliding} h={h} E_outer={young_outer}: mean pressure {results[0].error:+.4f}, "
        f"bore {results[1].error:+.4f}, farthest {results[2].error:+.3f}"
    )
    return result


@pytest.mark.parametrize(
    ("method", "young_outer"),
    [("node-to-surface", 1.0), ("node-to-surface", 10.0), ("surface-to-surface", 10.0)],
    indirect=["method"],
)
@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_press_fit(sliding, young_outer, method):
    default = errors(press_fit.H, sliding, young_outer)
    finer = errors(press_fit.H / 2, sliding, young_outer)
    assert np.all(default[:2] <= 0.003)
    assert default[2] <= 0.004
    assert np.all(finer < default)


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_clearance(sliding, method):
    problem, contact = press_fit.create(0.05, sliding, interference=-0.01)
    problem.solve()
    assert not contact.force.any()
    assert not contact.multiplier.any()
    assert not problem.u.x.array.any()
    # Open by the clearance, less the chords' height; in the mean chords face chords
    gap, height = contact.discrete.nodes.gap, 0.034**2 / (8 * 1.5)
    most = 0.01 + (height if method == "surface-to-surface" else 1e-12)
    assert np.all((gap > 0.01 - height) & (gap <= most))


MORTAR = {"method": "surface-to-surface"}


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_roller(method):
    benchmark = nafems.roller(0.5, order=2, method=method)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.ROLLER, rel=3e-3)
    assert benchmark.contact.force[1] == pytest.approx(-35e3 / 2, rel=1e-4)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_punch(friction):
    benchmark = nafems.punch(2.0, order=2, friction=friction, **MORTAR)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.PUNCH[friction], rel=7e-3)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_punch_by_its_section(friction):
    benchmark = nafems.punch(0.5, dim=2, friction=friction, **MORTAR)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.PUNCH[friction], rel=0.015)
    assert benchmark.contact.force[1] == pytest.approx(-100 * 3.14159265 * 50**2, rel=1e-6)


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


@pytest.mark.parametrize(("friction", "slave"), [*zip(FRICTIONS, ("die", "block"), strict=True)])
def test_plane(friction, slave):
    """Over 13 facets; the methods' vertical forces agree, and friction is mu times them.

    The die is the slave with friction in space.
    """
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
