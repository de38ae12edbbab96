# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of round bodies; what they refuse: tests/fast/input/test_meshes.py."""

import math
from unittest.mock import ANY

import numpy as np
import pytest

from meshes import (
    Tag,
    half_cylinders,
    half_spheres,
    hertz_cap,
    hertz_cylinder,
    hertz_grid,
    hertz_sphere,
    rings,
)

BODIES = (Tag.UPPER, Tag.LOWER)
CONTACTS = (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
TOPS = (Tag.UPPER_TOP, Tag.LOWER_BOTTOM)
CUTS = (Tag.UPPER_X0, Tag.UPPER_Y0, Tag.LOWER_X0, Tag.LOWER_Y0)
RADIUS = 8.0


def near(value, *tags, rel=1e-6):
    return dict.fromkeys(tags, pytest.approx(value, rel=rel))


# A unit block below, whose planes of symmetry are cut in space alone
BLOCK = near(1, Tag.LOWER_CONTACT, Tag.LOWER_BOTTOM, Tag.LOWER_X0)
CUBE = BLOCK | near(1, Tag.LOWER_Y0)
# Of the midpoints of a grid's cells: its height is 1 less the rise of the sphere above the square
SQUARES = (0.6 * (np.arange(500) + 0.5) / 500) ** 2
# Cells, sizes of bodies and of faces
GEOMETRY = {
    "sphere": (
        lambda: hertz_sphere(0.04),
        "tetrahedron",
        near(math.pi / 6, Tag.UPPER, rel=0.02) | near(1, Tag.LOWER),
        CUBE
        | near(math.pi / 2, Tag.UPPER_CONTACT, rel=0.01)
        | near(math.pi / 4, Tag.UPPER_TOP, Tag.UPPER_X0, Tag.UPPER_Y0, rel=0.01),
    ),
    # The cap takes about r^2 / (2 R) off each column; its mean over the square is 1/24 L
    "cap": (
        lambda: hertz_cap(8),
        "hexahedron",
        near(1 - 1 / 24, Tag.UPPER, rel=0.002) | near(1, Tag.LOWER),
        CUBE
        | near(1, Tag.UPPER_TOP)
        | dict.fromkeys((Tag.UPPER_CONTACT, Tag.UPPER_X0, Tag.UPPER_Y0), ANY),
    ),
    "grid": (
        lambda: hertz_grid(0.04),
        "hexahedron",
        near(0.36 * np.sqrt(1 - SQUARES[:, None] - SQUARES).mean(), Tag.UPPER, rel=2e-3)
        | near(1, Tag.LOWER),
        CUBE
        | near(0.36, Tag.UPPER_TOP)
        | dict.fromkeys((Tag.UPPER_CONTACT, Tag.UPPER_X0, Tag.UPPER_Y0), ANY),
    ),
    "cylinder": (
        lambda: hertz_cylinder(0.02),
        "triangle",
        near(math.pi / 4, Tag.UPPER, rel=0.005) | near(1, Tag.LOWER),
        BLOCK
        | near(1, Tag.UPPER_TOP, Tag.UPPER_X0)
        | near(math.pi / 2, Tag.UPPER_CONTACT, rel=0.005),
    ),
    "half cylinders": (
        lambda: half_cylinders(RADIUS, 0.1, zone=1.0),
        "triangle",
        near(math.pi / 2 * RADIUS**2, *BODIES, rel=2e-3),
        near(math.pi * RADIUS, *CONTACTS, rel=1e-3) | near(2 * RADIUS, *TOPS),
    ),
    "half spheres": (
        lambda: half_spheres(RADIUS, 0.4, zone=1.0),
        "tetrahedron",
        near(math.pi / 6 * RADIUS**3, *BODIES, rel=0.02),
        near(math.pi / 2 * RADIUS**2, *CONTACTS, rel=0.01)
        | near(math.pi / 4 * RADIUS**2, *TOPS, *CUTS, rel=0.01),
    ),
}


@pytest.mark.parametrize("name", GEOMETRY)
def test_geometry(name, measures):
    """Sizes are those of the bodies; bodies and faces are apart."""
    make, cell, bodies, faces = GEOMETRY[name]
    data = make()
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_name() == cell
    assert data.mesh.geometry.dim == data.mesh.topology.dim
    assert measured.bodies() == bodies
    assert measured.faces() == faces


@pytest.mark.parametrize(
    ("make", "nodes"),
    [
        # The numbers on which published comparisons were run
        *((lambda h=h: hertz_sphere(h), n) for h, n in ((0.04, 907), (0.02, 2441), (0.01, 9567))),
        (lambda: hertz_cap(8), 9**3 + 13**3),
        # The smallest mesh works
        (lambda: hertz_cap(1, 1), 16),
    ],
)
def test_node_count(make, nodes, measures):
    assert measures(make()).nodes() == nodes


def test_bodies_touch_in_the_origin(measures):
    """Each body has its own node there."""
    for data in (hertz_sphere(0.04), half_spheres(RADIUS, 0.4, zone=1.0)):
        for body in BODIES:
            x = measures(data).points(body)
            assert np.linalg.norm(x, axis=1).min() == pytest.approx(0, abs=1e-10)


def test_cap_lies_on_its_sphere(measures):
    """In another unit and with another radius."""
    facets = measures(hertz_cap(4, 3, length=10.0, radius=50.0)).facet_points(Tag.UPPER_CONTACT)
    x = np.unique(facets.reshape(-1, 3).round(9), axis=0)
    assert x.shape == (25, 3)
    assert np.allclose(np.linalg.norm(x - [0, 0, 50.0], axis=1), 50.0)
    assert x.min(axis=0) == pytest.approx(0, abs=1e-12)


def test_cells_grow_away_from_the_contact(measures):
    """The longest edge is four times as long as the shortest, in both bodies."""
    data = hertz_cap(6)
    for body, coordinate in ((Tag.UPPER, 0), (Tag.LOWER, 0), (Tag.LOWER, 2)):
        lengths = np.diff(np.unique(np.abs(measures(data).points(body)[:, coordinate]).round(9)))
        assert np.all(np.diff(lengths) > 0)
        assert lengths[-1] / lengths[0] == pytest.approx(4, rel=1e-6)


def test_a_grid_lies_on_its_sphere(measures):
    """The contact face lies on the unit sphere that touches the origin."""
    x = measures(hertz_grid(0.1)).facet_points(Tag.UPPER_CONTACT)
    assert np.allclose(np.linalg.norm(x - [0, 0, 1], axis=2), 1, rtol=0, atol=1e-12)
    assert x.min() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.06), (0.04, 0.04)])
