# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pages of figures name scripts that are there; for the figures see tests/fast/manual."""

import re
from pathlib import Path

import pytest
from face_slab import OPENING, ROW, SETTLED, TABLE, TEXT_STRESS, differs

ROOT = Path(__file__).parents[3]
MANUAL = ROOT / "docs" / "manual"
BENCHMARKS = ROOT / "tools" / "bench"
PAGES = sorted([*MANUAL.glob("numbers/*.md"), *MANUAL.glob("theory/*.md")])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_scripts_that_are_named_are_there(page):
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"`(?:tools/bench/)?(bench_\w+\.py)", text):
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


def test_the_papers_table_is_that_of_the_demo():
    """Rows of the paper, and how far what is computed is from them: within 4 % at mid length."""
    text = (MANUAL / "numbers" / "dam.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([\d.]+) \| ([\d.]+) MPa \| ([\d.]+) MPa \| (.+) \|$", text, re.M)
    assert [(float(angle), float(p)) for angle, p, *_ in rows] == list(TABLE)
    for angle, p, paper, computed in rows:
        assert float(paper) == TABLE[float(angle), float(p)][0]
        middle, percent, whole, of_whole, openings = computed.split(" | ")
        stress = float(middle.removesuffix(" MPa"))
        assert percent == differs(stress, float(paper))
        assert abs(stress / float(paper) - 1) < 0.04
        far = float(whole.removesuffix(" MPa")) / float(paper) - 1
        assert float(of_whole.removesuffix(" %")) == pytest.approx(100 * far, abs=0.51)
        if (float(angle), float(p)) == ROW:
            opening = float(openings.split(",")[0])
            assert f"| {OPENING} mm | {opening} mm (" in text
            assert abs(opening / OPENING - 1) < 0.05
            assert f"| {TEXT_STRESS} MPa | {middle} | {whole} (" in text
    (settled,) = re.findall(rf"\| {SETTLED:g} mm \| ([\d.]+) mm \(", text)
    assert abs(float(settled) / SETTLED - 1) < 0.02
