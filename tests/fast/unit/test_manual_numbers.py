# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pages of figures name scripts that are there; for the figures see tests/fast/manual."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
MANUAL = ROOT / "docs" / "manual"
BENCHMARKS = ROOT / "tests" / "benchmarks"
PAGES = sorted([*MANUAL.glob("numbers/*.md"), *MANUAL.glob("theory/*.md")])


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
