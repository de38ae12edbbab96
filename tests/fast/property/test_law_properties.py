# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact laws of single nodes."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, rotations

_MATRICES = ("by_traction", "by_slip", "by_normal")


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


def _evaluate(state):
    gdim = len(state[0])
    status = np.zeros(1, dtype=np.int8)
    core.frictional_status(*state, 10.0, status)
    value, by_gap = np.zeros(gdim), np.zeros(gdim)
    matrices = {name: np.zeros(gdim * gdim) for name in _MATRICES}
    core.frictional_complementarity(
        *state,
        np.ones(1),
        status,
        np.ones(gdim),
        value,
        matrices["by_traction"],
        by_gap,
        matrices["by_slip"],
        matrices["by_normal"],
    )
    return status[0], {"value": value, "by_gap": by_gap} | matrices


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
    assert np.array_equal(scaled["by_traction"], law["by_traction"])


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
    arrays = [np.array([v]) for v in (pressure, gap, c)]
    status, out = np.zeros(1, dtype=np.int8), [np.zeros(1) for _ in range(3)]
    core.normal_status(*arrays, status)
    core.normal_complementarity(*arrays, np.ones(1), status, *out)
    closed = pressure - c * gap > 0
    assert (status[0] != core.OPEN) == closed
    # Once closed it only opens without pressure
    core.normal_status(arrays[0], np.full(1, 1e3), arrays[2], status)
    assert (status[0] != core.OPEN) == ((closed and pressure > 0) or pressure - c * 1e3 > 0)
    assert out[0][0] == (c * gap if closed else pressure)
    assert (out[1][0], out[2][0]) == ((0, c) if closed else (1, 0))
