# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Steps gone on with from a checkpoint, in this process and in a new one."""

import subprocess
import sys

import pytest

from scenes.restarts import QUICK, SCENES, check_restart, run
from tether import environment, tethered


@pytest.mark.parametrize("name", [name for name in SCENES if name not in QUICK])
def test_three_steps_and_three_are_six(name, tmp_path):
    check_restart(name, tmp_path / "run.npz")


@pytest.mark.parametrize("name", ["hexahedra", "facets, friction"])
def test_a_new_process_goes_on_to_the_same_bits(name, tmp_path):
    straight, _ = run(SCENES[name]())
    run(SCENES[name](), until=4, checkpoint=tmp_path / "run.npz")
    program = (
        "import contactx, sys, scenes.restarts as t\n"
        f"bits, _ = t.run(t.SCENES[{name!r}](), restart='run.npz')\n"
        "sys.stdout.buffer.write(b''.join(bits))"
    )
    done = subprocess.run(
        tethered([sys.executable, "-c", program]),
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        check=True,
    )
    assert done.stdout == b"".join(straight)
