# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The quick starts of README and manual run as they stand; names and demos have their pages."""

import re
import tomllib

import numpy as np

import contactx as cx

import pages

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
