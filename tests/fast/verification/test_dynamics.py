# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia: forces of impact, energy and momentum."""

import impact_bars
import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag
from scenes.flying import SPEED, Flying

PLANE, SOLID = CellType.quadrilateral, CellType.tetrahedron


@pytest.mark.parametrize("scene", impact_bars.SCENES)
@pytest.mark.parametrize(
    ("courant", "method", "mass"),
    [(1.0, "node-to-surface", None), (0.7, "surface-to-surface", "consistent")],
)
def test_bars(scene, courant, method, mass):
    """Exact: rho c v A for 2 L / c; an impact costs the energy of half a cell."""
    n = 40
    bars = impact_bars.Bars(scene, n, courant, method, mass=mass)
    bars.run()
    assert abs(bars.steady.mean() - 1) <= 1e-3
    assert bars.swing <= 0.02
    assert bars.growth <= 1e-12
    assert -1e-12 <= bars.loss <= 1 / n
    assert bars.velocity == pytest.approx(impact_bars.VELOCITY, rel=2 / n)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_wall_that_hits_a_bar(friction):
    """The same in a frame that moves with the bar."""
    n, v = 20, impact_bars.VELOCITY
    bars = impact_bars.Bars(impact_bars.SCENES[0], n, 1.0)
    bars.run()
    data = meshes.blocks(
        PLANE, (1, n), (1, n), size_upper=(1 / n, 1.0), size_lower=(1, 1), gap=0.3 * v * bars.dt
    )
    mesh, tags = meshes.single(data, Tag.UPPER)
    u = story.displacement(mesh)
    test = ufl.TestFunction(u.function_space)
    point = fem.Constant(mesh, (0.0, 0.0))
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT),
        cx.Plane(point=point, normal=(0, 1)),
        friction=friction,
    )
    dynamics = cx.ContactDynamics(
        lambda w: ufl.inner(ufl.sym(ufl.grad(w)), ufl.grad(test)) * ufl.dx,
        u,
        density=1.0,
        contacts=[contact],
        petsc_options_prefix="moving_wall_",
    )
    forces = []

    def update(t):
        point.value[1] = v * t

    steps = len(bars.times)
    for step in cx.LoadSteps(dynamics, steps, update, t_end=steps * bars.dt, progress=False):
        forces.append(step.report.balance.impulse[0][1] / bars.dt * n / v)
    np.testing.assert_allclose(forces, bars.forces, rtol=0, atol=1e-9)
    assert dynamics.momentum()[1] * n == pytest.approx(v + bars.velocity, rel=1e-9)


CASES = [
    (PLANE, {"friction": 0.3}),
    (PLANE, {"friction": 0.3, "method": "surface-to-surface", "mass": "consistent"}),
    (PLANE, {"obstacle": cx.Plane((0, 0), (0, 1)), "friction": 0.2}),
    (PLANE, {"obstacle": cx.Sphere((0.5, -1.5), 1.5), "method": "surface-to-surface"}),
    (PLANE, {"tied": True}),
    (PLANE, {"held": True, "mass": "consistent"}),
    (PLANE, {"degree": 2, "friction": 0.2}),
    (SOLID, {"n": 2, "friction": 0.2}),
    (SOLID, {"n": 2, "method": "surface-to-surface"}),
]


@pytest.mark.parametrize(("cell", "options"), CASES)
def test_balance(cell, options):
    """What contact takes of the energy is what is missing; momentum is what impulses make."""
    scene = Flying(cell, **options)
    dynamics, contact = scene.dynamics, scene.contact
    energy, momentum = scene.energy, dynamics.momentum()
    start, moment = energy, dynamics.angular_momentum()
    is_free = "obstacle" in options
    touches = False
    for _ in range(14):
        dynamics.solve()
        balance = dynamics.report.balance
        touches = touches or contact.status.x.array.max() > 0
        change = balance.work_of_supports - balance.contact_loss
        assert balance.energy - energy == pytest.approx(change, abs=1e-9 * start)
        assert balance.energy == pytest.approx(scene.energy, rel=1e-12)
        if not options.get("held"):
            given = balance.impulse[0] if is_free else 0.0
            np.testing.assert_allclose(balance.momentum - momentum, given, atol=1e-9)
        energy, momentum = balance.energy, balance.momentum
    assert touches
    assert energy <= start * (1 + 1e-9)
    if not (is_free or options.get("held")):
        # Impulses act where the bodies are at the step's end, stresses where they are in its middle
        np.testing.assert_allclose(dynamics.angular_momentum(), moment, rtol=0, atol=5e-3)


def test_nodes_stay_on_what_they_have_hit():
    scene = Flying(PLANE, obstacle=cx.Plane((0, 0), (0, 1)), friction=10.0)
    for _ in range(6):
        scene.dynamics.solve()
    closed = scene.contact.slave_nodes[scene.contact.discrete.nodes.closed]
    velocity = scene.dynamics.velocity.x.array.reshape(-1, 2)[closed]
    assert len(closed) > 1
    np.testing.assert_allclose(velocity, 0, atol=1e-12 * SPEED)


def test_free_fall_is_exact():
    data = meshes.blocks(PLANE, (2, 2), (2, 2), gap=100.0)
    mesh, tags = meshes.single(data, Tag.UPPER)
    u = story.displacement(mesh)
    test = ufl.TestFunction(u.function_space)
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0, 0), (0, 1)))
    g = fem.Constant(mesh, (0.0, -10.0))
    dynamics = cx.ContactDynamics(
        lambda w: ufl.inner(ufl.sym(ufl.grad(w)), ufl.grad(test)) * ufl.dx,
        u,
        density=2.0,
        contacts=[contact],
        petsc_options_prefix="fall_",
        loads=2.0 * ufl.inner(g, test) * ufl.dx,
    )
    dynamics.velocity.interpolate(lambda x: np.stack([0 * x[0] + 1.0, 0 * x[0] + 3.0]))
    steps = [0.1, 0.15, 0.3, 1.0]
    for step in cx.LoadSteps(dynamics, steps, lambda t: None, progress=False):
        t, balance = step.t, step.report.balance
        x, y = u.x.array.reshape(-1, 2).T
        np.testing.assert_allclose(x, t, rtol=0, atol=1e-9)
        np.testing.assert_allclose(y, 3 * t - 5 * t**2, rtol=0, atol=1e-9)
        np.testing.assert_allclose(balance.momentum, [2.0, 2 * (3 - 10 * t)], rtol=0, atol=1e-9)
        assert balance.strain is None
        assert balance.energy == balance.kinetic == pytest.approx(1 + (3 - 10 * t) ** 2)
        assert "kinetic energy" in str(step.report)
