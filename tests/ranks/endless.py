# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests that never end, for test_launch.py to end them: ranks, and another process."""

import subprocess
import sys

from ranks.launch import SCRIPTS, launch
from tether import tethered


def test_ranks():
    launch(SCRIPTS / "hanging.py", 2, "sleep")


def test_process():
    subprocess.run(tethered([sys.executable, "-c", "import time; time.sleep(600)"]), check=True)
