# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces, moments and areas of parts of a contact."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import (
    CellType,
    compute_midpoints,
    create_rectangle,
    locate_entities_boundary,
    meshtags,
)

from meshes import Tag
from scenes import Blocks
from scenes.bearing import ANGLES, FIRST_ROLLER, INNER, INNER_TAG, OUTER_TAG, Bearing
from scenes.problems import make_problem
from story import displacement, elasticity

METHODS = ("node-to-surface", "surface-to-surface")


@pytest.mark.parametrize("method", METHODS)
def test_each_roller_of_a_bearing(method):
    """Its load is that of the stresses in it, and the rings hold it in balance."""
    bearing = Bearing(0.2, method=method, friction=0.1)
    bearing.push(0.03)
    bearing.problem.solve()
    inner, outer = bearing.contacts
    rollers = range(FIRST_ROLLER, FIRST_ROLLER + len(ANGLES))
    parts = [inner.part(tag) for tag in rollers]
    total = np.linalg.norm(inner.force)
    for part, angle, load, tag in zip(parts, ANGLES, bearing.loads(), rollers, strict=True):
        out = np.array([np.sin(angle), -np.cos(angle)])
        assert load > 0.1 * total
        assert part.force @ out == pytest.approx(load, rel=1e-2)
        assert np.abs(part.force + outer.part(tag).force).max() < 1e-6 * total
        # It acts where the roller is
        assert abs(part.moment(INNER * out)) < 0.1 * load
        assert part.area > 0 and part.closed > 0
    assert sum(part.force for part in parts) == pytest.approx(inner.force, abs=1e-9 * total)
    assert sum(part.area for part in parts) == pytest.approx(inner.closed_area)
    assert max(part.largest_pressure for part in parts) == inner.pressure.x.array.max()
    moment = sum(part.moment((1.0, 2.0)) for part in parts)
    assert moment == pytest.approx(inner.moment((1.0, 2.0)), abs=1e-9 * total * INNER)
    # Of the master, and all rollers at once
    for contact, tag in ((inner, INNER_TAG), (outer, OUTER_TAG)):
        assert np.abs(contact.part(tag).force + contact.force).max() < 1e-9 * total
        assert contact.part(tag).area == 0 and np.isnan(contact.part(tag).smallest_gap)
        together = contact.part(*rollers)
        assert together.force == pytest.approx(contact.force, abs=1e-9 * total)
        assert together.closed == contact.fields.totals().closed


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.tetrahedron])
def test_each_body_of_a_contact_of_all(cell):
    """The force on a body is what its support takes up."""
    scene = Blocks(cell)
    gdim = len(scene.u)
    contact = cx.Contact.all(scene.tags, Tag.UPPER_CONTACT, Tag.LOWER_CONTACT, friction=0.2)
    problem = scene.problem(contact)
    problem.solve()
    upper, lower = contact.part(Tag.UPPER_CONTACT), contact.part(Tag.LOWER_CONTACT)
    assert upper.force[-1] > 0.01
    top = problem.reaction(cx.Surface(scene.tags, Tag.UPPER_TOP))
    bottom = problem.reaction(cx.Surface(scene.tags, Tag.LOWER_BOTTOM))
    for part, support in ((upper, top), (lower, bottom)):
        assert np.abs(part.force + support.force).max() < 1e-9
    origin = np.zeros(gdim)
    assert np.abs(upper.moment(origin) + lower.moment(origin)).max() < 1e-9


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("degree", [1, 2])
def test_a_border_of_two_parts_is_shared(method, degree):
    """Of a uniform pressure each part has what its area has, weighted."""
    domain = create_rectangle(MPI.COMM_WORLD, [[0, 0], [1, 1]], [5, 3])
    u = displacement(domain, degree)
    bottom = locate_entities_boundary(domain, 1, lambda x: np.isclose(x[1], 0))
    left = locate_entities_boundary(domain, 1, lambda x: np.isclose(x[0], 0))
    top = locate_entities_boundary(domain, 1, lambda x: np.isclose(x[1], 1))
    first = compute_midpoints(domain, 1, bottom)[:, 0] < 0.4
    tags = meshtags(domain, 1, bottom, np.where(first, 1, 2).astype(np.int32))
    V = u.function_space
    bcs = [
        fem.dirichletbc(value, fem.locate_dofs_topological(V.sub(i), 1, facets), V.sub(i))
        for value, i, facets in ((0.0, 0, left), (-0.01, 1, top))
    ]
    contact = cx.Contact(
        cx.Surface(tags, 1, 2), cx.Plane((0, 0), (0, 1)), method=method, weight=0.5
    )
    problem = make_problem(0.5 * elasticity(u, 1.0, 0.3), u, [contact], bcs)
    problem.solve()
    for tag, width in ((1, 0.4), (2, 0.6)):
        part = contact.part(tag)
        assert part.force == pytest.approx(width * contact.force, abs=1e-12)
        assert part.area == pytest.approx(width * 0.5)
        assert part.moment((0, 0)) == pytest.approx(
            part.force[1] * (0.2 if tag == 1 else 0.7), rel=0.01
        )
    assert contact.closed_area == pytest.approx(0.5)


def test_tags_that_are_refused():
    scene = Blocks(CellType.triangle)
    contact = scene.contact()
    with pytest.raises(RuntimeError, match="has no results yet"):
        contact.part(int(Tag.UPPER_CONTACT))
    scene.problem(contact)
    with pytest.raises(TypeError, match=r"a tag is an integer, not 'a': write contact\.part"):
        contact.part("a")
    with pytest.raises(ValueError, match="tag 99 is of no facets of the contact, which has"):
        contact.part(Tag.UPPER_CONTACT, 99)
    with pytest.raises(ValueError, match="no tag is of no facets"):
        contact.part()
