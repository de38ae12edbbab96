# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of a contact."""

import numpy as np

import contactx as cx
from dolfinx import fem

from inputs.rows import Row, constant, refused, scene, solved, table

NOT_A_NUMBER = "{} must be a number, a fem.Constant or a fem.Function, not {}"


def option(**options):
    return lambda: scene().contact(**options)


def used(**options):
    blocks = scene()
    solved(blocks, blocks.contact(**options))


def function(name, value, **kind):
    blocks = scene()
    solved(blocks, blocks.contact(**{name: blocks.scalar(value, **kind)}))


def later(name, value):
    """Set an attribute of a contact that belongs to a problem."""
    blocks = scene()
    contact = blocks.contact(friction=0.1)
    blocks.problem(contact)
    setattr(contact, name, value)


def numbers(name, finite, some=None):
    """What is no number, or some kinds of it, and numbers that are out of range."""
    kinds = {
        "None": (None, "NoneType None"),
        "a text": ("0.3", "str '0.3'"),
        "a list": ([0.1, 0.2], "list"),
        "a truth value": (True, "bool True"),
        "a complex number": (0.3j, r"complex 0\.3j"),
        "an array": (np.array([0.3]), r"ndarray array"),
        "a class": (fem.Function, "UFLType"),
    }
    rows = [
        Row(f"{name}: {kind}", option(**{name: value}), TypeError, NOT_A_NUMBER.format(name, said))
        for kind, (value, said) in kinds.items()
        if kind in (some or kinds)
    ]
    return rows + [
        Row(f"{name}: {value}", option(**{name: value}), ValueError, f"{name} is {value}: give a")
        for value in finite
    ]


ROWS = [
    Row("adjust: a text", option(adjust="0.1"), TypeError, "adjust is str '0.1': give a length"),
    Row("adjust: -1", option(adjust=-1.0), ValueError, "adjust is -1: give a finite length"),
    Row("adjust: nan", option(adjust=float("nan")), ValueError, "adjust is nan: give a finite"),
    Row("adjust: a tie", option(adjust=0.1, tied=True), ValueError, "a tie keeps the gaps"),
    *numbers("friction", [-0.1, float("nan"), float("inf"), -float("inf")]),
    *numbers("offset", [float("nan")], some=["a text"]),
    Row(
        "friction: complex values",
        lambda: function("friction", 0.3, dtype=np.complex128),
        TypeError,
        "friction holds complex128 values: give real numbers in double precision",
    ),
    Row(
        "offset: a complex constant",
        lambda: used(offset=constant(0.1 + 1j)),
        TypeError,
        "offset holds complex128 values: give real",
    ),
    Row(
        "friction: a NaN function",
        lambda: function("friction", np.nan),
        ValueError,
        "friction is not finite: give finite numbers",
    ),
    Row(
        "friction: a negative function",
        lambda: function("friction", -1.0),
        ValueError,
        r"friction is -1: give numbers of at least 0",
    ),
    Row(
        "offset: an infinite function",
        lambda: function("offset", np.inf),
        ValueError,
        "offset is not finite: give finite numbers",
    ),
    Row(
        "offset: a NaN constant",
        lambda: used(offset=constant(np.nan)),
        ValueError,
        "offset is not finite: give finite numbers",
    ),
    Row(
        "friction: a vector",
        lambda: used(friction=constant((0.1, 0.2))),
        ValueError,
        r"friction is a constant of shape \(2,\): give one of a number",
    ),
    Row(
        "tangential factor: zero",
        option(tangential_factor=0.0),
        ValueError,
        r"tangential_factor is 0: give a positive number",
    ),
    Row(
        "tangential factor: a text",
        option(tangential_factor="small"),
        TypeError,
        "tangential_factor is",
    ),
    Row(
        "search distance: negative",
        option(search_distance=-1),
        ValueError,
        "search_distance is -1: give a positive length",
    ),
    Row(
        "search distance: zero",
        option(search_distance=0.0),
        ValueError,
        r"search_distance is 0: give a positive length",
    ),
    Row(
        "search distance: NaN",
        option(search_distance=np.nan),
        ValueError,
        "search_distance is nan: give a positive length",
    ),
    Row(
        "search distance: a text",
        option(search_distance="1"),
        TypeError,
        "search_distance is str '1': give a length, or None",
    ),
    Row(
        "search distance: a list",
        option(search_distance=[1.0]),
        TypeError,
        "search_distance is list .*: give a length, or None",
    ),
    Row(
        "sliding: unknown",
        option(sliding="large"),
        ValueError,
        'sliding must be "finite" or "small", not \'large\'',
    ),
    Row(
        "sliding: None",
        option(sliding=None),
        ValueError,
        'sliding must be "finite" or "small", not None',
    ),
    Row(
        "sliding: an array",
        option(sliding=np.zeros(2)),
        ValueError,
        'sliding must be "finite" or "small"',
    ),
    Row(
        "method: unknown",
        option(method="mortar"),
        ValueError,
        'method must be "node-to-surface" or "surface-to-surface", not',
    ),
    Row(
        "method: a list",
        option(method=["node-to-surface"]),
        ValueError,
        'method must be "node-to-surface" or',
    ),
    Row("tied: a text", option(tied="no"), TypeError, "tied is str 'no': give True or False"),
    Row("tied: a number", option(tied=2), TypeError, "tied is int 2: give True or False"),
    Row(
        "tied with friction", option(tied=True, friction=0.3), ValueError, "tied excludes friction"
    ),
    Row(
        "tied with friction that may come",
        lambda: used(tied=True, friction=constant(0.0)),
        ValueError,
        "tied excludes friction",
    ),
    Row(
        "an unknown option",
        option(frictoin=0.3),
        TypeError,
        "unexpected keyword argument 'frictoin'",
    ),
    Row(
        "an option replaced",
        lambda: later("friction", 0.3),
        AttributeError,
        "friction cannot be replaced .* change its value",
    ),
    Row(
        "an attribute misspelt",
        lambda: later("actve", False),
        AttributeError,
        "a Contact has no 'actve': check the spelling",
    ),
    Row(
        "active: a text",
        lambda: later("active", "no"),
        TypeError,
        "active is str 'no': give True or False",
    ),
    Row(
        "active: too early",
        lambda: setattr(scene().contact(), "active", False),
        RuntimeError,
        "pass it to a ContactProblem first",
    ),
    Row(
        "a slip that is not measured",
        lambda: tied_slip(),
        RuntimeError,
        "is tied: its nodes do not slip",
    ),
]


def tied_slip():
    blocks = scene()
    contact = blocks.contact(tied=True)
    blocks.problem(contact)
    return contact.slip


@table(ROWS)
def test_refused(row):
    refused(row)


def test_what_looks_odd_but_is_meant():
    for options in (
        {"search_distance": float("inf")},
        {"friction": np.float64(0.3), "offset": np.float32(0.01)},
        {"friction": np.array(0.3)},
        {"tied": np.True_},
    ):
        blocks = scene()
        contact = blocks.contact(**options)
        solved(blocks, contact)
        assert isinstance(contact, cx.Contact)
        assert contact.force[1] > 0
