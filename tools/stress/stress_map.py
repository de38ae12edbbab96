# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The stress map: where contactx holds and where it fails.

It runs all scenes, prints a table of what came of each family, and writes every scene to a CSV
file and to a picture; with ``--record`` what came of each family goes to docs/measured.json, too.
The exit code is 1 if a scene is wrong.

    python tools/stress/stress_map.py --record
    python tools/stress/stress_map.py --family "stiffness" --every 10
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos", "tools")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
from rich.console import Console  # noqa: E402
from rich.progress import Progress  # noqa: E402

import measured  # noqa: E402
from stress import picture, pool, sheet  # noqa: E402
from stress.degree import VARIABLE  # noqa: E402
from stress.families import all_scenes  # noqa: E402
from stress.outcome import Kind, Outcome  # noqa: E402

OUTPUT = ROOT / "build" / "stress"


def main() -> int:
    """Run the scenes and write the map."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--family", default="", help="regular expression: only such families")
    parser.add_argument("--every", type=int, default=1, help="take each n-th scene only")
    parser.add_argument("--degree", type=int, default=1, help="of the displacement of blocks")
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--output", type=Path, default=OUTPUT)
    parser.add_argument(measured.OPTION, action="store_true", help="record what came of it")
    args = parser.parse_args()
    if args.record and (args.family or args.every > 1 or args.degree > 1):
        parser.error("all scenes with linear displacements are recorded, or none")
    os.environ[VARIABLE] = str(args.degree)
    scenes = all_scenes()
    numbers = [i for i, s in enumerate(scenes) if re.search(args.family, s.family)]
    numbers = numbers[:: args.every]
    outcomes: dict[int, Outcome] = {}
    console = Console(width=max(100, Console().width))
    with Progress(console=console) as progress:
        bar = progress.add_task("scenes", total=len(numbers))

        def done(number: int, outcome: Outcome) -> None:
            outcomes[number] = outcome
            if outcome.kind in (Kind.WRONG, Kind.REFUSED):
                name = scenes[number].name
                text = f"{outcome.kind}: {name}: {outcome.reason}"
                progress.console.print(text, soft_wrap=True, markup=False, highlight=False)
            progress.advance(bar)

        pool.run_all(scenes, numbers, args.workers, done)
    rows = [outcomes[i] for i in sorted(outcomes)]
    args.output.mkdir(parents=True, exist_ok=True)
    sheet.write(rows, args.output / "map.csv")
    sheet.show(rows, console, args.output / "map.md")
    picture.draw(rows, args.output / "map.png")
    console.print(f"see {args.output}/map.csv, map.md and map.png", soft_wrap=True)
    if args.record:
        measured.record("stress_map", sheet.families(rows))
    return int(any(row.kind == Kind.WRONG for row in rows))


if __name__ == "__main__":
    sys.exit(main())
