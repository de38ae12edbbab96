# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Check the manual that Sphinx has made: links lead somewhere, nothing comes from a network.

A link within the manual must be to a file that is there, and to a place in it that is there. What a
page loads by itself (pictures, scripts, styles) must be a file of the manual.

Usage: tools/check_manual.py build/docs
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes by which an element loads something before a reader follows it
LOADED = {"img": "src", "link": "href", "script": "src", "source": "src", "video": "src"}


class Page(HTMLParser):
    """Places, links and what is loaded of a page."""

    def __init__(self, path: Path):
        """Read a page."""
        super().__init__()
        self.places: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what an element has."""
        values = {name: value or "" for name, value in attrs}
        if "id" in values:
            self.places.add(values["id"])
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        if LOADED.get(tag, "") in values:
            self.loaded.append(values[LOADED[tag]])


def check(root: Path) -> list[str]:
    """What is wrong with the pages in a folder."""
    pages = {path.resolve(): Page(path) for path in sorted(root.rglob("*.html"))}
    # Sphinx makes these without pages of their own behind all their links
    wrong = []
    for path, page in pages.items():
        name = path.relative_to(root.resolve())
        wrong += [f"{name} loads {u} from elsewhere" for u in page.loaded if urlsplit(u).netloc]
        for url in [*page.links, *page.loaded]:
            parts = urlsplit(url)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                wrong.append(f"{name} has a link to {url}, which is not there")
            elif parts.fragment and target in pages:
                if unquote(parts.fragment) not in pages[target].places:
                    wrong.append(f"{name} has a link to {url}, which has no such place")
    return wrong


if __name__ == "__main__":
    found = check(Path(sys.argv[1]))
    print("\n".join(found))
    sys.exit(1 if found else 0)
