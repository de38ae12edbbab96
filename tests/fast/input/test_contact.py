# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of a contact, and the coefficient of friction from step to step."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from inputs.rows import constant, refused, scene, solved, table
from meshes import Tag
from scenes import Blocks
from story import fix

NOT_A_NUMBER = "{} must be a number, a fem.Constant or a fem.Function, not {}"


def option(**options):
    return lambda: scene().contact(**options)


def used(**options):
    blocks = scene()
    solved(blocks, blocks.contact(**options))


def function(name, value, **kind):
    blocks = scene()
    solved(blocks, blocks.contact(**{name: blocks.scalar(value, **kind)}))


def later(name, value):
    """Set an attribute of a contact that belongs to a problem."""
    blocks = scene()
    contact = blocks.contact(friction=0.1)
    blocks.problem(contact)
    setattr(contact, name, value)


def numbers(name, finite, some=None):
    """What is no number, or some kinds of it, and numbers that are out of range."""
    kinds = {
        "NoneType None": None,
        "str '0.3'": "0.3",
        "list": [0.1, 0.2],
        "bool True": True,
        r"complex 0\.3j": 0.3j,
        "ndarray array": np.array([0.3]),
        "UFLType": fem.Function,
    }
    return {
        TypeError: [
            (option(**{name: value}), NOT_A_NUMBER.format(name, said))
            for said, value in kinds.items()
            if said in (some or kinds)
        ],
        ValueError: [(option(**{name: value}), f"{name} is {value}: give a") for value in finite],
    }


ROWS = {
    TypeError: [
        (option(smooth=0.1), "smooth"),
        (option(weight="r"), "weight must be a number or an expression of UFL"),
        (option(weight=lambda x: x), "weight must be a number"),
        (lambda: cx.FrictionLaw(0.3), "f of a FrictionLaw must be a function, not float"),
        (
            lambda: cx.FrictionLaw(lambda p, s: p, 0.3),
            "gradient of a FrictionLaw must be a function",
        ),
        (option(adjust="0.1"), "adjust is str '0.1': give a length"),
        (
            lambda: function("friction", 0.3, dtype=np.complex128),
            "friction holds complex128 values: give real numbers in double precision",
        ),
        (lambda: used(offset=constant(0.1 + 1j)), "offset holds complex128 values: give real"),
        (option(tangential_factor="small"), "tangential_factor is"),
        (option(search_distance="1"), "search_distance is str '1': give a length, or None"),
        (option(search_distance=[1.0]), "search_distance is list .*: give a length, or None"),
        (option(tied="no"), "tied is str 'no': give True or False"),
        (option(tied=2), "tied is int 2: give True or False"),
        (option(frictoin=0.3), "unexpected keyword argument 'frictoin'"),
        (lambda: later("active", "no"), "active is str 'no': give True or False"),
    ],
    ValueError: [
        (option(weight=0.0), "weight is 0.0: give a positive number"),
        (option(weight=-1), "weight is -1"),
        (option(weight=np.nan), "weight is nan"),
        (option(weight=ufl.as_vector([1.0, 2.0])), "scalar"),
        (option(adjust=-1.0), "adjust is -1: give a finite length"),
        (option(adjust=float("nan")), "adjust is nan: give a finite"),
        (option(adjust=0.1, tied=True), "a tie keeps the gaps"),
        (lambda: function("friction", np.nan), "friction is not finite: give finite numbers"),
        (lambda: function("friction", -1.0), r"friction is -1: give numbers of at least 0"),
        (lambda: function("offset", np.inf), "offset is not finite: give finite numbers"),
        (lambda: used(offset=constant(np.nan)), "offset is not finite: give finite numbers"),
        (
            lambda: used(friction=constant((0.1, 0.2))),
            r"friction is a constant of shape \(2,\): give one of a number",
        ),
        (option(tangential_factor=0.0), r"tangential_factor is 0: give a positive number"),
        (option(search_distance=-1), "search_distance is -1: give a positive length"),
        (option(search_distance=0.0), r"search_distance is 0: give a positive length"),
        (option(search_distance=np.nan), "search_distance is nan: give a positive length"),
        (option(sliding="large"), 'sliding must be "finite" or "small", not \'large\''),
        (option(sliding=None), 'sliding must be "finite" or "small", not None'),
        (option(sliding=np.zeros(2)), 'sliding must be "finite" or "small"'),
        (option(method="mortar"), 'method must be "node-to-surface" or "surface-to-surface", not'),
        (option(method=["node-to-surface"]), 'method must be "node-to-surface" or'),
        (option(tied=True, friction=0.3), "tied excludes friction"),
        (lambda: used(tied=True, friction=constant(0.0)), "tied excludes friction"),
    ],
    AttributeError: [
        (lambda: later("friction", 0.3), "friction cannot be replaced .* change its value"),
        (lambda: later("actve", False), "a Contact has no 'actve': check the spelling"),
    ],
    RuntimeError: [
        (lambda: setattr(scene().contact(), "active", False), "pass it to a ContactProblem first"),
        (lambda: tied_slip(), "is tied: its nodes do not slip"),
    ],
}


def tied_slip():
    blocks = scene()
    contact = blocks.contact(tied=True)
    blocks.problem(contact)
    return contact.slip


@table(
    ROWS,
    numbers("friction", [-0.1, float("nan"), float("inf"), -float("inf")]),
    numbers("offset", [float("nan")], some=["str '0.3'"]),
)
def test_refused(row):
    refused(row)


