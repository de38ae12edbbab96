# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What flows across a contact: conserved, exact where it is uniform, solved for with the rest."""

import numpy as np
import pytest

import contactx as cx
import dolfinx.fem.petsc
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.coupled import fix
from scenes.heat import CONDUCTIVITY, HOT, HeatedBlocks, coefficient
from scenes.problems import make_problem
from story import displacement, elasticity

MORTAR, NODES = "surface-to-surface", "node-to-surface"
ALL_CELLS = [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]


@pytest.mark.parametrize("gap", [0.0, 0.2])
@pytest.mark.parametrize(
    ("cell", "degree"),
    [
        (CellType.quadrilateral, 1),
        (CellType.hexahedron, 1),
        *((cell, 2) for cell in ALL_CELLS),
    ],
    ids=str,
)
def test_uniform_flow_is_exact(cell, degree, gap):
    """On meshes that do not match; linear triangles have stresses of their own from heat."""
    scene = HeatedBlocks(cell, degree=degree, gap=gap, method=MORTAR)
    problem = scene.problem()
    problem.solve()
    p, opening, flow = scene.exact()
    assert p > 0 if gap == 0 else opening > 0
    pressure = scene.contact.fields.recovered_pressure()
    assert np.abs(pressure - p).max() < 1e-9
    assert np.abs(scene.contact.discrete.nodes.gap - opening).max() < 1e-9
    assert scene.conductance.flow == pytest.approx(flow, rel=1e-9)


@pytest.mark.parametrize(
    ("cell", "degree"),
    [
        (CellType.triangle, 1),
        (CellType.tetrahedron, 1),
        (CellType.quadrilateral, 2),
        (CellType.hexahedron, 1),
    ],
    ids=str,
)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_nodes_give_nearly_the_same(cell, degree, friction):
    scene = HeatedBlocks(cell, degree=degree, method=NODES, friction=friction)
    problem = scene.problem()
    problem.solve()
    # Quadratically but for the averages of pressures
    assert problem.report.iterations <= 8
    _, _, flow = scene.exact()
    assert scene.conductance.flow == pytest.approx(flow, rel=1e-2)


@pytest.mark.parametrize("method", [NODES, MORTAR])
def test_field_by_field_comes_to_the_same(method):
    """Displacement for a temperature, temperature for a contact, and again."""
    together = HeatedBlocks(method=method)
    together.problem().solve()
    scene = HeatedBlocks(method=method)
    mechanics = make_problem(scene.F[0], scene.u, [scene.contact], scene.hold)
    Q = scene.T.function_space
    T, q = ufl.TrialFunction(Q), ufl.TestFunction(Q)
    a = fem.form(CONDUCTIVITY * ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx)
    L = fem.form(fem.Constant(Q.mesh, 0.0) * q * ufl.dx)
    change = np.inf
    for _ in range(60):
        mechanics.solve()
        A = dolfinx.fem.petsc.assemble_matrix(a, bcs=scene.heat)
        A.assemble()
        C = scene.conductance.matrix()
        for bc in scene.heat:
            C.zeroRowsColumnsLocal(bc.dof_indices()[0], diag=0.0)
        A.axpy(1.0, C)
        b = dolfinx.fem.petsc.assemble_vector(L)
        dolfinx.fem.petsc.apply_lifting(b, [a], bcs=[scene.heat])
        dolfinx.fem.petsc.set_bc(b, scene.heat)
        before = scene.T.x.array.copy()
        ksp = dolfinx.fem.petsc.PETSc.KSP().create()
        ksp.setOperators(A)
        ksp.getPC().setType("lu")
        ksp.setType("preonly")
        ksp.solve(b, scene.T.x.petsc_vec)
        change = np.abs(scene.T.x.array - before).max()
        if change < 1e-9 * HOT:
            break
    assert change < 1e-9 * HOT
    assert np.abs(scene.T.x.array - together.T.x.array).max() < 1e-7 * HOT
    assert np.abs(scene.u.x.array - together.u.x.array).max() < 1e-9


