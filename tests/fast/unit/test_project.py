# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Docstrings, stubs of the bindings, the conda recipe and the table of peers."""

import ast
import inspect
import re
import runpy
import textwrap
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jinja2
import pytest
import yaml
from peers import table

import contactx as cx

HEADING = re.compile(r"^(Args|Returns|Yields|Raises|Attributes):\n((?: .*\n|\n)*)", re.M)


def is_ours(function: Any) -> bool:
    return getattr(function, "__module__", "").startswith("contactx")


def public() -> Iterator[tuple[str, Any]]:
    """Functions, and properties, of all public classes with those that they inherit."""
    for name in cx.__all__:
        kind = getattr(cx, name)
        for member in dir(kind):
            if member.startswith("_") and member != "__init__":
                continue
            found = inspect.getattr_static(kind, member)
            if isinstance(found, classmethod | staticmethod):
                found = found.__func__
            function = found.fget if isinstance(found, property) else found
            # A dataclass makes its own
            is_made = member == "__init__" and hasattr(kind, "__dataclass_fields__")
            if inspect.isfunction(function) and is_ours(function) and not is_made:
                yield f"{name}.{member}", found


PUBLIC = dict(public())
FUNCTIONS = {name: found for name, found in PUBLIC.items() if not isinstance(found, property)}
PROPERTIES = {name: found.fget for name, found in PUBLIC.items() if isinstance(found, property)}


def sections(function: Callable[..., Any]) -> dict[str, str]:
    return dict(HEADING.findall((inspect.getdoc(function) or "") + "\n"))


def entries(section: str) -> list[str]:
    """Names that a section explains, in its order."""
    return re.findall(r"^    (\w+):", section, re.M)


@pytest.mark.parametrize("name", cx.__all__)
def test_public_classes_are_documented(name):
    kind = getattr(cx, name)
    assert inspect.getdoc(kind)
    attributes = entries(sections(kind).get("Attributes", ""))
    for field in getattr(kind, "__dataclass_fields__", {}):
        assert field in attributes


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arguments_are_those_of_the_signature(name):
    function = FUNCTIONS[name]
    taken = [p for p in inspect.signature(function).parameters if p not in ("self", "cls")]
    assert entries(sections(function).get("Args", "")) == taken


@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_is_returned_is_said_where_something_is(name):
    function = FUNCTIONS[name]
    gives = inspect.signature(function).return_annotation not in (None, "None")
    if name.endswith(".__init__"):
        gives = False
    assert gives == bool({"Returns", "Yields"} & set(sections(function)))


@pytest.mark.parametrize("name", FUNCTIONS | PROPERTIES)
def test_what_is_raised_is_said(name):
    """What a function raises by itself; further errors come from what it calls."""
    function = {**FUNCTIONS, **PROPERTIES}[name]
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    raised = {
        ast.unparse(node.exc.func)
        for node in ast.walk(tree)
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call)
    }
    assert raised <= set(entries(sections(function).get("Raises", "")))


@pytest.mark.parametrize("name", PROPERTIES)
def test_properties_are_documented(name):
    assert inspect.getdoc(PROPERTIES[name])


@pytest.mark.parametrize("name", PROPERTIES)
def test_arrays_have_a_shape(name):
    function = PROPERTIES[name]
    if "NDArray" in str(inspect.signature(function).return_annotation):
        assert "shape (" in inspect.getdoc(function)


ROOT = Path(__file__).parents[3]


def test_types_are_those_of_the_compiled_extension():
    pytest.importorskip("pybind11_stubgen", reason="make installs it with the extra lint")
    stubs = runpy.run_path(str(ROOT / "tools" / "stubs.py"))
    assert stubs["STUB"].read_text(encoding="utf-8") == stubs["stub"](), "run make stubs"


def recipe():
    """The recipe, as conda reads it on Linux with Python 3.13."""
    text = (ROOT / "recipe" / "meta.yaml").read_text()
    template = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string(text)
    rendered = template.render(
        PYTHON="python",
        compiler=lambda language: f"{language}_compiler",
        stdlib=lambda language: f"{language}_stdlib",
    )
    lines = (re.sub(r"(.*)  # \[win or py<312\]$", "", line) for line in rendered.splitlines())
    return yaml.safe_load("\n".join(lines))


def test_the_recipe_is_that_of_the_project():
    meta = recipe()
    tables = tomllib.loads((ROOT / "pyproject.toml").read_text())
    project = tables["project"]
    assert meta["package"] == {"name": project["name"], "version": project["version"]}
    assert "skip" not in meta["build"]
    assert meta["about"]["license"] == project["license"]
    assert meta["about"]["license_file"] == project["license-files"]
    for name in meta["about"]["license_file"]:
        assert (ROOT / name).exists()

    def names(requirements):
        return {re.split(r"[ <>=]", r, maxsplit=1)[0] for r in requirements}

    needs = meta["requirements"]
    # PyPI's wheel of Eigen has a name of its own
    build = {name.removeprefix("cmeel-") for name in names(tables["build-system"]["requires"])}
    assert build <= names(needs["host"])
    assert names(project["dependencies"]) <= names(needs["run"])
    assert "fenics-dolfinx 0.11.*" in needs["run"]


def row(peer, h, cpu, date="2026-11-21", **more):
    return {"peer": peer, "setting": "hard", "h": h, "cpu": cpu, "date": date, **more}


def test_measured_rows_take_the_place_of_earlier_ones(tmp_path):
    path = tmp_path / "peers.csv"
    path.write_text("peer,setting,h\n")
    table.update([row("A", "0.01", "3.0", version="2.20"), row("B", "0.01", "2.0")], path)
    new = [row("A", "0.02", "1.0", "2026-11-26"), row("A", "0.01", "2.9", "2026-11-26")]
    every = table.update([*new, row(table.OURS, "0.01", "0.5", "2026-11-26", commit="abc")], path)
    found = [(r["peer"], r["h"], r["cpu"], r["date"]) for r in table.rows(path)]
    assert found == [
        (table.OURS, "0.01", "0.5", "2026-11-26"),
        ("A", "0.02", "1.0", "2026-11-26"),
        ("A", "0.01", "2.9", "2026-11-26"),
        ("B", "0.01", "2.0", "2026-11-21"),
    ]
    assert len(every) == len(found)
    assert list(table.others(path)) == ["A, hard", "B, hard"]


def test_versions_stay_as_they_are_written():
    names = list(table.others())
    assert any(name.startswith("CalculiX 2.20, ") for name in names)
    assert not any(name.startswith(table.OURS) for name in names)
    assert all(row["date"] for row in table.rows())
