# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two elastic bodies that touch in a line or a point, by the scenes of the demos."""

from __future__ import annotations

import math

import cattaneo_mindlin
import hertz_axisymmetric
import hertz_cylinder
import numpy as np

import reference
import story
from published.drawing import curve
from published.half_space import JOHNSON
from published.record import Answer, Case, solve, steps


def line() -> Answer:
    problem, contact = hertz_cylinder.create(0.006, "finite")
    iterations = solve(problem)
    E, nu = hertz_cylinder.E, hertz_cylinder.NU
    exact = reference.HertzCylinder(
        2 * contact.force[1], 1.0, reference.contact_modulus(E, nu, E, nu)
    )
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    p = story.nodal_pressure(contact)
    drawn = curve(x, p, ("x / R", "pressure / E"), exact.pressure, 0.2)
    return Answer(float(p.max()), iterations, drawn, exact.peak_pressure)


def point() -> Answer:
    problem, contact = hertz_axisymmetric.create(0.003, method="node-to-surface")
    iterations = solve(problem)
    E, nu = hertz_axisymmetric.E, hertz_axisymmetric.NU
    exact = reference.HertzSphere(contact.force[1], 1.0, reference.contact_modulus(E, nu, E, nu))
    r = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    p = story.nodal_pressure(contact)
    drawn = curve(r, p, ("r / R", "pressure / E"), exact.pressure, 0.1)
    # The mean square of r under Hertz's pressure is 2 a^2/5
    load = contact.area * p
    radius = math.sqrt(2.5 * float(load @ r**2 / load.sum()))
    return Answer(radius, iterations, drawn, exact.contact_radius)


def mindlin() -> Answer:
    scene = cattaneo_mindlin.create(0.04, "finite")
    iterations: list[int] = []
    problem, contact = scene.problem, scene.contact

    def press(t: float) -> None:
        scene.press.g.value[...] = -0.18 * t

    def push(t: float) -> None:
        scene.push.g.value[...] = 0.028 * t

    iterations += steps(problem, 4, press)
    scene.friction.value = cattaneo_mindlin.FRICTION
    iterations += steps(problem, 4, push)
    exact = cattaneo_mindlin.formula(contact)
    tractions = cattaneo_mindlin.Tractions(scene)
    # The second moment of the shear: mu p0 pi/8 (b^3 - c^4/b)
    b, c = exact.half_width, exact.stick_half_width
    moment = float((tractions.area * tractions.q) @ tractions.x**2)
    expected = exact.friction * exact.peak_pressure * math.pi / 8 * (b**3 - c**4 / b)

    def shown(x: np.ndarray) -> np.ndarray:
        return exact.shear(x)

    near = np.abs(tractions.x) < 1
    drawn = curve(tractions.x[near], tractions.q[near], ("x", "shear"), shown)
    return Answer(moment, iterations, drawn, expected)


CASES = [
    Case(
        "hertz_line",
        "Cylinder on a block",
        f"Hertz 1882; {JOHNSON}, section 4.2",
        "largest pressure by force",
        line,
    ),
    Case(
        "hertz_sphere",
        "Sphere on a block",
        f"Hertz 1882; {JOHNSON}, section 4.2",
        "contact radius by force",
        point,
    ),
    Case(
        "mindlin_cylinders",
        "Cattaneo and Mindlin: cylinders pushed sideways",
        f"Cattaneo 1938, Mindlin 1949; {JOHNSON}, section 7.2",
        "second moment of the shear",
        mindlin,
    ),
]
