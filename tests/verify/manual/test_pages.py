# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The code of the manual's pages runs as it stands and prints what the pages say."""

import re
import warnings

import pytest
from matplotlib import pyplot as plt

import pages

RUN = [path for path in sorted(pages.MANUAL.rglob("*.md")) if pages.runs(path)]


@pytest.mark.parametrize("path", RUN, ids=lambda path: str(path.relative_to(pages.MANUAL)))
def test_page(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # Where there is no display
    plt.switch_backend("agg")
    with warnings.catch_warnings(record=True) as given:
        pages.run(path)
    plt.close("all")
    # A page that is warned says so, by a link to the page of the message
    for message in (str(warning.message) for warning in given if warning.category is UserWarning):
        named = re.search(r"\(manual: (errors/[\w-]+)\)", message)
        assert named and f"{named[1]}.md" in path.read_text(encoding="utf-8"), message


def test_tutorials_have_code():
    """A page whose blocks are written in another way would not be run, and nobody would see it."""
    names = {path.stem for path in RUN if path.parent.name == "tutorials"}
    written = {path.stem for path in (pages.MANUAL / "tutorials").glob("*.md")}
    assert written - names == {"index", "cpp"}


def test_a_page_is_one_program(tmp_path):
    """Blocks in lists belong to it, and what is printed must be shown."""
    page = tmp_path / "page.md"
    first = "1. One\n\n   ```python\n   def one():\n       return 1\n   ```\n"
    page.write_text(first + "\n```python\nprint(one())\n```\n```text\n1\n```\n")
    assert pages.run(page)["one"]() == 1
    page.write_text(first + "\n```python\nprint(one())\n```\n")
    with pytest.raises(AssertionError, match="not shown"):
        pages.run(page)
    page.write_text("```python\none()\n```\n")
    with pytest.raises(NameError):
        pages.run(page)


def test_differences_are_seen():
    assert pages.compare("a 1.0", "a 1.0001") == ""
    assert pages.compare("a 1.00", "a 1.01") == ""
    assert pages.compare("a 1.00", "a 1.02")
    assert pages.compare("7 nodes", "8 nodes")
    assert pages.compare("a 1.0", "b 1.0")
