# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Belts, beams and layers, whose contact is found by how they bend."""

from __future__ import annotations

import math

from mpi4py import MPI

import numpy as np
from scipy.optimize import brentq

import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag
from published.drawing import curve, deformed
from published.record import Answer, Case, solve, steps
from scenes import slender
from scenes.grids import faces
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem, pair_of


def belt() -> Answer:
    """A belt half around a drum, its right end pulled until all of it slides."""
    friction = 0.3
    strip = slender.belt(120, friction=friction)
    reports = slender.run_belt(strip, 0.01, 0.0)
    u, contact = strip.u, strip.contact
    x = u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    p = story.nodal_pressure(contact)
    angle = np.arctan2(x[:, 0], x[:, 1])
    # The tension is p R; where the ends are held, the belt bends
    inside = (np.abs(angle) < 1.2) & (p > 0)
    rise, log_middle = np.polyfit(angle[inside], np.log(p[inside]), 1)

    def exact(t: np.ndarray) -> np.ndarray:
        return np.exp(log_middle + friction * t)

    near = np.abs(angle) < 1.3
    drawn = curve(angle[near], p[near], ("angle", "pressure / E"), exact)
    iterations = [report.iterations for report in reports]
    return Answer(math.exp(rise * math.pi), iterations, drawn, math.exp(friction * math.pi))


def lifted() -> Answer:
    """A heavy strip on a rigid floor, lifted at one end: how high it comes by the force."""
    length, thick, young, weight, lift = 40.0, 1.0, 1000.0, 1.2e-3, 18.0
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[0, 0], [length, thick]], [60, 2], CellType.quadrilateral
    )
    u = story.displacement(domain, 2)
    V = u.function_space
    tags = faces(domain, ((1, 0.0), (0, length), (0, 0.0)))
    up = fem.Constant(domain, (0.0, 0.0))
    F = story.elasticity(u, young, 0.0) + story.traction(u, tags, 2, up)
    F += weight / thick * ufl.TestFunction(V)[1] * ufl.dx
    bcs = [story.fix(u, tags, 0, 0.0, 3)]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Plane((0, 0), (0, 1)))
    problem = make_problem(F, u, [contact], bcs)

    def update(t: float) -> None:
        up.value[1] = t * weight * lift / 2 / thick

    iterations = list(steps(problem, 5, update))
    x = V.tabulate_dof_coordinates()
    tip = np.argmin(np.linalg.norm(x - [length, thick / 2, 0], axis=1))
    height = weight * lift**4 / (24 * young * thick**3 / 12)
    return Answer(float(u.x.array[2 * tip + 1]), iterations, deformed(u, scale=100), height)


def guided() -> Answer:
    """A cantilever bent over a round guide by a force at its end, in one step.

    It lies on the guide, of radius R, as far as its moment is E I/R: over all but a length
    l = E I/(P R), which bends as a cantilever of its own.
    """
    length, thick, young, radius, free = 20.0, 0.2, 1000.0, 500.0, 10.0
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[0, 0], [length, thick]], [80, 2], CellType.quadrilateral
    )
    u = story.displacement(domain, 2)
    V = u.function_space
    tags = faces(domain, ((1, 0.0), (0, length), (0, 0.0)))
    stiff = young * thick**3 / 12
    force = stiff / (radius * free)
    F = st_venant_kirchhoff(u, young, 0.0)
    F += story.traction(u, tags, 2, fem.Constant(domain, (0.0, -force / thick)))
    bcs = [story.fix(u, tags, i, 0.0, 3) for i in range(2)]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Sphere((0.0, -radius), radius))
    problem = make_problem(F, u, [contact], bcs)
    iterations = solve(problem)
    x = V.tabulate_dof_coordinates()
    tip = np.argmin(np.linalg.norm(x - [length, thick / 2, 0], axis=1))
    lies = length - free
    depth = (lies**2 / 2 + lies * free) / radius + force * free**3 / (3 * stiff)
    return Answer(-float(u.x.array[2 * tip + 1]), iterations, deformed(u, scale=5), depth)


