# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What CONTRIBUTING.md says of the tree is so."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
CORE = ROOT / "cpp" / "contactx"
PYTHON = ROOT / "python" / "contactx"


def includes() -> set[tuple[str, str]]:
    """Pairs of rooms of the core of which the first one includes the second one."""
    pairs = set()
    for path in CORE.rglob("*"):
        if path.suffix not in (".h", ".cpp"):
            continue
        room = path.relative_to(CORE).parts[0]
        for name in re.findall(r'#include "([^"]+)"', path.read_text(encoding="utf-8")):
            other = (path.parent / name).resolve().relative_to(CORE).parts
            if len(other) > 1 and other[0] != room:
                pairs.add((room, other[0]))
    return pairs


def test_paths_are_there():
    paths = re.findall(r"`([\w.]+/[\w./]*)`", TEXT)
    assert len(paths) > 60
    places = (ROOT, CORE, PYTHON, ROOT / "cpp")
    assert [path for path in paths if not any((place / path).exists() for place in places)] == []


def test_rooms_are_those_of_the_core():
    rooms = set(re.findall(r"^\| `(\w+)/` \|", TEXT, re.MULTILINE))
    assert rooms == {path.name for path in CORE.iterdir() if path.is_dir()}
    assert len(rooms) == 12


def test_no_two_rooms_include_each_other():
    pairs = includes()
    assert len(pairs) > 30
    assert {pair for pair in pairs if pair[::-1] in pairs} == set()


def test_what_users_import_are_few_modules():
    modules = {path.stem for path in PYTHON.glob("*.py")} - {"__init__"}
    folders = {path.parent.name for path in PYTHON.glob("[!_]*/__init__.py")}
    assert len(modules | folders) <= 14


def test_commands_are_targets():
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = {a or b for a, b in re.findall(r"`make ([\w-]+)`|^    make ([\w-]+)", TEXT, re.M)}
    assert len(named) > 12
    assert named <= targets
