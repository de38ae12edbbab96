# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact tests that other codes ship with their sources, each with the values that they check."""

from __future__ import annotations

import math
from functools import cache

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag
from published.drawing import curve, deformed, surface
from published.record import Answer, Case, solve, steps
from scenes.grids import faces
from scenes.materials import of_bodies, st_venant_kirchhoff
from scenes.problems import make_problem, pair_of

ASTER = "Code_Aster, astest/"
CALCULIX = "CalculiX, test/"


def displaced(u: fem.Function, *place: float) -> npt.NDArray[np.float64]:
    """Displacement of the nodes at a place, shape (n, gdim)."""
    x = u.function_space.tabulate_dof_coordinates()
    gdim = u.function_space.mesh.geometry.dim
    there = np.flatnonzero(np.linalg.norm(x[:, :gdim] - place, axis=1) < 1e-9 + 1e-6 * x.max())
    assert len(there) > 0, f"no node at {place}"
    return u.x.array.reshape(-1, gdim)[there]


@cache
def _plate() -> tuple[fem.Function, cx.Contact, list[int]]:
    """SSNV128: half of a plate, pressed from above and from its side on a rigid plane; mm, MPa."""
    side = 40.0
    # The nodes of reference are at multiples of 1.25
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[0, 0], [side, side]], [64, 32], CellType.quadrilateral
    )
    u = story.displacement(domain)
    V = u.function_space
    tags = faces(domain, ((1, 0.0), (1, side), (0, 0.0), (0, side)))
    pressed = fem.Constant(domain, (0.0, 0.0))
    pushed = fem.Constant(domain, (0.0, 0.0))
    F = story.elasticity(u, 1.3e5, 0.2)
    F += story.traction(u, tags, 2, pressed) + story.traction(u, tags, 3, pushed)
    corner = fem.locate_dofs_geometrical(
        (V.sub(1), V.sub(1).collapse()[0]),
        lambda x: np.isclose(x[0], side) & np.isclose(x[1], 0),
    )
    bcs = [
        story.fix(u, tags, 0, 0.0, 4),
        fem.dirichletbc(fem.Function(V.sub(1).collapse()[0]), corner, V.sub(1)),
    ]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Plane((0, 0), (0, 1)), friction=1.0)
    problem = make_problem(F, u, [contact], bcs)

    def update(t: float) -> None:
        pressed.value[1] = -50.0 * t
        pushed.value[0] = 150.0 * t

    return u, contact, list(steps(problem, 5, update))


def ssnv128(place: float) -> Answer:
    """Displacement along the plane of a point of the contact, mm."""
    u, _, iterations = _plate()
    value = float(displaced(u, place, 0.0)[0, 0])
    return Answer(value, iterations, deformed(u, scale=100))


def _pad(share: float, springs: bool) -> tuple[fem.Function, cx.Contact, list[int], np.ndarray]:
    """SSNV503: a pad of 40 x 20 that falls 2 on a plane inclined by 30 degrees; friction 0.3."""
    angle = math.pi / 6
    along = np.array([math.cos(angle), math.sin(angle)])
    up = np.array([-along[1], along[0]])
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[10, 7], [50, 27]], [8, 4], CellType.quadrilateral
    )
    tags = faces(domain, ((1, 7.0), (1, 27.0), (0, 10.0), (0, 50.0)))
    flat = domain.geometry.x[:, :2].copy()
    domain.geometry.x[:, :2] = flat[:, :1] * along + flat[:, 1:] * up
    u = story.displacement(domain)
    v = ufl.TestFunction(u.function_space)
    down = fem.Constant(domain, (0.0, 0.0))
    push = fem.Constant(domain, (0.0, 0.0))
    F = story.elasticity(u, 2.1e5, 0.0)
    F += story.traction(u, tags, 2, down) + story.traction(u, tags, 3, push)
    if springs:
        # Two springs of stiffness 2 along the plane, spread over the right face
        t = ufl.as_vector(along.tolist())
        ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
        F += 4.0 / 20 * ufl.dot(u, t) * ufl.dot(v, t) * ds(4)
    plane = cx.Plane(tuple(5 * up), tuple(up))
    contact = cx.Contact(cx.Surface(tags, 1), plane, friction=0.3)
    problem = make_problem(F, u, [contact], [])
    down.value[:] = -300 * up
    iterations = solve(problem)
    push.value[:] = share * 0.3 * 300 * 40 / 20 * along
    iterations += solve(problem)
    return u, contact, iterations, along


