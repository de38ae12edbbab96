# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bulk and contacts assembled from forms: the assembler's own system, and misuse."""

from petsc4py import PETSc

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem, la
from dolfinx.fem.petsc import assemble_matrix
from dolfinx.mesh import CellType

from meshes import Tag
from scenes.blocks import Blocks
from scenes.coupled import Coupled
from story import METHODS


def make(cell=CellType.hexahedron, *, is_free=False, **options):
    """The upper block on the lower one, and on a floor; it may be free."""
    scene = Blocks(cell, gap=0.02)
    gdim = scene.u.function_space.mesh.geometry.dim
    if is_free:
        del scene.bcs[gdim:]
    # Nothing holds a free one along the surface
    friction = 0.0 if is_free else 0.3
    contacts = [scene.contact(friction=friction, offset=0.05, **options)]
    floor = cx.Plane(point=[0.0] * gdim, normal=[0.0] * (gdim - 1) + [1.0])
    contacts.append(cx.Contact(cx.Surface(scene.tags, Tag.UPPER_CONTACT), floor, **options))
    assembler = cx.ContactAssembler(scene.F, scene.u, contacts=contacts, bcs=scene.bcs)
    J = fem.form(ufl.derivative(scene.F, scene.u))
    return scene, assembler, cx.Forms(assembler, J), J


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("cell", "is_free"),
    [(CellType.triangle, True), (CellType.triangle, False), (CellType.hexahedron, False)],
)
def test_the_system_is_that_of_the_assembler(cell, is_free, method):
    scene, assembler, forms, J = make(cell, is_free=is_free, method=method)
    rng = np.random.default_rng(3)
    for bc in scene.bcs:
        bc.set(scene.u.x.array)
    assembler.begin_step()
    assembler.settle()
    x = assembler.x
    x.array[assembler.system.num_bulk :] += 0.01 * rng.standard_normal(
        x.getLocalSize() - assembler.system.num_bulk
    )
    forms.update(x)
    b, expected = assembler.create_vector(), assembler.create_vector()
    force = la.vector(J._cpp_object.function_spaces[0].dofmap.index_map, len(scene.u))
    fem.assemble_vector(force.array, fem.form(scene.F))
    for bc in scene.bcs:
        bc.set(force.array, scene.u.x.array, -1)
    b.array[: len(force.array)] = force.array
    forms.assemble_vector(b)
    assembler.residual(expected)
    assert (b - expected).norm() <= 1e-13 * expected.norm()
    A = forms.matrix()
    assemble_matrix(A, [[J]], bcs=scene.bcs)
    forms.assemble_matrix(A)
    assert (assembler.loop.free_bodies.springs is not None) == is_free
    # Columns of prescribed displacements stay in contact's part
    dx = x.duplicate()
    dx.array[:] = rng.standard_normal(x.getLocalSize())
    markers = assembler.bulk.markers
    dx.array[: len(markers)][markers == 1] = 0
    product, wanted = x.duplicate(), x.duplicate()
    A.mult(dx, product)
    assembler.jacobian().mult(dx, wanted)
    assert (product - wanted).norm() <= 1e-13 * wanted.norm() > 0
    blocks, others = forms.blocks(A), assembler.blocks()
    for name in "BCD":
        assert others[name].norm() > 0
    for name in "BD":
        assert (blocks[name] - others[name]).norm() <= 1e-13 * others[name].norm()


def test_the_matrix_of_other_pairs_is_another_one():
    scene, assembler, forms, _ = make(CellType.triangle)
    assembler.begin_step()
    forms.settle(assembler.x)
    first = forms.matrix()
    forms.update(assembler.x)
    assert forms.matrix() is first
    scene.u.x.array[0::2] += 0.35 * (scene.u.function_space.tabulate_dof_coordinates()[:, 1] > 0)
    assembler.begin_step()
    forms.settle(assembler.x)
    with pytest.raises(ValueError, match="A is not the matrix of the pairs of now"):
        forms.assemble_matrix(first)
    assert forms.matrix() is not first


def test_misuse():
    scene, assembler, forms, J = make(CellType.triangle)
    with pytest.raises(RuntimeError, match=r"residual\(\) before begin_step\(\)"):
        forms.assemble_vector(assembler.x)
    assembler.begin_step()
    with pytest.raises(ValueError, match="was given a Vec of the sizes"):
        forms.assemble_vector(PETSc.Vec().createMPI(3))
    for wrong in (scene.F, fem.form(scene.F)):
        with pytest.raises(ValueError, match="J must be a compiled bilinear form"):
            cx.Forms(assembler, wrong)
    with pytest.raises(RuntimeError, match="has no results yet"):
        scene.contact().forms()
    coupled = Coupled("mixed").problem.assembler
    with pytest.raises(ValueError, match="Forms is for a displacement alone"):
        cx.Forms(coupled, J)
