# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Write the recorded results, docs/measured.json, into README, manual, gallery and pictures.

Nothing is solved. What is recorded comes from benchmarks, gallery and stress map with ``--record``;
``make record`` runs them all.

    python tools/figures.py
"""

import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests", "demos", "tools/bench", "tools")]

import contactx  # noqa: E402, F401  # it comes first

# isort: split
import bench_methods  # noqa: E402
import bench_peers  # noqa: E402

import figures  # noqa: E402
import measured  # noqa: E402
from published import gallery  # noqa: E402
from stress import picture  # noqa: E402

DOCS = ROOT / "docs"


def main() -> None:
    """Write all."""
    sections = measured.load()
    for page in figures.rewrite(sections):
        print(f"changed: {page}")
    (DOCS / "gallery.md").write_text(
        gallery.page(sections["gallery"]["rows"], "gallery"), encoding="utf-8"
    )
    methods, families = sections["methods"], sections["stress_map"]
    ours = figures.where(methods)
    beside = textwrap.fill(f"measured {figures.of_peers()}", 80)
    digest = figures.digest(sections, "error_time")
    bench_peers.draw(DOCS / "error_time.png", note=beside, source=digest)
    for name, draw, rows, note in (
        ("methods", bench_methods.draw, methods["rows"], ours),
        ("stress_map", picture.draw_families, families["rows"], figures.where(families)),
    ):
        draw(rows, DOCS / f"{name}.png", note=note, source=figures.digest(sections, name))


if __name__ == "__main__":
    main()
