# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos of self-contact run, print what they should and leave their pictures."""

import closing_clip
import folding_strip
import numpy as np
import pytest
import settling_discs
from matplotlib import image


def test_the_halves_of_a_fold_that_leans_touch():
    """Their distance is between them, not from the plane of symmetry."""
    fold = folding_strip.Fold(0.06, friction=folding_strip.FRICTION)
    fold.run()
    distance = fold.apart()
    fold.u.x.array.reshape(-1, 2)[:, 0] += 0.2 * folding_strip.THICKNESS
    assert abs(fold.apart() - distance) < 1e-12
    assert abs(distance / folding_strip.THICKNESS - 1) < 0.015


@pytest.mark.parametrize(
    ("demo", "h", "tolerances"),
    [
        (closing_clip, "0.05", (0.02, 0.05, 0.05, 0.05)),
        (folding_strip, "0.06", (0.06, 0.015)),
        (settling_discs, "0.2", (1e-8,)),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_demo(demo, h, tolerances, tmp_path, capsys):
    results = demo.main(["--h", h, "--output", str(tmp_path)])
    for result, tolerance in zip(results, tolerances, strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "see "):
        assert text in printed
    pixels = image.imread(tmp_path / f"{demo.__name__}.png")
    assert pixels.shape[0] > 300
    assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 100
