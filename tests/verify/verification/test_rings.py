# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lame: a ring pressed into another one."""

import numpy as np
import press_fit
import pytest


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


@pytest.mark.usefixtures("method")
@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_coarse(sliding):
    assert np.all(errors(0.05, sliding, 1.0)[:2] <= 0.01)


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
