# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scripts that compare several ranks with one: checkpoints, load steps, files."""

from itertools import product

import pytest

from ranks import checkpoint_ranks
from ranks.launch import SCRIPTS, launch
from ranks.load_steps_ranks import PAIRS
from ranks.relaxed import MESHES

# Ranks, what is said, and how often all ranks raise the same
RUNS = {
    "checkpoint_ranks": (
        4,
        [
            f"{name}: {n} ranks, then {m}"
            for name, (n, m) in product(checkpoint_ranks.SCENES, checkpoint_ranks.PAIRS)
        ],
        0,
    ),
    "load_steps_ranks": (
        4,
        [f"{name}: {n} ranks, then {m}" for name, (n, m) in product(MESHES, PAIRS)],
        16,
    ),
    "output_ranks": (
        3,
        [
            *(f"{name}: files and surface" for name in MESHES),
            "parts make the whole",
            "reactions balance",
            "pictures of contact",
        ],
        5,
    ),
}


@pytest.mark.parametrize("name", RUNS)
def test_all_is_as_on_one_rank(name, tmp_path):
    ranks, said, errors = RUNS[name]
    output = launch(SCRIPTS / f"{name}.py", ranks, str(tmp_path))
    assert [text for text in said if text not in output] == []
    assert sum(line.startswith("all ranks: ") for line in output.splitlines()) == errors
    if name == "load_steps_ranks":
        # The table, by one rank
        assert output.count("┏") == 1
