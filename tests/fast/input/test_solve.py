# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What goes wrong in a step leaves the last state as it was, bit for bit, and of use.

The next solve with good input has the answer of a problem that never saw the failure.
"""

import numpy as np
import pytest

import contactx as cx

from scenes.steps import KINDS, Rubbing


def nan_at_a_slave(scene, function, value):
    function.x.array[scene.contact.status.x.array >= 0] = value


# What goes bad, how it goes well again, and what is raised
FAILURES = {
    "a NaN load": (
        lambda s: s.load.value.fill(np.nan),
        lambda s: s.load.value.fill(0.0),
        cx.ConvergenceError,
        "the residual is not finite: the material fails at the start .* load or coefficient of F",
    ),
    "an infinite load": (
        lambda s: s.load.value.fill(np.inf),
        lambda s: s.load.value.fill(0.0),
        cx.ConvergenceError,
        "the residual is not finite: the material fails at the start",
    ),
    "a NaN modulus": (
        lambda s: s.young.value.fill(np.nan),
        lambda s: s.young.value.fill(1.0),
        cx.ConvergenceError,
        "the residual is not finite: the material fails at the start",
    ),
    "NaN in the Jacobian alone": (
        lambda s: s.tangent.value.fill(np.nan),
        lambda s: s.tangent.value.fill(1.0),
        cx.ConvergenceError,
        "the Jacobian of F is not finite: .* coefficient of F, or of J, is NaN or infinite",
    ),
    "infinite Jacobian": (
        lambda s: s.tangent.value.fill(np.inf),
        lambda s: s.tangent.value.fill(1.0),
        cx.ConvergenceError,
        "the Jacobian of F is not finite",
    ),
    "a zero Jacobian": (
        lambda s: s.tangent.value.fill(0.0),
        lambda s: s.tangent.value.fill(1.0),
        cx.ConvergenceError,
        "contact did not converge",
    ),
    "a load that the material cannot carry": (
        lambda s: s.load.value.fill(-1e6),
        lambda s: s.load.value.fill(0.0),
        cx.ConvergenceError,
        "contact did not converge",
    ),
    "NaN as Dirichlet value": (
        lambda s: s._side.g.value.fill(np.nan),
        lambda s: s.update(0.5),
        ValueError,
        "bcs prescribe displacements that are not finite",
    ),
    "infinite Dirichlet value": (
        lambda s: s._down.g.value.fill(-np.inf),
        lambda s: s.update(0.5),
        ValueError,
        "bcs prescribe displacements that are not finite",
    ),
    "a NaN offset": (
        lambda s: nan_at_a_slave(s, s.offset, np.nan),
        lambda s: s.offset.x.array.fill(0.0),
        ValueError,
        "offset is not finite: give finite numbers",
    ),
    "an infinite offset": (
        lambda s: nan_at_a_slave(s, s.offset, np.inf),
        lambda s: s.offset.x.array.fill(0.0),
        ValueError,
        "offset is not finite: give finite numbers",
    ),
}
OF_FRICTION = {
    "NaN friction": (
        lambda s: nan_at_a_slave(s, s.friction, np.nan),
        lambda s: s.friction.x.array.fill(0.2),
        ValueError,
        "friction is not finite: give finite numbers",
    ),
    "negative friction": (
        lambda s: nan_at_a_slave(s, s.friction, -0.1),
        lambda s: s.friction.x.array.fill(0.2),
        ValueError,
        r"friction is -0\.1: give numbers of at least 0",
    ),
}


@pytest.fixture(scope="module")
def straight():
    """States after one and two good steps, by the kind of the scene."""
    states = {}
    for kind, options in KINDS.items():
        scene = Rubbing(**options)
        scene.update(0.25)
        scene.problem.solve()
        first = scene.state()
        scene.update(0.5)
        scene.problem.solve()
        states[kind] = first, scene.state(), scene.u.x.array.copy()
    return states


@pytest.mark.parametrize("kind", KINDS)
def test_failures_of_a_step(kind, straight):
    failures = FAILURES | ({} if "friction" in KINDS[kind] else OF_FRICTION)
    scene = Rubbing(**KINDS[kind])
    scene.update(0.25)
    scene.problem.solve()
    first = scene.state()
    _, second, u = straight[kind]
    for name, (spoil, mend, error, message) in failures.items():
        scene.update(0.5)
        spoil(scene)
        with pytest.raises(error, match=message):
            scene.problem.solve()
        assert scene.state() == first, name
        mend(scene)
    scene.update(0.5)
    scene.problem.solve()
    assert np.abs(scene.u.x.array - u).max() <= 1e-13
    # Multigrid and the start of its iterations are made anew
    assert scene.state() == second or kind == "condensed"


@pytest.mark.parametrize("name", FAILURES)
def test_a_failure_of_the_first_step(name):
    spoil, mend, error, message = FAILURES[name]
    scene, other = Rubbing(), Rubbing()
    before = scene.state()
    scene.update(0.5)
    spoil(scene)
    with pytest.raises(error, match=message):
        scene.problem.solve()
    assert scene.state() == before
    mend(scene)
    for each in (scene, other):
        each.update(0.5)
        each.problem.solve()
    assert scene.state() == other.state()


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_an_update_that_sets_what_is_not_finite(value):
    """The loop ends at the last accepted step with its loads, and can be gone on with."""
    scene, other = Rubbing(), Rubbing()
    states, calls = [], []

    def update(t):
        calls.append(t)
        scene.update(t)
        if t > 0.6 and len(calls) < 5:
            scene.history.x.array[:] = value
            scene._side.g.value[...] = value

    steps = scene.steps(4, update=update)
    with pytest.raises(ValueError, match=r"bcs prescribe .* as update of LoadSteps, may be wrong"):
        for step in steps:
            scene.history.x.array[:] = 2 * scene.history.x.array + step.index
            states.append(scene.state())
    assert steps.t == calls[-1] == 0.5
    assert scene.state() == states[-1]
    scene.run(steps)
    other.run(other.steps(4))
    assert scene.state() == other.state()


def test_a_material_that_fails_amid_a_long_step():
    """The logarithm of a negative number, after some iterations: the step is cut."""
    scene = Rubbing()

    def update(t):
        scene._down.g.value[...] = -0.6 * t
        scene._side.g.value[...] = 0.6 * t

    taken = list(scene.steps(1, update=update))
    assert taken[-1].t == 1
    assert scene.contact.force[1] > 0
