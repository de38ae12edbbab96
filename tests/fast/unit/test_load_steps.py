# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loops over load steps: order of calls, cuts, failures, interrupts, what is shown."""

import io
import logging
import warnings

import numpy as np
import pytest
import rich
from rich.console import Console

import contactx as cx
from contactx._host.discrete_contact import Fields

from meshes import Tag
from scenes.materials import neo_hookean
from scenes.problems import make_problem
from scenes.steps import Sheared

pytestmark = pytest.mark.usefixtures("method")


def test_the_loop_sees_each_step_and_update_comes_before_it():
    scene = Sheared()
    log = []
    for step in scene.steps(4, output=lambda s: log.append(("output", s.index))):
        log.append(("body", step.index))
        assert step.t == scene.calls[-1] == step.index / 4
        assert step.report is scene.problem.report
        assert step.iterations == step.report.iterations > 0
        assert step.report.discarded == 0
    assert scene.calls == [0.25, 0.5, 0.75, 1.0]
    assert log == [(what, k) for k in (1, 2, 3, 4) for what in ("output", "body")]


def test_a_step_that_fails_is_cut_and_reaches_the_same_end():
    scene, direct = Sheared(), Sheared()
    steps = scene.steps(1)
    taken = list(steps)
    # What is left is cut, too: a shorter step is cheaper than damped ones
    assert scene.calls == [1.0, 0.5, 1.0, 0.75, 1.0]
    assert [(step.index, step.t) for step in taken] == [(1, 0.5), (2, 0.75), (3, 1.0)]
    first, _, second = (step.report for step in taken)
    assert first.discarded > 0 and second.discarded == 0
    assert f"({first.discarded} more in attempts that failed)" in str(first)
    assert "cut" not in str(second)
    assert steps.t == 1
    # The attempt that failed has left no trace
    for _ in direct.steps([0.5, 0.75, 1.0]):
        pass
    assert direct.calls == [0.5, 0.75, 1.0]
    assert direct.state() == scene.state()


def test_a_final_failure_leaves_the_last_accepted_step():
    scene = Sheared(far=0.0, deep=1.5)
    states, found = [scene.state()], []

    def update(t):
        scene.update(t)
        # What an attempt does to the state is undone before the next one
        found.append(scene.history.x.array[0])
        scene.history.x.array[:] = t

    steps = scene.steps(4, update=update)
    with pytest.raises(cx.ConvergenceError) as info:
        for _ in steps:
            states.append(scene.state())
    assert len(states) > 1
    assert 0.25 <= steps.t < 1 / 1.5
    assert scene.state() == states[-1]
    failed = [t for t in scene.calls if t > steps.t]
    assert len(failed) > 2
    assert np.all(np.diff(failed[-3:]) < 0)
    assert scene.calls[-1] == steps.t
    assert found[-3:] == [steps.t] * 3
    report = scene.problem.report
    assert info.value.report is report
    assert not report.converged
    assert report.discarded > 0
    assert "the shortest that max_cuts = 6 allows" in info.value.__notes__[0]


def test_a_failure_of_the_first_step_sets_the_loads_of_zero():
    scene = Sheared()
    fresh = scene.state()
    steps = scene.steps(1, max_cuts=0)
    with pytest.raises(cx.ConvergenceError, match="no convergence in snes_max_it"):
        next(iter(steps))
    assert scene.calls == [1.0, 0.0]
    assert scene.state() == fresh
    assert steps.t == 0


def test_after_a_failure_another_loop_goes_on():
    scene, straight = Sheared(), Sheared()
    steps = scene.steps([0.5, 1.0])
    for step in steps:
        if step.t == 0.5:
            break
    scene.far = 300.0
    with pytest.raises(cx.ConvergenceError):
        next(iter(steps))
    assert steps.t == 0.5
    scene.far = 3.0
    assert [(step.index, step.t) for step in steps] == [(2, 0.75), (3, 1.0)]
    assert list(steps) == []
    for _ in straight.steps([0.5, 0.75, 1.0]):
        pass
    assert scene.state() == straight.state()


class Wrong(Exception):
    pass


def raise_at(call, error):
    """A function that raises when it is called that often, and works before and after."""
    calls = []

    def wrap(function):
        def wrapped(*args):
            calls.append(args)
            if len(calls) == call:
                raise error
            return function(*args)

        return wrapped

    return wrap


