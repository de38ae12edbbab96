# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A strip that yields while a punch bends it."""

import pytest

from scenes.forming import BentStrip


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_a_strip_is_bent_far(friction):
    scene = BentStrip(friction=friction)
    solves, failed = scene.bend(10.0, 20)
    # Without extrapolated starts it ends at 4.5 mm or needs far more
    assert solves + failed <= 600
    assert -scene.punch.force[1] == pytest.approx(scene.support.force[1], rel=1e-9)
    assert scene.history[1].x.array.max() > 0.05
