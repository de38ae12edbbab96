# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs scenes by their numbers, as they are asked for, in a process of its own.

A scene that ends the process, or hangs, is lost alone: whoever asked goes on with a new process.
"""

from __future__ import annotations

import gc
import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos", "tools")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
from stress.families import all_scenes  # noqa: E402
from stress.outcome import run  # noqa: E402


def main() -> None:
    """Answer each number on a line with a line of JSON."""
    # What PETSc or a user's function prints must not be taken for an answer
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    scenes = all_scenes()
    for line in sys.stdin:
        print(json.dumps(run(scenes[int(line)]).row()), file=answers, flush=True)
        # Communicators are few, and go with meshes, which are in cycles
        gc.collect()


if __name__ == "__main__":
    main()
