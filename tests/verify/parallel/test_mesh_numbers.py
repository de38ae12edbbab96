# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes are the same on any number of ranks: nodes, their numbers, cells and tags."""

from ranks.launch import SCRIPTS, launch
from ranks.mesh_numbers import MODELS


def test_nodes_cells_and_tags_are_numbered_the_same_on_one_to_four_ranks():
    output = launch(SCRIPTS / "mesh_numbers.py", 4)
    for name in MODELS:
        for size in (2, 3, 4):
            assert f"{name}: the same on {size} ranks" in output
