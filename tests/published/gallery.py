# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run the published benchmarks; write docs/gallery.md and a small picture of each.

The exit code is 1 if more than three values are missed by more than their tolerance, or one that
has no note to explain it.

    python tests/published/gallery.py
    python tests/published/gallery.py --only hueeber --output build/gallery
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
from published.cases import CASES  # noqa: E402
from published.drawing import picture  # noqa: E402
from published.record import Result  # noqa: E402

# Misses that the page may have, each explained
MISSES = 3
_INTRODUCTION = """# Published benchmarks

Benchmarks of contact that others have published, each with the published value, its source and the
value of contactx. They agree within 3 %, by default options, unless the notes say otherwise.
`make gallery` runs them all and writes this page; `make verify` checks those that take less than
20 s. The scenes are in `tests/published`. Where the published value is a formula, it is evaluated
at the force or depth that was computed. Iterations are linear solves.
"""

_MISSING = """
## What is missing

- **NAFEMS R0094 problem 4 in space**: curves alone are public; Code_Aster's plane model is above.
- **NAFEMS R0094 problem 5**, a steel roller on rubber: no number of it was found in public;
  Code_Aster's tests have problems 1, 2 and 4. Carter's roller on rubber, above, stands for it.
- **A cantilever bent over a round guide** (Timoshenko): tried in one step on 160 quadratic cells,
  it does not converge; between clamp and lift-off its pressure is zero in theory.
- **Ironing in space** (Puso and Laursen 2004): the scene is described in public, in the examples of
  Livermore's Smith, its forces as curves alone; the shallow ironing above is in plane strain.
  Kratos checks displacements of its own variant against a file that is not in its sources; MOOSE's
  test pdass_problems/ironing.i ends with a single node in contact, whose pressure is that of its
  mesh.
- **Torus on itself**: no number of the papers on self-contact was found; the torus above is
  compared with the ring's equations.
"""


def row(result: Result, pictures: str) -> str:
    """A row of the table."""
    case = result.case
    fields = (
        f"![]({pictures}/{case.name}.png)",
        case.title,
        case.source,
        case.quantity,
        f"{result.published:.5g}",
        f"{result.answer.value:.5g}",
        f"{100 * result.error:+.2f} %",
        result.iterations,
    )
    return "| " + " | ".join(fields) + " |"


def page(results: Sequence[Result], pictures: str) -> str:
    """The page of the manual."""
    head = ("", "benchmark", "source", "quantity", "published", "contactx", "error", "iterations")
    lines = [_INTRODUCTION, "| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    lines += [row(result, pictures) for result in results]
    notes = [result for result in results if result.case.note]
    if notes:
        lines += ["", "## Notes", ""]
        lines += [f"- **{r.case.title}**, {r.case.quantity}: {r.case.note}" for r in notes]
    return "\n".join(lines) + "\n" + _MISSING


def missed(result: Result) -> bool:
    """Whether the error is larger than it should be, which is not so of one that is no number."""
    return not abs(result.error) <= result.case.tolerance


def main() -> int:
    """Run the benchmarks."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", default="", help="regular expression: only such names")
    parser.add_argument("--output", type=Path, default=ROOT / "docs", help="folder of the page")
    args = parser.parse_args()
    chosen = [case for case in CASES if re.search(args.only, case.name)]
    pictures = args.output / "gallery"
    pictures.mkdir(parents=True, exist_ok=True)
    results = []
    for case in chosen:
        begin = time.perf_counter()
        result = Result(case, case.run())
        result.seconds = time.perf_counter() - begin
        results.append(result)
        picture(result.answer, pictures / f"{case.name}.png")
        print(
            f"{case.name:20s} {result.published:12.6g} {result.answer.value:12.6g} "
            f"{100 * result.error:+7.2f} % {result.iterations:>16s} {result.seconds:6.1f} s",
            flush=True,
        )
    (args.output / "gallery.md").write_text(page(results, pictures.name), encoding="utf-8")
    misses = [result for result in results if missed(result)]
    for result in misses:
        print(f"missed: {result.case.name}: {result.case.note or 'NOT EXPLAINED'}")
    return int(len(misses) > MISSES or not all(result.case.note for result in misses))


if __name__ == "__main__":
    sys.exit(main())
