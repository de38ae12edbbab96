# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The two loadings of the face slabs: turned by a soft support, pushed together from the sides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import contactx as cx

from meshes import FaceSlab
from slab_results import rotation
from slab_scene import Scene, Setting

# Settlement of the support below the middle for a rotation of one degree, m; a first guess
_SETTLEMENT = 0.53
# Relative error of the rotation at which the tries end
TOLERANCE = 1e-3


@dataclass(frozen=True)
class Try:
    """Rotation in degrees that a settlement ds of the support, m, gives."""

    settlement: float
    rotation: float


def slice_of(model: FaceSlab) -> FaceSlab:
    """Plane-strain slice of slabs at mid length, with the same cells across."""
    thickness = float(model.thickness_at(model.length / 2))
    return replace(
        model, length=1.0, rows=1, cushion_rows=None, thickness=thickness, thickening=0.0
    )


def guess(wanted: float) -> float:
    """Settlement to start from for a rotation in degrees, m."""
    return _SETTLEMENT * wanted


def secant(
    turn: Callable[[float], float],
    wanted: float,
    *,
    show: Callable[[Try], object] = lambda _: None,
    most: int = 12,
) -> Try:
    """Find the settlement for a rotation by the secant method.

    Args:
        turn: Rotation in degrees for a settlement in metres.
        wanted: Wanted rotation, degrees.
        show: Called with each try.
        most: Largest number of tries.

    Returns:
        The last try, which meets the rotation.

    Raises:
        RuntimeError: If no try meets it.
    """
    tries: list[Try] = []
    settlement = guess(wanted)
    while len(tries) < most:
        tries.append(Try(settlement, turn(settlement)))
        show(tries[-1])
        if abs(tries[-1].rotation / wanted - 1) < TOLERANCE:
            return tries[-1]
        # From the origin at first: without settlement there is hardly a rotation
        before, last = tries[-2] if len(tries) > 1 else Try(0.0, 0.0), tries[-1]
        slope = (last.settlement - before.settlement) / (last.rotation - before.rotation)
        settlement = last.settlement + slope * (wanted - last.rotation)
    raise RuntimeError(f"no settlement in {most} tries turns the slabs by {wanted} degrees")


def try_supports(
    setting: Setting, wanted: float, pressure: float, show: Callable[[Try], object]
) -> Try:
    """Find the support on a slice, in one step each: in proportion to the load all is the same."""
    thin = replace(setting, model=slice_of(setting.model))

    def turn(settlement: float) -> float:
        return rotation(scheme_1(thin, settlement, pressure, steps=1, progress=False))

    return secant(turn, wanted, show=show)


def scheme_1(
    setting: Setting,
    settlement: float,
    pressure: float,
    *,
    steps: int = 10,
    each: Callable[[Scene], object] = lambda _: None,
    progress: bool = True,
) -> Scene:
    """Press the slabs on a support that is softest below the middle.

    Args:
        setting: Setting.
        settlement: Settlement ds below the middle, m.
        pressure: Final pressure, MPa.
        steps: Number of steps.
        each: Called after each step.
        progress: Whether to show a progress bar and the table of steps.
    """
    scene = Scene(setting, springs=True)
    scene.compliance.value = settlement / pressure

    def update(t: float) -> None:
        scene.pressure.value = pressure * t

    for _ in cx.LoadSteps(scene.problem, steps, update=update, progress=progress):
        each(scene)
    return scene


def scheme_2(
    setting: Setting,
    pressure: float,
    push: float,
    *,
    steps: int = 20,
    each: Callable[[Scene], object] = lambda _: None,
    progress: bool = True,
) -> Scene:
    """Press the slabs on a firm support, then push the cushion's sides inward.

    Args:
        setting: Setting; its model should have joints that gape.
        pressure: Pressure, MPa.
        push: Displacement of each side at the end, m.
        steps: Number of steps of the push, after one of the pressure.
        each: Called after each step.
        progress: Whether to show a progress bar and the table of steps.
    """
    scene = Scene(setting, springs=False)

    def update(t: float) -> None:
        step = t * (steps + 1)
        scene.pressure.value = pressure * min(1.0, step)
        for side, sign in zip(scene.push, (1, -1), strict=True):
            side.value = sign * push * max(0.0, step - 1) / steps

    for _ in cx.LoadSteps(scene.problem, steps + 1, update=update, progress=progress):
        each(scene)
    return scene
