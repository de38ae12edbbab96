# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of self-contact."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import mesh


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
