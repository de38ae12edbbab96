# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies, what holds them and checks of them are those of one rank on any number of ranks."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parent / "bodies_on_ranks.py"


@pytest.mark.parametrize("ranks", [1, 2, 3, 4])
def test_bodies_on_ranks(ranks):
    launcher = Path(sys.executable).parent / "mpiexec"
    launcher = launcher if launcher.exists() else "mpiexec"
    # mpi4py ends all ranks where one fails
    script = [sys.executable, "-m", "mpi4py", SCRIPT]
    result = subprocess.run(
        [launcher, "-n", str(ranks), *script], capture_output=True, text=True, timeout=120
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stdout == "as on one rank\n"
