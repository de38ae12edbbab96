# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A checkpoint of some ranks is gone on from on others, to the answer of one."""

from pathlib import Path

import numpy as np
import pytest
from launch import launch
from outcome import differences

SCRIPT = Path(__file__).with_name("run_restart.py")
WRITTEN_ON = {2: "1", 3: "2", 1: "3"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Each checkpoint is written up to the middle and read on another number of ranks."""
    folder = tmp_path_factory.mktemp("restart")
    launch(SCRIPT, 1, str(folder), "whole", "write")
    for ranks, written_on in WRITTEN_ON.items():
        tasks = [written_on] if ranks == 1 else [written_on, "write"]
        launch(SCRIPT, ranks, str(folder), *tasks)
    return folder


@pytest.mark.parametrize("ranks", WRITTEN_ON)
@pytest.mark.parametrize("scene", ["dented", "sliding", "loose"])
def test_restart_on_other_ranks(folder, scene, ranks):
    with (
        np.load(folder / f"{scene}-whole-1.npz") as whole,
        np.load(folder / f"{scene}-{WRITTEN_ON[ranks]}-{ranks}.npz") as restarted,
    ):
        assert not differences(dict(restarted), dict(whole), 1e-9)
