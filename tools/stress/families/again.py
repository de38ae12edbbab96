# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loads that are repeated, taken back, or cancel: nothing may be left of them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from stress.blocks import Blocks
from stress.check import Check
from stress.families.grid import label, scenes, variants
from stress.grids import Array, even, grid
from stress.parts import Parts
from stress.scene import METHODS, SLIDINGS, Case, Scene
from stress.sides import pressed, watch
from stress.tools import Ball, Floor

_UNITS = ((1e-6, 1.0), (1.0, 1e-6), (1.0, 1.0), (1e3, 1e6), (1e6, 1e-3), (1e-6, 1e6))


def repeated() -> Iterator[Scene]:
    """Units of length and modulus; the same loads are solved for twice."""
    options = list(
        variants(
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.0, 0.3),
            radius=(None, 2.0),
        )
    )
    options = [{**row, "side": 0.05 if row["friction"] > 0 else 0.0} for row in options]
    yield from scenes("solved twice, units", _UNITS, options, _twice)


def _twice(units: tuple[float, float], **options) -> Case:
    length, modulus = units
    blocks = Blocks(
        cell=CellType.quadrilateral,
        length=length,
        modulus=modulus,
        n_upper=(6, 4),
        n_lower=(7, 4),
        **options,
    )
    case = blocks.case()

    def answers() -> list[Check]:
        before = blocks.u.x.array.copy()
        case.problem.solve()
        moved = np.abs(blocks.u.x.array - before).max() / np.abs(before).max()
        return [
            Check("iterations of the second solve", case.problem.report.iterations, 0.0),
            Check("movement in the second solve", float(moved), 1e-9),
        ]

    case.answers = answers
    return case


def released() -> Iterator[Scene]:
    """Units of length and modulus; a disc is pressed into a block and lifted off."""
    options = list(
        variants(
            depth=(0.01, 0.3),
            material=("linear", "svk"),
            method=METHODS,
            steps=(2, 6),
            cut=(True, False),
        )
    )
    yield from scenes("pressed and let go, units", _UNITS, options, _released)


def _released(units: tuple[float, float], depth, material, method, steps, cut) -> Case:
    length, modulus = units
    body = grid(length * even(-2, 2, 16), length * even(-2, 0, 6))
    parts = Parts(body, material=material, young=(modulus,))
    parts.hold(0, "y0")
    at = length * np.array([0.02, 1.0])
    tool = Ball(parts.mesh, at, length)
    contact = cx.Contact(parts.surface(0, "y1"), tool.obstacle, method=method)
    most = [0.0]

    def update(t: float) -> None:
        # At the end it is off by more than a chord, within which means of gaps are not zero
        down = depth * 2 * t if t <= 0.5 else depth - (depth + 0.3) * (2 * t - 1)
        tool.move(at - length * np.array([0.0, down]))

    def step_answers(t: float) -> list[Check]:
        most[0] = max(most[0], float(np.abs(parts.forces()).max()))
        return [c for c in look(t) if most[0] > 0 or "missed" not in c.name]

    def answers() -> list[Check]:
        left = np.abs(parts.displacements()).max() / (length * depth)
        return [
            Check("it was pressed", float(not most[0] > 0), 0.0),
            Check("displacement that is left", float(left), 1e-7),
            Check("force that is left", float(np.abs(parts.forces()).max() / most[0]), 1e-7),
        ]

    look = watch(pressed(parts, parts.facets(0, "y1"), tool, length, method))
    return parts.case(
        contact,
        update,
        size=length,
        modulus=modulus,
        steps=steps,
        cut=cut,
        step_answers=step_answers,
        tools=[tool],
        answers=answers,
    )


def heated() -> Iterator[Scene]:
    """Units of length and modulus; blocks that touch expand alike, free of stress."""
    options = list(
        variants(
            blocks=(1, 2),
            heat=(1e-6, 1e-2),
            method=METHODS,
            friction=(0.0, 0.3),
        )
    )
    for units in _UNITS:
        for row in options:
            values = ":".join(f"{v:g}" for v in units)
            name = {**row, "heat": f"{row['heat']:g}"}
            yield Scene(
                "free of stress, units", values, label(name), partial(_heated, units, **row)
            )


def _heated(units: tuple[float, float], blocks, heat, method, friction) -> Case:
    length, modulus = units
    bodies = [grid(length * even(0, 2, 6), length * even(0, 1, 3))]
    if blocks == 2:
        bodies.append(grid(length * even(0, 2, 4), length * even(1, 2, 2)))
    parts = Parts(*bodies, young=(modulus,) * blocks)
    domain = parts.mesh
    strain = fem.Constant(domain, 0.0)
    v = ufl.TestFunction(parts.u.function_space)
    # Twice the bulk modulus of the plane, for what free expansion makes of it
    K = modulus / ((1 + parts.nu) * (1 - 2 * parts.nu))
    parts.F -= fem.Constant(domain, K) * strain * ufl.div(v) * ufl.dx
    lift = fem.Constant(domain, 0.0)
    for number, body in enumerate(parts.bodies):
        low = body.faces["y0"].ravel()
        left, right = (int(low[k(parts.x[low, 0])]) for k in (np.argmin, np.argmax))
        parts.fix(left, 0)
        for corner in (left, right):
            # The upper one is lifted by as much as the lower one grows
            parts.fix(corner, 1, lift if number else None)
    tool = None
    if blocks == 1:
        tool = Floor(domain, (0.0, 0.0))
        contact = cx.Contact(
            parts.surface(0, "y0"), tool.obstacle, method=method, friction=friction
        )
    else:
        faces = parts.surface(1, "y0"), parts.surface(0, "y1")
        contact = cx.Contact(*faces, method=method, friction=friction)

    def update(t: float) -> None:
        strain.value = heat * t
        lift.value = heat * t * length

    def answers() -> list[Check]:
        given: Array = parts.displacements()
        expected = heat * (parts.x - parts.x.min(axis=0))
        error = np.abs(given - expected).max() / (heat * 2 * length)
        force = float(np.abs(contact.force).max())
        return [
            Check("free expansion", float(error), 1e-7),
            Check("no force", force / (modulus * heat * length), 1e-8),
        ]

    return parts.case(
        contact,
        update,
        size=length,
        modulus=modulus,
        answers=answers,
        tools=[tool],
    )
