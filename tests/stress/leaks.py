# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Memory over 1,000 steps, and over 1,000 problems, each in a process of its own.

    python tests/stress/leaks.py [steps] [name of a run]

Of the last four fifths it may grow by no more than a bound; the script fails if it does.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

STEPS = 1000
# Growth behind the first fifth, MB
BOUND = 2.0


def run(name: str, steps: int) -> float:
    """Take a run, print memory on the way, and return its growth behind the warm-up, MB."""
    from memory import RUNS, objects, open_files, resident

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
    here = Path(__file__).parent
    folders = [here, here.parent, here.parent / "hostile", here.parents[1] / "demos"]
    if len(sys.argv) > 2:
        sys.path[:0] = map(str, folders)
        import contactx  # it loads the wheels' MPI

        return int(run(sys.argv[2], steps) > BOUND)
    sys.path[:0] = map(str, folders)
    from memory import RUNS

    import contactx  # noqa: F401

    from tether import tethered

    env = {**os.environ, "OMP_NUM_THREADS": "1"}
    failed = [
        name
        for name in RUNS
        if subprocess.run(
            tethered([sys.executable, __file__, str(steps), name]), env=env
        ).returncode
    ]
    print(f"memory grows: {', '.join(failed)}" if failed else "memory does not grow")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
