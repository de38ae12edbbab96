# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A surface in contact with itself, all of several bodies with one another, and its options."""

from mpi4py import MPI

import numpy as np
import pytest
from closing_clip import CLOSING, SLIT, THICKNESS, Clip

import contactx as cx
from dolfinx import mesh
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.problems import make_problem
from scenes.thin_sheets import PRESSURE, ThinSheets
from story import displacement, elasticity, fix


@pytest.mark.parametrize("steps", [1, 4, 16])
def test_the_tips_of_a_clip_meet_and_stop(steps):
    clip = Clip(0.1)
    clip.run(2 * CLOSING, steps)
    assert clip.penetration < 0.01 * THICKNESS
    # Beam theory of a thin ring, of which this is none
    assert clip.contact_force == pytest.approx(CLOSING, rel=0.06)
    imbalance = np.linalg.norm(clip.problem.report.imbalance)
    assert imbalance <= 1e-10 * clip.contact_force
    # Tips that were open by much are still there: they have stopped
    assert clip.gap() == pytest.approx(0, abs=0.01 * SLIT)


def test_a_scene_that_is_turned_turns_its_answer():
    straight, turned = Clip(0.1), Clip(0.1, angle=0.7)
    for clip in (straight, turned):
        clip.run(2 * CLOSING, 2)
    assert turned.contact_force == pytest.approx(straight.contact_force, rel=1e-9)
    assert turned.problem.report.iterations == straight.problem.report.iterations
    c, s = np.cos(0.7), np.sin(0.7)
    expected = straight.u.x.array.reshape(-1, 2) @ np.array([[c, s], [-s, c]])
    assert turned.u.x.array == pytest.approx(expected.ravel(), abs=1e-9)


def test_what_goes_through_itself_is_refused():
    """The search does not reach what the tips go through: only the audit sees it."""
    clip = Clip(0.1, search_distance=1e-4)
    clip.press(2 * CLOSING)
    with pytest.raises(cx.ConvergenceError, match="went through"):
        clip.problem.solve()


def test_the_condensed_solver_finds_the_same():
    moved = []
    for options in ({}, {"pc_type": "condensed"}):
        sheets = ThinSheets(friction=0.3, petsc_options=options)
        sheets.problem.solve()
        moved.append(sheets.u.x.array.copy())
    assert moved[1] == pytest.approx(moved[0], abs=1e-8 * np.abs(moved[0]).max())


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_thin_sheets_have_two_sides(friction):
    """The middle one carries on both sides, thinner than its facets, tagged all around."""
    sheets = ThinSheets(friction=friction)
    sheets.problem.solve()
    contact = sheets.contact
    nodes = contact.discrete.nodes
    assert np.linalg.norm(sheets.problem.report.imbalance) <= 1e-10 * PRESSURE
    # Two layers of contact carry the load
    total = np.abs((nodes.area[:, None] * contact.multiplier.reshape(len(nodes.area), -1)).sum())
    assert np.nanmax(np.abs(nodes.gap[nodes.closed])) < 1e-10
    if friction == 0:
        assert total == pytest.approx(2 * PRESSURE, rel=1e-9)
    # No node is on both sides
    slaves = set(contact.slave_nodes[nodes.closed].tolist())
    for pairs in contact.discrete.pairs:
        for row in pairs.nodes:
            if row[0] in slaves:
                assert not slaves & set(row[1:].tolist())


def test_sides_stay_what_they_are():
    """Which nodes are slaves does not change while a load grows."""
    clip = Clip(0.1)
    clip.run(1.5 * CLOSING, 3)
    before = clip.contact.discrete.nodes.closed.copy()
    assert before.any()
    for load in (1.7, 2.0, 2.5):
        clip.press(load * CLOSING)
        clip.problem.solve()
        after = clip.contact.discrete.nodes.closed
        assert (after | before).sum() == max(after.sum(), before.sum())


