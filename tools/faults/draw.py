# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draw faults: small wrong changes of the code, which the tests should catch.

    python tools/faults/draw.py [--seed 23] [--count 40] > faults.json

A fault is one token of one line changed, or one statement left out, at a place drawn at random
from a part of the project that is drawn in turn. What no compiler takes is drawn anew.
"""

from __future__ import annotations

import argparse
import ast
import json
import random
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]

# Parts of the project and where they are
PARTS = {
    "kernels": ("cpp/contactx/kernel",),
    "law": ("cpp/contactx/law",),
    "contact": ("cpp/contactx/contact",),
    "solve": ("cpp/contactx/solve",),
    "geometry": ("cpp/contactx/geometry",),
    "search": ("cpp/contactx/search",),
    "condensation": ("cpp/contactx/condense",),
    "audit": ("cpp/contactx/audit",),
    "steps": (
        "python/contactx/steps.py",
        "python/contactx/_host/checkpoint",
        "cpp/contactx/storage",
    ),
    "parallel": ("cpp/contactx/mesh", "python/contactx/_host/parallel"),
}

# A token and what it becomes, for both languages
_TOKENS = (
    (r"(?<=[\w\])]) \+ (?=[\w(])", " - "),
    (r"(?<=[\w\])]) - (?=[\w(])", " + "),
    (r"(?<=[\w\])]) \* (?=[\w(])", " / "),
    (r"(?<=[\w\])]) / (?=[\w(])", " * "),
    (r" \+= ", " -= "),
    (r" -= ", " += "),
    (r"(?<=[\w\])]) < (?=[\w(-])", " > "),
    (r"(?<=[\w\])]) > (?=[\w(-])", " < "),
    (r" <= ", " > "),
    (r" >= ", " < "),
    (r" == ", " != "),
    (r" != ", " == "),
    (r" && | and ", {" && ": " || ", " and ": " or "}),
    (r" \|\| | or ", {" || ": " && ", " or ": " and "}),
    (r"\bmin\b(?=\()", "max"),
    (r"\bmax\b(?=\()", "min"),
    (r"\bminimum\b(?=\()", "maximum"),
    (r"\bmaximum\b(?=\()", "minimum"),
    (r"\[0\]", "[1]"),
    (r"\[1\]", "[0]"),
    (r"\bTrue\b", "False"),
    (r"\bFalse\b", "True"),
    (r"\btrue\b", "false"),
    (r"\bfalse\b", "true"),
    (r"\bnot (?=\w)", ""),
    (r"(?<=\()!(?=\w)", ""),
    (r"(?<![\w.\[])0\.5(?![\w.])", "0.6"),
    (r"(?<![\w.\[])2(?= \*)", "3"),
)


def code_lines(file: Path) -> Iterator[tuple[int, str]]:
    """Lines that do something, with their numbers: no comments, texts, imports, heads."""
    lines = file.read_text().splitlines()
    if file.suffix == ".py":
        skipped: set[int] = set()
        for node in ast.walk(ast.parse(file.read_text())):
            text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
            heads = (ast.Import, ast.ImportFrom, ast.Raise, ast.Assert, ast.JoinedStr)
            if text or isinstance(node, heads):
                skipped.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
            elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                skipped.update(range(node.lineno, node.body[0].lineno))
        pairs = [(n, line) for n, line in enumerate(lines, 1) if n not in skipped]
        yield from ((n, line) for n, line in pairs if not line.lstrip().startswith(("#", '"', "'")))
        return
    quiet = ("//", "#", "template", "using", "namespace", "throw", "assert", "static_assert", '"')
    for n, line in enumerate(lines, 1):
        if not line.lstrip().startswith(quiet) and "std::invalid_argument" not in line:
            yield n, line.split(" //")[0]


def files_of(place: str) -> list[Path]:
    """The file, or all files of the folder, with that path."""
    path = ROOT / place
    found = [path] if path.is_file() else sorted(path.rglob("*"))
    if not found:
        raise FileNotFoundError(f"there is no {place}")
    return found


def changes(line: str, language: str) -> Iterator[str]:
    """What a line can become."""
    for pattern, new in _TOKENS:
        for match in re.finditer(pattern, line):
            put = new[match[0]] if isinstance(new, dict) else new
            yield line[: match.start()] + put + line[match.end() :]
    indent = line[: len(line) - len(line.lstrip())]
    if language == ".py":
        # A name that is not there is too easy to find
        if re.fullmatch(
            r"\s+(\w[\w.]*(\[.*\]|\.\w+) [-+*/]?=|\w+ [-+*/]=) .+[^\\,(\[{]|\s+[\w.]+\(.*\)", line
        ):
            yield indent + "pass"
    elif re.fullmatch(r"\s+[\w.\[\]()*, >-]+ [-+*/]?= [^;]+;|\s+[\w.:]+\([^;]*\);", line):
        if not re.match(r"\s+(const|auto|double|int|std::\S+|return)\b", line):
            yield indent + ";"


def compiles(file: Path, text: str) -> bool:
    """Whether a compiler takes a file with another text."""
    if file.suffix == ".py":
        try:
            ast.parse(text)
        except SyntaxError:
            return False
        return True
    command = ["c++", "-std=c++20", "-fsyntax-only", "-x", "c++", f"-I{ROOT / 'cpp'}"]
    command += [f"-I{file.parent}", "-"]
    return subprocess.run(command, input=text, capture_output=True, text=True).returncode == 0


def draw(seed: int, count: int) -> list[dict[str, object]]:
    """Draw faults, no two on one line."""
    rng = random.Random(seed)
    places: dict[str, list[tuple[Path, int, str, str]]] = {}
    for part, paths in PARTS.items():
        places[part] = [
            (file, number, line, other)
            for path in paths
            for file in files_of(path)
            if file.suffix in (".py", ".cpp", ".h")
            for number, line in code_lines(file)
            for other in changes(line, file.suffix)
        ]
    found: list[dict[str, object]] = []
    used: set[tuple[Path, int]] = set()
    while len(found) < count:
        part = list(PARTS)[len(found) % len(PARTS)]
        file, number, line, other = rng.choice(places[part])
        lines = file.read_text().splitlines()
        lines[number - 1] = other
        if (file, number) in used or not compiles(file, "\n".join(lines) + "\n"):
            continue
        used.add((file, number))
        path = str(file.relative_to(ROOT))
        found.append({"part": part, "file": path, "line": number, "was": line, "is": other})
    return found


def main() -> None:
    """Print the faults as JSON."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=23)
    parser.add_argument("--count", type=int, default=40)
    options = parser.parse_args()
    json.dump(draw(options.seed, options.count), sys.stdout, indent=1)


if __name__ == "__main__":
    main()
