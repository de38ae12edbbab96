# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What CONTRIBUTING.md and pages of the manual say of the tree is so.

The rules of the loop are where their page says, each reason of a refused step has a page, and pages
of figures name scripts that are there; for the figures see tests/fast/manual.
"""

import ast
import json
import re
from pathlib import Path

import pytest
from face_slab import OPENING, ROW, SETTLED, TABLE, TEXT_STRESS, differs

from contactx._host import newton

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
    assert len(rooms) == 13


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


MANUAL = ROOT / "docs" / "manual"
BENCHMARKS = ROOT / "tools" / "bench"
PAGES_OF_FIGURES = sorted([*MANUAL.glob("numbers/*.md"), *MANUAL.glob("theory/*.md")])


@pytest.mark.parametrize("page", PAGES_OF_FIGURES, ids=lambda page: page.stem)
def test_scripts_that_are_named_are_there(page):
    text = page.read_text(encoding="utf-8")
    for name in re.findall(r"`(?:tools/bench/)?(bench_\w+\.py)", text):
        assert (BENCHMARKS / name).is_file()
    for name in re.findall(r"`((?:demos|tests|docs|tools)/[\w/.]+)", text):
        assert (ROOT / name).exists()


def test_all_scripts_are_listed():
    text = (MANUAL / "numbers" / "scripts.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(bench_\w+\.py)`", text))
    assert named == {path.name for path in BENCHMARKS.glob("bench_*.py")}


def test_files_of_the_core_that_the_theory_names_are_there():
    core = ROOT / "cpp" / "contactx"
    for page in MANUAL.glob("theory/*.md"):
        text = page.read_text(encoding="utf-8")
        for line in re.findall(r"^\*(?:Core|Python).*", text, re.M):
            for part, root in re.findall(r"(Core|Python): ((?:`[^`]+`,? ?)+)", line, re.I):
                base = core if part.lower() == "core" else ROOT / "python" / "contactx"
                for name in re.findall(r"`([^`]+)`", root):
                    assert (base / name).exists(), f"{page.name}: {name}"


def test_the_papers_table_is_that_of_the_demo():
    """Rows of the paper, and how far what is computed is from them: within 4 % at mid length."""
    text = (MANUAL / "numbers" / "dam.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([\d.]+) \| ([\d.]+) MPa \| ([\d.]+) MPa \| (.+) \|$", text, re.M)
    assert [(float(angle), float(p)) for angle, p, *_ in rows] == list(TABLE)
    for angle, p, paper, computed in rows:
        assert float(paper) == TABLE[float(angle), float(p)][0]
        middle, percent, whole, of_whole, openings = computed.split(" | ")
        stress = float(middle.removesuffix(" MPa"))
        assert percent == differs(stress, float(paper))
        assert abs(stress / float(paper) - 1) < 0.04
        far = float(whole.removesuffix(" MPa")) / float(paper) - 1
        assert float(of_whole.removesuffix(" %")) == pytest.approx(100 * far, abs=0.51)
        if (float(angle), float(p)) == ROW:
            opening = float(openings.split(",")[0])
            assert f"| {OPENING} mm | {opening} mm (" in text
            assert abs(opening / OPENING - 1) < 0.05
            assert f"| {TEXT_STRESS} MPa | {middle} | {whole} (" in text
    (settled,) = re.findall(rf"\| {SETTLED:g} mm \| ([\d.]+) mm \(", text)
    assert abs(float(settled) / SETTLED - 1) < 0.02


THEORY = ROOT / "docs" / "manual" / "theory"


def rules(page: str) -> list[list[str]]:
    """Rules of a page with a place and a test; tables of what was measured have figures there."""
    rows = [
        [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        for line in (THEORY / page).read_text(encoding="utf-8").splitlines()
        if line.startswith("| ") and not line.startswith("| rule")
    ]
    return [row for row in rows if len(row) == 4]


OF_METHOD, OF_SOLVER = rules("rules.md"), rules("solver_rules.md")
RULES = OF_METHOD + OF_SOLVER
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


def test_rules_are_few():
    """Definitions change the answer, refusals keep wrong ones from being taken, rules neither."""
    text = (THEORY / "rules.md").read_text(encoding="utf-8")
    parts = re.split(r"^## (Definitions|Refusals|Rules: status)", text, flags=re.M)
    definitions, refusals, method = (
        sum(line.startswith("| ") and line.count(" | ") == 3 for line in part.splitlines())
        - part.count("| rule |")
        for part in (parts[2], parts[4], parts[6].split("## What was measured")[0])
    )
    assert len(OF_METHOD) == definitions + refusals + method
    assert f"{definitions} definitions, {refusals} refusals and {method} rules" in text
    assert method <= 49
    assert 0 < len(OF_SOLVER) <= 8


def test_rules_can_be_switched_off():
    """Each text that tools/stress/without.py replaces is there once."""
    for rule in json.loads((ROOT / "tools" / "stress" / "rules.json").read_text(encoding="utf-8")):
        for change in rule["off"]:
            text = (ROOT / "cpp" / "contactx" / change["file"]).read_text(encoding="utf-8")
            assert text.count(change["old"]) == 1, (rule["name"], change["old"])
            assert "OFF" in change["new"]


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
            assert re.search(rf"TEST\w*\(\s*{match[1]},\s*{match[2]}[,)]", CPP_TESTS), name
        else:
            file, test = name.split("::")
            found = [path for path in (ROOT / "tests").rglob(Path(file).name) if file in str(path)]
            assert any(f"def {test}(" in path.read_text(encoding="utf-8") for path in found), name


PAGES = ROOT / "docs" / "manual" / "errors"
PYTHON_FILES = sorted((ROOT / "python" / "contactx").rglob("*.py"))
CPP_FILES = sorted(
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


FROM_PYTHON = [parts for path in PYTHON_FILES for parts in texts_of_python(path)]
FROM_CPP = [parts for path in CPP_FILES for parts in texts_of_cpp(path)]
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
        parts for path in CPP_FILES if path.parent.name == "problem" for parts in texts_of_cpp(path)
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
    calls = [call for path in PYTHON_FILES for call in calls_to(error, path)]
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


@pytest.mark.parametrize("path", PYTHON_FILES, ids=lambda path: path.name)
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
