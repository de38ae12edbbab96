# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Memory over 1,000 steps, and over 1,000 problems, each in a process of its own.

    python tools/stress/leaks.py [steps] [name of a run]

Of the last four fifths it may grow by no more than a bound; the script fails if it does.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2] / folder) for folder in ("tests", "demos", "tools")]

import contactx  # noqa: E402, F401  # it loads the wheels' MPI

# isort: split
from stress.memory import RUNS, objects, open_files, resident  # noqa: E402
from tether import environment, tethered  # noqa: E402

STEPS = 1000
# Growth behind the first fifth, MB
BOUND = 2.0


def run(name: str, steps: int) -> float:
    """Take a run, print memory on the way, and return its growth behind the warm-up, MB."""
    every = max(1, steps // 20)
    print(f"{name}\n{'step':>6} {'MB':>8} {'objects':>8} {'files':>6}", flush=True)
    warm = 0.0
    for step in RUNS[name](steps):
        if step % every == 0 or step == steps // 5:
            count = objects()
            now = resident()
            print(f"{step:6} {now:8.2f} {count:8} {open_files():6}", flush=True)
            if step <= steps // 5:
                warm = now
    growth = resident() - warm
    print(f"growth from step {steps // 5} on: {growth:+.2f} MB", flush=True)
    return growth


def main() -> int:
    """Run one, or each in a process."""
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else STEPS
    if len(sys.argv) > 2:
        return int(run(sys.argv[2], steps) > BOUND)
    failed = []
    for name in RUNS:
        command = tethered([sys.executable, __file__, str(steps), name])
        if subprocess.run(command, env=environment()).returncode:
            failed.append(name)
    print(f"memory grows: {', '.join(failed)}" if failed else "memory does not grow")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