@pytest.mark.parametrize(("error", "call"), [(Wrong, 8), (KeyboardInterrupt, 10), (Wrong, 12)])
def test_another_error_of_the_solve_is_not_cut(monkeypatch, error, call):
    """The loads are those of the last accepted step again."""
    scene = Sheared(far=0.1)
    system, states = scene.problem.assembler.system, []
    monkeypatch.setattr(system, "residual", raise_at(call, error)(system.residual))
    steps = scene.steps(4)
    with pytest.raises(error):
        for _ in steps:
            states.append(scene.state())
    assert 0 < len(states) < 4
    assert scene.calls == [*(k / 4 for k in range(1, len(states) + 2)), len(states) / 4]
    assert scene.state() == states[-1]
    assert [step.t for step in steps][-1] == 1


@pytest.mark.parametrize("error", [Wrong, KeyboardInterrupt])
def test_an_error_after_the_solve_counts_as_a_failed_step(monkeypatch, error):
    scene = Sheared(far=0.1)
    steps = scene.steps(2)
    next(iter(steps))
    before = scene.state()
    with monkeypatch.context() as patch:
        patch.setattr(Fields, "update", raise_at(1, error)(Fields.update))
        with pytest.raises(error):
            next(iter(steps))
    assert scene.state() == before
    assert steps.t == scene.calls[-1] == 0.5
    assert [step.t for step in steps] == [1.0]


@pytest.mark.parametrize("error", [Wrong, KeyboardInterrupt])
def test_an_error_of_update_is_not_followed_by_another_call(error):
    scene = Sheared(far=0.1)

    def update(t):
        scene.update(t)
        if t > 0.5:
            scene.u.x.array[:] = scene.history.x.array[:] = 7
            raise error

    states = []
    with pytest.raises(error):
        for _ in scene.steps(2, update=update):
            states.append(scene.state())
    assert scene.calls == [0.5, 1.0]
    assert scene.state() == states[-1]


def test_an_update_that_does_not_go_back_does_not_hide_the_failure():
    scene = Sheared(far=300.0)

    def update(t):
        scene.update(t)
        if t == 0:
            raise Wrong("no way back")

    with pytest.raises(cx.ConvergenceError) as info:
        next(iter(scene.steps(1, update=update, max_cuts=1)))
    assert (
        "update(0), which sets the loads back, failed: Wrong('no way back')"
        in (info.value.__notes__[-1])
    )


def test_an_error_of_the_body_leaves_the_step_accepted():
    scene = Sheared(far=0.1)
    steps = scene.steps(2)
    with pytest.raises(Wrong):
        for _ in steps:
            raise Wrong
    assert steps.t == 0.5
    assert [step.index for step in steps] == [2]


def test_warnings_point_to_the_loop(monkeypatch):
    scene = Sheared(far=0.1)

    def warn(_):
        scene.problem.assembler.say("something is odd")

    monkeypatch.setattr(Fields, "update", warn)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        next(iter(scene.steps(1)))
    assert [w.filename for w in caught] == [__file__]


def test_the_table_and_the_bar(monkeypatch):
    console = Console(record=True, force_terminal=True, width=100, file=io.StringIO())
    monkeypatch.setattr(rich, "get_console", lambda: console)
    scene = Sheared()
    steps = scene.steps(1, progress=True)
    for _ in steps:
        pass
    shown = console.export_text(clear=False)
    assert steps.table() in shown
    assert "step 1 to t = 0.5, cut 1x" in shown
    rows = [line.split("│")[1:-1] for line in steps.table().splitlines() if "│" in line]
    assert [float(row[1]) for row in rows] == [0.5, 0.75, 1.0]
    assert int(rows[0][3]) > 0 == int(rows[2][3])


def test_silence(capsys):
    for _ in Sheared().steps(1, progress=False):
        pass
    assert capsys.readouterr() == ("", "")
    for _ in Sheared().steps(1, progress=True):
        pass
    # No terminal: no bar, but the table
    assert capsys.readouterr().out.startswith("┏")


