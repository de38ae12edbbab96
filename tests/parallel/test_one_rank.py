# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""More than one rank is refused, on every rank."""

import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parent / "two_ranks.py"


def test_two_ranks_raise():
    launcher = Path(sys.executable).parent / "mpiexec"
    result = subprocess.run(
        [launcher if launcher.exists() else "mpiexec", "-n", "2", sys.executable, SCRIPT],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stdout.count("refused: contactx runs on one rank") == 2
