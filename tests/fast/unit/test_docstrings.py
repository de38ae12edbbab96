# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each public name says what it takes, what it returns and what it raises."""

import ast
import inspect
import re
import textwrap
from collections.abc import Callable, Iterator
from typing import Any

import pytest

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
