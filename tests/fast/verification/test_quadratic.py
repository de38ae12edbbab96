# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Quadratic displacements, and meshes of a higher order, whose cells may be curved."""

from __future__ import annotations

import importlib

import numpy as np
import press_fit as press_fit_demo
import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag, build
from patch_scene import Patch, Shape
from scenes import dimension
from scenes.blocks import CELLS, PLANE, Blocks
from scenes.covering import METHODS, covering
from scenes.materials import st_venant_kirchhoff
from scenes.problems import direct_solver, make_problem, pair_of

LAWS = {
    "frictionless": {},
    "friction": {"friction": 0.3},
    "tied": {"tied": True},
    "small": {"friction": 0.3, "sliding": "small"},
}


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("options", LAWS.values(), ids=LAWS)
def test_pressure_is_uniform_on_meshes_that_do_not_match(cell, options):
    for slave in ("upper", "lower"):
        shape = Shape(cell, upper=3, lower=2, distortion=0.0)
        patch = Patch(shape, degree=2, slave=slave, method="surface-to-surface", **options)
        patch.problem.solve()
        assert patch.pressure_errors().max() < 1e-9
        assert patch.stress_errors().max() < 1e-9
        pressure = patch.contact.pressure.x.array[patch.contact.slave_nodes]
        assert pressure == pytest.approx(patch.pressure, rel=1e-9)


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("options", [{}, {"tied": True}], ids=("free", "tied"))
def test_it_is_so_on_distorted_facets(cell, options):
    shape = Shape(cell, upper=3, lower=4, distortion=0.15)
    patch = Patch(
        shape, degree=2, young=(1.0, 0.4), lateral=0.3, method="surface-to-surface", **options
    )
    patch.problem.solve()
    # Inverse maps of quadrilaterals are no polynomials
    tolerance = 1e-7 if cell == CellType.hexahedron else 1e-9
    assert patch.pressure_errors().max() < tolerance
    assert patch.stress_errors().max() < tolerance


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("options", LAWS.values(), ids=LAWS)
def test_nodes_on_equal_meshes_carry_what_is_uniform(cell, options):
    patch = Patch(Shape(cell, upper=3, lower=3, distortion=0.0), degree=2, **options)
    patch.problem.solve()
    assert patch.stress_errors().max() < 1e-9
    # Vertices of triangles of six nodes get no force, but have a pressure
    if cell != CellType.tetrahedron:
        assert patch.contact.discrete.nodes.closed.all()
        assert patch.pressure_errors().max() < 1e-9
    slaves = patch.contact.slave_nodes
    assert patch.contact.pressure.x.array[slaves] == pytest.approx(patch.pressure, rel=1e-9)
    traction = patch.contact.traction.x.array.reshape(-1, patch.shape.dim)[slaves]
    assert traction[:, -1] == pytest.approx(patch.pressure, rel=1e-9)
    assert np.abs(patch.contact.gap.x.array[slaves]).max() < 1e-12
    assert patch.contact.area @ np.full(len(slaves), patch.pressure) == pytest.approx(
        patch.contact.force[-1], rel=1e-6
    )


