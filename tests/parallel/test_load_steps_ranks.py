# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Load steps on several ranks: checkpoints of n ranks read by m, errors of one raised on all."""

from load_steps_ranks import PAIRS
from relaxed import MESHES
from run_ranks import run_ranks


def test_checkpoints_errors_and_the_table(tmp_path):
    output = run_ranks("load_steps_ranks.py", 4, tmp_path)
    for name in MESHES:
        for n, m in PAIRS:
            assert f"{name}: {n} ranks, then {m}" in output
    assert output.count("all ranks: ") == 16
    assert output.count("┏") == 1
