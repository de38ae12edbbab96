# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The record of measured results, docs/measured.json: what benchmarks, gallery and map write there.

A section has the rows of one run, and with them the machine, the day, the commit and the command.
README, manual and pictures take their figures from it, see ``figures.py``.
"""

from __future__ import annotations

import datetime as dt
import json
import os
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
FILE = ROOT / "docs" / "measured.json"
OPTION = "--record"
# Folders whose changes make another program than that of the commit
_MEASURED = ("cpp", "python", "demos", "tests", "tools")
_DIGITS = 6


def load() -> dict[str, dict[str, Any]]:
    """All sections by their names."""
    sections: dict[str, dict[str, Any]] = json.loads(FILE.read_text(encoding="utf-8"))
    return sections


def record(section: str, rows: Sequence[Mapping[str, Any]], **more: Any) -> None:
    """Replace a section by what was measured in this process.

    Args:
        section: Its name.
        rows: What was measured.
        more: What else belongs to it.
    """
    sections = load() if FILE.exists() else {}
    sections[section] = {
        "command": shlex.join(["python", *_command(sys.argv)]),
        "machine": machine(),
        "date": dt.date.today().isoformat(),
        "commit": commit(),
        "version": version(),
        **more,
        "rows": [{key: _rounded(value) for key, value in row.items()} for row in rows],
    }
    write(sections)
    print(f"recorded in {FILE.relative_to(ROOT)}; write pages and pictures by tools/figures.py")


def run(section: str, main: Callable[[list[str]], list[dict[str, Any]]], argv: list[str]) -> int:
    """Run a benchmark, and record it if ``--record`` is among its arguments.

    Args:
        section: Where its rows go.
        main: What measures.
        argv: Its arguments.

    Returns:
        Number of rows that could not be measured.

    Raises:
        SystemExit: If a part of the benchmark alone is to be recorded.
    """
    others = [argument for argument in argv if argument != OPTION]
    if OPTION in argv and others:
        raise SystemExit(f"{OPTION} takes the whole benchmark, not {' '.join(others)}")
    rows = main(others)
    failed = sum("failed" in row for row in rows)
    if OPTION in argv and not failed:
        record(section, rows)
    return failed


def write(sections: Mapping[str, Mapping[str, Any]]) -> None:
    """Write the file, a row on a line, so that differences can be read."""
    text = []
    for name, section in sorted(sections.items()):
        lines = [f"    {json.dumps(key)}: {json.dumps(section[key])}" for key in section]
        lines = [line for line, key in zip(lines, section, strict=True) if key != "rows"]
        rows = ",\n".join(f"      {json.dumps(row)}" for row in section["rows"])
        lines.append(f'    "rows": [\n{rows}\n    ]')
        text.append(f"  {json.dumps(name)}: {{\n" + ",\n".join(lines) + "\n  }")
    FILE.write_text("{\n" + ",\n".join(text) + "\n}\n", encoding="utf-8")


def machine() -> str:
    """Kind of processor, cores and memory."""
    names = [
        line.partition(":")[2].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if line.startswith("model name")
    ]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    name = names[0].replace("(R)", "").replace("(TM)", "") if names else "processor"
    return f"{' '.join(name.split())}, {len(os.sched_getaffinity(0))} cores, {memory:.0f} GiB"


def commit() -> str:
    """The commit that runs, with a plus where tracked files differ from it."""
    try:
        short = _git("rev-parse", "--short=7", "HEAD")
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", *_MEASURED)
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return short + "+" * bool(changed)


def version() -> str:
    """Version of contactx."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    return str(tomllib.loads(text)["project"]["version"])


def _git(*arguments: str) -> str:
    run = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
    return run.stdout.strip()


def _command(argv: Sequence[str]) -> list[str]:
    """Arguments of this process, its script as seen from the root."""
    script = Path(argv[0]).resolve()
    name = script.relative_to(ROOT) if script.is_relative_to(ROOT) else Path(script.name)
    return [str(name), *argv[1:]]


def _rounded(value: Any) -> Any:
    # Numbers of NumPy are none of JSON's
    value = value.item() if hasattr(value, "item") else value
    return float(f"{value:.{_DIGITS}g}") if isinstance(value, float) else value