def blocks(cell: CellType, **options) -> tuple[cx.ContactAssembler, cx.Contact, fem.Function]:
    """A block on a wider one, which is pushed down and sideways."""
    dim = 2 if cell in PLANE else 3
    wide, shift = (1.5,) * (dim - 1) + (1.0,), (0.23,) * (dim - 1)
    data = meshes.blocks(cell, (2,) * dim, (3,) * dim, size_lower=wide, shift=shift)
    tags = data.facet_tags
    u = story.displacement(data.mesh, 2)
    down = [0.02] * (dim - 1) + [-0.05]
    bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
    bcs += [story.fix(u, tags, i, down[i], Tag.UPPER_TOP) for i in range(dim)]
    contact = pair_of(tags, **options)
    F = story.elasticity(u, 1.0, 0.3)
    return cx.ContactAssembler(F, u, contacts=[contact], bcs=bcs), contact, u


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("options", LAWS.values(), ids=LAWS)
def test_jacobians_are_derivatives(cell, method, options):
    assembler, contact, u = blocks(cell, method=method, **options)
    b, dx = assembler.create_vector(), assembler.create_vector()
    ksp = direct_solver()
    A = None
    assembler.begin_step()
    for _ in range(3):
        assembler.settle()
        assembler.residual(b)
        A = assembler.jacobian(A)
        ksp.setOperators(A)
        ksp.solve(b, dx)
        assembler.update(-dx)
    assert (contact.discrete.nodes.status > 0).sum() > 3

    rng = np.random.default_rng(1)
    n = len(u.x.array)

    def by(way: np.ndarray) -> np.ndarray:
        """Residual after a way; the state is what it was."""
        dx.array[:] = way
        assembler.update(dx)
        assembler.residual(b)
        found = b.array.copy()
        dx.array[:] = -way
        assembler.update(dx)
        return found

    by_noise = 1e-3 * rng.standard_normal(dx.getLocalSize())
    dx.array[:] = by_noise
    assembler.update(dx)
    assembler.settle()
    A = assembler.jacobian(A)
    way, step = rng.standard_normal(dx.getLocalSize()), 3e-7
    way[n:] *= 0.05
    near, far = (by(k * step * way) - by(-k * step * way) for k in (1, 2))
    numbers = (8 * near - far) / (12 * step)
    dx.array[:] = way
    product = b.duplicate()
    A.mult(dx, product)
    for rows in (slice(0, n), slice(n, None)):
        error = np.abs(numbers - product.array)[rows].max()
        assert error < 1e-8 * np.abs(product.array[rows]).max()


def press_fit(n: int, order: int, degree: int, method: str) -> float:
    """Largest error of the pressure of a ring pressed into another one, over Lame's."""
    data = meshes.rings(n, radii=press_fit_demo.RADII, order=order)
    tags = data.facet_tags
    u = story.displacement(data.mesh, degree)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
    ]
    contact = pair_of(tags, method=method, sliding="small", offset=press_fit_demo.INTERFERENCE)
    F = story.elasticity(u, press_fit_demo.E, press_fit_demo.NU)
    make_problem(F, u, [contact], bcs).solve()
    pressure = contact.pressure.x.array[contact.slave_nodes]
    return float(np.abs(pressure / press_fit_demo.lame().pressure - 1).max())


@pytest.mark.parametrize("method", METHODS)
def test_curved_meshes_are_followed(method):
    straight = press_fit(12, 1, 2, method)
    curved = [press_fit(n, 2, 2, method) for n in (12, 24)]
    assert curved[0] < 0.4 * straight
    assert curved[1] < curved[0]
    # Nodes on facets scatter where the meshes do not match
    assert curved[1] < (2.5e-3 if method == "surface-to-surface" else 0.02)


@pytest.mark.parametrize("method", METHODS)
def test_ties_of_curved_meshes_that_do_not_match_are_free_of_stress(method):
    """At rest, and turned by any angle with all that they tie."""
    data = meshes.rings(8, 12, order=2)
    tags, u = data.facet_tags, story.displacement(data.mesh, 2)
    V = u.function_space
    bcs, values = [], []
    for i in range(2):
        W, _ = V.sub(i).collapse()
        values.append(fem.Function(W))
        dofs = fem.locate_dofs_topological((V.sub(i), W), 1, tags.find(Tag.UPPER_TOP))
        bcs.append(fem.dirichletbc(values[i], dofs, V.sub(i)))
    contact = pair_of(tags, method=method, tied=True)
    F = st_venant_kirchhoff(u, 1.0, 0.3)
    problem = make_problem(F, u, [contact], bcs)
    for angle in (0.0, 0.5, 2.0):
        c, s = np.cos(angle) - 1, np.sin(angle)
        ways = (lambda x: c * x[0] - s * x[1], lambda x: s * x[0] + c * x[1])
        for value, way in zip(values, ways, strict=True):
            value.interpolate(way)
        u.interpolate(lambda x: np.stack([way(x) for way in ways]))
        problem.solve()
        assert problem.report.iterations == 0
        assert np.abs(contact.multiplier).max() < 1e-12


