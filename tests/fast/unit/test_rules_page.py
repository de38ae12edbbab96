# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The rules of the loop are where their page says, and their tests are there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "manual" / "theory" / "rules.md"
ROWS = [
    [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
    for line in PAGE.read_text(encoding="utf-8").splitlines()
    if line.startswith("| ") and not line.startswith("| rule")
]
# Rules with a place and a test; the table of what was measured has figures in their place
RULES = [row for row in ROWS if len(row) == 4]
CPP_TESTS = "\n".join(
    path.read_text(encoding="utf-8") for path in (ROOT / "cpp" / "tests").rglob("*.cpp")
)


def sources(name: str) -> list[Path]:
    """Files of the core or the package that a row names, with or without their suffix."""
    found = [
        base / folder / f"{name}{suffix}"
        for base in (ROOT / "cpp" / "contactx", ROOT / "python" / "contactx")
        for folder in ("", "active_set")
        for suffix in ("", ".cpp", ".h")
    ]
    return [path for path in found if path.is_file()]


def test_there_are_rules():
    assert len(RULES) > 60


@pytest.mark.parametrize("row", RULES, ids=lambda row: row[0][:60])
def test_a_rule_is_where_its_row_says(row):
    names = re.findall(r"`([^`]+)`", row[1])
    files = [name for name in names if "/" in name or name.endswith((".py", ".cpp", ".h"))]
    paths = {name: sources(name) for name in files}
    assert files and all(paths.values()), paths
    text = "\n".join(p.read_text(encoding="utf-8") for found in paths.values() for p in found)
    for name in set(names) - set(files):
        assert re.search(rf"\b{name.removeprefix('_modes->')}\b", text), name


@pytest.mark.parametrize("row", RULES, ids=lambda row: row[0][:60])
def test_a_rule_has_its_tests(row):
    names = re.findall(r"`([^`]+)`", row[2])
    assert names
    for name in names:
        if match := re.fullmatch(r"(\w+)\.(\w+)", name):
            if match[2] in ("py", "cpp"):
                assert list((ROOT / "cpp" / "tests").rglob(name)), name
                continue
            assert re.search(rf"TEST(?:_F|_P)?\(\s*{match[1]},\s*{match[2]}\)", CPP_TESTS), name
        else:
            file, test = name.split("::")
            found = [path for path in (ROOT / "tests").rglob(Path(file).name) if file in str(path)]
            assert any(f"def {test}(" in path.read_text(encoding="utf-8") for path in found), name
