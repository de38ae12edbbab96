# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact that is integrated with a weight: axisymmetric models and thicknesses."""

from __future__ import annotations

import warnings

import hertz_axisymmetric
import numpy as np
import pytest
from hertz_axisymmetric import NU, E

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import reference
import story
from meshes import Tag
from scenes.blocks import CELLS, PLANE, Blocks
from scenes.problems import make_problem

METHODS = ("node-to-surface", "surface-to-surface")
OPTIONS = {
    "frictionless": {},
    "friction": {"friction": 0.3},
    "tied": {"tied": True},
    "small": {"friction": 0.3, "sliding": "small"},
    "plane": {"master": cx.Plane(point=(0.0, 0.0), normal=(0.0, 1.0)), "friction": 0.3},
}
DOWN = 0.02


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_a_thickness_scales_forces_alone(options, method):
    thick, thin = Blocks(CellType.quadrilateral), Blocks(CellType.quadrilateral)
    thin.F = 0.25 * thin.F
    contacts = [
        thick.contact(method=method, **options),
        thin.contact(method=method, weight=0.25, **options),
    ]
    problems = [s.problem(c) for s, c in zip((thick, thin), contacts, strict=True)]
    for problem in problems:
        problem.solve()
    assert problems[0].report.iterations == problems[1].report.iterations
    assert thick.u.x.array == pytest.approx(thin.u.x.array, abs=1e-12)
    assert np.abs(contacts[0].multiplier).max() > 0.01
    for name in ("pressure", "traction", "status"):
        values = [getattr(c, name).x.array for c in contacts]
        assert values[1] == pytest.approx(values[0], abs=1e-10)
    assert contacts[1].area == pytest.approx(0.25 * contacts[0].area, rel=1e-14)
    assert contacts[1].force == pytest.approx(0.25 * contacts[0].force, abs=1e-12)


def test_forces_around_an_axis_have_no_moment():
    """But those of a thickness have one, even where it grows along a coordinate."""
    for weight, is_around in (
        (lambda x: 2 * ufl.pi * x[0], True),
        (lambda x: 0.5 * x[0], True),
        (lambda x: 1 + x[0], False),
        (lambda x: 0.25, False),
    ):
        blocks = Blocks(CellType.quadrilateral)
        x = ufl.SpatialCoordinate(blocks.u.function_space.mesh)
        contact = blocks.contact(weight=weight(x))
        blocks.problem(contact)
        if is_around:
            with pytest.raises(RuntimeError, match="the forces around the axis have no moment"):
                contact.moment((0.0, 0.0))
        else:
            assert contact.moment((0.0, 0.0)) == 0


def wedge(cell: CellType, master: cx.Plane | None = None, **options) -> cx.Contact:
    """Blocks without Poisson's effect whose thickness grows along the interface, pressed by 0.01.

    The stress is uniform, whatever the thickness: it does not vary in the direction of the load.
    """
    dim = 2 if cell in PLANE else 3
    data = meshes.blocks(cell, (4,) * dim, (3,) * dim)
    domain, tags = data.mesh, data.facet_tags
    u = story.displacement(domain)
    t = 1 + 0.7 * ufl.SpatialCoordinate(domain)[0]
    v = ufl.TestFunction(u.function_space)
    F = ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)) * t * ufl.dx
    bcs = [
        story.fix(u, tags, i, -DOWN if face == Tag.UPPER_TOP and i == dim - 1 else 0.0, face)
        for i in range(dim)
        for face in (Tag.UPPER_TOP, Tag.LOWER_BOTTOM)
    ]
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT),
        master or cx.Surface(tags, Tag.LOWER_CONTACT),
        method="surface-to-surface",
        weight=t,
        **options,
    )
    make_problem(F, u, [contact], bcs).solve()
    return contact


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("options", [{}, {"friction": 0.2}, {"tied": True}], ids=repr)
def test_a_wedge_is_pressed_uniformly(cell, options):
    contact = wedge(cell, **options)
    p = contact.multiplier if contact.multiplier.ndim == 1 else contact.multiplier[:, -1]
    assert p == pytest.approx(DOWN / 2, rel=1e-9)
    # The force is the pressure times the integral of the thickness
    assert contact.force[-1] == pytest.approx(DOWN / 2 * 1.35, rel=1e-9)