def test_a_log_has_a_line_for_each_attempt(tmp_path, caplog):
    scene, path = Sheared(), tmp_path / "runs" / "run.log"
    with caplog.at_level(logging.INFO, "contactx.steps"):
        for k, step in enumerate(scene.steps(1, log=path)):
            # Lines are on disk before the loop's body runs
            lines = path.read_text().splitlines()
            assert len(lines) == len(caplog.messages) + 1 == [3, 5, 6][k]
            assert lines[-1].endswith("accepted") and step.t == float(lines[-1].split()[2])
    heading, *lines = path.read_text().splitlines()
    assert lines == caplog.messages
    rows = [dict(zip(heading.split(), line.split(), strict=False)) for line in lines]
    assert [(row["step"], row["attempt"]) for row in rows] == [
        ("1", "1"), ("1", "2"), ("2", "1"), ("2", "2"), ("3", "1"),
    ]  # fmt: skip
    assert [float(row["t"]) for row in rows] == scene.calls
    assert [float(row["dt"]) for row in rows] == [1.0, 0.5, 0.5, 0.25, 0.25]
    assert all(("failed: " in line) == (k in (0, 2)) for k, line in enumerate(lines))
    solves = [int(row["solves"]) for row in rows]
    report = scene.problem.report
    assert solves[-1] == report.iterations and min(solves) > 0
    assert int(rows[-1]["closed"]) == report.history[-1].closed > 0
    assert float(rows[-1]["residual"]) <= float(rows[-1]["tolerance"])


def test_a_restarted_run_goes_on_in_its_log(tmp_path):
    log, saved = tmp_path / "run.log", tmp_path / "run.state"
    for step in Sheared().steps(4, log=log, checkpoint=saved):
        if step.index == 2:
            break
    Sheared().steps(4, log=log, restart=saved, checkpoint=saved)
    before = log.read_text()
    for _ in (steps := Sheared().steps(4, log=log, restart=saved)):
        pass
    assert log.read_text().startswith(before) and steps.t == 1
    # The loop was left before its body had ended, so that step 2 comes again
    assert [line.split()[0] for line in log.read_text().splitlines() if "accepted" in line] == [
        "1", "2", "2", "3", "4",
    ]  # fmt: skip


def test_iterates_are_logged_for_who_asks(caplog):
    with caplog.at_level(logging.DEBUG, "contactx.iterates"):
        step = next(iter(Sheared().steps(4)))
    assert len(caplog.messages) == step.iterations + 1
    assert "number=0" in caplog.messages[0]


def test_a_step_starts_from_an_extrapolation_of_the_last_one():
    scene, plain = Sheared(far=0.5), Sheared(far=0.5)
    solves = sum(step.iterations for step in scene.steps(8))
    without = 0
    for t in np.arange(1, 9) / 8:
        plain.update(t)
        plain.problem.solve()
        without += plain.problem.report.iterations
    assert solves <= 0.8 * without
    assert scene.u.x.array == pytest.approx(plain.u.x.array, abs=1e-9)


def test_a_start_of_the_users_own_is_kept():
    """What an update sets u to is not extrapolated once more."""
    scene = Sheared(far=0.5)
    seen = []

    def update(t):
        scene.update(t)
        if t > 0.5:
            scene.u.x.array[:] = last
        seen.append(scene.u.x.array.copy())

    last = scene.u.x.array.copy()
    reports = [step.report for step in scene.steps(2, update=update)]
    assert len(seen) == 2
    # From where nothing has moved the first residual is that of all of the way
    assert reports[1].history[0].residual > 1.5 * reports[0].history[0].residual


def test_an_iterate_where_a_level_set_is_undefined_ends_an_attempt_only():
    scene = Sheared(far=0.5)
    is_undefined, problem = True, None

    def height(x):
        nonlocal is_undefined
        if problem is not None and problem.assembler.core.has_begun and is_undefined:
            # Once: what is restored is where it is defined
            is_undefined = False
            return np.full_like(x[1], np.nan)
        return x[1].copy()

    up = lambda x: np.stack([0 * x[0], 0 * x[0] + 1])  # noqa: E731
    contact = cx.Contact(cx.Surface(scene.tags, Tag.UPPER_CONTACT), cx.LevelSet(height, up))
    problem = make_problem(neo_hookean(scene.u, 2.6, 0.3), scene.u, [contact], scene.bcs)
    scene.update(1.0)
    before = scene.u.x.array.copy()
    with pytest.raises(cx.ConvergenceError, match="function of a LevelSet"):
        problem.solve()
    assert np.array_equal(scene.u.x.array, before)
    calls = []

    def update(t):
        nonlocal is_undefined
        calls.append(t)
        is_undefined = len(calls) == 1
        scene.update(t)

    for _ in cx.LoadSteps(problem, 1, update, progress=False):
        pass
    assert calls == [1.0, 0.5, 1.0]
    assert contact.force[1] > 0
