# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demo of several ranks, on one and on two of them."""

import re
from pathlib import Path

import parallel
import pytest

from ranks.launch import launch


@pytest.mark.parametrize("ranks", [1, 2])
def test_parallel(ranks):
    printed = launch(Path(parallel.__file__), ranks, "--h", "0.07")
    print(printed)
    # One rank speaks
    for text in ("converged after", "Who has what", "expected", f"ranks: {ranks}"):
        assert printed.count(text) == 1
    iterations = re.search(r"iterations, one rank's\D*(\d+)\D*(\d+)", printed)
    assert iterations[1] == iterations[2]
    assert float(re.search(r"one rank within (\S+) of", printed)[1]) <= 1e-9
    radius = re.search(r"contact radius, Hertz.*│\s*([+-]\S+) %", printed)
    assert abs(float(radius[1])) <= 10
    # Each rank has cells
    shares = printed.partition("Who has what")[2].partition("└")[0]
    assert len(re.findall(r"^│ \d+\s*│ [1-9]\d*\s*│", shares, re.MULTILINE)) == ranks
