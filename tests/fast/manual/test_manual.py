# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pages of the manual, and figures in them, in README and in pictures."""

import re
import tomllib

import numpy as np

import contactx  # noqa: F401  # it comes first
import contactx as cx

import pages

# isort: split
import csv
import json

import pytest
from peers import table
from PIL import Image

import figures
import measured
from published import gallery
from published.cases import CASES

# What a page may have beside Python, which runs: other languages, parts of files, what Sphinx makes
SHOWN = r"text|\{code-block\} (console|diff|text)|\{literalinclude\} \S+"
MADE = r"\{(toctree|eval-rst)\}|\{include\} \S+"


def test_readme(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = pages.run(pages.ROOT / "README.md", silent=True)
    contact = names["contact"]
    tangential, normal = np.abs(contact.force)
    # The block slides at the end: full friction
    assert normal > 0 and np.isclose(tangential, 0.3 * normal, rtol=1e-6)
    assert (contact.status.x.array == 2).any()
    assert (tmp_path / "block.pvd").exists()


def test_first_tutorial(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = pages.run(pages.MANUAL / "tutorials" / "elasticity.md")
    assert np.allclose(names["floor"].force, (0, 0.01), atol=1e-9)


def test_no_python_is_shown_without_being_run():
    """A reader cannot tell apart what is a part of the program and what is not."""
    readme, demos = pages.ROOT / "README.md", pages.MANUAL / "demos"
    for path in [readme, *sorted(pages.MANUAL.rglob("*.md"))]:
        for block in pages.blocks(path):
            is_known = re.fullmatch(rf"python|{SHOWN}|{MADE}", block.language)
            assert is_known, f"{path}, line {block.line}: {block.language}"
        # Four blanks make code, too: commands of the README, formulas of the demos' docstrings
        if path != readme and path.parent != demos:
            assert not pages.indented(path), f"{path}: {pages.indented(path)}"


def test_cpp_tutorial_shows_the_demo():
    """What the page shows is the demo's source; what it says of its parts is in them."""
    page = pages.MANUAL / "tutorials" / "cpp.md"
    demo = pages.ROOT / "demos" / "cpp" / "sliding_block"
    moving = pages.ROOT / "tests" / "dolfinx_cpp"
    shown = pages.inclusions(page)
    assert [part.file for part in shown] == [
        demo / "CMakeLists.txt",
        demo / "sliding_block.py",
        demo / "main.cpp",
        demo / "main.cpp",
        demo.parent / "pressed_block" / "main.cpp",
        demo.parent / "own_forms" / "main.cpp",
        moving / "falling_block.py",
        moving / "dynamics.cpp",
        moving / "dynamics.cpp",
        moving / "fields.cpp",
        moving / "several_fields.py",
    ]
    codes = [part.code for part in shown]
    project, forms, contact, loop, newton, own, step, dynamics, steps, blocks, heat = codes
    assert project.startswith("cmake_minimum_required") and "COMPONENTS dolfinx" in project
    assert forms.startswith('"""Forms of linear elasticity') and "forms = [F, J]" in forms
    assert "cx::Contact" in contact and contact.rstrip().endswith(";")
    calls = ("begin_step", "settle", "limit", "accept")
    assert all(loop.count(f"assembler.{call}(") == 1 for call in calls)
    assert "acceleration" in step and step.rstrip().endswith("J = derivative(F, u)")
    assert "newton.set_form" in newton and "assembler.restore()" in newton
    assert 10 <= own.count("// contact") <= 15 and "newton.setJ" in own
    assert "nullptr" in blocks and "bcs, push, contact" in blocks
    assert "F_warm =" in heat
    assert "cx::DynamicForms" in dynamics and "dynamics->step(" in steps
    # Code of the page's own would be code that nothing compiles
    languages = {block.language.split()[0] for block in pages.blocks(page)}
    assert languages == {"{literalinclude}", "{code-block}"}
    commands = [block.code for block in pages.blocks(page) if block.language.endswith("console")]
    for path in re.findall(r"demos/\S+", "\n".join(commands)):
        assert (pages.ROOT / path).exists()


def test_each_demo_has_a_page():
    demos = {
        path.stem
        for path in (pages.ROOT / "demos").glob("*.py")
        if "__main__" in path.read_text(encoding="utf-8")
    }
    written = {path.stem for path in (pages.MANUAL / "demos").glob("*.md")} - {"index"}
    assert written == demos


def test_each_public_name_is_in_the_reference():
    text = (pages.MANUAL / "reference" / "python.md").read_text(encoding="utf-8")
    written = {word.rpartition(".")[2] for word in re.findall(r"::\s+(contactx\S+)", text)}
    assert set(cx.__all__) <= written


def test_versions_are_one():
    pyproject = tomllib.loads((pages.ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    version = pyproject["project"]["version"]
    assert cx.__version__ == version
    citation = (pages.ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {version}\n" in citation
    changes = (pages.ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"^## (\S+)", changes, re.MULTILINE)[1] == version


WRITE = "write the record into them: python tools/figures.py"


def page(name):
    return (figures.ROOT / name).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def sections():
    return measured.load()


def test_pages_have_the_recorded_figures(sections):
    found = figures.differences(page, sections)
    assert not found, "\n".join([*found, WRITE])


def test_another_figure_in_a_page_is_found(sections):
    """A word, a number of a sentence, and one of a table."""
    (old,) = re.findall(r"contactx takes [\d.]+ s", page("README.md"))
    changed = {
        "README.md": page("README.md").replace(old, "contactx takes 0.3 s"),
        "CHANGELOG.md": page("CHANGELOG.md").replace("published problems", "problems"),
    }
    speed = "docs/manual/numbers/speed.md"
    line = next(line for line in page(speed).splitlines() if "penalty 200" in line)
    changed[speed] = page(speed).replace(line, line.replace("| 7 |", "| 6 |"))
    found = figures.differences(lambda name: changed.get(name, page(name)), sections)
    assert [text.split()[0] for text in found] == list(changed)
    assert "0.3 s" in found[0] and old in found[0]


@pytest.mark.parametrize("since", ["", "One more sentence. And another one."])
def test_rewritten_pages_are_the_same(since, sections, monkeypatch, tmp_path):
    """Of another record, pages can be made that have its figures."""
    other = json.loads(json.dumps(sections))
    for row in other["methods"]["rows"]:
        row.update(cpu=10 * row["cpu"], p_l2_best=row["p_l2_best"] / 2)
    other["stress_map"].update(date="2030-01-01", since=since)
    for row in other["stress_map"]["rows"]:
        row.update(scenes=row["of"], WRONG=0)
    pages = {name for name, _ in figures.said()} | {table.page for table in figures.TABLES}
    for name in pages:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(page(name), encoding="utf-8")
    monkeypatch.setattr(figures, "ROOT", tmp_path)
    assert figures.rewrite(sections) == []
    assert "README.md" in figures.rewrite(other)
    assert figures.differences(page, other) == []
    # There and back: nothing else has changed
    figures.rewrite(sections)
    monkeypatch.undo()
    assert all((tmp_path / name).read_text(encoding="utf-8") == page(name) for name in pages)


def test_the_gallery_has_what_was_recorded(sections):
    rows = sections["gallery"]["rows"]
    assert [row["name"] for row in rows] == [case.name for case in CASES]
    assert gallery.page(rows, "gallery") == page("docs/gallery.md"), WRITE
    for row in rows:
        assert (figures.ROOT / "docs" / "gallery" / f"{row['name']}.png").exists()


@pytest.mark.parametrize("name", figures.PICTURES)
def test_pictures_show_what_was_recorded(name, sections):
    with Image.open(figures.ROOT / "docs" / f"{name}.png") as image:
        assert image.text["Source"] == figures.digest(sections, name), WRITE


def test_the_gallery_and_the_benchmark_have_the_same_values_of_nafems(sections):
    values = {row["name"]: row["contactx"] for row in sections["gallery"]["rows"]}
    rows = [
        row
        for row in sections["nafems"]["rows"]
        if row["order"] == 1 and row["method"] == "node-to-surface"
    ]
    of_punch = {row["friction"]: row["value"] for row in rows if row["h"] == 1.0}
    (of_roller,) = (row["value"] for row in rows if row["problem"] == "roller")
    assert values["r0094_1"] == pytest.approx(of_roller, rel=1e-4)
    assert values["r0094_2"] == pytest.approx(of_punch[0.0], rel=1e-4)
    assert values["r0094_2_friction"] == pytest.approx(of_punch[0.1], rel=1e-4)


def test_each_section_says_where_it_was_measured(sections):
    for name, section in sections.items():
        assert section["machine"] and section["command"].startswith(
            ("python tests/", "python tools/")
        ), name
        assert re.fullmatch(r"\d{4}-\d\d-\d\d", section["date"]), name
        assert re.fullmatch(r"[0-9a-f]{7,}\+?", section["commit"]), name
        assert section["rows"] and "failed" not in section["rows"][0], name


def test_no_part_of_a_benchmark_is_recorded(monkeypatch):
    rows = [{"h": 0.1, "failed": "for a reason"}]
    monkeypatch.setattr(measured, "write", lambda sections: pytest.fail("it was recorded"))
    assert measured.run("hertz", lambda argv: rows, ["--record"]) == 1
    with pytest.raises(SystemExit, match="takes the whole benchmark"):
        measured.run("hertz", lambda argv: rows, ["--record", "0.02"])


def test_where_the_peers_were_measured(monkeypatch, tmp_path):
    """The days and the machine of the run, and which rows are older."""
    rows = table.rows()
    monkeypatch.setattr(figures, "PEERS", tmp_path / "peers.csv")

    def write(known):
        for number, row in enumerate(rows):
            is_new = number < known
            row.update(date="2030-01-01", machine="a machine" if is_new else "", version="1")
        with figures.PEERS.open("w", newline="") as file:
            writer = csv.DictWriter(file, table.COLUMNS)
            writer.writeheader()
            writer.writerows(rows)

    write(len(rows) - 1)
    begins, last = "on 2030-01-01 on a machine, but for", f"{rows[-1]['peer']} 1"
    assert figures.of_peers() == f"{begins} 1 row of {last}, of an earlier day"
    of_last = sum(row["peer"] == rows[-1]["peer"] for row in rows)
    write(len(rows) - of_last)
    assert figures.of_peers() == f"{begins} {last}, of an earlier day"
    write(len(rows))
    assert figures.of_peers() == "on 2030-01-01 on a machine"
