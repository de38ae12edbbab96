# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A ring in another one, held by nothing but their interference, or by nothing at all."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

import contactx as cx
from dolfinx import fem

import reference
from stress.check import Check
from stress.families.grid import label, variants
from stress.grids import Array, Body, even, grid
from stress.parts import Parts
from stress.scene import METHODS, SLIDINGS, Case, Scene
from stress.sides import View, apart, unfolded, watch

_RADII = (0.5, 1.0, 1.5)


def _ring(inner: float, outer: float, n: int) -> Body:
    return grid(
        even(inner, outer, max(2, n // 10)),
        even(0, 2 * np.pi, n),
        shape=lambda r, a: (r * np.cos(a), r * np.sin(a)),
        ring=True,
    )


def _case(
    interference: float,
    *,
    method: str,
    sliding: str,
    slave: str,
    n: tuple[int, int],
    material: str,
    steps: int,
) -> Case:
    """The inner ring is free of supports, the outer one held without being strained."""
    a, b, c = _RADII
    # Meshed with the interference of the small ones, given as an offset of the large ones
    meshed = abs(interference) <= 0.02
    wide = b + interference if meshed else b
    parts = Parts(_ring(a, wide, n[0]), _ring(b, c, n[1]), material=material)
    rim = np.unique(parts.bodies[1].faces["x1"])
    right, left = (int(rim[k(parts.x[rim, 0])]) for k in (np.argmax, np.argmin))
    for node, component in ((right, 0), (right, 1), (left, 1)):
        parts.fix(node, component)
    offset = fem.Constant(parts.mesh, 0.0)
    surfaces = [parts.surface(0, "x1"), parts.surface(1, "x0")]
    faces = [(0, parts.facets(0, "x1")), (1, parts.facets(1, "x0"))]
    if slave == "outer":
        surfaces, faces = surfaces[::-1], faces[::-1]
    contact = cx.Contact(*surfaces, method=method, sliding=sliding, offset=offset)

    def update(t: float) -> None:
        offset.value = 0.0 if meshed else t * interference

    def answers() -> list[Check]:
        forces = parts.forces()
        ring = np.unique(parts.bodies[0].cells)
        most = float(np.abs(forces).max())
        if interference < 0:
            return [Check("rings that do not touch rest", most, 1e-12)]
        lame = reference.PressFit(interference, *_RADII, 1.0, 0.3, 1.0, 0.3).pressure
        total = np.abs(forces[ring].sum(axis=0)).max() / most
        # Chords of both rings take from the interference or add to it
        chords = sum(b * (1 - np.cos(np.pi / k)) for k in n)
        error = abs(_pressure(parts, forces) / lame - 1)
        return [
            Check("forces on the ring cancel", float(total), 1e-8),
            Check("pressure against Lame", error, 0.1 + interference + chords / interference),
        ]

    views: list[View] = [unfolded(parts)] if parts.nonlinear else []
    views.append(lambda: _inside(parts))
    if meshed and sliding == "finite":
        views.append(apart(parts, *faces, radius=b, method=method, size=c - b))
    return parts.case(
        contact,
        update,
        size=c - b,
        steps=steps,
        step_answers=watch(*views),
        answers=answers,
    )


def _inside(parts: Parts) -> Iterator[Check]:
    """The inner ring has not left the outer one."""
    farthest = np.linalg.norm(parts.positions()[parts.bodies[0].cells], axis=2).max()
    yield Check("the ring is inside the rim of the other one", float(farthest / _RADII[2]), 1.0)


def _pressure(parts: Parts, forces: Array) -> float:
    """Mean pressure between the rings, by the stresses of the inner one."""
    nodes = np.unique(parts.bodies[0].faces["x1"])
    # It may have turned, which nothing prevents
    x = parts.positions()[nodes]
    inwards = -x / np.linalg.norm(x, axis=1, keepdims=True)
    return float((forces[nodes] * inwards).sum() / (2 * np.pi * _RADII[1]))


def rings() -> Iterator[Scene]:
    """By how much the inner ring is too large; too small if it is negative."""
    for own in variants(
        method=METHODS,
        sliding=SLIDINGS,
        slave=("inner", "outer"),
        n=((64, 80), (80, 64)),
        material=("linear", "neo-hooke"),
    ):
        for interference in (-0.1, -0.02, 0.01, 0.02, 0.05):
            steps = 2 if own["material"] == "linear" else 1
            if own["material"] != "linear" and (interference < 0 or own["sliding"] == "small"):
                # With frozen kinematics a ring that turns becomes smaller, which relieves it
                continue
            yield Scene(
                "ring free in another one, interference",
                f"{interference:g}",
                label(own),
                partial(_case, interference, steps=steps, **own),
                # Nothing tells where a ring lies that touches nothing
                partial(bool, interference > 0),
            )
