# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""With friction, too, the answer does not depend on how rough the linear solves are."""

import numpy as np
import pytest

from contactx._host import linear

import meshes
import scenes
from scenes.covering import METHODS


@pytest.mark.parametrize("method", METHODS)
def test_hertz_with_friction(method, monkeypatch):
    """Exact solves, solves that are as rough as the loop asks for, and far more accurate ones."""
    follow = linear.Condensed.follow
    part = 1.0

    def scaled(self, loop):
        follow(self, loop)
        if not self._solver.is_last:
            self._solver.target *= part

    monkeypatch.setattr(linear.Condensed, "follow", scaled)
    data = meshes.hertz_sphere(0.05)
    answers, krylov = [], []
    for solver, part in (("lu", 1.0), ("condensed", 1.0), ("condensed", 1e-3)):
        scene = scenes.HertzSphere(
            data, "finite", method=method, friction=0.3,
            petsc_options={"pc_type": solver},
        )  # fmt: skip
        scene.problem.solve()
        answers.append((scene.problem.u.x.array, scene.contact.multiplier))
        krylov.append(scene.problem.report.krylov)
    assert krylov[1] < 0.9 * krylov[2]
    for other in answers[1:]:
        for found, exact in zip(other, answers[0], strict=True):
            assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()
