# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checkpoints of contact hold the same on any number of ranks, to the last bit."""

from ranks.checkpoint_ranks import PAIRS, SCENES
from ranks.launch import SCRIPTS, launch


def test_what_is_read_on_other_ranks_is_what_was_written(tmp_path):
    output = launch(SCRIPTS / "checkpoint_ranks.py", 2, str(tmp_path))
    for name in SCENES:
        for n, m in PAIRS:
            assert f"{name}: {n} ranks, then {m}" in output
