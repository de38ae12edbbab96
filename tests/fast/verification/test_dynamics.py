# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia: forces of impact, energy and momentum; steps that fail; what is refused."""

import impact_bars
import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import story
from inputs.rows import refused, scene, table
from meshes import Tag
from scenes.flying import GAP, SPEED, Flying

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


CELL = CellType.quadrilateral
DT, STEPS = 0.01, 8


def states(scene):
    """All that a step starts from."""
    dynamics, contact = scene.dynamics, scene.contact
    return [
        dynamics.u.x.array.copy(),
        dynamics.velocity.x.array.copy(),
        contact.multiplier.copy(),
        contact.status.x.array.copy(),
    ]


def steps(scene, **options):
    given = {"t_end": STEPS * DT, "progress": False, **options}
    return cx.LoadSteps(scene.dynamics, STEPS, lambda t: None, **given)


def test_a_step_that_fails_leaves_everything_as_it_was():
    scene = Flying(CELL, friction=0.3, petsc_options={"snes_max_it": 2})
    for k in range(STEPS):
        before = states(scene)
        try:
            scene.dynamics.solve()
        except cx.ConvergenceError:
            break
        assert not np.array_equal(before[1], scene.dynamics.velocity.x.array) or k == 0
    else:
        pytest.fail("no step has failed")
    for old, new in zip(before, states(scene), strict=True):
        np.testing.assert_array_equal(new, old)
    assert scene.dynamics.report.balance is None


@pytest.mark.parametrize("obstacle", [None, cx.Plane((0, 0), (0, 1))], ids=["block", "plane"])
def test_steps_are_short_at_an_impact(obstacle):
    """The time of the first contact comes out by as much as the way of that step says."""
    limit, cell = 0.005, np.sqrt(2) / 3
    scene = Flying(CELL, obstacle=obstacle, impact_travel=limit)
    given = GAP / SPEED
    t, taken, hit = 0.0, [], None
    for step in cx.LoadSteps(
        scene.dynamics, 3, lambda t: None, t_end=0.12, max_cuts=8, progress=False
    ):
        taken.append(step.t - t)
        if hit is None and np.any(scene.contact.status.x.array > 0):
            hit = t, step.t
        t = step.t
    assert hit[0] <= given <= hit[1]
    assert SPEED * (given - hit[0]) <= 1.01 * limit * cell
    # They were long before it, and grow back
    assert taken[-1] > 4 * min(taken)


def test_a_step_that_arrives_too_fast_is_refused():
    scene = Flying(CELL, impact_travel=1e-3)
    before = states(scene)
    with pytest.raises(cx.ConvergenceError, match=r"impact_travel = 0\.001: take shorter steps"):
        for _ in range(STEPS):
            before = states(scene)
            scene.dynamics.solve()
    for old, new in zip(before, states(scene), strict=True):
        np.testing.assert_array_equal(new, old)
    assert not scene.dynamics.report.converged


def test_a_run_goes_on_from_its_file(tmp_path):
    file = tmp_path / "run.state"
    obstacle = cx.Plane((0, 0), (0, 1))
    for options in ({"friction": 0.3}, {"obstacle": obstacle}):
        for step in steps(Flying(CELL, **options), checkpoint=file):
            # The file is that of the step before
            if step.index == 5:
                break
        other = Flying(CELL, **options)
        for _ in steps(other):
            pass
        again = Flying(CELL, **options)
        for _ in steps(again, restart=file):
            pass
        for old, new in zip(states(other), states(again), strict=True):
            np.testing.assert_array_equal(new, old)


def test_a_step_needs_its_length():
    scene = Flying(CELL)
    dynamics = scene.dynamics
    for dt, kind in ((0.0, ValueError), (np.inf, ValueError), ("1", TypeError)):
        with pytest.raises(kind, match="dt is"):
            dynamics.dt = dt
    assert dynamics.dt == 0.01
    dynamics._has_dt = False
    with pytest.raises(RuntimeError, match="no dt was set"):
        dynamics.solve()


def test_a_velocity_that_is_not_finite_is_refused():
    scene = Flying(CELL)
    before = scene.dynamics.u.x.array.copy()
    scene.dynamics.velocity.x.array[3] = np.nan
    with pytest.raises(ValueError, match="velocity is not finite"):
        scene.dynamics.solve()
    np.testing.assert_array_equal(scene.dynamics.u.x.array, before)


def dynamics(**changed):
    """Make a problem of which something is changed."""

    def do():
        blocks = scene()
        u = changed.pop("u", blocks.u)
        v = ufl.TestFunction(blocks.u.function_space)
        given = {
            "forces": lambda w: ufl.inner(ufl.grad(w), ufl.grad(v)) * ufl.dx,
            "density": 1.0,
            "contacts": [blocks.contact()],
            "petsc_options_prefix": "never_",
            **{k: make(blocks) if callable(make) else make for k, make in changed.items()},
        }
        cx.ContactDynamics(given.pop("forces"), u, **given)

    return do


def made(value):
    """An argument that is a function itself."""
    return lambda _: value


def negative(blocks):
    """A density that is negative in a part of the bodies."""
    x = ufl.SpatialCoordinate(blocks.u.function_space.mesh)
    return x[0] - 0.5


def around(blocks):
    """A density of an axisymmetric model whose mesh touches the axis."""
    return 2 * ufl.pi * ufl.SpatialCoordinate(blocks.u.function_space.mesh)[0]


def energy(blocks):
    return ufl.inner(blocks.u, blocks.u) * ufl.dx


ROWS = {
    TypeError: [
        (dynamics(u=3), "u must be a dolfinx.fem.Function"),
        (dynamics(forces=3), "forces is int 3: give a function"),
        (dynamics(forces=made(lambda a, b, c: a)), "takes 3 arguments: give"),
        (dynamics(forces=made(lambda a: 3)), "forces gives a int: let it"),
        (dynamics(density="1"), "density is str '1': give a number or"),
        (dynamics(loads=3.0), "loads is float 3.0: give a UFL form"),
        (dynamics(strain_energy=1), "strain_energy is int 1: give a function"),
        (dynamics(impact_travel="0.1"), "impact_travel is str '0.1': give a"),
    ],
    ValueError: [
        (dynamics(density=0.0), "density is 0.0: give a finite number above 0"),
        (dynamics(density=np.nan), "density is nan: give a finite number"),
        (dynamics(density=negative), "masses that are not positive"),
        (dynamics(density=around), 'without a mass: .* Give mass="consistent"'),
        (dynamics(loads=energy), "loads has 0 arguments: give a form"),
        (dynamics(impact_travel=0.0), "impact_travel is 0.0: give a number"),
        (dynamics(mass="none"), "mass is str 'none': give \"lumped\" or"),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)


def test_a_consistent_mass_may_touch_the_axis():
    dynamics(density=around, mass="consistent")()


def test_lumped_masses_of_quadratic_elements_are_refused():
    blocks = scene()
    V = fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 2, (2,)))
    with pytest.raises(ValueError, match="for linear elements, and u is of degree 2: leave"):
        cx.ContactDynamics(
            lambda w: ufl.inner(w, ufl.TestFunction(V)) * ufl.dx,
            fem.Function(V),
            density=1.0,
            mass="lumped",
            contacts=[blocks.contact()],
            petsc_options_prefix="never_",
        )
