# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loose bodies that settle, a strip that is folded, impact of bars, a block that bounces."""

import numpy as np
import pytest
from folding_strip import FRICTION, THICKNESS, Elastica, Fold
from settling_discs import COLUMNS, ROWS, Box


@pytest.mark.parametrize(("rows", "columns"), [(2, 3), (ROWS, COLUMNS)])
def test_discs_at_rest_carry_their_weight(rows, columns):
    box = Box(0.13, rows=rows, columns=columns)
    box.settle()
    assert box.carried() == pytest.approx(box.weight, rel=1e-8)
    assert box.unbalanced() <= 1e-8 * box.weight / (rows * columns)
    assert np.linalg.norm(box.discs.fields.imbalance) <= 1e-10 * box.weight
    assert box.problem.report.free_modes == 0


def test_a_box_that_is_turned_turns_its_answer():
    boxes = [Box(0.13, rows=2, columns=3, angle=angle) for angle in (0.0, 0.6)]
    for box in boxes:
        box.settle()
    straight, turned = (box.u.x.array.reshape(-1, 2) for box in boxes)
    c, s = np.cos(0.6), np.sin(0.6)
    assert turned == pytest.approx(straight @ np.array([[c, s], [-s, c]]), abs=1e-7)


@pytest.mark.parametrize("steps", [10, 20])
def test_a_folded_strip_is_an_elastica(steps):
    fold = Fold(0.06, friction=FRICTION)
    fold.run(steps)
    force = float(abs(fold.contact.force[0]))
    assert force == pytest.approx(abs(Elastica().contact), rel=0.06)
    assert np.abs(fold.touching()[:, 0]).max() < 0.01 * THICKNESS
    report = fold.problem.report
    assert np.linalg.norm(report.imbalance) <= 1e-10 * force
    assert report.audit.depth < 0.01 * THICKNESS