def test_curved_meshes_of_linear_displacements_are_refused():
    with pytest.raises(ValueError, match="is curved: the mesh is of order 2"):
        press_fit(6, 2, 1, "node-to-surface")


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("method", METHODS)
def test_the_solvers_agree(cell, method):
    answers = []
    for pc in ("lu", "condensed"):
        scene = Blocks(cell, degree=2)
        contact = scene.contact(method=method, friction=0.2)
        problem = scene.problem(contact, petsc_options={"pc_type": pc})
        problem.solve()
        assert problem.report.imbalance == pytest.approx(0, abs=1e-12)
        answers.append((scene.u.x.array, contact.multiplier))
    for a, b in zip(*answers, strict=True):
        assert b == pytest.approx(a, abs=1e-8 * np.abs(a).max())


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("method", METHODS)
def test_obstacles_meet_the_nodes(cell, method):
    dim = 2 if cell in PLANE else 3
    up = np.eye(dim)[-1]
    scene = Blocks(cell, degree=2)
    master = cx.Plane(point=0.02 * up, normal=up)
    contact = scene.contact(master=master, friction=0.3, method=method)
    scene.problem(contact).solve()
    gap = contact.gap.x.array[contact.slave_nodes]
    closed = contact.discrete.nodes.closed
    assert closed.mean() > 0.9
    assert np.abs(gap[closed]).max() < 1e-12
    assert gap.min() > -1e-12
    x = scene.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    assert len(np.unique(x, axis=0)) == 5 ** (dim - 1)
    assert contact.force[-1] > 0.01