def receding_half_width() -> float:
    """Half of the width in which a layer of thickness 1 rests on a half-plane, under a line load.

    The integral equation of Keer, Dundurs and Tsai for like materials without friction: under the
    pressure p the layer's lower face and the half-plane have one slope. Chebyshev's points and
    weights of a pressure that vanishes as a square root at both ends.
    """
    k, step = np.linspace(1e-3, 50, 20000, retstep=True)
    # Symmetric and bending parts of a layer's compliance, over that of a half-plane
    even = (np.cosh(k) - 1) / (np.sinh(k) + k)
    odd = (np.cosh(k) + 1) / (np.sinh(k) - k)
    own = (even + odd) / 2 - 1
    n = 24
    angle = np.pi * np.arange(1, n + 1) / (n + 1)
    s, w = np.cos(angle), np.pi / (n + 1) * np.sin(angle) ** 2
    between = np.cos(np.pi * (np.arange(n // 2) + 0.5) / (n + 1))

    def excess(b: float) -> float:
        """Load that a half-width b carries, less the one that is applied."""
        # Pressures less the load at the top do not bend it as k goes to 0
        waves = np.sin(np.outer(between * b, k))
        bent = (waves * own) @ (np.cos(np.outer(s * b, k)) - 1).T * step
        rows = w * b * (2 / (b * (between[:, None] - s)) + bent)
        squeezed = waves @ (even - 1) * step
        # Pressures are even
        half = n // 2
        pressure = np.linalg.solve(rows[:, :half] + rows[:, ::-1][:, :half], -squeezed)
        return float(2 * b * w[:half] @ pressure) - 1

    return float(brentq(excess, 1.0, 1.4))


def receding() -> Answer:
    """Half of a weightless layer of thickness 1 on a large block, pressed by a line load."""
    h = 1 / 24
    data = meshes.blocks(
        CellType.quadrilateral, (144, 24), (192, 144), size_upper=(6, 1), size_lower=(16, 12)
    )
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    force = 1e-3
    x = ufl.SpatialCoordinate(data.mesh)
    ds = ufl.Measure("ds", domain=data.mesh, subdomain_data=tags)
    loaded = ufl.conditional(ufl.lt(x[0], h), force / 2 / h, 0.0)
    F = story.elasticity(u, 1.0, 0.3)
    F += loaded * ufl.TestFunction(u.function_space)[1] * ds(int(Tag.UPPER_TOP))
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_BOTTOM),
    ]
    contact = pair_of(tags)
    problem = make_problem(F, u, [contact], bcs)
    iterations = solve(problem)
    place = u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    p = story.nodal_pressure(contact)
    drawn = curve(place, p / force, ("x / thickness", "pressure thickness / load"), None, 2.5)
    return Answer(float(place[p > 0].max()) + h / 2, iterations, drawn, receding_half_width())


CASES = [
    Case(
        "belt",
        "Belt half around a drum, friction 0.3",
        "Euler 1769, Eytelwein 1808",
        "ratio of the tensions, exp(mu pi), from the rise of the pressure",
        belt,
    ),
    Case(
        "lifted",
        "Heavy strip lifted off a floor at one end",
        "S. Timoshenko, Strength of Materials, part II, van Nostrand, 1941",
        "height of the end, q l^4/(24 E I) for a force of q l/2",
        lifted,
        note="Five load steps: in one step, on a mesh of 160 cells, the active set gives up two "
        "nodes an iteration and does not come to its end within the 50 of a solve; load steps cut.",
    ),
    Case(
        "guided",
        "Cantilever bent over a round guide",
        "S. Timoshenko, Strength of Materials, part II, van Nostrand, 1941; asked for in Physics "
        "Forums, Analysis of beam bending against constraint, 2008",
        "deflection of the end",
        guided,
        note="Between clamp and lift-off there is no pressure in theory, but a force where it "
        "lifts off: the active set takes many iterations, and closes nodes here and there.",
    ),
    Case(
        "receding",
        "Layer pressed on a half-plane by a line load: receding contact",
        "L. M. Keer, J. Dundurs and K. C. Tsai, J. Appl. Mech. 39, 1972, 1115-1120",
        "half-width over thickness, from their integral equation",
        receding,
        note="The equation is solved here by Chebyshev's points: no table of its roots was found.",
    ),
]
