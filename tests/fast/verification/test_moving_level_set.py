# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A level set that moves: nothing tells how it drags what it touches."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks

pytestmark = pytest.mark.usefixtures("method")
REFUSED = "LevelSet moves while it is touched, .* Take a Sphere, Plane or Cylinder, .* friction=0"


class Dragged:
    """A block on a disc that goes aside, or on a wave."""

    def __init__(self, kind, **options):
        self.scene = Blocks(CellType.quadrilateral, n_upper=4, down=0.01)
        domain = self.scene.u.function_space.mesh
        self.at = fem.Constant(domain, np.array([0.7, -3.0]))
        self.angle, self.time, self.spin = (fem.Constant(domain, 0.0) for _ in range(3))
        self.way = fem.Constant(domain, np.zeros(2))
        c = self.at
        obstacles = {
            "ufl": lambda: cx.LevelSet(lambda x: ufl.sqrt(ufl.dot(x - c, x - c)) - 3),
            "python": lambda: cx.LevelSet(self._distance, self._gradient),
            "plane": lambda: cx.LevelSet(lambda x: ufl.dot(x - c, ufl.as_vector([0.0, 1.0])) - 3),
            "sphere": lambda: cx.Sphere(c, 3.0, angle=self.angle),
            "ufl, velocity": lambda: cx.LevelSet(
                lambda x: ufl.sqrt(ufl.dot(x - c, x - c)) - 3,
                velocity=lambda x: self.way + self.spin * ufl.perp(x - c),
                time=self.time,
            ),
            "python, velocity": lambda: cx.LevelSet(
                self._distance, self._gradient, velocity=self._velocity, time=self.time
            ),
        }
        self.contact = self.scene.contact(master=obstacles[kind](), **options)
        self.problem = self.scene.problem(self.contact)

    def _from_centre(self, x):
        return x - self.at.value[:, None]

    def _distance(self, x):
        return np.linalg.norm(self._from_centre(x), axis=0) - 3

    def _gradient(self, x):
        d = self._from_centre(x)
        return d / np.linalg.norm(d, axis=0)

    def _velocity(self, x):
        y = self._from_centre(x)
        return self.way.value[:, None] + self.spin.value * np.array([-y[1], y[0]])

    def step(self, aside=0.0, up=0.0, spin=0.0):
        self.at.value[:] += aside, up
        self.angle.value += spin
        # In a step that takes half a unit of time
        self.way.value[:] = 2 * aside, 2 * up
        self.spin.value = 2 * spin
        self.time.value += 0.5
        self.problem.solve()


@pytest.mark.parametrize("kind", ["ufl", "python", "plane"])
def test_one_that_moves_under_friction_is_refused(kind):
    scene = Dragged(kind, friction=0.5)
    scene.step()
    scene.step()
    before = scene.scene.u.x.array.copy(), scene.contact.force
    for aside, up in ((0.01, 0.0), (0.0, 0.01)):
        at = scene.at.value.copy()
        with pytest.raises(ValueError, match=REFUSED):
            scene.step(aside, up)
        assert (scene.scene.u.x.array == before[0]).all()
        assert (scene.contact.force == before[1]).all()
        scene.at.value[:] = at
    scene.step()
    assert scene.problem.report.iterations == 0


@pytest.mark.parametrize("kind", ["ufl", "python"])
def test_without_friction_it_may_move(kind):
    scene, same = Dragged(kind), Dragged("sphere")
    for each in (scene, same):
        each.step()
        each.step(0.02, 0.01)
    assert scene.contact.force == pytest.approx(same.contact.force, rel=1e-9, abs=1e-12)


def test_a_tie_that_moves_is_refused():
    scene = Dragged("ufl", tied=True)
    scene.step()
    with pytest.raises(ValueError, match=REFUSED):
        scene.step(0.01)


def test_it_may_come_from_where_nothing_touches_it():
    scene = Dragged("ufl", friction=0.5)
    scene.at.value[1] = -4.0
    scene.problem.solve()
    scene.at.value[1] = -3.5
    scene.problem.solve()
    # It still moves in the step in which it is touched first
    scene.at.value[1] = -3.0
    with pytest.raises(ValueError, match=REFUSED):
        scene.problem.solve()
    assert not scene.contact.force.any()


@pytest.mark.parametrize("kind", ["ufl, velocity", "python, velocity"])
@pytest.mark.parametrize("options", [{"friction": 0.5}, {"tied": True}], ids=["friction", "tied"])
def test_one_with_a_velocity_drags_as_a_sphere_does(kind, options):
    scene, sphere = Dragged(kind, **options), Dragged("sphere", **options)
    steps = ({}, {"aside": 0.01}, {"spin": 4e-3}, {"spin": -8e-3}, {"up": 0.002})
    for step in steps:
        for each in (scene, sphere):
            each.step(**step)
        # Round about the centre where it is now, and on to there
        assert scene.contact.force == pytest.approx(sphere.contact.force, rel=1e-6)
        assert scene.contact.status.x.array == pytest.approx(sphere.contact.status.x.array)
    assert abs(scene.contact.force[0]) > 1e-4


def test_a_failed_step_of_one_with_a_velocity_leaves_no_trace():
    scene, same = Dragged("ufl, velocity", friction=0.5), Dragged("ufl, velocity", friction=0.5)
    for each in (scene, same):
        each.step()
    scene.way.value[0], scene.time.value = np.nan, 0.7
    with pytest.raises(ValueError, match="velocity of a LevelSet is not finite"):
        scene.problem.solve()
    scene.time.value = 0.5
    for each in (scene, same):
        each.step(aside=0.01)
    assert (scene.scene.u.x.array == same.scene.u.x.array).all()


@pytest.mark.parametrize(
    ("velocity", "message"),
    [
        (lambda x: x[0], "must be a vector of 2 components"),
        (lambda x: ufl.as_vector([1 / (x[0] - x[0]), 0.0]), "velocity of a LevelSet is not finite"),
    ],
)
def test_a_velocity_must_be_a_finite_vector(velocity, message):
    scene = Blocks(CellType.quadrilateral, n_upper=4, down=0.01)
    time = fem.Constant(scene.u.function_space.mesh, 0.0)
    floor = cx.LevelSet(lambda x: x[1], velocity=velocity, time=time)
    problem = scene.problem(scene.contact(master=floor, friction=0.5))
    problem.solve()
    time.value = 1.0
    with pytest.raises(ValueError, match=message):
        problem.solve()
