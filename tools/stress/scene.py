# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a scene of the stress map is, and what it is made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from stress import judge
from stress.check import Check
from stress.tools import Tool

# What a message must name for its advice to swap both sides to count
SWAP = r"(?i)(swap|exchange)|the other way round|(take|make) [^.;:]* (as )?the slave"
METHODS = ("node-to-surface", "surface-to-surface")
SLIDINGS = ("finite", "small")
SHORT = {"node-to-surface": "n2s", "surface-to-surface": "s2s"}


@dataclass
class Case:
    """A problem with its loads and what is known of its answer.

    Attributes:
        problem: The problem.
        contacts: Its contacts.
        F: Residual of the bulk.
        bcs: Dirichlet conditions.
        update: Function of t that sets the loads.
        size: Size of the smaller body.
        modulus: Young's modulus of the softest body.
        steps: Load steps.
        into: How far a slave node may lie in the master's body, for each contact; None where it
            is not looked for.
        answers: Known answers at the end.
        step_answers: Known answers after each accepted step of a given t.
        notes: What is worth knowing, though it is not wrong, at the end.
        cut: Whether steps that fail are cut.
        tools: What each contact has for a master, None where that is a surface.
        swapped: The same case with slave and master swapped, if there is one: a refusal that asks
            for that is right if this is solved.
    """

    problem: cx.ContactProblem
    contacts: Sequence[cx.Contact]
    F: ufl.Form
    bcs: Sequence[fem.DirichletBC]
    update: Callable[[float], object]
    size: float = 1.0
    modulus: float = 1.0
    steps: Any = 1
    into: Sequence[float | None] = ()
    answers: Callable[[], Sequence[Check]] = tuple
    step_answers: Callable[[float], Sequence[Check]] = field(default=lambda t: ())
    notes: Callable[[], Sequence[Check]] = tuple
    cut: bool = True
    tools: Sequence[Tool | None] = ()
    swapped: Callable[[], Case] | None = None

    def given(self) -> judge.Problem:
        """What the judge is given: nothing of contactx but displacement and multipliers."""
        rows = zip_longest(self.contacts, self.into, self.tools)
        contacts = [_given(*row) for row in rows]
        return judge.Problem(self.F, self.problem.u, self.bcs, contacts, self.size)


def _given(contact: cx.Contact, into: float | None, tool: Tool | None) -> judge.Contact:
    slave, master, offset = contact.slave, contact.master, contact.offset

    def reported() -> tuple[Any, Any]:
        return contact.slave_nodes, contact.multiplier

    return judge.Contact(
        slave.facet_tags,
        slave.tags,
        judge.Obstacle(tool.level, lambda: tool.at) if tool else master.tags,
        contact.friction,
        contact.method == "surface-to-surface",
        contact.sliding == "finite",
        lambda: float(getattr(offset, "value", offset)),
        reported,
        into,
    )


@dataclass(frozen=True)
class Scene:
    """A scene of the map.

    Attributes:
        family: The axis that it is on.
        value: Where on that axis.
        variant: What else tells it from the others.
        make: Makes its case.
        solvable: Whether the scene can be solved rightly in another way, such as many small steps;
            not looked for if None.
        advice: Whether the scene is solved rightly once it is changed as a refusal says, by a
            regular expression for the words of that.
    """

    family: str
    value: str
    variant: str
    make: Callable[[], Case]
    solvable: Callable[[], bool] | None = None
    advice: Mapping[str, Callable[[], bool]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name of the scene."""
        return f"{self.family}: {self.value}, {self.variant}"


def relative(name: str, computed: Any, expected: Any, allowed: float, least: float = 0.0) -> Check:
    """Compare with a known answer, relative to its largest entry.

    Args:
        name: What is compared.
        computed: Computed values.
        expected: Known values.
        allowed: Relative error that is allowed.
        least: Size of the values below which they count as rounding.
    """
    computed, expected = np.asarray(computed), np.asarray(expected)
    scale = max(float(np.abs(expected).max(initial=0.0)), least)
    error = float(np.abs(computed - expected).max(initial=0.0))
    return Check(name, error / scale if scale > 0 else error, allowed)
