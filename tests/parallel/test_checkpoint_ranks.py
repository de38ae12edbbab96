# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checkpoints of contact hold the same on any number of ranks, to the last bit."""

from checkpoint_ranks import PAIRS, SCENES
from run_ranks import run_ranks


def test_what_is_read_on_other_ranks_is_what_was_written(tmp_path):
    output = run_ranks("checkpoint_ranks.py", 2, tmp_path)
    for name in SCENES:
        for n, m in PAIRS:
            assert f"{name}: {n} ranks, then {m}" in output
