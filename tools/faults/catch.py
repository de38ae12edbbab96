# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Put faults into the code one by one, and see which tests catch them.

    python tools/faults/catch.py faults.json [--tier fast|verify] [--results results.json]

It builds and tests the checkout that it is in: take a clone. A fault that the results have as
caught is not tried again, so that the second tier is run on what the first has left.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
# What each tier runs, what most likely catches a fault first; seconds after which it hangs
TIERS = {
    "fast": (
        ("build", "make all", 600),
        ("fast", "{pytest} -n 2 {cheap} tests/fast --ignore tests/fast/parallel", 600),
        ("C++ tests", "make test-cpp", 600),
        ("fast", "{pytest} tests/fast/parallel", 300),
    ),
    "verify": (
        ("build", "make all", 600),
        ("verify", "{pytest} tests/verify/parallel", 900),
        ("verify", "{pytest} -n 2 tests/verify --ignore tests/verify/parallel", 1500),
    ),
}
_CHEAP = "tests/fast/assembly tests/fast/unit tests/fast/verification"
_PYTEST = "env OMP_NUM_THREADS=1 .venv/bin/python -m pytest -x -q -p no:cacheprovider"


def run(command: str, seconds: float) -> tuple[bool, str]:
    """Whether a command succeeds, and the end of what it prints; a hang fails."""
    process = subprocess.Popen(
        command.format(pytest=_PYTEST, cheap=_CHEAP),
        shell=True,
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        printed, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return False, "hangs"
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGTERM)
    return process.returncode == 0, printed


def first_failure(printed: str) -> str:
    """The first test that failed, or the last line."""
    found = re.search(r"^(?:FAILED|ERROR) (\S+)", printed, re.MULTILINE)
    found = found or re.search(r"\[  FAILED  \] (\S+)", printed)
    return found[1] if found else (printed.strip().splitlines() or ["nothing printed"])[-1][:120]


def caught_by(fault: dict[str, Any], tier: str) -> dict[str, str] | None:
    """What catches a fault; None if the tier does not."""
    file = ROOT / fault["file"]
    before = file.read_bytes()
    lines = before.decode().splitlines(keepends=True)
    line = lines[fault["line"] - 1]
    assert line.rstrip("\n").startswith(fault["was"].rstrip()), f"another line now: {fault}"
    lines[fault["line"] - 1] = fault["is"] + line[len(fault["was"]) :]
    file.write_text("".join(lines))
    try:
        for stage, command, seconds in TIERS[tier]:
            passed, printed = run(command, seconds)
            if not passed:
                return {"by": stage, "test": first_failure(printed)}
        return None
    finally:
        file.write_bytes(before)


def main() -> None:
    """Try all faults that are not caught yet, and write down what came of each."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("faults", type=Path)
    parser.add_argument("--tier", choices=TIERS, default="fast")
    parser.add_argument("--results", type=Path, default=ROOT / "build" / "faults.json")
    options = parser.parse_args()
    results: dict[str, Any] = {}
    if options.results.exists():
        results = json.loads(options.results.read_text())
    for number, fault in enumerate(json.loads(options.faults.read_text()), 1):
        known = results.get(str(number), {})
        if known.get("by") or options.tier in known.get("not by", []):
            continue
        found = caught_by(fault, options.tier)
        missed = [*known.get("not by", []), *([] if found else [options.tier])]
        results[str(number)] = {**fault, "not by": missed, **(found or {})}
        options.results.write_text(json.dumps(results, indent=1))
        what = f"caught by {found['by']}: {found['test']}" if found else "NOT caught"
        print(f"{number:3} {fault['file']}:{fault['line']} {what}", flush=True)
    caught = sum("by" in result for result in results.values())
    print(f"{caught} of {len(results)} are caught")


if __name__ == "__main__":
    main()
