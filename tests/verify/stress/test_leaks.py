# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The runs of leaks.py, shorter: what each step or problem leaves behind shows soon."""

import subprocess
import sys

import pytest

from tether import environment, tethered

# Steps before the warm-up has ended, and behind it; a form that is rarely needed is compiled in it
WARM, STEPS = 160, 260
# Growth of memory behind it, MB, and of Python's objects a step: the row of its table
BOUND, OBJECTS = 0.3, 1.2

PROGRAM = """
import contactx
import sys
from stress.memory import RUNS, objects, resident
name, warm, steps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
for step in RUNS[name](steps):
    if step == warm:
        first = objects(), resident()
    last = step
print(objects() - first[0], resident() - first[1], last)
"""


@pytest.mark.parametrize(
    "name", ["node to surface", "surface to surface", "condensed", "problems made and dropped"]
)
def test_memory_does_not_grow(name):
    """In a process of its own, whose memory is that of this run alone."""
    done = subprocess.run(
        tethered([sys.executable, "-W", "ignore", "-c", PROGRAM, name, str(WARM), str(STEPS)]),
        env=environment(),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    objects, grown, last = map(float, done.stdout.split())
    assert last >= STEPS
    assert grown <= BOUND
    assert objects <= OBJECTS * (last - WARM) + 50
