# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a problem is made of: displacement, forms, conditions, contacts, options."""

import gc
import sys
import warnings
import weakref
from types import SimpleNamespace

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from inputs.rows import problem, refused, scene, table, with_
from meshes import Tag
from scenes import Blocks
from story import displacement, elasticity, fix

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
DISPLACEMENTS = {
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


@pytest.mark.parametrize("scalar", [np.complex128, np.float32])
def test_petsc_of_another_scalar(monkeypatch, scalar):
    monkeypatch.setattr(PETSc, "ScalarType", scalar)
    with pytest.raises(
        TypeError, match=f"PETSc was built with {np.dtype(scalar).name} scalars.*real"
    ):
        problem()


def stiffness(V, W=None):
    """Some form of two arguments."""
    return ufl.inner(ufl.grad(ufl.TrialFunction(V)), ufl.grad(ufl.TestFunction(W or V))) * ufl.dx


def load(blocks, V):
    """Some form of one argument that depends on the displacement."""
    return ufl.inner(ufl.grad(blocks.u), ufl.grad(ufl.TestFunction(V))) * ufl.dx


RESIDUAL = "give the residual, linear in a TestFunction"
SPACE = "an argument in .* not of the function space of u: make test and trial functions with"
FORMS = {
    TypeError: [
        (lambda: problem(F="F"), f"F must be a ufl.Form, not str: {RESIDUAL}"),
        (lambda: problem(F=0), "F must be a ufl.Form, not int"),
        (with_("F", lambda b: fem.form(b.F)), "F must be a ufl.Form, not Form"),
        (lambda: problem(J="J"), "J must be a ufl.Form, not str: give the derivative of F"),
    ],
    ValueError: [
        (lambda: problem(F=ufl.Form([])), "F is a form without integrals"),
        (
            with_("F", lambda b: ufl.inner(b.u, b.u) * ufl.dx),
            f"F has 0 arguments, but must have 1: {RESIDUAL}",
        ),
        (with_("F", lambda b: ufl.derivative(b.F, b.u)), "F has 2 arguments, but must have 1"),
        (with_("F", lambda b: stiffness(b.u.function_space)), "F has 2 arguments, but must have 1"),
        (with_("F", lambda b: scene().F), f"F has {SPACE}"),
        (
            with_("F", lambda b: elasticity(fem.Function(b.u.function_space), 1.0, 0.3)),
            "F does not depend on u.* write F with the very Function",
        ),
        (with_("F", lambda b: load(b, space(b, "Lagrange", 2, (2,)))), f"F has {SPACE}"),
        (with_("F", lambda b: load(b, space(b, *VECTORS))), f"F has {SPACE}"),
        (
            with_(
                "F",
                lambda b: (
                    b.F
                    + ufl.inner(scene().u, ufl.TestFunction(b.u.function_space))
                    * ufl.dx(b.u.function_space.mesh)
                ),
            ),
            "F has integrals or functions on another mesh than u: contact needs one mesh",
        ),
        (with_("J", lambda b: b.F), "J has 1 arguments, but must have 2: give the derivative"),
        (with_("J", lambda b: stiffness(space(b, "Lagrange", 2, (2,)))), f"J has {SPACE}"),
        (with_("J", lambda b: stiffness(scene().u.function_space)), f"J has {SPACE}"),
    ],
}


def options(**given):
    return lambda: problem(petsc_options=given)


def used_twice():
    blocks = scene()
    contact = blocks.contact()
    problem(blocks, contacts=[contact])
    problem(blocks, contacts=[contact])


KIND = r"PETSc refuses an option of the solver: .*{}.* Correct petsc_options"
OPTIONS = {
    TypeError: [
        (
            with_("contacts", lambda b: b.contact()),
            r"contacts must be a list: write contacts=\[contact\]",
        ),
        (lambda: problem(contacts=None), "contacts must be a list of contactx.Contact, not None"),
        (
            with_("contacts", lambda b: (c for c in [b.contact()])),
            "contacts must be a list of contactx.Contact, not generator",
        ),
        (
            with_("contacts", lambda b: [b.contact().slave]),
            "contacts holds a Surface: pass a list of contactx.Contact",
        ),
        (lambda: problem(petsc_options_prefix=3), "petsc_options_prefix is 3: give a string"),
        (
            lambda: problem(petsc_options="-snes_rtol 1"),
            "petsc_options must be a dictionary, not str: write",
        ),
        (
            lambda: problem(petsc_options=["snes_rtol"]),
            "petsc_options must be a dictionary, not list",
        ),
        (lambda: problem(petsc_options={1: 2}), "petsc_options holds the name 1: give strings"),
        (
            lambda: problem(form_compiler_options="-O3"),
            "form_compiler_options must be a dictionary, not str",
        ),
        (lambda: problem(jit_options="x"), "jit_options must be a dictionary, not str"),
    ],
    ValueError: [
        *(
            (
                options(**{name: value}),
                rf"petsc_options\['{name}'\] is .*: give a number of at least 0",
            )
            for name, value in (
                ("snes_rtol", -1e-8),
                ("snes_atol", "abc"),
                ("snes_rtol", float("nan")),
                ("snes_atol", float("inf")),
                ("snes_rtol", None),
            )
        ),
        (lambda: problem(contacts=[]), "contacts is empty: pass at least one Contact"),
        (with_("contacts", lambda b: [b.contact()] * 2), "contacts lists the same Contact twice"),
        (
            lambda: problem(petsc_options_prefix=""),
            "petsc_options_prefix is empty: give a unique one",
        ),
        (
            lambda: problem(petsc_options_prefix="-a_"),
            "petsc_options_prefix is '-a_': give one without dash and spaces",
        ),
        (
            lambda: problem(petsc_options_prefix="a b_"),
            "petsc_options_prefix is 'a b_': give one without dash and spaces",
        ),
        (
            lambda: problem(petsc_options={"-snes_rtol": 1e-9}),
            "petsc_options holds '-snes_rtol': leave out the dash",
        ),
        (
            options(snes_max_it=1.5),
            r"petsc_options\['snes_max_it'\] is 1\.5: give an integer of at least 0",
        ),
        (options(snes_type="newton"), KIND.format("SNES type newton")),
        (options(ksp_type="nope"), KIND.format("KSP type nope")),
        (options(pc_type=None), KIND.format("PC type")),
        (options(snes_linesearch_type="bad"), KIND.format("Line Search type bad")),
        (options(pc_factor_mat_solver_type="nope"), KIND.format("solver type nope")),
        (options(snes_divergence_tolerance=-7), KIND.format("Divergence tolerance")),
        (
            lambda: problem(form_compiler_options={"nonsense": 1}),
            "form_compiler_options holds 'nonsense', which is none: give one of",
        ),
        (
            lambda: problem(form_compiler_options={"scalar_type": np.float32}),
            r"form_compiler_options\['scalar_type'\] .* needs real double precision",
        ),
        (
            lambda: problem(jit_options={"nonsense": 1}),
            "jit_options holds 'nonsense', which is none: give one of",
        ),
    ],
    RuntimeError: [
        (used_twice, "belongs to a ContactProblem already: create one"),
    ],
}


@pytest.mark.parametrize("name", ["snes_rtoll", "hostile_snes_rtol", "condensed_nonsense"])
def test_options_that_nothing_reads_are_warned_of(name):
    with pytest.warns(UserWarning, match=f"petsc_options has '{name}', which nothing has read"):
        problem(petsc_options={name: 1e-5, "snes_max_it": 40})


def test_options_that_are_read_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        problem(petsc_options={"pc_type": "condensed", "condensed_mg_levels_ksp_max_it": 2})
        problem(petsc_options={"mat_mumps_icntl_14": 80, "snes_linesearch_type": "bt"})
        problem(form_compiler_options={"scalar_type": np.float64})


def test_a_refused_problem_frees_its_contacts():
    blocks = scene()
    contact = blocks.contact()
    with pytest.raises(ValueError, match="Correct petsc_options"):
        problem(blocks, contacts=[contact], petsc_options={"ksp_type": "nope"})
    assert not blocks.u.x.array.any()
    other = blocks.contact()
    degenerate = cx.Contact(other.slave, cx.Plane((0, 0), (0, 0)))
    with pytest.raises(ValueError, match="zero vector"):
        problem(blocks, contacts=[other, degenerate])
    problem(blocks, contacts=[other])
    assert other.force[1] > 0


def test_a_problem_is_freed_with_its_functions():
    """Meshes have communicators, of which there are few."""
    blocks = Blocks(CellType.quadrilateral)
    blocks.problem(blocks.contact()).solve()
    u = weakref.ref(blocks.u)
    del blocks
    gc.collect()
    assert u() is None


CHANGES = {
    # Slave nodes at the sides no longer move along the surface
    "appended": lambda b: b.bcs.append(fix(b.u, b.tags, 0, 0.01, Tag.UPPER_X0, Tag.UPPER_X1)),
    "taken out": lambda b: b.bcs.pop(0),
    "replaced": lambda b: b.bcs.__setitem__(-1, fix(b.u, b.tags, 1, -0.02, Tag.UPPER_TOP)),
}


@pytest.mark.parametrize("solver", ["lu", "condensed"])
@pytest.mark.parametrize("change", CHANGES)
def test_a_list_that_changes_counts_from_the_next_solve_on(change, solver):
    """As if the problem had been made with it; without friction the way there does not count."""
    scene, other = (Blocks(CellType.quadrilateral, n_upper=6, n_lower=9) for _ in range(2))
    options = {"petsc_options": {"pc_type": solver}}
    if solver == "lu":
        options["petsc_options"]["pc_factor_mat_solver_type"] = "mumps"
    contact, same = scene.contact(), other.contact()
    problem = scene.problem(contact, **options)
    problem.solve()
    first = scene.u.x.array.copy()
    CHANGES[change](scene)
    CHANGES[change](other)
    problem.solve()
    assert np.abs(scene.u.x.array - first).max() > 1e-4
    other.problem(same, **options).solve()
    np.testing.assert_allclose(scene.u.x.array, other.u.x.array, rtol=0, atol=1e-9)
    np.testing.assert_allclose(contact.multiplier, same.multiplier, rtol=0, atol=1e-9)


def test_conditions_that_come_later_are_checked():
    scene, stranger = Blocks(CellType.quadrilateral), Blocks(CellType.quadrilateral)
    problem = scene.problem(scene.contact())
    problem.solve()
    u = scene.u.x.array.copy()
    scene.bcs.append(stranger.bcs[0])
    with pytest.raises(ValueError, match="bcs"):
        problem.solve()
    assert (scene.u.x.array == u).all()
    scene.bcs.pop()
    problem.solve()


@pytest.mark.parametrize("name", ["u", "contacts", "bcs", "F", "audit", "velocity"])
def test_what_has_been_read_cannot_be_replaced(name):
    scene = Blocks(CellType.quadrilateral)
    if name == "velocity":
        v = ufl.TestFunction(scene.u.function_space)
        problem = cx.ContactDynamics(
            lambda w: ufl.inner(ufl.grad(w), ufl.grad(v)) * ufl.dx,
            scene.u,
            density=1.0,
            contacts=[scene.contact()],
            petsc_options_prefix="replaced_",
        )
        problem.dt = 0.1
    else:
        problem = scene.problem(scene.contact())
    problem.mine = 1
    problem.u = scene.u
    with pytest.raises(AttributeError, match=f"{name} cannot be replaced once the Contact"):
        setattr(problem, name, fem.Function(scene.u.function_space))


def test_a_class_of_ones_own_keeps_what_it_was_given():
    class Own(cx.ContactProblem):
        def __init__(self, F, u, contacts, bcs):
            super().__init__(F, u, contacts=contacts, bcs=bcs, petsc_options_prefix="own_")
            self.F, self.bcs, self.u = F, bcs, u
            self.mine = 1
            self.mine = 2

    scene = Blocks(CellType.quadrilateral)
    own = Own(scene.F, scene.u, [scene.contact()], scene.bcs)
    own.solve()
    assert own.bcs is scene.bcs


class Constraint:
    """What contactx sees of a MultiPointConstraint."""

    def __init__(self, V):
        self.finalized = True
        self.function_space = V


def test_a_space_that_a_constraint_has_made_is_refused(monkeypatch):
    monkeypatch.setitem(
        sys.modules, "dolfinx_mpc", SimpleNamespace(MultiPointConstraint=Constraint)
    )
    scene = Blocks(CellType.triangle)
    V = scene.u.function_space
    constraint = Constraint(V)
    with pytest.raises(ValueError, match="u is in the function space of a MultiPointConstraint"):
        scene.problem(scene.contact())
    constraint.function_space = fem.functionspace(V.mesh, ("Lagrange", 1, (2,)))
    scene.problem(scene.contact()).solve()


def test_with_dolfinx_mpc():
    dolfinx_mpc = pytest.importorskip("dolfinx_mpc")
    scene = Blocks(CellType.triangle)
    V = scene.u.function_space
    mpc = dolfinx_mpc.MultiPointConstraint(V)
    mpc.create_periodic_constraint_geometrical(
        V,
        lambda x: np.isclose(x[0], x[0].max()),
        lambda x: np.stack([x[0] - x[0].max() + x[0].min(), x[1], x[2]]),
        [],
    )
    mpc.finalize()
    # The space that it was made of is as it was
    scene.problem(scene.contact()).solve()
    u = fem.Function(mpc.function_space)
    with pytest.raises(ValueError, match="u is in the function space of a MultiPointConstraint"):
        cx.ContactAssembler(elasticity(u, 1.0, 0.3), u, contacts=[scene.contact()])


@table(DISPLACEMENTS, FORMS, OPTIONS)
def test_refused(row):
    refused(row)
