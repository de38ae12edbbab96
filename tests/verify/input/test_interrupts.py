# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ctrl-C: a real signal, at many moments of a run and inside all that a user or PETSc calls.

It is raised at once, leaves the last accepted step bit for bit, and the run goes on to the same
bits as one without interrupts: of the condensed solver, whose multigrid is made anew, but for
rounding.
"""

import signal
import sys
from pathlib import Path

import numpy as np
import pytest

import contactx as cx
from contactx._host.callbacks import Interrupts
from contactx._host.checkpoint.snapshot import FunctionValues

from scenes.steps import KINDS, Rubbing

PACKAGE = str(Path(cx.__file__).parent)
STEPS = 3
MOMENTS = 8


class Counter:
    """Raises a signal at some call of a function of the package."""

    def __init__(self, at=None, times=1):
        self.calls, self._at, self._times = 0, at, times

    def __enter__(self):
        sys.setprofile(self._see)
        return self

    def __exit__(self, *_):
        sys.setprofile(None)

    def _see(self, frame, event, _):
        if event == "call" and frame.f_code.co_filename.startswith(PACKAGE):
            self.calls += 1
            if self.calls == self._at:
                self.where = f"{frame.f_code.co_filename}:{frame.f_code.co_name}"
                for _ in range(self._times):
                    signal.raise_signal(signal.SIGINT)


def watched(kind):
    """A scene, its steps, and the states after each step, before and after the loop's body."""
    scene = Rubbing(**KINDS[kind])
    states = {0.0: [scene.state()]}

    def output(step):
        states[step.t] = [scene.state()]

    return scene, scene.steps(STEPS, output=output), states


def straight(kind):
    """The end of a run, the states on the way, and how many calls it takes."""
    scene, steps, _ = watched(kind)
    with Counter() as counter:
        scene.run(steps)
    scene, steps, states = watched(kind)
    for step in steps:
        scene.history.x.array[:] = 2 * scene.history.x.array + step.index
        states[step.t].append(scene.state())
    return scene, states, counter.calls


@pytest.mark.parametrize("kind", KINDS)
def test_at_many_moments(kind):
    whole, states, calls = straight(kind)
    for at in np.linspace(2, calls - 2, MOMENTS).astype(int):
        scene, steps, _ = watched(kind)
        with pytest.raises(KeyboardInterrupt), Counter(at) as counter:
            scene.run(steps)
        # At once: no step was taken after the signal
        assert counter.calls <= at + 400
        assert scene.state() in states[steps.t], counter.where
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        scene.run(steps)
        assert steps.t == 1
        assert scene.state() == whole.state() or kind == "condensed", counter.where
        assert np.abs(scene.u.x.array - whole.u.x.array).max() <= 1e-12
        assert np.array_equal(scene.history.x.array, whole.history.x.array)
        status = scene.contact.status.x.array
        assert np.array_equal(status, whole.contact.status.x.array)


@pytest.mark.parametrize("kind", ["nodes", "condensed"])
def test_a_solve_at_many_moments(kind):
    """Without load steps: what was there before the call, or after it."""
    one, other = Rubbing(**KINDS[kind]), Rubbing(**KINDS[kind])
    one.update(0.25)
    before = other.state()
    with Counter() as counter:
        one.problem.solve()
    after = one.state()
    other.update(0.25)
    for at in np.linspace(1, 0.8 * counter.calls, MOMENTS).astype(int):
        with pytest.raises(KeyboardInterrupt), Counter(at):
            other.problem.solve()
        assert other.state() == before
    other.problem.solve()
    assert np.abs(other.u.x.array - one.u.x.array).max() <= 1e-13
    assert other.state() == after


@pytest.mark.parametrize("where", ["update", "output", "level set", "monitor"])
def test_inside_of_what_a_user_gives(where):
    """The signal comes in Python that contactx or PETSc calls."""
    armed = []

    def maybe(place):
        if place == where and armed and armed.pop():
            signal.raise_signal(signal.SIGINT)

    def ball(x):
        maybe("level set")
        return (x[0] - 0.7) ** 2 + (x[1] + 2) ** 2 - 4

    def gradient(x):
        return 2 * np.stack([x[0] - 0.7, x[1] + 2])

    def make():
        scene = Rubbing()
        if where == "level set":
            blocks = scene.blocks
            scene.contact = blocks.contact(master=cx.LevelSet(ball, gradient))
            scene.problem = blocks.problem(scene.contact)
        scene.problem.solver.setMonitor(lambda *_: maybe("monitor"))

        def update(t):
            if t > 0.5:
                armed.append(not scene.interrupted)
            scene.update(t)
            maybe("update")

        scene.interrupted = False
        steps = scene.steps(2, update=update, output=lambda step: maybe("output"))
        return scene, steps

    scene, steps = make()
    with pytest.raises(KeyboardInterrupt):
        scene.run(steps)
    # In the output the step is accepted, and comes again
    assert steps.t == (1 if where == "output" else 0.5)
    scene.interrupted = True
    armed.clear()
    scene.run(steps)
    whole, others = make()
    whole.interrupted = True
    armed.clear()
    whole.run(others)
    assert scene.state() == whole.state()
    for each in (scene, whole):
        each.problem.solver.cancelMonitor()


def test_a_second_one_waits_until_the_state_is_back():
    """The second one comes while the first is dealt with."""
    scene = Rubbing()
    before = scene.state()
    scene.update(0.25)
    pressed = []
    with pytest.raises(KeyboardInterrupt), Counter(200, times=1) as counter:
        restore = FunctionValues.restore

        def pressed_again(values):
            pressed.append(values)
            signal.raise_signal(signal.SIGINT)
            restore(values)

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(FunctionValues, "restore", pressed_again)
            scene.problem.solve()
    assert counter.calls >= 200
    assert pressed
    assert scene.state() == before


def test_what_has_waited_comes_at_the_end():
    with pytest.raises(KeyboardInterrupt), Interrupts() as interrupts:
        interrupts.wait()
        signal.raise_signal(signal.SIGINT)
        reached = True
    assert reached
    with Interrupts() as outer:
        with pytest.raises(KeyboardInterrupt), Interrupts() as inner:
            inner.wait()
            signal.raise_signal(signal.SIGINT)
        # It was raised once: from here on the next one waits
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            outer.allow()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
