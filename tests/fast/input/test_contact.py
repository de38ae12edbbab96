# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of a contact."""

import numpy as np

import contactx as cx
from dolfinx import fem

from inputs.rows import constant, refused, scene, solved, table

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
        "NoneType None": None,
        "str '0.3'": "0.3",
        "list": [0.1, 0.2],
        "bool True": True,
        r"complex 0\.3j": 0.3j,
        "ndarray array": np.array([0.3]),
        "UFLType": fem.Function,
    }
    return {
        TypeError: [
            (option(**{name: value}), NOT_A_NUMBER.format(name, said))
            for said, value in kinds.items()
            if said in (some or kinds)
        ],
        ValueError: [(option(**{name: value}), f"{name} is {value}: give a") for value in finite],
    }


ROWS = {
    TypeError: [
        (option(adjust="0.1"), "adjust is str '0.1': give a length"),
        (
            lambda: function("friction", 0.3, dtype=np.complex128),
            "friction holds complex128 values: give real numbers in double precision",
        ),
        (lambda: used(offset=constant(0.1 + 1j)), "offset holds complex128 values: give real"),
        (option(tangential_factor="small"), "tangential_factor is"),
        (option(search_distance="1"), "search_distance is str '1': give a length, or None"),
        (option(search_distance=[1.0]), "search_distance is list .*: give a length, or None"),
        (option(tied="no"), "tied is str 'no': give True or False"),
        (option(tied=2), "tied is int 2: give True or False"),
        (option(frictoin=0.3), "unexpected keyword argument 'frictoin'"),
        (lambda: later("active", "no"), "active is str 'no': give True or False"),
    ],
    ValueError: [
        (option(adjust=-1.0), "adjust is -1: give a finite length"),
        (option(adjust=float("nan")), "adjust is nan: give a finite"),
        (option(adjust=0.1, tied=True), "a tie keeps the gaps"),
        (lambda: function("friction", np.nan), "friction is not finite: give finite numbers"),
        (lambda: function("friction", -1.0), r"friction is -1: give numbers of at least 0"),
        (lambda: function("offset", np.inf), "offset is not finite: give finite numbers"),
        (lambda: used(offset=constant(np.nan)), "offset is not finite: give finite numbers"),
        (
            lambda: used(friction=constant((0.1, 0.2))),
            r"friction is a constant of shape \(2,\): give one of a number",
        ),
        (option(tangential_factor=0.0), r"tangential_factor is 0: give a positive number"),
        (option(search_distance=-1), "search_distance is -1: give a positive length"),
        (option(search_distance=0.0), r"search_distance is 0: give a positive length"),
        (option(search_distance=np.nan), "search_distance is nan: give a positive length"),
        (option(sliding="large"), 'sliding must be "finite" or "small", not \'large\''),
        (option(sliding=None), 'sliding must be "finite" or "small", not None'),
        (option(sliding=np.zeros(2)), 'sliding must be "finite" or "small"'),
        (option(method="mortar"), 'method must be "node-to-surface" or "surface-to-surface", not'),
        (option(method=["node-to-surface"]), 'method must be "node-to-surface" or'),
        (option(tied=True, friction=0.3), "tied excludes friction"),
        (lambda: used(tied=True, friction=constant(0.0)), "tied excludes friction"),
    ],
    AttributeError: [
        (lambda: later("friction", 0.3), "friction cannot be replaced .* change its value"),
        (lambda: later("actve", False), "a Contact has no 'actve': check the spelling"),
    ],
    RuntimeError: [
        (lambda: setattr(scene().contact(), "active", False), "pass it to a ContactProblem first"),
        (lambda: tied_slip(), "is tied: its nodes do not slip"),
    ],
}


def tied_slip():
    blocks = scene()
    contact = blocks.contact(tied=True)
    blocks.problem(contact)
    return contact.slip


@table(
    ROWS,
    numbers("friction", [-0.1, float("nan"), float("inf"), -float("inf")]),
    numbers("offset", [float("nan")], some=["str '0.3'"]),
)
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