def test_sizes_of_a_grid(measures, h_master, expected):
    """Cells are of one size in the zone and grow beyond, by a quarter at most."""
    measured = measures(hertz_grid(0.04, h_master))
    for tag, size in ((Tag.UPPER, 0.04), (Tag.LOWER, expected)):
        across = np.unique(measured.points(tag)[:, 0].round(9))
        lengths = np.diff(across)
        zone = across[1:] < 0.2 + 1e-6
        assert lengths[zone] == pytest.approx(size, rel=0.15)
        assert np.ptp(lengths[zone]) < 1e-6
        assert np.all(lengths[1:] / lengths[:-1] < 1.26)
    depth = -np.unique(measured.points(Tag.LOWER)[:, 2].round(9))[::-1]
    assert 0.5 * expected < depth[1] <= expected + 1e-9


def edges_near_the_origin(measured, tag, reach):
    """Lengths of the edges of facets within reach, shape (n, edges of a facet), and of all."""
    corners = measured.facet_points(tag)
    after = np.roll(corners, 1, axis=1)
    lengths = np.linalg.norm(corners - after, axis=2)
    return lengths[np.linalg.norm(corners, axis=2).max(axis=1) < reach], lengths


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.01), (0.03, 0.03)])
def test_a_cylinder_and_its_block_have_sizes_of_their_own(measures, h_master, expected):
    """The sizes hold on the contact faces, where the bodies lie on each other."""
    measured = measures(hertz_cylinder(0.02, h_master))
    for tag, size in zip(CONTACTS, (0.02, expected), strict=True):
        lengths, _ = edges_near_the_origin(measured, tag, 0.15)
        assert len(lengths) >= 4
        assert np.allclose(lengths, size, rtol=0.15)


def test_wider_zone_has_more_nodes():
    """The zone keeps the fine size."""
    narrow, wide = (hertz_cylinder(0.02, zone=zone).mesh.geometry.x.shape[0] for zone in (0.1, 0.4))
    assert wide > 2 * narrow


@pytest.mark.parametrize(
    ("make", "h", "up"), [(half_cylinders, 0.1, 1), (half_spheres, 0.4, 2)], ids=["2D", "3D"]
)
def test_faces_of_halves_lie_where_they_should(make, h, up, measures):
    """Nodes of round faces are on them, those of flat faces in their planes."""
    measured = measures(make(RADIUS, h, zone=1.0))
    for face, flat, height in zip(CONTACTS, TOPS, (RADIUS, -RADIUS), strict=True):
        r = np.linalg.norm(measured.facet_points(face) - height * np.eye(3)[up], axis=2)
        assert np.allclose(r, RADIUS, rtol=0, atol=1e-10)
        assert np.allclose(measured.facet_points(flat)[..., up], height, atol=1e-10)
    upper, lower = (measured.points(body)[:, up] for body in BODIES)
    assert [upper.min(), lower.max()] == pytest.approx([0, 0], abs=1e-10)


