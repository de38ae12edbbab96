# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia that hit something."""

from __future__ import annotations

import math
from functools import cache

from mpi4py import MPI

import impact_bars
import numpy as np
from impact_bars import SCENES, VELOCITY, Bars

import contactx as cx
import ufl
from dolfinx import mesh

import story
from published.drawing import curve
from published.record import Answer, Case
from scenes.grids import faces
from scenes.materials import st_venant_kirchhoff

_SOURCE = "S. Timoshenko and J. N. Goodier, Theory of Elasticity, 3rd ed., 1970, section 169"


@cache
def _bars(scene: str) -> Bars:
    """Bars of 100 cells, after they have bounced."""
    bars = Bars(scene, 100, 1.0)
    bars.run()
    return bars


def _answer(value: float, bars: Bars) -> Answer:
    """A value of bars, and the contact force over time."""

    def exact(t: np.ndarray) -> np.ndarray:
        return np.where(t < 2, 1.0, 0.0)

    labels = ("time c / L", "force / rho c v A")
    return Answer(value, bars.iterations, curve(bars.times, bars.forces, labels, exact))


def force() -> Answer:
    """Contact force of a bar on a wall."""
    bars = _bars(SCENES[0])
    return _answer(float(bars.steady.mean()), bars)


def duration() -> Answer:
    """Time for which a bar is on a wall."""
    bars = _bars(SCENES[0])
    return _answer(bars.duration, bars)


def velocity() -> Answer:
    """Velocity of one of two bars after they have hit each other."""
    bars = _bars(SCENES[1])
    return _answer(bars.velocity / VELOCITY, bars)


def rocking() -> Answer:
    """A tilted block that falls back on its base: time until it stands; m, kg, s.

    It has turned about its lower right corner by half of the angle at which it would tip over.
    """
    width, height, density, gravity = 0.25, 1.0, 2000.0, 9.81
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[-width, 0], [0, height]], [4, 16], mesh.CellType.quadrilateral
    )
    u = story.displacement(domain)
    V = u.function_space
    limit = math.atan(width / height)
    tilt = limit / 2
    cos, sin = math.cos(tilt), math.sin(tilt)
    u.interpolate(
        lambda x: np.stack([(cos - 1) * x[0] + sin * x[1], (cos - 1) * x[1] - sin * x[0]])
    )
    contact = cx.Contact(
        cx.Surface(faces(domain, ((1, 0.0),)), 1), cx.Plane((0, 0), (0, 1)), friction=1.0
    )
    dynamics = cx.ContactDynamics(
        lambda w: ufl.replace(st_venant_kirchhoff(u, 1e9, 0.2), {u: w}),
        u,
        density=density,
        contacts=[contact],
        loads=-density * gravity * ufl.TestFunction(V)[1] * ufl.dx,
        petsc_options_prefix="rocking_",
    )
    x = V.tabulate_dof_coordinates()
    top = np.argmin(np.linalg.norm(x - [0, height, 0], axis=1))
    low = np.argmin(np.linalg.norm(x, axis=1))
    times, angles, iterations = [0.0], [tilt], []
    for step in cx.LoadSteps(dynamics, 40, update=lambda t: None, t_end=0.4, progress=False):
        iterations.append(step.iterations)
        times.append(step.t)
        angles.append(math.asin((u.x.array[2 * top] - u.x.array[2 * low]) / height))
    # It goes down until it stands; what comes then is not looked at
    stands = float(np.interp(0.0, -np.array(angles), times))
    rate = math.sqrt(3 * gravity / (2 * math.hypot(width, height)))
    exact = math.acosh(1 / (1 - tilt / limit)) / rate

    def housner(t: np.ndarray) -> np.ndarray:
        return limit - (limit - tilt) * np.cosh(rate * t)

    drawn = curve(times, angles, ("time, s", "angle"), housner, exact)
    return Answer(stands, iterations, drawn, exact)


CASES = [
    Case(
        "bar_force",
        "Elastic bar that hits a rigid wall",
        _SOURCE,
        f"contact force over rho c v A, mean from {impact_bars.BETWEEN[0]} "
        f"to {impact_bars.BETWEEN[1]} L/c",
        force,
        published=1.0,
        problem="bar",
    ),
    Case(
        "bar_time",
        "Elastic bar that hits a rigid wall",
        _SOURCE,
        "time of contact over L/c",
        duration,
        published=2.0,
        problem="bar",
    ),
    Case(
        "bars_velocity",
        "Two like elastic bars that hit each other",
        _SOURCE,
        "mean velocity after over that before",
        velocity,
        published=1.0,
        note="By bars of 100 cells; the rest is in waves of the length of some cells that stay "
        "in the bars. With 200 cells it is 1.2 %.",
    ),
    Case(
        "rocking",
        "Tilted block that falls back on its base, friction 1",
        "G. W. Housner, Bull. Seismol. Soc. Am. 53, 1963, 403-417",
        "time until it stands, s",
        rocking,
        note="Housner's block is rigid, slender and on a corner. How far it tilts to the other "
        "side depends on what the impact sets in vibration: by 0.34 to 0.38 of the limit on seven "
        "meshes, stiffnesses and time steps; his law of impact gives 0.387.",
    ),
]
