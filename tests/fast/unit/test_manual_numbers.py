# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pages of figures have what the files have that scripts draw, and name scripts that are there."""

import csv
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
MANUAL = ROOT / "docs" / "manual"
BENCHMARKS = ROOT / "tests" / "benchmarks"
PAGES = sorted([*MANUAL.glob("numbers/*.md"), *MANUAL.glob("theory/*.md")])


def test_the_peers_are_those_of_the_benchmark():
    text = (MANUAL / "numbers" / "speed.md").read_text(encoding="utf-8")
    with (BENCHMARKS / "peers.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) > 10
    for row in rows:
        time = row["cpu"] or f"({row['wall']})"
        values = [row["h"], f"{int(row['dofs']):,}", row["iterations"], time, row["memory"]]
        values += [row["p_l2"], row["pen"]]
        line = f"| {row['peer']} {row['version']}, {row['setting']} | {' | '.join(values)} |"
        assert line in text


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_scripts_that_are_named_are_there(page):
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"`(?:tests/benchmarks/)?(bench_\w+\.py)", text):
        assert (BENCHMARKS / name).is_file()
    for name in re.findall(r"`((?:demos|tests|docs|tools)/[\w/.]+)", text):
        assert (ROOT / name).exists()


def test_all_scripts_are_listed():
    text = (MANUAL / "numbers" / "scripts.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(bench_\w+\.py)`", text))
    assert named == {path.name for path in BENCHMARKS.glob("bench_*.py")}


def test_files_of_the_core_that_the_theory_names_are_there():
    core = ROOT / "cpp" / "contactx"
    for page in MANUAL.glob("theory/*.md"):
        text = page.read_text(encoding="utf-8")
        for line in re.findall(r"^\*(?:Core|Python).*", text, re.M):
            for part, root in re.findall(r"(Core|Python): ((?:`[^`]+`,? ?)+)", line, re.I):
                base = core if part.lower() == "core" else ROOT / "python" / "contactx"
                for name in re.findall(r"`([^`]+)`", root):
                    assert (base / name).exists(), f"{page.name}: {name}"