def test_pressure_opens_the_way():
    """The derivative by the pressure: fewer iterations than without it, the same answer."""
    scene = HeatedBlocks(method=MORTAR, h=lambda p, gap: 500 * p**2)
    problem = scene.problem()
    problem.solve()
    p, _, flow = scene.exact()
    assert scene.conductance.flow == pytest.approx(flow, rel=1e-8)
    assert p > 0
    scene.u.x.array[:] *= 1.01
    scene.T.x.array[:] += 1
    problem.solve()
    assert problem.report.iterations <= 5


@pytest.mark.parametrize("method", [NODES, MORTAR])
@pytest.mark.parametrize("degree", [1, 2])
def test_an_obstacle_has_a_temperature(method, degree):
    """A block on a cold plate: in line, h (T - T0) = k (T1 - T) / L."""
    data = meshes.blocks(CellType.quadrilateral, (4, 3), (5, 3))
    tags, domain = data.facet_tags, data.mesh
    u = displacement(domain, degree)
    T = fem.Function(fem.functionspace(domain, ("Lagrange", degree)))
    q = ufl.TestFunction(T.function_space)
    heat = CONDUCTIVITY * ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx
    y = -1.0
    contact = cx.Contact(
        cx.Surface(tags, Tag.LOWER_BOTTOM), cx.Plane((0.0, y), (0.0, 1.0)), method=method
    )
    cold = fem.Constant(domain, 10.0)
    conductance = cx.Conductance(contact, T, 5.0, obstacle_value=cold)
    V = u.function_space
    problem = make_problem([elasticity(u, 1.0, 0.3), heat], [u, T], [contact], [
            fix(V, tags, np.zeros(2), Tag.UPPER_TOP),
            fix(V.sub(0), tags, 0.0, Tag.LOWER_BOTTOM),
            fix(V.sub(1), tags, -0.01, Tag.LOWER_CONTACT),
            fix(T.function_space, tags, 100.0, Tag.LOWER_CONTACT),
            fix(T.function_space, tags, 0.0, Tag.UPPER_TOP),
        ], displacement=0, conductances=[conductance])  # fmt: skip
    for value in (10.0, 40.0):
        cold.value = value
        problem.solve()
        width = contact.area.sum()
        exact = width * (100 - value) / (1 / CONDUCTIVITY + 1 / 5)
        assert conductance.flow == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("method", [NODES, MORTAR])
@pytest.mark.parametrize("degree", [1, 2])
def test_results_on_both_surfaces(method, degree):
    scene = HeatedBlocks(CellType.hexahedron, degree=degree, method=method)
    scene.problem().solve()
    contact, (p, _, _) = scene.contact, scene.exact()
    ds = ufl.Measure("ds", subdomain_data=scene.tags)
    upper, lower = ds(int(Tag.UPPER_CONTACT)), ds(int(Tag.LOWER_CONTACT))

    def total(form):
        return fem.assemble_scalar(fem.form(form))

    exact = method == MORTAR
    near = 1e-9 if exact else 2e-2
    area = total(fem.Constant(scene.u.function_space.mesh, 1.0) * lower)
    assert total(contact.master_pressure * lower) == pytest.approx(p * area, rel=near)
    assert total(contact.on_both(contact.pressure) * lower) == pytest.approx(p * area, rel=near)
    assert total(contact.master_pressure * upper) == pytest.approx(0, abs=1e-12)
    gap = contact.on_both(contact.gap, missing=7.0)
    assert np.isfinite(gap.x.array).all()
    assert gap.x.array.max() == 7.0
    assert total(abs(gap) * lower) < 1e-9
    # The temperature across: each side sees the other one's
    across = contact.across(scene.T)
    for face in (upper, lower):
        jump = total(abs(scene.T - across) * face) / area
        flow = total(coefficient(p, 0.0) * abs(scene.T - across) * face)
        assert jump > 1
        assert flow == pytest.approx(scene.exact()[2] * area, rel=1e-8 if exact else 0.1 * degree)