@pytest.mark.parametrize("cell", [CellType.hexahedron, CellType.tetrahedron], ids=lambda c: c.name)
def test_blocks_that_nobody_pairs(cell):
    """All faces of two blocks are one surface; the contact is that of the faces that meet."""
    forces = []
    for is_named in (True, False):
        data = meshes.blocks(cell, [4, 4, 2], [3, 3, 2])
        u, tags = displacement(data.mesh), data.facet_tags
        if is_named:
            faces = [cx.Surface(tags, face) for face in (Tag.LOWER_CONTACT, Tag.UPPER_CONTACT)]
            contact = cx.Contact(*faces, friction=0.3)
        else:
            contact = cx.Contact.all(tags, friction=0.3)
        bcs = [fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)]
        bcs += [fix(u, tags, i, -0.05 * (i == 2), Tag.UPPER_TOP) for i in range(3)]
        problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], bcs)
        problem.solve()
        forces.append(contact.force)
    assert forces[1] == pytest.approx(forces[0], abs=1e-9)


@pytest.fixture(scope="module")
def tags():
    domain = mesh.create_unit_square(MPI.COMM_SELF, 2, 2)
    domain.topology.create_connectivity(1, 2)
    facets = mesh.exterior_facet_indices(domain.topology)
    values = np.where(np.arange(len(facets)) < 4, 1, 2).astype(np.int32)
    return mesh.meshtags(domain, 1, np.sort(facets), values)


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"method": "surface-to-surface"}, ValueError, "method is .* the same surface"),
        ({"sliding": "small"}, ValueError, "sliding is .* the same surface"),
        ({"tied": True}, ValueError, "tied is for two surfaces"),
        ({"excluded_distance": -1.0}, ValueError, "excluded_distance is -1: give a finite"),
        ({"excluded_distance": np.inf}, ValueError, "excluded_distance is inf"),
        ({"excluded_distance": "1"}, TypeError, "excluded_distance is str '1': give a length"),
    ],
)
def test_refused_options(tags, options, error, text):
    surface = cx.Surface(tags, 1)
    with pytest.raises(error, match=text):
        cx.Contact(slave=surface, master=surface, **options)
    with pytest.raises(error, match=text):
        cx.Contact.all(tags, 1, **options)


def test_excluded_distance_is_for_self_contact_alone(tags):
    with pytest.raises(ValueError, match="not the same surface: leave it out"):
        cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2), excluded_distance=0.1)


def test_surfaces_that_share_a_part_are_refused(tags):
    with pytest.raises(ValueError, match="for self-contact the same surface twice"):
        cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 1, 2))


def test_the_same_tags_are_the_same_surface(tags):
    contact = cx.Contact(cx.Surface(tags, 1, 2), cx.Surface(tags, 2, 1))
    assert contact.is_self
    assert str(contact) == "Contact of Surface(tags=(1, 2), 8 facets) with itself"


def test_all_takes_all_tags(tags):
    assert cx.Contact.all(tags).slave.tags == (1, 2)
    assert cx.Contact.all(tags, 2).slave.tags == (2,)
    with pytest.raises(TypeError, match="facet_tags must be dolfinx MeshTags"):
        cx.Contact.all(None)


def test_all_takes_surfaces(tags):
    first, second = cx.Surface(tags, 1), cx.Surface(tags, 2)
    for given in (([first, second],), (first, second), ((first, second, first),)):
        contact = cx.Contact.all(*given, friction=0.3)
        assert contact.is_self and contact.slave.tags == (1, 2)
    assert cx.Contact.all(second).slave.tags == (2,)


def test_all_refuses_what_is_no_surface(tags):
    domain = mesh.create_unit_square(MPI.COMM_SELF, 1, 1)
    domain.topology.create_connectivity(1, 2)
    facets = mesh.exterior_facet_indices(domain.topology)
    other = mesh.meshtags(domain, 1, np.sort(facets), np.full(len(facets), 2, dtype=np.int32))
    with pytest.raises(ValueError, match="have different facet tags: put the tags"):
        cx.Contact.all([cx.Surface(tags, 1), cx.Surface(other, 2)])
    with pytest.raises(TypeError, match="not int 2 among surfaces"):
        cx.Contact.all(cx.Surface(tags, 1), 2)
    with pytest.raises(ValueError, match="has no surface"):
        cx.Contact.all([])
