# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows of the tables of bad input: what is done, and what must come of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks

# What must be raised, by what is done and what must be said of it: which argument, what was wrong,
# what to do
type Rows = dict[type[Exception], list[tuple[Callable[[], Any], str]]]


class Row(NamedTuple):
    """One bad input."""

    error: type[Exception]
    do: Callable[[], Any]
    message: str


def table(*tables: Rows) -> pytest.MarkDecorator:
    """Parametrise a test by the rows of some tables."""
    every = [item for rows in tables for item in rows.items()]
    rows = [Row(error, *pair) for error, pairs in every for pair in pairs]
    return pytest.mark.parametrize("row", rows, ids=[row.message[:60] for row in rows])


def refused(row: Row) -> None:
    """Check a row."""
    with pytest.raises(row.error, match=row.message):
        row.do()


def scene() -> Blocks:
    """Two small blocks."""
    return Blocks(CellType.triangle)


def solved(blocks: Blocks, contact: cx.Contact, **options: Any) -> None:
    """Make a problem and solve it."""
    blocks.problem(contact, **options).solve()


def constant(value: Any) -> fem.Constant:
    """A constant on some mesh."""
    return fem.Constant(scene().u.function_space.mesh, value)


def problem(blocks=None, **changed):
    """Make a problem of which something is changed, and solve it."""
    blocks = blocks or scene()
    given = {
        "F": blocks.F,
        "u": blocks.u,
        "bcs": blocks.bcs,
        "petsc_options_prefix": "hostile_",
        **changed,
    }
    if "contacts" not in given:
        given["contacts"] = [blocks.contact()]
    cx.ContactProblem(given.pop("F"), given.pop("u"), **given).solve()


def with_(name, make):
    """A problem with an argument that is made of the scene."""

    def do():
        blocks = scene()
        problem(blocks, **{name: make(blocks)})

    return do
