# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A hang is found, told and ended; so the other tests here can fail."""

import time

import pytest

from ranks.launch import SCRIPTS, Failure, Hang, launch

SCRIPT = SCRIPTS / "hanging.py"


def test_a_hang_is_told_and_ended():
    start = time.perf_counter()
    with pytest.raises(Hang, match="hang of 2 ranks") as info:
        launch(SCRIPT, 2, "hang")
    assert time.perf_counter() - start < 30
    text = str(info.value)
    for rank in (0, 1):
        assert f"rank {rank} in a barrier" in text
    assert text.count("Timeout (") == 2
    assert text.count('hanging.py", line') == 2


def test_an_error_is_told():
    with pytest.raises(Failure, match="it has failed"):
        launch(SCRIPT, 2, "fail")


def test_a_script_that_ends():
    assert launch(SCRIPT, 2, "end").count("came to the end") == 2