def ssnv503_sticks() -> Answer:
    """A free pad that friction alone holds: its force along the plane."""
    u, contact, iterations, along = _pad(0.99, False)
    return Answer(float(contact.force @ along), iterations, deformed(u))


def ssnv503_slides() -> Answer:
    """The pad that slides until its springs hold it: displacement along x."""
    u, _, iterations, _ = _pad(1.01, True)
    return Answer(float(u.x.array[0::2].mean()), iterations, deformed(u))


@cache
def _hueeber(on_upper: bool) -> tuple[fem.Function, list[int]]:
    """Two squares of 10 mm between rigid walls.

    Both sides of the lower square, or one side of each, are pulled down by 1 MPa and pressed in by
    0.1 MPa. In the first test the upper wall goes down by 0.5 um. CalculiX loads each node by the
    same force: the upper square, of 70 cells and not 60, has 70/60 of the traction.
    """
    data = meshes.blocks(
        CellType.quadrilateral, (70, 70), (60, 60), size_upper=(10, 10), size_lower=(10, 10)
    )
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    young, nu = of_bodies(data, 20e3, 15e3), of_bodies(data, 0.4, 0.2)
    F = story.elasticity(u, young, nu)
    left, share = (Tag.UPPER_X0, 70 / 60) if on_upper else (Tag.LOWER_X0, 1.0)
    F += story.traction(u, tags, left, fem.Constant(data.mesh, (0.1 * share, -share)))
    F += story.traction(u, tags, Tag.LOWER_X1, fem.Constant(data.mesh, (-0.1, -1.0)))
    bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2)]
    bcs.append(story.fix(u, tags, 0, 0.0, Tag.UPPER_TOP))
    bcs.append(story.fix(u, tags, 1, 0.0 if on_upper else -5e-4, Tag.UPPER_TOP))
    contact = pair_of(tags)
    problem = make_problem(F, u, [contact], bcs)
    return u, solve(problem)


def hueeber(on_upper: bool, x: float, lower: bool, component: int) -> Answer:
    """Displacement of a corner of the contact, mm.

    Args:
        lower: Whether it is the lower square's, which is meshed after the upper one.
    """
    u, iterations = _hueeber(on_upper)
    both = displaced(u, x, 0.0)
    assert len(both) == 2
    # The lower square is pulled down and away
    row = np.argmin(both[:, 1]) if lower else np.argmax(both[:, 1])
    return Answer(float(both[row, component]), iterations, deformed(u, scale=1000))


def four_c() -> Answer:
    """A cube of one cell, turned by 45 degrees, on a block of 10 x 10 x 4; it goes down by 0.14."""
    data = meshes.blocks(
        CellType.hexahedron,
        (1, 1, 1),
        (10, 10, 4),
        size_lower=(2, 2, 1),
        shift=(0.5, 0.5),
        gap=0.02,
    )
    x = data.mesh.geometry.x
    upper = np.unique(data.mesh.geometry.dofmaps[0][data.cell_tags.find(Tag.UPPER)])
    arm = (x[upper, :2] - 1) / math.sqrt(2)
    x[upper, 0], x[upper, 1] = 1 + arm[:, 0] - arm[:, 1], 1 + arm[:, 0] + arm[:, 1]
    u = story.displacement(data.mesh)
    tags = data.facet_tags
    F = st_venant_kirchhoff(u, 2250.0, 0.3)
    bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)]
    bcs += [story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(2)]
    moved = story.fix(u, tags, 2, 0.0, Tag.UPPER_TOP)
    contact = pair_of(tags, method="surface-to-surface")
    problem = make_problem(F, u, [contact], [*bcs, moved])

    def update(t: float) -> None:
        moved.g.value[...] = -0.14 * t

    iterations = list(steps(problem, 5, update))
    value = float(displaced(u, 0.2, 0.0, -0.5)[0, 0])
    where = u.function_space.tabulate_dof_coordinates()
    top = np.flatnonzero(np.isclose(where[:, 2], 0.0))
    drawn = surface(where[top] - 1, u.x.array[3 * top + 2], "vertical displacement", 1.1)
    return Answer(value, iterations, drawn)


