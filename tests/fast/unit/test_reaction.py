# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reactions of supports are in balance with loads and contact forces."""

from mpi4py import MPI

import hertz_axisymmetric
import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType, create_unit_square

from meshes import Tag
from scenes import Blocks
from scenes.blocks import NU
from scenes.materials import neo_hookean
from story import fix

METHODS = ("node-to-surface", "surface-to-surface")


def cross(arm, force):
    """Moment of a force about the origin, in 2D about z."""
    whole = np.cross(*(np.append(v, np.zeros(3 - len(v))) for v in (arm, force)))
    return whole if len(arm) == 3 else whole[2]


class Loaded(Blocks):
    """The upper block is pressed, pushed along and has a weight, at finite strains."""

    def __init__(self, cell, degree=1):
        super().__init__(cell, degree=degree)
        self.gdim = len(self.u)
        self.weight = np.array([0.01, 0.02, -0.03][-self.gdim :])
        domain = self.u.function_space.mesh
        v = ufl.TestFunction(self.u.function_space)
        self.dx = ufl.dx(domain)
        self.F = neo_hookean(self.u, 1.0, NU) - ufl.dot(ufl.as_vector(self.weight), v) * self.dx
        self.bcs[self.gdim] = fix(self.u, self.tags, 0, 0.03, Tag.UPPER_TOP)

    def load(self):
        """Force and moment of the weight of both blocks."""
        x = ufl.SpatialCoordinate(self.u.function_space.mesh) + self.u
        sums = [fem.assemble_scalar(fem.form(f * self.dx)) for f in (*x, 1.0)]
        return sums[-1] * self.weight, cross(sums[:-1], self.weight)


@pytest.mark.parametrize(
    "cell, degree, method",
    [
        (CellType.triangle, 1, METHODS[0]),
        (CellType.quadrilateral, 2, METHODS[1]),
        (CellType.hexahedron, 1, METHODS[1]),
        (CellType.tetrahedron, 1, METHODS[0]),
    ],
)
@pytest.mark.parametrize("on_plane", [False, True])
def test_balance(cell, degree, method, on_plane):
    scene = Loaded(cell, degree)
    gdim = scene.gdim
    plane = cx.Plane(np.zeros(gdim), np.eye(gdim)[-1])
    master = plane if on_plane else None
    contact = scene.contact(master=master, friction=0.3, method=method)
    problem = scene.problem(contact)
    problem.solve()
    size = np.linalg.norm(contact.force)
    assert size > 0.02
    force, moment = scene.load()
    supports = problem.reaction()
    from_plane = contact.force if on_plane else np.zeros(gdim)
    assert np.abs(supports.force + force + from_plane).max() < 1e-9 * size
    origin = np.zeros(gdim)
    about = supports.moment(origin) + (contact.moment(origin) if on_plane else 0)
    if on_plane or method == METHODS[0]:
        assert np.abs(about + moment).max() < 1e-9 * size
    # Another point: the arms change by the same vector
    shift = np.arange(1.0, gdim + 1)
    assert np.allclose(
        supports.moment(shift), supports.moment(origin) + cross(-shift, supports.force), atol=1e-12
    )

    # Of one condition its component, of a face what all its conditions exert
    top = problem.reaction(cx.Surface(scene.tags, Tag.UPPER_TOP)).force
    for component, bc in enumerate(scene.bcs[gdim:]):
        exerted = problem.reaction(bc).force
        assert exerted[component] == pytest.approx(top[component], abs=1e-12)
        assert np.count_nonzero(exerted) == 1
    bottom = problem.reaction(cx.Surface(scene.tags, Tag.LOWER_BOTTOM)).force
    assert np.allclose(top + bottom, supports.force, rtol=0, atol=1e-9 * size)


def test_the_axial_force_is_of_all_the_circumference():
    problem, contact = hertz_axisymmetric.create(0.1)
    problem.solve()
    top = problem.reaction(problem.assembler.bulk.bcs[-1])
    assert top.force[1] == pytest.approx(-contact.force[1], rel=1e-9)
    with pytest.raises(RuntimeError, match="forces around the axis have no moment"):
        top.moment((0.0, 0.0))


def test_places_that_are_refused():
    scene = Blocks(CellType.triangle)
    problem = scene.problem(scene.contact())
    domain = create_unit_square(MPI.COMM_WORLD, 1, 1)
    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    elsewhere = fem.dirichletbc(np.zeros(2), np.array([0], dtype=np.int32), V)
    with pytest.raises(TypeError, match=r"where is int 3: give a fem\.DirichletBC"):
        problem.reaction(3)
    with pytest.raises(ValueError, match="prescribes no displacement of this problem"):
        problem.reaction(elsewhere)
    with pytest.raises(ValueError, match=r"point is .* give 2 finite numbers"):
        problem.reaction().moment((0, 0, 0))