@pytest.mark.parametrize("cell", CELLS)
def test_a_wedge_is_pressed_uniformly_on_a_plane(cell):
    dim = 2 if cell in PLANE else 3
    up = np.eye(dim)[-1]
    contact = wedge(cell, master=cx.Plane(point=0 * up, normal=up))
    assert contact.multiplier == pytest.approx(DOWN, rel=1e-9)
    assert contact.force[-1] == pytest.approx(DOWN * 1.35, rel=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_a_sphere_on_a_block_is_hertz_s(method):
    problem, contact = hertz_axisymmetric.create(0.0036, method=method)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        problem.solve()
    hertz = reference.HertzSphere(
        force=contact.force[1], radius=1.0, modulus=reference.contact_modulus(E, NU, E, NU)
    )
    r = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    pressure = contact.pressure.x.array[contact.slave_nodes]
    inside = (pressure > 0) & (r < 0.9 * hertz.contact_radius)
    # 20 cells in the contact radius, and the node on the axis
    assert r[inside].min() == pytest.approx(0, abs=1e-12)
    assert np.count_nonzero(inside) > 17
    worst = np.abs(pressure - hertz.pressure(r))[inside].max()
    assert worst < 0.02 * hertz.peak_pressure


@pytest.mark.parametrize("method", METHODS)
def test_friction_obeys_coulomb_and_the_solvers_agree(method):
    answers = []
    for pc in ("lu", "condensed"):
        scene = Blocks(CellType.triangle, n_upper=5, n_lower=6)
        scene.F = hertz_axisymmetric.elasticity(scene.u, 1.0, 0.3)
        r = ufl.SpatialCoordinate(scene.u.function_space.mesh)[0]
        # The normal is the vertical
        contact = scene.contact("small", method=method, friction=0.1, weight=2 * ufl.pi * r)
        scene.problem(contact, petsc_options={"pc_type": pc}).solve()
        p, t = contact.multiplier[:, 1], np.abs(contact.multiplier[:, 0])
        status = contact.status.x.array[contact.slave_nodes]
        assert (status == 2).any()
        assert (status == 1).any()
        assert t[status == 2] == pytest.approx(0.1 * p[status == 2], rel=1e-9)
        assert (t <= 0.1 * p * (1 + 1e-9)).all()
        answers.append(scene.u.x.array)
    assert answers[1] == pytest.approx(answers[0], abs=1e-10)


def test_weights_that_do_not_fit_the_surface_are_refused():
    scene, other = Blocks(CellType.triangle), Blocks(CellType.triangle)
    x = ufl.SpatialCoordinate(scene.u.function_space.mesh)
    with pytest.raises(ValueError, match="test or trial functions"):
        scene.contact(weight=ufl.TestFunction(scene.u.function_space)[0])
    cases = {
        "finite and not negative": x[0] - 0.5,
        "zero all over a slave facet": ufl.max_value(x[0] - 0.75, 0.0),
        "another mesh": ufl.SpatialCoordinate(other.u.function_space.mesh)[0],
    }
    for words, weight in cases.items():
        with pytest.raises(ValueError, match=words):
            scene.problem(scene.contact(weight=weight))
    # None of them has taken anything
    scene.problem(scene.contact(weight=1 + x[0])).solve()


def test_a_bulk_with_a_radius_and_a_contact_without_is_worth_a_warning():
    scene = Blocks(CellType.triangle)
    r = ufl.SpatialCoordinate(scene.u.function_space.mesh)[0]
    plane = scene.F
    v = ufl.TestFunction(scene.u.function_space)
    body = ufl.inner(fem.Constant(scene.u.function_space.mesh, (0.0, 1.0)), v)
    around = ufl.inner(ufl.grad(scene.u), ufl.grad(v)) * 2 * ufl.pi * r * ufl.dx + body * r * ufl.dx
    scene.F = around
    with pytest.warns(UserWarning, match="has no weight"):
        scene.problem(scene.contact())
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.problem(scene.contact(weight=2 * ufl.pi * r))
        # A load that grows with the position is no such sign
        scene.F = plane + r * body * ufl.dx
        scene.problem(scene.contact())
