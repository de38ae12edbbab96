# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Load steps on several ranks: checkpoints of n ranks read by m, errors of one raised on all."""

from ranks.launch import SCRIPTS, launch
from ranks.load_steps_ranks import PAIRS
from ranks.relaxed import MESHES


def test_checkpoints_errors_and_the_table(tmp_path):
    output = launch(SCRIPTS / "load_steps_ranks.py", 4, str(tmp_path))
    for name in MESHES:
        for n, m in PAIRS:
            assert f"{name}: {n} ranks, then {m}" in output
    assert output.count("all ranks: ") == 16
    assert output.count("┏") == 1