def test_what_looks_odd_but_is_meant():
    for options in (
        {"search_distance": float("inf")},
        {"friction": np.float64(0.3), "offset": np.float32(0.01)},
        {"friction": np.array(0.3)},
        {"tied": np.True_},
    ):
        blocks = scene()
        contact = blocks.contact(**options)
        solved(blocks, contact)
        assert isinstance(contact, cx.Contact)
        assert contact.force[1] > 0


@pytest.fixture
def blocks():
    return Blocks(CellType.quadrilateral)


def spaces(domain):
    return [
        fem.functionspace(domain, ("Lagrange", 2)),
        fem.functionspace(domain, ("Lagrange", 1, (2,))),
        fem.functionspace(domain, ("DG", 0)),
        fem.functionspace(domain, ("DG", 1)),
        fem.functionspace(Blocks(CellType.quadrilateral).u.function_space.mesh, ("Lagrange", 1)),
    ]


@pytest.mark.parametrize(
    ("which", "name"),
    [*zip(range(5), ["friction", "offset", "friction", "offset", "friction"], strict=True)],
)
def test_function_of_another_space(blocks, which, name):
    function = fem.Function(spaces(blocks.u.function_space.mesh)[which])
    contact = blocks.contact(**{name: function})
    with pytest.raises(ValueError, match=rf"{name} is a function of .*: interpolate it into"):
        blocks.problem(contact)


@pytest.mark.parametrize(
    ("bad", "message"),
    [(-0.5, "friction is -0.5: give numbers of at least 0"), (np.nan, "friction is not finite")],
)
@pytest.mark.parametrize("constant", [True, False])
def test_value_that_goes_bad_between_steps(blocks, bad, message, constant):
    """The step fails and leaves everything as it was; then the next one is good."""
    domain = blocks.u.function_space.mesh
    if constant:
        friction = fem.Constant(domain, 0.3)
        values = friction.value
    else:
        friction = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
        values = friction.x.array

    def give(value):
        values[...] = value

    give(0.3)
    contact = blocks.contact(friction=friction)
    problem = blocks.problem(contact)
    problem.solve()
    u, multiplier = blocks.u.x.array.copy(), contact.multiplier.copy()
    total = contact.slip_total.x.array.copy()
    give(bad)
    with pytest.raises(ValueError, match=message):
        problem.solve()
    assert np.array_equal(blocks.u.x.array, u)
    assert np.array_equal(contact.multiplier, multiplier)
    give(0.3)
    problem.solve()
    assert np.abs(blocks.u.x.array - u).max() <= 1e-12
    assert np.abs(contact.slip_total.x.array - total).max() <= 1e-12


class Pulled(Blocks):
    """Pressed on the lower block, and pulled aside as far as one likes."""

    def __init__(self, cell, aside):
        super().__init__(cell)
        # The plane's x: replaces the first support of the top
        gdim = self.u.function_space.mesh.geometry.dim
        self.bcs[gdim] = fix(self.u, self.tags, 0, aside, Tag.UPPER_TOP)


@pytest.mark.parametrize(
    "cell", [CellType.quadrilateral, CellType.hexahedron], ids=lambda c: c.name
)
@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_function_that_changes_between_steps_is_used(cell, sliding):
    blocks = Pulled(cell, 0.1)
    mu = fem.Function(fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 1)))
    mu.x.array[:] = 0.1
    contact = blocks.contact(sliding, friction=mu)
    problem = blocks.problem(contact)
    for value in (0.1, 0.05, 0.02):
        mu.x.array[:] = value
        problem.solve()
        nodes = contact.discrete.nodes
        slipping = nodes.status == 2
        tangential = contact.multiplier - nodes.pressure[:, None] * nodes.normal
        size = np.linalg.norm(tangential, axis=1)
        assert slipping.any()
        assert size[slipping] == pytest.approx(value * nodes.pressure[slipping], abs=1e-12)
        assert np.all(size <= value * nodes.pressure + 1e-12)


def test_function_that_varies_over_the_surface_is_used_node_by_node():
    blocks = Pulled(CellType.hexahedron, 0.2)
    mu = fem.Function(fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 1)))
    mu.interpolate(lambda x: 0.02 + 0.05 * x[0] + 0.03 * x[1] ** 2)
    contact = blocks.contact(friction=mu)
    blocks.problem(contact).solve()
    nodes = contact.discrete.nodes
    x = blocks.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    expected = 0.02 + 0.05 * x[:, 0] + 0.03 * x[:, 1] ** 2
    slipping = nodes.status == 2
    tangential = contact.multiplier - nodes.pressure[:, None] * nodes.normal
    size = np.linalg.norm(tangential, axis=1)
    assert slipping.sum() >= 3
    assert (size / nodes.pressure)[slipping] == pytest.approx(expected[slipping], rel=1e-9)


@pytest.mark.parametrize("name", ["offset", "sliding", "tied", "master"])
def test_an_option_cannot_be_replaced_where_it_would_have_no_effect(blocks, name):
    contact = blocks.contact(friction=0.1)
    setattr(contact, name, getattr(contact, name))
    with pytest.raises((TypeError, ValueError), match=name):
        setattr(contact, name, "none")
    problem = blocks.problem(contact)
    with pytest.raises(AttributeError, match=f"{name} cannot be replaced"):
        setattr(contact, name, 0.2)
    assert contact.friction == 0.1
    problem.solve()