def membrane(n: int = 24) -> Answer:
    """A membrane over a ball, whose rim is given: Bueler's obstacle problem, a quarter of it.

    A sheet of one layer of cells, whose nodes move up and down alone and whose stress is the slope.
    It lies on the ball of radius 1 as far as r = a, and is -A log(r) + B beyond.
    """
    a = brentq(lambda a: a**2 * math.log(2 / a) - (1 - a**2), 0.5, 0.9)
    A = a**2 / math.sqrt(1 - a**2)
    domain = mesh.create_box(
        MPI.COMM_WORLD, [[0, 0, 1], [2, 2, 1 + 2 / n]], [n, n, 1], CellType.hexahedron
    )
    u = story.displacement(domain)
    V = u.function_space
    tags = faces(domain, ((2, 1.0), (0, 2.0), (1, 2.0)))

    def height(r: np.ndarray) -> np.ndarray:
        outside = A * np.log(2 / np.maximum(r, a))
        return np.where(r < a, np.sqrt(1 - np.minimum(r, a) ** 2), outside)

    rim = fem.Function(V)
    rim.interpolate(lambda x: np.stack([0 * x[0], 0 * x[0], height(np.hypot(*x[:2])) - 1]))
    edge = fem.locate_dofs_topological(V, 2, np.hstack([tags.find(2), tags.find(3)]))
    bcs = [fem.dirichletbc(rim, edge)]
    for sub in (V.sub(0), V.sub(1)):
        every = fem.locate_dofs_geometrical((sub, sub.collapse()[0]), lambda x: x[0] > -1)
        bcs.append(fem.dirichletbc(fem.Function(sub.collapse()[0]), every, sub))
    F = n / 2 * ufl.inner(ufl.grad(u), ufl.grad(ufl.TestFunction(V))) * ufl.dx
    contact = cx.Contact(cx.Surface(tags, 1), cx.Sphere((0.0, 0.0, 0.0), 1.0))
    problem = make_problem(F, u, [contact], bcs)
    iterations = solve(problem)
    slaves = contact.slave_nodes
    r = np.hypot(*V.tabulate_dof_coordinates()[slaves, :2].T)
    drawn = curve(r, 1 + u.x.array[3 * slaves + 2], ("r", "height"), height, 2.0)
    return Answer(4 * float(contact.force[2]), iterations, drawn, 2 * math.pi * A)


_THESIS = "S. Hueeber, thesis, Stuttgart 2008"
CASES: list[Case] = [
    *(
        Case(
            f"ssnv128_{point.lower()}",
            "Plate on a rigid plane, friction 1 (Raous, Chabrand and Lebon's GRECO benchmark)",
            f"{ASTER}ssnv128b.comm, point PP{point}",
            f"displacement along the plane of point {point}, mm",
            lambda place=place: ssnv128(place),
            published=value,
            problem="ssnv128",
        )
        for point, place, value in (
            ("A", 0.0, 2.86e-2),
            ("B", 1.25, 2.72e-2),
            ("C", 5.0, 2.28e-2),
            ("D", 7.5, 1.98e-2),
        )
    ),
    Case(
        "ssnv503_sticks",
        "Free pad on an incline, pushed by 0.99 of the friction",
        f"{ASTER}ssnv503c.comm",
        "force along the plane, N",
        ssnv503_sticks,
        published=-3564.0,
    ),
    Case(
        "ssnv503_slides",
        "Pad on an incline, pushed by 1.01 of the friction against springs",
        f"{ASTER}ssnv503c.comm",
        "displacement along x, mm",
        ssnv503_slides,
        published=8.794,
    ),
    Case(
        "hueeber1",
        "Two squares, the lower one pulled down at both sides",
        f"{CALCULIX}hueeber1_mortar.dat.ref ({_THESIS}, p. 44)",
        "vertical displacement of the lower square's corner, mm",
        lambda: hueeber(False, 10.0, True, 1),
        published=-1.20575e-3,
    ),
    Case(
        "hueeber2",
        "Two squares, one side of each pulled down",
        f"{CALCULIX}hueeber2_mortar.dat.ref ({_THESIS}, p. 73)",
        "horizontal displacement of the lower square's corner, mm",
        lambda: hueeber(True, 10.0, True, 0),
        published=1.103643e-3,
    ),
    Case(
        "four_c",
        "Cube turned by 45 degrees on a block",
        "4C, tests/input_files/contact3D_sp_dual_simple_new_struct.4C.yaml",
        "displacement of node 11 along x",
        four_c,
        note="By surface-to-surface, 4C's own method, which is not the default. Node-to-surface "
        "refuses: the slave is one facet of four nodes over a hundred.",
        published=-0.00372699924569964806,
        options="surface-to-surface",
    ),
    Case(
        "membrane",
        "Membrane over a ball",
        "PETSc, src/snes/tutorials/ex9.c; E. Bueler, PETSc for Partial Differential Equations, "
        "SIAM 2021, chapter 12",
        "force on the ball over the tension, 2 pi A",
        membrane,
    ),
]
