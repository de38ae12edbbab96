# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Gmsh is left as it was found, and its errors reach every rank."""

import sys

from mpi4py import MPI

import gmsh
import pytest

from dolfinx.mesh import CellType

from meshes import Tag, blocks, hertz_sphere
from meshes.build import build_mesh
from meshes.gmsh_session import gmsh_session


@pytest.fixture
def running_gmsh():
    """Provide a gmsh that the user has started, with a model and options of theirs."""
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.ElementOrder", 2)
    gmsh.option.setNumber("Mesh.MeshSizeFactor", 0.5)
    yield gmsh
    gmsh.finalize()


def test_gmsh_is_finalised():
    """A gmsh that we started is gone at the end."""
    with gmsh_session("test"):
        assert gmsh.isInitialized()
        assert gmsh.model.getCurrent() == "contactx_test"
    assert not gmsh.isInitialized()


def test_gmsh_is_finalised_after_an_error():
    """Also after an error, which comes through unchanged."""
    with pytest.raises(RuntimeError, match="inside"), gmsh_session("test"):
        raise RuntimeError("inside")
    assert not gmsh.isInitialized()


@pytest.mark.parametrize("name", ["mine", None])
def test_user_model_survives(running_gmsh, name):
    """The user's model is current again, whether it has a name or not, and so are options."""
    if name is not None:
        running_gmsh.model.add(name)
    running_gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    running_gmsh.model.occ.synchronize()
    with pytest.raises(RuntimeError, match="inside"), gmsh_session("test"):
        raise RuntimeError("inside")
    blocks(CellType.triangle, (1, 1), (1, 1))
    assert running_gmsh.model.getCurrent() == (name or "")
    assert len(running_gmsh.model.getEntities(3)) == 1
    assert running_gmsh.option.getNumber("Mesh.ElementOrder") == 2
    assert running_gmsh.option.getNumber("Mesh.MeshSizeFactor") == 0.5


def test_user_options_do_not_change_our_mesh(running_gmsh):
    """The mesh is the same as with a fresh gmsh."""
    mesh = hertz_sphere(0.04).mesh
    assert mesh.geometry.index_map().size_global == 907
    assert mesh.geometry.cmaps[0].degree == 1


def test_missing_gmsh_says_how_to_install_it(monkeypatch):
    """The message names the extra, on every rank."""
    monkeypatch.setitem(sys.modules, "gmsh", None)
    with pytest.raises((ImportError, RuntimeError), match=r"pip install contactx\[demo\]"):
        hertz_sphere(0.2)


def test_tags_name_their_groups():
    """The physical groups carry the names of the tags."""
    groups = blocks(CellType.triangle, (1, 1), (1, 1)).physical_groups
    assert groups["upper_contact"].tag == Tag.UPPER_CONTACT
    assert groups["lower"].dim == 2


def test_error_of_a_recipe_reaches_every_rank():
    """No rank waits for a mesh that will not come."""

    def recipe(gmsh):
        raise RuntimeError("no such shape")

    with pytest.raises(RuntimeError, match="no such shape"):
        build_mesh("test", 2, recipe, MPI.COMM_WORLD)
