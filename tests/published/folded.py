# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that fold onto themselves: one surface is slave and master."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

import contactx as cx
import ufl
from dolfinx import fem, mesh

import meshes
import story
from meshes import Tag
from published.drawing import deformed
from published.record import Answer, Case, steps
from scenes.grids import faces
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem

# Over the radius of the ring's middle, and over E' I / R^3
THICKNESS, PRESSURE = 0.01, 8.0
NU, CELLS, STEPS = 0.3, 48, 10
# Part of the radius by which the ring is wider and less high, so that it does not stay a circle
UNROUND = 0.005


# Radius of the section of the torus, by that of its middle line; cells of a quarter of it
ROUND, AROUND = 0.02, 24


def ring_force(pressure: float, distance: float = 0.0) -> float:
    """Force between opposite points of a ring under outer pressure, in E' I / R^2.

    The equations of Flaherty, Keller and Rubinow for a quarter of an inextensible ring, which is
    circular and of curvature 1 without load: from the point in contact at the origin, where it is
    level, to the one where it stands upright. By them opposite points touch at 5.247, and the
    curvature there vanishes at 10.34, from where on there is more than a point in contact.

    Args:
        pressure: Force per length, in E' I / R^3.
        distance: Half of what is left between the opposite points, over R.
    """

    def quarter(across: float, bend: float, contact: float) -> np.ndarray:
        def along(_: float, state: np.ndarray) -> list[float]:
            angle, _, _, level, upright, bend = state
            c, s = np.cos(angle), np.sin(angle)
            return [bend, c, s, -pressure * s, pressure * c, level * s - upright * c]

        start = [0, 0, 0, across, -contact / 2, bend]
        return np.asarray(solve_ivp(along, (0, np.pi / 2), start, rtol=1e-9, atol=1e-11).y[:, -1])

    def missed(unknown: np.ndarray) -> list[float]:
        angle, _, height, level, _, _ = quarter(*unknown)
        return [angle + np.pi / 2, height + distance, level]

    found = root(missed, [0.0, 0.5, 4.0])
    assert found.success
    return float(found.x[2])


def ring() -> Answer:
    """A thin ring that is pressed flat from outside until its inner face meets itself."""
    outer = 1 + THICKNESS / 2
    data = meshes.hoop(CELLS, 1, radius=outer, thickness=THICKNESS, height=-outer)
    x, tags = data.mesh.geometry.x, data.facet_tags
    x[:, 0] *= 1 + UNROUND
    x[:, 1] *= 1 - UNROUND
    u = story.displacement(data.mesh, 2)
    # E' I is 1
    young = (1 - NU**2) * 12 / THICKNESS**3
    pressure = fem.Constant(data.mesh, 0.0)
    F = st_venant_kirchhoff(u, young, NU)
    deformation = ufl.Identity(2) + ufl.grad(u)
    pushed = ufl.cofac(deformation) * ufl.FacetNormal(data.mesh)
    ds = ufl.Measure("ds", domain=data.mesh, subdomain_data=tags)
    F += pressure * ufl.inner(pushed, ufl.TestFunction(u.function_space)) * ds(Tag.UPPER_CONTACT)
    contact = cx.Contact.all(tags, int(Tag.UPPER_TOP))
    problem = make_problem(F, u, [contact], _symmetry(u))

    def update(t: float) -> None:
        pressure.value = t * PRESSURE

    iterations = list(steps(problem, STEPS, update))
    # Slaves may be on either side
    force = float(contact.multiplier @ contact.area)
    return Answer(force, iterations, deformed(u), ring_force(PRESSURE))


def _symmetry(u: fem.Function) -> list[fem.DirichletBC]:
    """Conditions that keep both axes of symmetry where they are."""
    V = u.function_space
    return [_held(V, axis) for axis in range(2)]


def _held(V: fem.FunctionSpace, axis: int) -> fem.DirichletBC:
    """Condition that keeps in a plane of symmetry what is in it."""
    part, _ = V.sub(axis).collapse()
    there = fem.locate_dofs_geometrical(
        (V.sub(axis), part), lambda x: np.isclose(x[axis], 0, atol=1e-9)
    )
    return fem.dirichletbc(fem.Function(part), there, V.sub(axis))


