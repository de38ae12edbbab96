# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton's method from far away: active sets that creep, cells that must not turn inside out."""

import numpy as np
import pytest

import contactx as cx
import ufl
from contactx import cpp as core
from contactx._host.newton import NewtonLoop
from dolfinx import fem

from scenes import bent, ladder, slender
from scenes.held_sheet import limit
from scenes.materials import neo_hookean, st_venant_kirchhoff
from scenes.roller import Roller
from story import METHODS, elasticity
from stress.grids import even, grid
from stress.parts import Parts


def answer(strip):
    contact = strip.contact
    return strip.u.x.array.copy(), contact.force.copy(), contact.pressure.x.array.copy()


def without_path(monkeypatch):
    begin = NewtonLoop.begin

    def begin_barred(self, report):
        begin(self, report)
        self._loop.bar_path()

    monkeypatch.setattr(NewtonLoop, "begin", begin_barred)


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("shape", slender.SHAPES)
def test_iterations_on_a_slender_beam_do_not_grow_with_its_cells(shape, method, friction):
    counts = []
    for n in (100, 400):
        strip = slender.beam(n, shape, method=method, friction=friction)
        counts.append(slender.press(strip, shape).iterations)
    print(counts)
    assert max(counts) <= 24


@pytest.mark.parametrize("method", METHODS)
def test_nor_where_strains_are_large(method):
    for n in (50, 400):
        strip = slender.beam(n, "deep", material=st_venant_kirchhoff, method=method)
        report = slender.press(strip, "deep")
        assert report.iterations <= 20
        assert report.discarded == 0


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("method", METHODS)
def test_a_cantilever_lies_down_on_a_circle(method, friction):
    for n, most in ((60, 16), (360, 26)):
        assert bent.cantilever(n, elasticity, method=method, friction=friction).iterations <= most
    report = bent.cantilever(120, st_venant_kirchhoff, method=method, friction=friction)
    assert report.interior > 0
    assert report.iterations <= 30
    assert report.discarded == 0


def test_a_long_cantilever_is_condensed():
    """On the way its residual is far larger than its load, and so is a part of it."""
    report = bent.cantilever(1000, st_venant_kirchhoff)
    assert report.krylov > 0
    assert report.iterations <= 33
    assert report.discarded == 0


@pytest.mark.parametrize("method", METHODS)
def test_leaves_that_touch_along_their_length_come_apart(method):
    report = bent.leaves(60, method=method)
    assert report.iterations <= 30
    assert report.discarded == 0


@pytest.mark.parametrize("degrees", [49, 51, 57, 65, 75])
@pytest.mark.parametrize("method", METHODS)
def test_a_ladder_stands(method, degrees):
    """Active sets throw it off where both ends are close to slip."""
    assert degrees > ladder.LIMIT
    report, u = ladder.lean(degrees, method=method)
    assert report.iterations <= 25
    assert report.discarded == 0
    assert np.abs(u.x.array).max() <= 1e-3


@pytest.mark.parametrize("degrees", [40, 43])
@pytest.mark.parametrize("method", METHODS)
def test_a_ladder_that_slips_is_named(method, degrees):
    """No forces inside both cones balance its weight."""
    assert degrees < ladder.LIMIT
    with pytest.raises(cx.ConvergenceError, match="cannot be balanced") as info:
        ladder.lean(degrees, method=method)
    assert info.value.report.iterations <= 30


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_the_active_set_creeps_without_the_interior_point(friction, monkeypatch):
    without_path(monkeypatch)
    strip = slender.beam(400, "deep", friction=friction, petsc_options={"snes_max_it": 200})
    report = slender.press(strip, "deep")
    assert report.interior == 0
    assert report.iterations > 40


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("material", [elasticity, st_venant_kirchhoff])
def test_the_way_does_not_change_the_answer(material, friction, monkeypatch):
    path = slender.beam(200, "deep", material=material, friction=friction)
    report = slender.press(path, "deep")
    assert report.interior > 0
    assert "iterates of an interior point" in str(report)
    without_path(monkeypatch)
    options = {"snes_max_it": 200}
    alone = slender.beam(200, "deep", material=material, friction=friction, petsc_options=options)
    assert slender.press(alone, "deep").interior == 0
    for a, b in zip(answer(path), answer(alone), strict=True):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-7 * np.abs(b).max())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_nodes_on_the_path_are_condensed(friction, method):
    """Springs take the place of constraints in the condensed matrix and on all its levels."""
    answers = []
    for pc in ("lu", "condensed"):
        strip = slender.beam(
            200, "deep", method=method, friction=friction, petsc_options={"pc_type": pc}
        )
        report = slender.press(strip, "deep")
        assert report.interior > 0
        assert report.uncondensed == []
        assert report.iterations <= 25
        answers.append(answer(strip))
    for a, b in zip(*answers, strict=True):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-7 * np.abs(b).max())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("pull", slender.PULLS)
def test_belts_slide_around_a_drum(pull, method):
    """Pressures are small and ways long: a gap over the way squared must not open a node."""
    right, left = slender.PULLS[pull]
    strip = slender.belt(100, method=method)
    reports = slender.run_belt(strip, right, left)
    assert len(reports) == 5
    print([r.iterations for r in reports])
    assert sum(r.iterations for r in reports) <= 60
    assert sum(r.discarded for r in reports) == 0
    # All but its ends lies on the drum
    assert strip.contact.discrete.nodes.closed.sum() >= 90


