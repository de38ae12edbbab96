# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run the published benchmarks; write docs/gallery.md and a small picture of each.

With ``--record`` the values go to docs/measured.json, too, from which others count them. The exit
code is 1 if more than three values are missed by more than their tolerance, or one that has no note
to explain it.

    python tests/published/gallery.py --record
    python tests/published/gallery.py --only hueeber --output build/gallery
"""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
import measured  # noqa: E402
from published.cases import CASES  # noqa: E402
from published.drawing import picture  # noqa: E402
from published.record import CODES, NAFEMS, TEXTBOOKS, TOLERANCE, Result  # noqa: E402

# Misses that the page may have, each explained
MISSES = 3
_INTRODUCTION = """# Published benchmarks

Benchmarks of contact that others have published, each with the published value, its source and the
value of contactx: {values} values of {problems} problems, {textbooks} from textbooks and papers,
{nafems} from NAFEMS R0094 and {codes} from the tests and manuals of other codes (Code_Aster,
CalculiX, 4C, MOOSE, PETSc). The largest deviation is {worst:+.1f} %; {wide} values deviate by more
than 3 %, for reasons that the notes give. {optional} values are not by default options: the notes
name those.

`make gallery` runs them all and writes this page; `make verify` checks those that take less than
20 s. The scenes are in `tests/published`. Where the published value is a formula, it is evaluated
at the force or depth that was computed. Iterations are linear solves.
"""

_MISSING = """
## What is missing

- **NAFEMS R0094 problem 4 in space**: curves alone are public; Code_Aster's plane model is above.
- **NAFEMS R0094 problem 5**, a steel roller on rubber: no number of it was found in public;
  Code_Aster's tests have problems 1, 2 and 4. Carter's roller on rubber, above, stands for it.
- **Ironing in space** (Puso and Laursen 2004): the scene is described in public, in the examples of
  Livermore's Smith, its forces as curves alone; the shallow ironing above is in plane strain.
  Kratos checks displacements of its own variant against a file that is not in its sources; MOOSE's
  test pdass_problems/ironing.i ends with a single node in contact, whose pressure is that of its
  mesh.
- **Torus on itself**: no number of the papers on self-contact was found; the torus above is
  compared with the ring's equations.
"""


def counts(rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """How many values and problems there are, from where, and how far off."""
    case_of = {case.name: case for case in CASES}
    cases = [case_of[row["name"]] for row in rows]
    origins = [case.origin for case in cases]
    errors = [100 * row["error"] for row in rows]
    return {
        "values": len(rows),
        "problems": len({case.problem or case.name for case in cases}),
        "textbooks": origins.count(TEXTBOOKS),
        "nafems": origins.count(NAFEMS),
        "codes": origins.count(CODES),
        "worst": max(errors, key=abs),
        "wide": sum(abs(error) > 100 * TOLERANCE for error in errors),
        "within": sum(abs(error) <= 100 * TOLERANCE for error in errors),
        "optional": sum(bool(case.options) for case in cases),
    }


def line(row: Mapping[str, Any], pictures: str) -> str:
    """A line of the table."""
    (case,) = (case for case in CASES if case.name == row["name"])
    iterations = str(row["iterations"])
    fields = (
        f"![]({pictures}/{case.name}.png)",
        case.title,
        case.source,
        case.quantity,
        f"{row['published']:.5g}",
        f"{row['contactx']:.5g}",
        f"{100 * row['error']:+.2f} %",
        iterations if row["steps"] == 1 else f"{iterations} in {row['steps']} steps",
    )
    return "| " + " | ".join(fields) + " |"


def page(rows: Sequence[Mapping[str, Any]], pictures: str) -> str:
    """The page of the manual."""
    head = ("", "benchmark", "source", "quantity", "published", "contactx", "error", "iterations")
    lines = [_INTRODUCTION.format(**counts(rows)), "| " + " | ".join(head) + " |"]
    lines += ["|" + " --- |" * len(head), *(line(row, pictures) for row in rows)]
    names = {row["name"] for row in rows}
    notes = [case for case in CASES if case.name in names and case.note]
    if notes:
        lines += ["", "## Notes", ""]
        lines += [f"- **{case.title}**, {case.quantity}: {case.note}" for case in notes]
    return "\n".join(lines) + "\n" + _MISSING


def missed(result: Result) -> bool:
    """Whether the error is larger than it should be, which is not so of one that is no number."""
    return not abs(result.error) <= result.case.tolerance


def main() -> int:
    """Run the benchmarks."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", default="", help="regular expression: only such names")
    parser.add_argument("--output", type=Path, default=ROOT / "docs", help="folder of the page")
    parser.add_argument(measured.OPTION, action="store_true", help="record what was measured")
    args = parser.parse_args()
    if args.record and args.only:
        parser.error("all cases are recorded, or none")
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
            f"{100 * result.error:+7.2f} % {result.row['iterations']:6d} {result.seconds:6.1f} s",
            flush=True,
        )
    rows = [result.row for result in results]
    (args.output / "gallery.md").write_text(page(rows, pictures.name), encoding="utf-8")
    if args.record:
        measured.record("gallery", rows)
    misses = [result for result in results if missed(result)]
    for result in misses:
        print(f"missed: {result.case.name}: {result.case.note or 'NOT EXPLAINED'}")
    return int(len(misses) > MISSES or not all(result.case.note for result in misses))


if __name__ == "__main__":
    sys.exit(main())
