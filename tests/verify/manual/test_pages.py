# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The code of the manual's pages runs as it stands and prints what the pages say."""

import pytest
from matplotlib import pyplot as plt

import pages

RUN = [path for path in sorted(pages.MANUAL.rglob("*.md")) if pages.runs(path)]


@pytest.mark.parametrize("path", RUN, ids=lambda path: str(path.relative_to(pages.MANUAL)))
def test_page(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # Where there is no display
    plt.switch_backend("agg")
    pages.run(path)
    plt.close("all")


def test_tutorials_have_code():
    """A page whose blocks are written in another way would not be run, and nobody would see it."""
    names = {path.stem for path in RUN if path.parent.name == "tutorials"}
    written = {path.stem for path in (pages.MANUAL / "tutorials").glob("*.md")}
    assert written - names == {"index", "cpp"}


def test_differences_are_seen():
    assert pages.compare("a 1.0", "a 1.0001") == ""
    assert pages.compare("a 1.00", "a 1.01") == ""
    assert pages.compare("a 1.00", "a 1.02")
    assert pages.compare("7 nodes", "8 nodes")
    assert pages.compare("a 1.0", "b 1.0")
