# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Displacement, mesh and Dirichlet conditions of a problem."""

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest

import basix.ufl
import contactx as cx
from dolfinx import fem, mesh

from inputs.rows import problem, refused, scene, table, with_
from meshes import Tag
from story import displacement, fix

VECTORS = ("Lagrange", 1, (2,))


def space(blocks, *element):
    return fem.functionspace(blocks.u.function_space.mesh, element)


def mixed(blocks):
    cell = blocks.u.function_space.mesh.basix_cell()
    parts = [basix.ufl.element("Lagrange", cell, 1, shape=(2,)), basix.ufl.element("DG", cell, 0)]
    V = fem.functionspace(blocks.u.function_space.mesh, basix.ufl.mixed_element(parts))
    return fem.Function(V)


def single():
    domain = mesh.create_unit_square(MPI.COMM_WORLD, 1, 1, dtype=np.float32)
    return fem.Function(fem.functionspace(domain, VECTORS), dtype=np.float32)


def shell():
    x = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    element = basix.ufl.element("Lagrange", "triangle", 1, shape=(3,))
    domain = mesh.create_mesh(MPI.COMM_WORLD, np.array([[0, 1, 2]]), element, x)
    return displacement(domain)


def prescribed(value):
    """A problem with a Dirichlet value."""

    def do():
        blocks = scene()
        blocks.bcs[-1].g.value[...] = value
        problem(blocks)

    return do


def start(value):
    def do():
        blocks = scene()
        blocks.u.x.array[4] = value
        problem(blocks)

    return do


def coordinates(value):
    def do():
        blocks = scene()
        contact = blocks.contact()
        blocks.u.function_space.mesh.geometry.x[3, 1] = value
        problem(blocks, contacts=[contact])

    return do


def inside(blocks):
    """All nodes constrained, some of them below the plane."""
    V = blocks.u.function_space
    dofs = np.arange(V.dofmap.index_map.size_local, dtype=np.int32)
    contact = blocks.contact(master=cx.Plane((0.0, 0.1), (0.0, 1.0)))
    problem(blocks, bcs=[fem.dirichletbc(np.zeros(2), dofs, V)], contacts=[contact])


WANTED = r'contact needs.*functionspace\(mesh, \("Lagrange", 1, \(2,\)\)\)'
BCS = r"bcs\[0\] is a condition on another function space than that of u: make it with"
FINITE = "bcs prescribe displacements that are not finite, at 3 dofs: give finite numbers"
ROWS = {
    TypeError: [
        (lambda: problem(u=np.zeros(3)), "u must be a dolfinx.fem.Function, not ndarray"),
        (lambda: problem(u=single()), "u holds float32 values, but contactx needs float64"),
        (
            with_("u", lambda b: fem.Function(b.u.function_space, dtype=np.complex128)),
            "u holds complex128 values, but contactx needs float64",
        ),
        (with_("bcs", lambda b: b.bcs[0]), r"bcs must be a list of conditions: write bcs=\[bc\]"),
        (lambda: problem(bcs="bcs"), "bcs must be a list of fem.dirichletbc, not str"),
        (lambda: problem(bcs=[1.0]), r"bcs\[0\] is a float: give a fem.dirichletbc"),
    ],
    ValueError: [
        (
            with_("u", lambda b: fem.Function(space(b, "Lagrange", 1))),
            r"u has values of shape \(\), but the displacement of this mesh needs \(2,\)",
        ),
        (
            with_("u", lambda b: fem.Function(space(b, "Lagrange", 1, (3,)))),
            r"u has values of shape \(3,\), but",
        ),
        (
            with_("u", lambda b: fem.Function(space(b, "Lagrange", 3, (2,)))),
            f"u is of degree 3; {WANTED}",
        ),
        (
            with_("u", lambda b: fem.Function(space(b, "N1curl", 1))),
            f"u is not in a continuous Lagrange space; {WANTED}",
        ),
        (
            with_("u", lambda b: fem.Function(space(b, "DG", 1, (2,)))),
            f"u is not in a continuous Lagrange space; {WANTED}",
        ),
        (with_("u", mixed), "u is in a mixed space or a part of one"),
        (with_("u", lambda b: mixed(b).sub(0)), "u is in a mixed space or a part of one"),
        (
            lambda: problem(u=shell()),
            "u is on a mesh of cells of dimension 2 in 3 dimensions; contact needs",
        ),
        (
            start(np.nan),
            r"the displacement u is not finite at 1 dofs, first at node \d+ of the mesh.*: repair",
        ),
        (
            start(np.inf),
            r"the displacement u is not finite at 1 dofs, first at node \d+ of the mesh.*: repair",
        ),
        (
            coordinates(np.nan),
            r"coordinates of the mesh are not finite at 1 dofs, first at node .*: repair the mesh",
        ),
        (coordinates(-np.inf), "coordinates of the mesh are not finite at 1 dofs"),
        (with_("bcs", lambda b: scene().bcs), BCS),
        (
            with_(
                "bcs",
                lambda b: [fix(fem.Function(space(b, *VECTORS)), b.tags, 0, 0.0, Tag.LOWER_BOTTOM)],
            ),
            BCS,
        ),
        (
            with_(
                "bcs",
                lambda b: [
                    fix(
                        fem.Function(space(b, "Lagrange", 2, (2,))),
                        b.tags,
                        0,
                        0.0,
                        Tag.LOWER_BOTTOM,
                    )
                ],
            ),
            BCS,
        ),
        (prescribed(np.nan), FINITE),
        (prescribed(-np.inf), FINITE),
        (
            lambda: inside(scene()),
            "contact 0 .* is over-constrained: .* constrain 3 slave nodes inside the rigid obst",
        ),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)


@pytest.mark.parametrize("scalar", [np.complex128, np.float32])
def test_petsc_of_another_scalar(monkeypatch, scalar):
    monkeypatch.setattr(PETSc, "ScalarType", scalar)
    with pytest.raises(
        TypeError, match=f"PETSc was built with {np.dtype(scalar).name} scalars.*real"
    ):
        problem()
