# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that fold onto themselves: one surface is slave and master."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

import contactx as cx
import ufl
from dolfinx import fem

import meshes
import story
from meshes import Tag
from published.drawing import deformed
from published.record import Answer, Case, steps
from scenes.materials import st_venant_kirchhoff

# Over the radius of the ring's middle, and over E' I / R^3
THICKNESS, PRESSURE = 0.01, 8.0
NU, CELLS, STEPS = 0.3, 48, 10
# Part of the radius by which the ring is wider and less high, so that it does not stay a circle
UNROUND = 0.005


def ring_force(pressure: float) -> float:
    """Force between opposite points of a ring under outer pressure, in E' I / R^2.

    The equations of Flaherty, Keller and Rubinow for a quarter of an inextensible ring, which is
    circular and of curvature 1 without load: from the point in contact at the origin, where it is
    level, to the one where it stands upright. By them opposite points touch at 5.247, and the
    curvature there vanishes at 10.34, from where on there is more than a point in contact.
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
        return [angle + np.pi / 2, height, level]

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
    problem = cx.ContactProblem(
        F, u, contacts=[contact], bcs=_symmetry(u), petsc_options_prefix="ring_"
    )

    def update(t: float) -> None:
        pressure.value = t * PRESSURE

    iterations = list(steps(problem, STEPS, update))
    # Slaves may be on either side
    force = float(contact.multiplier @ contact.area)
    return Answer(force, iterations, deformed(u), ring_force(PRESSURE))


def _symmetry(u: fem.Function) -> list[fem.DirichletBC]:
    """Conditions that keep both axes of symmetry where they are."""
    V = u.function_space
    found = []
    for axis in range(2):
        part, _ = V.sub(axis).collapse()
        there = fem.locate_dofs_geometrical(
            (V.sub(axis), part), lambda x, axis=axis: np.isclose(x[axis], 0, atol=1e-9)
        )
        found.append(fem.dirichletbc(fem.Function(part), there, V.sub(axis)))
    return found


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
]
