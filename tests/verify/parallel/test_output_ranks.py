# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files for ParaView and pictures on several ranks: all of what one rank would write."""

from ranks.launch import SCRIPTS, launch
from ranks.relaxed import MESHES


def test_files_surfaces_parts_and_errors(tmp_path):
    output = launch(SCRIPTS / "output_ranks.py", 3, str(tmp_path))
    for name in MESHES:
        assert f"{name}: files and surface" in output
    assert "parts make the whole" in output
    assert output.count("all ranks: ") == 4
