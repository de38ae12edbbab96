# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The coefficient of friction as a user gives it, right and wrong, and from step to step."""

import numpy as np
import pytest

from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from story import fix


@pytest.fixture
def scene():
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
def test_function_of_another_space(scene, which, name):
    function = fem.Function(spaces(scene.u.function_space.mesh)[which])
    contact = scene.contact(**{name: function})
    with pytest.raises(ValueError, match=rf"{name} is a function of .*: interpolate it into"):
        scene.problem(contact)


@pytest.mark.parametrize(
    ("bad", "message"),
    [(-0.5, "friction is -0.5: give numbers of at least 0"), (np.nan, "friction is not finite")],
)
@pytest.mark.parametrize("constant", [True, False])
def test_value_that_goes_bad_between_steps(scene, bad, message, constant):
    """The step fails and leaves everything as it was; then the next one is good."""
    domain = scene.u.function_space.mesh
    if constant:
        friction = fem.Constant(domain, 0.3)
        values = friction.value
    else:
        friction = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
        values = friction.x.array

    def give(value):
        values[...] = value

    give(0.3)
    contact = scene.contact(friction=friction)
    problem = scene.problem(contact)
    problem.solve()
    u, multiplier = scene.u.x.array.copy(), contact.multiplier.copy()
    total = contact.slip_total.x.array.copy()
    give(bad)
    with pytest.raises(ValueError, match=message):
        problem.solve()
    assert np.array_equal(scene.u.x.array, u)
    assert np.array_equal(contact.multiplier, multiplier)
    give(0.3)
    problem.solve()
    assert np.abs(scene.u.x.array - u).max() <= 1e-12
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
    scene = Pulled(cell, 0.1)
    mu = fem.Function(fem.functionspace(scene.u.function_space.mesh, ("Lagrange", 1)))
    mu.x.array[:] = 0.1
    contact = scene.contact(sliding, friction=mu)
    problem = scene.problem(contact)
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
    scene = Pulled(CellType.hexahedron, 0.2)
    mu = fem.Function(fem.functionspace(scene.u.function_space.mesh, ("Lagrange", 1)))
    mu.interpolate(lambda x: 0.02 + 0.05 * x[0] + 0.03 * x[1] ** 2)
    contact = scene.contact(friction=mu)
    scene.problem(contact).solve()
    nodes = contact.discrete.nodes
    x = scene.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    expected = 0.02 + 0.05 * x[:, 0] + 0.03 * x[:, 1] ** 2
    slipping = nodes.status == 2
    tangential = contact.multiplier - nodes.pressure[:, None] * nodes.normal
    size = np.linalg.norm(tangential, axis=1)
    assert slipping.sum() >= 3
    assert (size / nodes.pressure)[slipping] == pytest.approx(expected[slipping], rel=1e-9)


@pytest.mark.parametrize("name", ["offset", "sliding", "tied", "master"])
def test_an_option_cannot_be_replaced_where_it_would_have_no_effect(scene, name):
    contact = scene.contact(friction=0.1)
    setattr(contact, name, getattr(contact, name))
    problem = scene.problem(contact)
    with pytest.raises(AttributeError, match=f"{name} cannot be replaced"):
        setattr(contact, name, 0.2)
    assert contact.friction == 0.1
    problem.solve()
