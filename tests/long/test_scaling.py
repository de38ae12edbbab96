# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a rank sends, on up to 16 ranks; it takes minutes where they share two cores."""

import bench_scaling
import pytest
import runner
import tables

from story import METHODS


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "OUTPUT", tmp_path)


@pytest.mark.parametrize("method", METHODS)
def test_what_a_rank_sends_does_not_grow_with_their_number(method):
    """Between 4 and 16 ranks, with as much to do for each."""
    rows = bench_scaling.weak((1, 4, 16), dims=(3,), methods=(method,), partitions=("shifted",))
    tables.show(method, bench_scaling.WEAK, rows, runner.OUTPUT / "weak.csv")
    assert not tables.failures(rows)
    one, few, many = rows
    assert one["bytes a search"] == one["halo"] == 0
    assert few["iterations"] == many["iterations"]
    assert many["halo"] <= 1.1 * few["halo"]
    assert 0 < few["bytes an iteration"] and 0 < few["bytes a search"]
    assert many["bytes an iteration"] <= 1.1 * few["bytes an iteration"]
    # In the middle of four there is no rank yet with as many neighbours as any has
    assert many["messages an iteration"] <= 1.25 * few["messages an iteration"]
    # But for the boxes, of which each rank has one
    searched = [row["bytes a search"] - row["of boxes"] for row in (few, many)]
    assert searched[1] <= 1.1 * searched[0]
    assert many["of boxes"] <= 16 * 200
