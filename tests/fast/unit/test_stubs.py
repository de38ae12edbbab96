# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Types of the bindings: cpp.pyi is what ``make stubs`` writes for them."""

import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


def test_types_are_those_of_the_compiled_extension():
    pytest.importorskip("pybind11_stubgen", reason="make installs it with the extra lint")
    stubs = runpy.run_path(str(ROOT / "tools" / "stubs.py"))
    assert stubs["STUB"].read_text(encoding="utf-8") == stubs["stub"](), "run make stubs"
