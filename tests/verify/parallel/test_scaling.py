# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The benchmark of ranks and the demo of several ranks; on up to 16 ranks: tests/long."""

import re
from pathlib import Path

import bench_scaling
import parallel
import pytest
import runner

from ranks.launch import launch
from story import METHODS


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "OUTPUT", tmp_path)


def test_strong_scaling(monkeypatch):
    monkeypatch.setattr(bench_scaling, "RUNS", 1)
    linear, _, *contact = bench_scaling.strong([0.07], METHODS[:1], [0.3])
    assert linear["efficiency"] == 1
    assert [row["shared"] for row in contact] == [False, True]
    for row in contact:
        assert row["iterations"] == row["iterations of two"]
        assert row["ratio"] == pytest.approx(row["efficiency"] * linear["ratio"])


@pytest.mark.parametrize("method", METHODS)
def test_what_a_rank_sends(method):
    one, two = bench_scaling.weak((1, 2), dims=(2,), methods=(method,), partitions=("shifted",))
    assert one["bytes a search"] == one["halo"] == 0
    # But for the ends of the slab, of which two ranks have one each
    assert two["iterations"] == pytest.approx(one["iterations"], abs=1)
    assert two["force"] == pytest.approx(one["force"], rel=0.1)
    # A box has a rank, two corners, an axis and a sine; before it comes its size
    assert two["of boxes"] == (8 + 1) * 8
    assert two["of boxes"] < two["bytes a search"] <= 20_000
    assert 0 < two["halo"] <= 200 and two["bytes an iteration"] <= 200_000


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