def torus() -> Answer:
    """A slender solid torus, pressed flat in its plane until it meets itself.

    A quarter of it: its middle line is in one plane of symmetry, the points that meet are in
    another one. While the load rises it is a little larger where these points are, which leads
    past the pressure at which the torus buckles.
    """
    n = [2 * AROUND, 3, 2]
    domain = mesh.create_box(
        MPI.COMM_WORLD,
        [[-np.pi / 2, -1.0, 0.0], [np.pi / 2, 1.0, 1.0]],
        n,
        mesh.CellType.hexahedron,
    )
    tags = faces(domain, [(1, -1.0), (1, 1.0), (2, 1.0)])
    x = domain.geometry.x
    turn, p, q = x.T.copy()
    # Three cells each way, the middle one cut in half: there the section has a side, no corner
    q = np.where(np.isclose(q, 0.5), 1 / 3, q)
    away = 1 + ROUND * p * np.sqrt(1 - np.maximum(q, 1 / 3) ** 2 / 2)
    x[:, 0] = (1 + UNROUND) * away * np.cos(turn)
    x[:, 1] = (1 - UNROUND) * away * np.sin(turn)
    x[:, 2] = ROUND * q * np.sqrt(1 - p**2 / 2)
    u = story.displacement(domain, 2)
    V = u.function_space
    area, inertia = _section(3)
    load, pinch = (fem.Constant(domain, 0.0) for _ in range(2))
    F = st_venant_kirchhoff(u, 1 / inertia, NU, 4)
    # A force per length of the middle line, which stays normal to it, spread over the section
    X = ufl.SpatialCoordinate(domain)
    normal = ufl.inv(ufl.Identity(3) + ufl.grad(u)).T * ufl.as_vector([X[0], X[1], 0])
    inward = normal / ufl.sqrt(ufl.inner(normal, normal))
    dx = ufl.dx(metadata={"quadrature_degree": 4})
    along = load + pinch * (X[1] ** 2 - X[0] ** 2)
    F += along / area * ufl.inner(inward, ufl.TestFunction(V)) * dx
    bcs = [_held(V, axis) for axis in range(3)]
    surface = cx.Surface(tags, 1, 2, 3)
    contact = cx.Contact(surface, surface)
    problem = make_problem(F, u, [contact], bcs)

    def update(t: float) -> None:
        load.value, pinch.value = t * PRESSURE, np.sin(np.pi * t)

    iterations = list(steps(problem, STEPS, update))
    # Slaves are on either side: what keeps the upper part, but for the nodes that are held
    kept = fem.assemble_vector(fem.form(F)).array.reshape(-1, 3)
    force = 4 * float(kept[V.tabulate_dof_coordinates()[:, 1] > 1e-6, 1].sum())
    return Answer(force, iterations, _outline(u), ring_force(PRESSURE, ROUND * np.sqrt(17 / 18)))


def _outline(u: fem.Function) -> Callable[[Any], None]:
    """A drawing of the torus, as its plane of symmetry cuts it."""
    x = u.function_space.tabulate_dof_coordinates()
    away = np.hypot(x[:, 0] / (1 + UNROUND), x[:, 1] / (1 - UNROUND))
    moved = x + u.x.array.reshape(-1, 3)
    edges = []
    for side in (1, -1):
        # Corners of the cells alone lie on the circle
        at = np.flatnonzero(np.isclose(x[:, 2], 0) & (side * (away - 1) > 0.9 * ROUND))
        edges.append(moved[at[np.argsort(np.arctan2(x[at, 1], x[at, 0]))]][::side, :2])
    half = np.concatenate(edges)

    def draw(axes: Any) -> None:
        for sign in (1, -1):
            axes.fill(sign * half[:, 0], half[:, 1], color="#4878a8")
        axes.set_aspect("equal")
        axes.axis("off")

    return draw


def _section(across: int) -> tuple[float, float]:
    """Area and second moment of the torus's section, a polygon: the cells have straight sides."""
    p = np.linspace(-1, 1, across + 1)
    side = np.stack([np.sqrt(1 - p**2 / 2), p * np.sqrt(0.5)], axis=1)
    turned = [side @ np.array([[c, s], [-s, c]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    a = ROUND * np.concatenate([quarter[:-1] for quarter in turned])
    b = np.roll(a, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    second = cross @ (a[:, 0] ** 2 + a[:, 0] * b[:, 0] + b[:, 0] ** 2) / 12
    return float(cross.sum()) / 2, float(second)


CASES = [
    Case(
        "ring",
        "Thin ring pressed flat from outside until it meets itself",
        "J. E. Flaherty, J. B. Keller and S. I. Rubinow, SIAM J. Appl. Math. 23, 1972, 446-455",
        "force between opposite points under the pressure 8 E' I/R^3, in E' I/R^2",
        ring,
        note="The force is from their equations, solved here; by these opposite points touch at "
        "5.247 and have no curvature at 10.34, as published. The ring is 0.01 R thick, and its "
        "axes differ by a hundredth; the pressure is raised in ten steps: it buckles on the way.",
    ),
    Case(
        "torus",
        "Slender solid torus pressed flat from outside until it meets itself",
        "J. E. Flaherty, J. B. Keller and S. I. Rubinow, SIAM J. Appl. Math. 23, 1972, 446-455",
        "force between opposite points under the load 8 E I/R^3, in E I/R^2",
        torus,
        note="Their equations are solved here for middle lines that stay a thickness apart. On "
        "the way the load is a little larger where the torus will touch, so that it buckles "
        "there. With half as many cells around it the force is 7.1 % too small.",
        slow=True,
    ),
]
