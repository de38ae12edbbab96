# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies, what supports them and checks of them are those of one rank on any number of ranks."""

import pytest

from ranks.launch import SCRIPTS, launch


@pytest.mark.parametrize("ranks", [1, 2, 3, 4])
def test_bodies_on_ranks(ranks):
    assert launch(SCRIPTS / "bodies_on_ranks.py", ranks) == "as on one rank\n"
