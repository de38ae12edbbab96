# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files for ParaView and pictures on several ranks: all of what one rank would write."""

from relaxed import MESHES
from run_ranks import run_ranks


def test_files_surfaces_parts_and_errors(tmp_path):
    output = run_ranks("output_ranks.py", 3, tmp_path)
    for name in MESHES:
        assert f"{name}: files and surface" in output
    assert "parts make the whole" in output
    assert output.count("all ranks: ") == 4