@pytest.mark.parametrize(("h_master", "expected"), [(None, 1.5), (True, 0.6)])
@pytest.mark.parametrize(
    ("make", "h", "least", "far"),
    [(half_cylinders, 0.05, 15, 0.5), (half_spheres, 0.2, 8, 1.0)],
    ids=["2D", "3D"],
)
def test_each_half_has_its_own_size(make, h, least, far, h_master, expected, measures):
    """The sizes hold in the zone, and the cells are much larger far away."""
    measured = measures(make(RADIUS, h, h_master and expected * h, zone=1.0))
    for tag, size in zip(CONTACTS, (h, expected * h), strict=True):
        lengths, every = edges_near_the_origin(measured, tag, 0.85)
        assert len(lengths) > least
        assert np.mean(lengths) == pytest.approx(size, rel=0.15)
        assert make is half_spheres or np.allclose(lengths, size, rtol=0.15)
        assert far < every.mean(axis=1).max() < 2 * far


def test_nodes_of_half_cylinders_do_not_match(measures):
    """But for the origin, no node of one arc is above one of the other."""
    measured = measures(half_cylinders(RADIUS, 0.05, zone=1.0))
    upper, lower = (np.unique(measured.facet_points(tag)[..., 0]) for tag in CONTACTS)
    upper, lower = (x[np.abs(x) < 0.5] for x in (upper, lower))
    close = np.abs(upper[:, None] - lower).min(axis=1) < 1e-3
    assert close.sum() < len(upper) / 2


@pytest.mark.parametrize(
    ("make", "unit"),
    [
        (lambda R: half_cylinders(R, R / 8, zone=R / 4), 1024.0),
        (lambda R: rings(6, radii=(R, 1.5 * R, 2 * R)), 1000.0),
    ],
)
def test_radii_scale_the_mesh(make, unit):
    """The same mesh in another unit of length."""
    a, b = (np.sort(np.linalg.norm(make(R).mesh.geometry.x, axis=1)) for R in (1.0, unit))
    assert np.allclose(unit * a, b)


ROUND = {
    Tag.UPPER_CONTACT: 1.5,
    Tag.UPPER_TOP: 1.0,
    Tag.LOWER_CONTACT: 1.5,
    Tag.LOWER_BOTTOM: 2.0,
}


def test_geometry_of_rings(measures):
    """Areas and lengths are those of inscribed polygons, bodies and faces are apart."""
    data = rings(20, 30)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_name() == "quadrilateral"
    bodies, faces = measured.bodies(), measured.faces()
    for tag, n, inner, outer in ((Tag.UPPER, 20, 1.0, 1.5), (Tag.LOWER, 30, 1.5, 2.0)):
        sector = n * math.sin(math.pi / 2 / n) / 2
        assert bodies.pop(tag) == pytest.approx(sector * (outer**2 - inner**2))
    assert not bodies
    for tag, radius in ROUND.items():
        n = 20 if tag < Tag.LOWER_CONTACT else 30
        assert faces.pop(tag) == pytest.approx(2 * n * radius * math.sin(math.pi / 4 / n))
    assert faces == near(0.5, *CUTS)


def test_faces_of_rings_lie_where_they_should(measures):
    """Nodes of arcs are on their circle, those of planes on their plane."""
    measured = measures(rings(7))
    for tag, radius in ROUND.items():
        r = np.linalg.norm(measured.facet_points(tag), axis=2)
        assert np.allclose(r, radius, rtol=0, atol=1e-12)
    for tag in CUTS:
        axis = int(tag in (Tag.UPPER_Y0, Tag.LOWER_Y0))
        assert np.allclose(measured.facet_points(tag)[..., axis], 0, atol=1e-12)


@pytest.mark.parametrize(
    ("n", "n_master", "expected"), [(1, None, 2), (10, None, 15), (10, 10, 10), (9, 4, 4)]
)
def test_numbers_of_cells_of_rings(measures, n, n_master, expected):
    """The arcs have the cells asked for; by default they do not match."""
    measured = measures(rings(n, n_master))
    for tag in ROUND:
        cells = n if tag < Tag.LOWER_CONTACT else expected
        assert len(measured.facet_points(tag)) == cells


def test_cells_of_rings_are_about_square(measures):
    """Radial edges are as long as those at half way between the arcs, also in thin rings."""
    measured = measures(rings(40, 60, radii=(1.0, 2.0, 2.2)))
    for plane, n, mean in ((Tag.UPPER_Y0, 40, 1.5), (Tag.LOWER_Y0, 60, 2.1)):
        edges = measured.facet_points(plane)
        lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1)
        assert np.allclose(lengths, math.pi / 2 * mean / n, rtol=0.15)
