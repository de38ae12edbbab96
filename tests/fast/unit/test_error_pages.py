# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each reason of a refused step has a page of the manual, and each page a message that names it."""

import ast
import re
from pathlib import Path

import pytest

from contactx._host import newton

ROOT = Path(__file__).parents[3]
PAGES = ROOT / "docs" / "manual" / "errors"
PYTHON = sorted((ROOT / "python" / "contactx").rglob("*.py"))
CPP = sorted(
    path
    for folder in ("contactx", "contactx_dolfinx")
    for path in (ROOT / "cpp" / folder).rglob("*")
    if path.suffix in (".h", ".cpp")
)
# Files of the core in which a step is driven
DRIVER = ("audit_report", "make_contact", "messages", "problem", "snapshot", "step_plan")
NAMED = re.compile(r"\(manual: errors/([a-z-]+)\)")


def pieces(node: ast.AST) -> list[str]:
    """Literal parts of an expression of text, in order; adjacent ones are one."""
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if isinstance(node, ast.JoinedStr):
        return [text for value in node.values for text in pieces(value)]
    if isinstance(node, ast.BinOp):
        return pieces(node.left) + pieces(node.right)
    if isinstance(node, ast.IfExp):
        return pieces(node.body) + pieces(node.orelse)
    return []


def texts_of_python(path: Path) -> list[list[str]]:
    """Literal parts of each text in a module that names a page."""
    found = []
    covered: set[int] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if id(node) in covered or not isinstance(node, ast.Constant | ast.JoinedStr | ast.BinOp):
            continue
        covered.update(map(id, ast.walk(node)))
        parts = pieces(node)
        if any(NAMED.search(part) for part in parts):
            found.append(parts)
    return found


def texts_of_cpp(path: Path) -> list[list[str]]:
    """The same of C++: literals that follow one another are one."""
    source = path.read_text(encoding="utf-8")
    joined = re.sub(r'"\s*\n\s*"', "", source)
    found = []
    for statement in joined.split(";\n"):
        parts = re.findall(r'"((?:[^"\\]|\\.)*)"', statement)
        if any(NAMED.search(part) for part in parts):
            found.append([part.replace('\\"', '"') for part in parts])
    return found


def is_named(texts: list[list[str]]) -> set[str]:
    return {page for parts in texts for part in parts for page in NAMED.findall(part)}


FROM_PYTHON = [parts for path in PYTHON for parts in texts_of_python(path)]
FROM_CPP = [parts for path in CPP for parts in texts_of_cpp(path)]
THERE = {path.stem for path in PAGES.glob("*.md")} - {"index"}


def test_pages_are_those_that_messages_name():
    assert is_named(FROM_PYTHON + FROM_CPP) == THERE


def test_the_index_lists_all_pages():
    index = (PAGES / "index.md").read_text(encoding="utf-8")
    toctree = index[index.index("{toctree}") :]
    assert set(re.findall(r"^([a-z-]+)$", toctree, re.M)) == THERE
    assert set(re.findall(r"\]\(([a-z-]+)\.md\)", index)) == THERE


@pytest.mark.parametrize("page", sorted(THERE))
def test_a_page_quotes_the_messages_that_name_it(page):
    """Whoever looks for the words of a message finds its page."""
    text = " ".join((PAGES / f"{page}.md").read_text(encoding="utf-8").split())
    of_steps = [
        parts for path in CPP if path.parent.name == "problem" for parts in texts_of_cpp(path)
    ]
    for parts in FROM_PYTHON + of_steps:
        if page in is_named([parts]):
            # Without what is put in
            words = [
                " ".join(piece.split()).strip(" .:;")
                for part in parts
                for piece in re.split(r"\{[^}]*\}|\(manual:.*", part)
            ]
            assert [w for w in words if len(w) > 12 and w not in text] == []


def test_each_reason_of_the_loop_names_a_page():
    reasons = [
        *(text for code, text in newton._REASONS.items() if code < 0),
        newton._reason_of(4, converged=False),
        newton._reason_of(-9, converged=False),
    ]
    assert [text for text in reasons if not NAMED.search(text)] == []


def calls_to(name: str, path: Path) -> list[ast.Call]:
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return [
        node
        for node in nodes
        if isinstance(node, ast.Call) and name in (ast.unparse(node.func).split(".")[-1],)
    ]


def literals(node: ast.AST) -> str:
    constants = [n.value for n in ast.walk(node) if isinstance(n, ast.Constant)]
    return "".join(text for text in constants if isinstance(text, str))


def test_each_message_of_the_core_names_a_page():
    """What it throws, returns or adds to the faults and warnings of a step."""
    statements = [
        statement
        for name in DRIVER
        for path in [ROOT / "cpp" / "contactx" / "problem" / f"{name}.cpp"]
        for statement in path.read_text(encoding="utf-8").split(";\n")
        if re.search(
            r"push_back\(|throw (solve::NotFinite|std::invalid_argument)\(|return ", statement
        )
    ]
    texts = ["".join(re.findall(r'"((?:[^"\\]|\\.)*)"', statement)) for statement in statements]
    # Names, arguments out of their range and what comes before the rest of a sentence are short
    texts = [text for text in texts if len(text) > 60]
    assert len(texts) >= 16
    assert [text for text in texts if not NAMED.search(text)] == []


def test_each_warning_of_the_core_names_a_page():
    words = [
        "".join(re.findall(r'"([^"]*)"', body))
        for path in (ROOT / "cpp" / "contactx" / "audit").glob("*.cpp")
        for body in re.findall(r"::words\(\) const\n\{(.*?)\n\}", path.read_text(), re.DOTALL)
    ]
    assert len(words) >= 2
    assert [text for text in words if not NAMED.search(text)] == []


@pytest.mark.parametrize("error", ["ConvergenceError", "NotFiniteError"])
def test_each_text_of_a_refused_step_names_a_page(error):
    """Texts that are written where the error is raised; others come from what is tested above."""
    calls = [call for path in PYTHON for call in calls_to(error, path)]
    assert calls
    texts = [literals(call) for call in calls]
    assert [text for text in texts if text and not NAMED.search(text)] == []


# What a message asks for, where it does not say what an argument must be
ASKS = re.compile(
    r"\b(give|take|write|pass|call|leave|make|set|check|repair|use|correct|support|let|put|list|"
    r"create|go on|interpolate|restart|pip install|refine|raise|must|needs?|return|"
    r"is the disk full)\b",
    re.I,
)


@pytest.mark.parametrize("path", PYTHON, ids=lambda path: path.name)
def test_other_messages_say_what_to_do(path):
    """Errors that are made of a text of their own; others hand on what was raised below."""
    kinds = ("ValueError", "TypeError", "RuntimeError", "AttributeError", "OSError", "ImportError")
    calls = [call for kind in kinds for call in calls_to(kind, path)]
    # What checkpoints refuse is raised again by LoadSteps, which says what to do
    handed_on = ("error.errno", "_INSTEAD", "advice", "type(theirs)")
    if path.name in ("checkpoint.py", "steps.py"):
        calls = [call for call in calls if not literals(call).startswith(("it ", " is"))]
    silent = [
        text
        for text, call in ((literals(call), call) for call in calls)
        if re.search(r"\w", text)
        and not ASKS.search(text)
        and not any(h in ast.unparse(call) for h in handed_on)
    ]
    assert silent == []
