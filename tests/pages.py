# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Code blocks of the manual's pages, run as a reader would run them.

The ``python`` blocks of a page, copied one below the other into an empty file, are a program. A
block of ``text`` behind one of them is what that one prints: the same words, and numbers that
differ by rounding at most.
"""

import ast
import contextlib
import io
import re
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent

import numpy as np

ROOT = Path(__file__).parents[1]
MANUAL = ROOT / "docs" / "manual"
# Iterates differ a little between machines
RTOL, ATOL = 1e-3, 1e-9

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass(frozen=True)
class Block:
    """A block of code: its language, its lines, and the line of the page where they begin."""

    language: str
    code: str
    line: int

    @property
    def lines(self) -> range:
        """Its lines in the page, which are counted from 1."""
        return range(self.line + 1, self.line + self.code.count("\n") + 2)


def blocks(path: Path) -> list[Block]:
    """Blocks of a page, in order, those too that are indented with the items of a list."""
    found, fence, language, start = [], "", "", 0
    lines = path.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines):
        opened = re.match(r"\s*([`~:]{3,})\s*(.*)$", line)
        if not fence and opened:
            fence, language, start = opened[1], opened[2].strip(), number + 1
        elif fence and line.strip() == fence:
            found.append(Block(language, dedent("\n".join(lines[start:number])), start))
            fence = ""
    assert not fence, f"{path}: the block of line {start} has no end"
    return found


def indented(path: Path) -> list[str]:
    """First lines of what Markdown takes for code because it is indented by four or more."""
    fenced = {number for block in blocks(path) for number in block.lines}
    lines = ["", *path.read_text(encoding="utf-8").splitlines()]
    return [
        line
        for number, line in enumerate(lines)
        if re.match(r" {4,}\S", line) and not lines[number - 1].strip() and number not in fenced
    ]


@dataclass(frozen=True)
class Inclusion:
    """A part of a file that a page shows: the file, and the lines as they stand there."""

    file: Path
    code: str


def inclusions(path: Path) -> list[Inclusion]:
    """What a page shows of files, as Sphinx's ``literalinclude`` takes it.

    Its first and its last line must be marked by what stands in one line of the file alone, so that
    a change of the file cannot move them unseen.
    """
    found = []
    for block in blocks(path):
        name = re.match(r"\{literalinclude\}\s+(\S+)$", block.language)
        if name is None:
            continue
        options = dict(re.findall(r"^:([\w-]+):\s*\"?(.*?)\"?$", block.code, re.MULTILINE))
        file = (path.parent / name[1]).resolve()
        lines = file.read_text(encoding="utf-8").splitlines()
        first, last = 0, len(lines) - 1
        if "lines" in options:
            start, _, end = options["lines"].partition("-")
            first, last = int(start) - 1, int(end) - 1 if end else last
        if "start-at" in options:
            (first,) = (k for k, line in enumerate(lines) if options["start-at"] in line)
        if "end-at" in options:
            (last,) = (k for k, line in enumerate(lines) if options["end-at"] in line)
        assert first <= last < len(lines), f"{path}, line {block.line}: nothing of {file}"
        found.append(Inclusion(file, "\n".join(lines[first : last + 1])))
    return found


def script(path: Path) -> str:
    """The program of a page, with each block in its place so that errors name the page's lines."""
    text = ""
    for block in blocks(path):
        if block.language == "python":
            text += "\n" * (block.line - text.count("\n")) + block.code + "\n"
    return text


def runs(path: Path) -> bool:
    """Whether a page has anything to run."""
    return any(block.language == "python" for block in blocks(path))


def run(path: Path, *, silent: bool = False) -> dict:
    """Run the program of a page in the current folder and check what it prints.

    Args:
        path: The page.
        silent: Whether a block may print what the page does not show.

    Returns:
        Its names.
    """
    names: dict = {"__name__": "__main__"}
    found, program = blocks(path), ast.parse(script(path), str(path))
    for block, after in zip(found, [*found[1:], None], strict=True):
        if block.language != "python":
            continue
        statements = [statement for statement in program.body if statement.lineno in block.lines]
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(ast.Module(statements, []), str(path), "exec"), names)
        if after is not None and after.language == "text":
            difference = compare(after.code, printed.getvalue())
            assert not difference, f"{path}, line {after.line}: {difference}"
        elif not silent:
            assert not printed.getvalue(), f"{path}, line {block.line}: not shown is what it prints"
    return names


def compare(expected: str, printed: str) -> str:
    """What is different between the text of a page and what was printed; empty if nothing is."""
    say = f"the page has\n{expected}\nprinted was\n{printed}"
    if _NUMBER.sub("#", expected).split() != _NUMBER.sub("#", printed).split():
        return say
    tokens = [_NUMBER.findall(text) for text in (expected, printed)]
    wanted, got = (np.array(found, dtype=float) for found in tokens)
    allowed = ATOL + RTOL * np.abs(wanted) + [1.01 * last_digit(token) for token in tokens[0]]
    return "" if np.all(np.abs(got - wanted) <= allowed) else say


def last_digit(token: str) -> float:
    """What one in the last digit of a number is worth; nothing of a whole number, which counts."""
    digits, _, power = token.lower().partition("e")
    decimals = len(digits.partition(".")[2])
    return 10.0 ** (int(power or 0) - decimals) if decimals else 0.0
