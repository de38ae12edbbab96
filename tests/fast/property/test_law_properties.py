# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact laws of single nodes."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, rotations

_FUNCTION = ("value", "by_multiplier", "by_gap", "by_slip", "by_normal")


@st.composite
def states(draw, gdims=(2, 3)):
    """Arrays of one node as the laws take them; the gap may be none."""
    gdim = draw(st.sampled_from(gdims))

    def vector():
        return np.array(draw(st.lists(fractions, min_size=gdim, max_size=gdim)))

    normal = vector()
    length = np.linalg.norm(normal)
    normal = normal / length if length > 0 else np.eye(gdim)[0]
    gap = draw(st.one_of(fractions, st.just(np.nan)))
    c, friction = (abs(draw(fractions)) for _ in range(2))
    values = (vector(), [gap], normal, vector(), [c], [friction])
    return tuple(np.array(v, dtype=np.float64) for v in values)


_RANKS = core.SerialNodes(1)


def _evaluate(state):
    traction, gap, normal, slip, c, friction = state
    node, law = core.NodeState(1, len(traction), True), core.Coulomb()
    node.multiplier[:], node.gap[:], node.normal[0] = traction, gap, normal
    node.slip[0], node.c[:], node.area[:] = slip, c, 1
    law.set_friction(friction)
    law.set_status(node, _RANKS)
    law.evaluate(node)
    return node.status[0], {name: getattr(node, name).ravel() for name in _FUNCTION}


@given(states())
def test_any_state_has_a_finite_function(state):
    status, law = _evaluate(state)
    assert status in (core.OPEN, core.STICK, core.SLIP)
    assert status == core.OPEN or np.isfinite(state[1][0])
    for values in law.values():
        assert np.isfinite(values).all()


@given(states())
def test_friction_is_at_most_that_of_coulomb(state):
    traction, gap, normal, _, c, friction = state
    status, law = _evaluate(state)
    if status != core.SLIP:
        return
    tangential = traction - (traction @ normal) * normal
    target = tangential - (law["value"] - c * gap * normal)
    # Of a closed node
    bound = friction * (traction @ normal - c * np.minimum(gap, 0))
    assert np.linalg.norm(target) <= bound + 1e-12


@given(states(), powers)
def test_the_law_does_not_depend_on_the_unit_of_force(state, scale):
    traction, gap, normal, slip, c, friction = state
    status, law = _evaluate(state)
    other, scaled = _evaluate((scale * traction, gap, normal, slip, scale * c, friction))
    assert other == status
    assert np.array_equal(scaled["value"], scale * law["value"])
    assert np.array_equal(scaled["by_slip"], scale * law["by_slip"])
    assert np.array_equal(scaled["by_multiplier"], law["by_multiplier"])


@given(st.data(), states())
def test_the_law_does_not_depend_on_the_axes(data, state):
    traction, gap, normal, slip, c, friction = state
    status, law = _evaluate(state)
    rotation = data.draw(rotations(len(traction)))
    turned = (rotation @ traction, gap, rotation @ normal, rotation @ slip, c, friction)
    other, value = _evaluate(turned)
    # On the border between two of them rounding decides
    if other == status:
        np.testing.assert_allclose(value["value"], rotation @ law["value"], atol=1e-12)


@given(fractions, st.one_of(fractions, st.just(np.nan)), fractions.map(abs))
def test_normal_law(pressure, gap, c):
    node, law = core.NodeState(1, 2, False), core.Frictionless()
    node.multiplier[:], node.gap[:], node.c[:], node.area[:] = pressure, gap, c, 1
    law.set_status(node, _RANKS)
    law.evaluate(node)
    closed = pressure - c * gap > 0
    assert (node.status[0] != core.OPEN) == closed
    assert node.value[0] == (c * gap if closed else pressure)
    assert (node.by_multiplier.item(), node.by_gap[0]) == ((0, c) if closed else (1, 0))
    # Once closed it only opens without pressure
    node.gap[:] = 1e3
    law.set_status(node, _RANKS)
    assert (node.status[0] != core.OPEN) == ((closed and pressure > 0) or pressure - c * 1e3 > 0)