def test_the_tension_of_a_belt_falls_as_euler_says():
    """Per unit of length the drum's pressure is the tension: from end to end exp(-mu pi)."""
    strip = slender.belt(200, friction=0.3)
    slender.run_belt(strip, *slender.PULLS["one end"])
    x = strip.u.function_space.tabulate_dof_coordinates()
    pressure = strip.contact.pressure.x.array
    inner = np.isclose(np.hypot(x[:, 0], x[:, 1]), 1.0, atol=1e-4)
    angle = np.arctan2(x[inner, 0], x[inner, 1])
    p = pressure[inner]
    middle = np.abs(angle) < 1.2
    slope = np.polyfit(angle[middle], np.log(p[middle]), 1)[0]
    # Towards the end that is pulled
    assert slope == pytest.approx(0.3, rel=0.02)


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("material", ["svk", "neo-hooke"])
def test_a_roller_turns_no_cell_inside_out(material, method, friction):
    report = Roller(material, method, friction, n=10).press()
    print(report.iterations, report.audit.smallest_det)
    assert report.iterations <= 14
    assert report.discarded == 0
    assert report.audit.inverted == 0


def test_steps_that_squeeze_cells_are_shortened():
    roller = ("svk", "surface-to-surface", 0.0)
    report = Roller(*roller, n=10).press(0.6)
    assert report.limited > 0
    assert report.audit.inverted == 0
    assert "steps shortened to keep cells from turning inside out" in str(report)


def test_damped_steps_take_over(monkeypatch):
    """Where steps go too far for other reasons than cells."""
    roller = ("svk", "surface-to-surface", 0.1)
    monkeypatch.setattr(core.Loop, "limit", limit)
    report = Roller(*roller, n=10).press(0.6)
    assert report.damped
    assert report.shortened > 0
    assert report.discarded == 50
    assert "steps damped, as others did not converge" in str(report)
    monkeypatch.setattr(NewtonLoop, "damping_may_help", False)
    with pytest.raises(cx.ConvergenceError, match="no convergence"):
        Roller(*roller, n=10).press(0.6)


@pytest.mark.parametrize("degree", [3, 8])
def test_a_shell_that_iterates_have_thrown_off_is_still_held(degree):
    """Full steps from an inner shell's coarse polygon lead far off, where it meets nothing.

    That nothing balances its load there is no property of the load: it is pressed against the
    outer shell. Which iterates go astray is a matter of the last digits of the material.
    """

    def arc(a, r):
        return r * np.cos(a), r * np.sin(a)

    radii, cells = (1.0, 1.3, 1.6), (4, 7)
    bodies = [
        grid(even(0, np.pi / 2, cells[k]), even(radii[k], radii[k + 1], 2), shape=arc)
        for k in (0, 1)
    ]
    shells = Parts(*bodies, material="neo-hooke")
    u = shells.u
    F = neo_hookean(u, 1.0, 0.3, degree=degree)
    x, n = (kind(shells.mesh) for kind in (ufl.SpatialCoordinate, ufl.FacetNormal))
    bore = ufl.ds(subdomain_data=shells.tags)(shells.tag(0, "y0"))
    pressure = 0.03 * (1 + 0.8 * x[0])
    F += pressure * ufl.inner(n, ufl.TestFunction(u.function_space)) * bore
    shells.hold(1, "y1")
    slave, master = shells.surface(0, "y1"), shells.surface(1, "y0")
    contact = cx.Contact(slave, master, method="surface-to-surface", friction=0.2)
    options = {"contacts": [contact], "bcs": shells.bcs, "petsc_options_prefix": "shells_"}
    problem = cx.ContactProblem(F, u, **options)
    problem.solve()
    print(problem.report.iterations, problem.report.discarded)
    load = [fem.assemble_scalar(fem.form(pressure * n[k] * bore)) for k in (0, 1)]
    assert contact.force == pytest.approx(load, abs=1e-11)


def test_a_line_search_of_ones_own_is_not_replaced():
    options = {"snes_linesearch_type": "bt", "snes_max_it": 3}
    strip = slender.beam(100, "deep", material=st_venant_kirchhoff, petsc_options=options)
    with pytest.raises(cx.ConvergenceError):
        slender.press(strip, "deep")
    report = strip.problem.report
    assert (report.damped, report.discarded, report.interior) == (False, 0, 0)


def test_a_line_search_starts_from_the_residual_of_now(tmp_path):
    """Pairs and status change after each step, and with them the residual."""
    file = tmp_path / "search"
    options = {
        "snes_linesearch_type": "bt",
        "snes_linesearch_monitor": f"ascii:{file}",
        "snes_max_it": 100,
    }
    strip = slender.beam(50, "thick", petsc_options=options)
    report = slender.press(strip, "thick")
    words = [line.split() for line in file.read_text().splitlines()]
    starts = np.array([float(w[w.index("fnorm") + 1]) for w in words if "fnorm" in w])
    # The first has differences from the Dirichlet values as well
    seen = [row.residual for row in report.history[1:-1]]
    assert len(seen) > 5
    for residual in seen:
        assert np.abs(starts / residual - 1).min() < 1e-9
