# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The code of the manual's pages runs as it stands and prints what the pages say."""

import matplotlib
import pytest

import pages

RUN = [path for path in sorted(pages.MANUAL.rglob("*.md")) if pages.runs(path)]


@pytest.mark.parametrize("path", RUN, ids=lambda path: str(path.relative_to(pages.MANUAL)))
def test_page(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(matplotlib, "use", lambda *_: None)
    matplotlib.pyplot.switch_backend("agg")
    pages.run(path)
    matplotlib.pyplot.close("all")


def test_tutorials_have_code():
    """A page whose blocks are written in another way would not be run, and nobody would see it."""
    names = {path.stem for path in RUN if path.parent.name == "tutorials"}
    written = {path.stem for path in (pages.MANUAL / "tutorials").glob("*.md")}
    assert written - names == {"index", "cpp"}


def test_differences_are_seen():
    assert pages.compare("a 1.0", "a 1.0001") == ""
    assert pages.compare("a 1.0", "a 1.01")
    assert pages.compare("a 1.0", "b 1.0")