class TestRefusals:
    def test_arguments(self):
        scene = HeatedBlocks()
        for given, kind, message in (
            ((scene.T, scene.T, 1.0), TypeError, "contact must be"),
            ((scene.contact, 3.0, 1.0), TypeError, "field must be"),
            ((scene.contact, scene.T, "much"), TypeError, "coefficient is"),
            ((scene.contact, scene.T, -1.0), ValueError, "of at least 0"),
            ((scene.contact, scene.T, np.nan), ValueError, "finite"),
        ):
            with pytest.raises(kind, match=message):
                cx.Conductance(*given)
        with pytest.raises(ValueError, match="for rigid obstacles"):
            cx.Conductance(scene.contact, scene.T, 1.0, obstacle_value=1.0)
        rigid = cx.Contact(scene.contact.slave, cx.Plane((0.0, 0.0), (0.0, 1.0)))
        with pytest.raises(ValueError, match="obstacle_value is missing"):
            cx.Conductance(rigid, scene.T, 1.0)
        with pytest.raises(TypeError, match="number or a fem"):
            cx.Conductance(rigid, scene.T, 1.0, obstacle_value="cold")

    def test_problem(self):
        scene = HeatedBlocks()

        def problem(conductances, **options):
            given = {"u": [scene.u, scene.T], "F": scene.F, "displacement": 0, **options}
            return make_problem(
                given["F"],
                given["u"],
                [scene.contact],
                [],
                displacement=given["displacement"],
                conductances=conductances,
            )

        with pytest.raises(TypeError, match=r"write conductances=\["):
            problem(scene.conductance)
        with pytest.raises(TypeError, match=r"conductances\[0\] must be"):
            problem([1.0])
        with pytest.raises(TypeError, match="must be a list"):
            problem(3)
        other = cx.Contact(scene.contact.slave, scene.contact.master)
        with pytest.raises(ValueError, match="none of the problem's contacts"):
            problem([cx.Conductance(other, scene.T, 1.0)])
        with pytest.raises(ValueError, match="is not solved for"):
            problem([scene.conductance], u=scene.u, F=scene.F[0], displacement=None)
        wrong = fem.Function(fem.functionspace(scene.T.function_space.mesh, ("Lagrange", 2)))
        q = ufl.TestFunction(wrong.function_space)
        with pytest.raises(ValueError, match="whose nodes are those of contact"):
            problem(
                [cx.Conductance(scene.contact, wrong, 1.0)],
                u=[scene.u, wrong], F=[scene.F[0], wrong * q * ufl.dx],
            )  # fmt: skip

    @pytest.mark.parametrize(
        ("h", "message"),
        [
            (lambda p, gap: -1.0 - p, "negative or not finite"),
            (lambda p, gap: np.ones(3), "returned the shape"),
        ],
    )
    def test_coefficients(self, h, message):
        scene = HeatedBlocks(h=h)
        problem = scene.problem()
        with pytest.raises(ValueError, match=message):
            problem.solve()

    def test_fields_of_other_spaces(self):
        scene = HeatedBlocks()
        scene.problem()
        wrong = fem.Function(fem.functionspace(scene.T.function_space.mesh, ("Lagrange", 2)))
        with pytest.raises(ValueError, match="take the space of the contact's results"):
            scene.contact.across(wrong)
        scene = HeatedBlocks()
        rigid = cx.Contact(scene.contact.slave, cx.Plane((0.0, 0.0), (0.0, 1.0)))
        make_problem(scene.F[0], scene.u, [rigid], scene.hold)
        with pytest.raises(ValueError, match="rigid obstacle"):
            rigid.on_both(rigid.pressure)


def test_the_condensed_solver_is_for_fields_that_do_not_flow_across():
    scene = HeatedBlocks(CellType.triangle)
    options = {"conductances": [scene.conductance], "displacement": 0}
    arguments = scene.F, [scene.u, scene.T], [scene.contact], scene.heat + scene.hold
    with pytest.raises(ValueError, match="leave it out where there are conductances"):
        make_problem(*arguments, petsc_options={"pc_type": "condensed"}, **options)