def test_functions_may_be_linear_or_quadratic():
    forces = []
    for degree in (1, 2):
        scene = Blocks(CellType.triangle, degree=2)
        V = fem.functionspace(scene.u.function_space.mesh, ("Lagrange", degree))
        mu, offset = fem.Function(V), fem.Function(V)
        mu.interpolate(lambda x: 0.1 + 0.2 * x[0])
        offset.interpolate(lambda x: 0.01 * x[0])
        contact = scene.contact(friction=mu, offset=offset)
        scene.problem(contact).solve()
        forces.append(contact.force)
    assert forces[0] == pytest.approx(forces[1], rel=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_checkpoints_and_files_hold_all_nodes(method, tmp_path):
    def loop(**options) -> tuple[cx.LoadSteps, Blocks, cx.Contact]:
        scene = Blocks(CellType.triangle, degree=2)
        contact = scene.contact(friction=0.3, method=method)
        top = scene.bcs[-1]
        steps = cx.LoadSteps(
            scene.problem(contact),
            4,
            update=lambda t: top.g.value.fill(-0.05 * t),
            progress=False,
            **options,
        )
        return steps, scene, contact

    whole, scene, contact = loop()
    with cx.VTKOutput(tmp_path / "out.pvd", scene.u, [contact]) as output:
        for step in whole:
            output.write(step.t)
            if step.index == 2:
                whole.save(tmp_path / "half.state")
    part, again, _ = loop(restart=tmp_path / "half.state")
    list(part)
    assert again.u.x.array == pytest.approx(scene.u.x.array, abs=1e-13)
    assert (tmp_path / "out.pvd").exists()


# DOLFINx reads no hexahedra of order 3 from gmsh
ORDERS = [(cell, order) for cell in CELLS for order in (2, 3)][:-1]
STACKED = "meshes.stacked"
GAP = 0.1
# Heights of the faces, and where vertices are along the first axis
UPPER_CONTACT, UPPER_TOP = (GAP, 0.23), (1 + GAP, 0.23)
LOWER_CONTACT = (0.0, 0.0)


def bulge(face, by=0.01):
    """Moves the nodes of a face of the blocks upwards, but for the vertices."""
    height, first = face

    def move(x):
        at = np.isclose(x[:, -1], height)
        x[at, -1] += by * (1 - np.cos(4 * np.pi * (x[at, 0] - first))) / 2

    return move


@pytest.fixture
def of_order(monkeypatch):
    """Make the meshes of a module of another order, and move their nodes by a function."""

    def change(module, order, move=None):
        def build_mesh(name, dim, recipe, comm, options=None):
            def changed(gmsh):
                recipe(gmsh)
                gmsh.model.mesh.setOrder(order)
                tags, x, _ = gmsh.model.mesh.getNodes()
                x = x.reshape(-1, 3)
                if move is not None:
                    move(x[:, :dim])
                    for tag, place in zip(tags, x, strict=True):
                        gmsh.model.mesh.setNode(tag, place, [])

            return build.build_mesh(name, dim, changed, comm, options)

        monkeypatch.setattr(importlib.import_module(module), "build_mesh", build_mesh)

    return change


def solved(cell, master=None, method=METHODS[0]):
    """Forces and pressures of the blocks, slave nodes in the order of their places."""
    scene = Blocks(cell, gap=GAP, down=0.15)
    contact = scene.contact(master=master, method=method)
    scene.problem(contact).solve()
    x = scene.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    return contact.force, contact.multiplier[np.lexsort(np.round(x, 9).T)]


def assert_same(one, other):
    for a, b in zip(one, other, strict=True):
        assert np.abs(a).max() > 0
        assert a == pytest.approx(b, rel=1e-9, abs=1e-9 * np.abs(b).max())


@covering(**{"cell,order": ORDERS}, scheme=METHODS)
def test_straight_cells_are_as_those_of_order_one(cell, order, scheme, of_order):
    expected = solved(cell, method=scheme)
    of_order(STACKED, order)
    assert_same(solved(cell, method=scheme), expected)


@covering(cell=CELLS, scheme=METHODS)
def test_the_bulk_may_be_curved_where_nothing_touches(cell, scheme, of_order):
    of_order(STACKED, 2, bulge(UPPER_TOP))
    force, pressure = solved(cell, method=scheme)
    assert force[-1] > 0 and pressure.max() > 0


@covering(
    **{"face,name": [(UPPER_CONTACT, "slave"), (LOWER_CONTACT, "master")], "cell,order": ORDERS},
    by=(0.01, 1e-4, -1e-4),
)
def test_a_curved_contact_surface_is_refused(face, name, cell, order, by, of_order):
    of_order(STACKED, order, bulge(face, by))
    message = (
        rf"^{name} Surface\(.*\) is curved: the mesh is of order {order}, and "
        r"\d+ of these facets have nodes up to .* away from .* first at \(.*\)\. .* "
        r"make the mesh of order 1, in gmsh by gmsh\.model\.mesh\.setOrder\(1\)"
    )
    with pytest.raises(ValueError, match=message):
        solved(cell)


@pytest.mark.parametrize("cell", (CellType.triangle, CellType.hexahedron), ids=lambda c: c.name)
def test_against_an_obstacle_only_the_slave_counts(cell, of_order):
    dim = dimension(cell)
    floor = cx.Plane(np.zeros(dim), np.eye(dim)[-1])
    of_order(STACKED, 2)
    expected = solved(cell, floor)
    of_order(STACKED, 2, bulge(LOWER_CONTACT))
    assert_same(solved(cell, floor), expected)
    of_order(STACKED, 2, bulge(UPPER_CONTACT))
    with pytest.raises(ValueError, match=r"slave Surface.* is curved"):
        solved(cell, floor)


def test_round_meshes_of_gmsh(of_order):
    """Their nodes between the vertices are on the circle."""
    of_order("meshes.rings", 2)
    with pytest.raises(ValueError, match=r"slave Surface.* nodes up to 0\.000\d* away"):
        press_fit_demo.create(0.1, "finite")
    # What the message says
    of_order("meshes.rings", 1)
    press_fit_demo.create(0.1, "finite")
