# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A fluid wets surfaces from where it enters up to closed contacts, and presses there."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem

from meshes import Tag
from scenes import CELLS, Blocks, dimension, grids
from scenes.covering import covering
from scenes.problems import make_problem
from story import METHODS, displacement, elasticity, fix

SURFACES = Tag.UPPER_CONTACT, Tag.LOWER_CONTACT


def at_left_end(x):
    """The lower block's left end."""
    return np.isclose(x[0], 0)


# Slaves that are finer and coarser than the master, down to a quarter
@covering(cell=CELLS, degree=(1, 2), n_upper=(2, 5), n_lower=(3, 8), method=METHODS)
def test_a_fluid_stops_at_the_block_on_a_slab(cell, degree, n_upper, n_lower, method):
    """In 2D on one side; in 3D it goes round the block, and under it on neither surface."""
    gdim = dimension(cell)
    if gdim == 3 and degree == 2:
        n_upper, n_lower = n_upper // 2, n_lower // 2
    scene = Blocks(cell, degree=degree, n_upper=n_upper, n_lower=n_lower)
    contact = scene.contact(method=method)
    domain = scene.u.function_space.mesh
    surface = cx.Surface(scene.tags, *SURFACES)
    fluid = cx.FluidPenetration(domain, surface, entry=at_left_end, contacts=[contact])
    problem = scene.problem(contact)
    problem.solve()
    assert fluid.update()
    assert not fluid.update()
    x = fem.functionspace(domain, ("Lagrange", 1)).tabulate_dof_coordinates()
    slab = x[np.abs(x[:, gdim - 1]) < 1e-9]
    block = np.all((x[:, : gdim - 1] > 0.23 - 1e-9) & (x[:, : gdim - 1] < 1.23 + 1e-9), axis=1)
    outside = ~block & (np.abs(x[:, gdim - 1]) < 1e-9)
    if gdim == 2:
        outside &= x[:, 0] < 0.23
    assert len(slab) > outside.sum() > 0
    assert np.array_equal(fluid.wet.x.array > 0.5, outside)


class Strip:
    """A strip that a load presses on a floor, the more the farther from the fluid's end."""

    BELOW, ABOVE, END, FLOOR = 1, 2, 3, 4
    SLOPE, START = 0.2, 0.5

    def __init__(self, degree, *, is_rigid):
        strip = grids.grid((0, 0), (10, 0.2), (50, 1))
        floor = grids.grid((0, -1), (10, 0), (37, 2))
        domain = grids.create(strip) if is_rigid else grids.create(strip, floor)
        facets = grids.outside(domain)
        x, of = grids.middles(domain, facets)
        upper = of[:, 1] > 0
        values = np.zeros(len(facets))
        values[upper & np.isclose(x[:, 1], 0)] = self.BELOW
        values[np.isclose(x[:, 1], 0.2)] = self.ABOVE
        values[upper & np.isclose(x[:, 0], 10)] = self.END
        values[~upper & np.isclose(x[:, 1], 0)] = self.FLOOR
        values[np.isclose(x[:, 1], -1)] = 5
        tags = grids.chosen(domain, facets, values)
        self.u = u = displacement(domain, degree)
        below = cx.Surface(tags, self.BELOW)
        faces = (self.BELOW,) if is_rigid else (self.BELOW, self.FLOOR)
        self.contact = cx.Contact(
            below, cx.Plane((0, 0), (0, 1)) if is_rigid else cx.Surface(tags, self.FLOOR)
        )
        self.fluid = cx.FluidPenetration(
            domain, cx.Surface(tags, *faces), entry=at_left_end, contacts=[self.contact]
        )
        self.p = fem.Constant(domain, 0.0)
        ds = ufl.Measure("ds", domain, subdomain_data=tags)
        wet, N, v = self.fluid.wet, ufl.FacetNormal(domain), ufl.TestFunction(u.function_space)
        load = self.SLOPE * (ufl.SpatialCoordinate(domain)[0] - self.START)
        F = elasticity(u, 1e4, 0.0) + load * v[1] * ds(self.ABOVE)
        F += self.p * wet * ufl.dot(v, N) * ds(faces)
        self.load, self.push = load * ds(self.ABOVE), self.p * wet * ds(self.BELOW)
        self.wetted, self.wetted_floor = wet * ds(self.BELOW), wet * ds(self.FLOOR)
        bcs = [fix(u, tags, 0, 0.0, self.END)]
        if not is_rigid:
            bcs += [fix(u, tags, i, 0.0, 5) for i in range(2)]
        self.problem = make_problem(F, u, [self.contact], bcs)

    def front(self, pressure):
        """Where a thin strip leaves the floor: the moment of what lifts it vanishes there."""
        return 3 * (pressure / self.SLOPE + self.START)


def integral(form):
    return fem.assemble_scalar(fem.form(form))


@pytest.mark.parametrize(("degree", "is_rigid"), [(1, True), (2, True), (2, False)])
def test_a_fluid_lifts_a_strip_as_far_as_it_is_pressed_less(degree, is_rigid):
    scene = Strip(degree, is_rigid=is_rigid)
    scene.problem.solve()
    updates, facet = 0, 10 / 50
    for scene.p.value in (0.0, 0.3):
        scene.problem.solve()
        while scene.fluid.update():
            scene.problem.solve()
            updates += 1
        # The floor takes what is left of the load
        load, push = integral(scene.load), integral(scene.push)
        assert scene.contact.force[1] == pytest.approx(load - push, rel=1e-9)
        # Between the last wetted vertex and the next one, which is closed, it ends half-way
        nodes = scene.u.function_space.tabulate_dof_coordinates()[scene.contact.slave_nodes, 0]
        closed = nodes[scene.contact.discrete.nodes.status > 0].min()
        wetted = integral(scene.wetted)
        assert 0 <= closed - (wetted - facet / 2) <= 1.01 * facet
        assert closed == pytest.approx(scene.front(scene.p.value), abs=1.01 * facet)
        if not is_rigid:
            assert integral(scene.wetted_floor) == pytest.approx(wetted, abs=facet)
    assert updates > 2


def test_in_self_contact_pairs_tell_what_is_in_front_of_a_node():
    scene = Blocks(CELLS[1], n_upper=5, n_lower=7)
    contact = cx.Contact.all(scene.tags, *SURFACES)
    domain = scene.u.function_space.mesh
    fluid = cx.FluidPenetration(
        domain, cx.Surface(scene.tags, *SURFACES), entry=at_left_end, contacts=[contact]
    )
    scene.problem(contact).solve()
    assert fluid.update()
    x = fluid.wet.function_space.tabulate_dof_coordinates()[fluid.wet.x.array > 0.5]
    # Up to the facet of the edge of the block at 0.23
    assert 0 <= x[:, 0].max() < 0.23
    assert np.all(x[:, 1] < 1e-9)
