# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Refused input of FluidPenetration."""

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks


@pytest.fixture(scope="module")
def scene():
    return Blocks(CellType.quadrilateral)


def fluid(scene, **changed):
    surface = cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
    options = {
        "domain": scene.u.function_space.mesh,
        "surface": surface,
        "entry": lambda x: np.isclose(x[0], 0),
        "contacts": [scene.contact()],
    }
    return cx.FluidPenetration(**(options | changed))


@pytest.mark.parametrize(
    ("changed", "error", "message"),
    [
        ({"domain": 1}, TypeError, "domain must be a dolfinx Mesh, not int 1"),
        ({"surface": 1}, TypeError, "surface must be a contactx.Surface, not int 1"),
        ({"entry": 1}, TypeError, "entry must be a contactx.Surface or a function of positions"),
        ({"entry": lambda x: x[0]}, TypeError, "entry returns an array of float64"),
        ({"entry": lambda x: np.isclose(x[0], 9)}, ValueError, "the fluid enters nowhere"),
        ({"contacts": []}, ValueError, "contacts is empty"),
        ({"contacts": None}, TypeError, "contacts must be a list"),
    ],
)
def test_refused(scene, changed, error, message):
    with pytest.raises(error, match=message):
        fluid(scene, **changed)


def test_a_surface_that_the_entry_does_not_touch_is_refused(scene):
    with pytest.raises(ValueError, match="the fluid enters nowhere"):
        fluid(scene, entry=cx.Surface(scene.tags, Tag.UPPER_TOP))


def test_tags_of_another_mesh_are_refused(scene):
    other = Blocks(CellType.quadrilateral)
    with pytest.raises(ValueError, match="belong to another mesh"):
        fluid(scene, surface=cx.Surface(other.tags, Tag.LOWER_CONTACT))


def test_contacts_must_belong_to_one_problem(scene):
    with pytest.raises(RuntimeError, match="pass it to a ContactProblem first"):
        fluid(scene).update()
    contacts = [scene.contact(), scene.contact()]
    for contact in contacts:
        scene.problem(contact)
    with pytest.raises(ValueError, match="belong to several problems"):
        fluid(scene, contacts=contacts).update()
