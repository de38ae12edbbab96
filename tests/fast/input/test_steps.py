# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Load steps, which t they attempt, and files for ParaView."""

from pathlib import Path

import numpy as np
import pytest

import contactx as cx
from contactx.steps import make_plan
from dolfinx import fem

from inputs.rows import constant, refused, scene, table
from scenes.steps import Sheared


def steps(*args, **options):
    """Take all steps."""

    def do():
        blocks = Sheared(far=0.1)
        given = {"update": blocks.update, "progress": False, **options}
        for _ in cx.LoadSteps(blocks.problem, *(args or (1,)), **given):
            pass

    return do


def output(make):
    """Write results; the function makes arguments of a scene and its contact."""

    def do():
        blocks = scene()
        contact = blocks.contact()
        blocks.problem(contact)
        given = {"path": "never.pvd", "u": blocks.u, "contacts": [contact], "t": 0.0}
        given |= make(blocks, contact)
        t = given.pop("t")
        with cx.VTKOutput(given.pop("path"), given.pop("u"), given.pop("contacts"), **given) as out:
            out.write(t)

    return do


def quadratic(blocks):
    return fem.Function(fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 2)))


def attached():
    blocks = scene()
    contact = blocks.contact()
    blocks.problem(contact)
    return contact


ROWS = {
    ValueError: [
        (steps(0), "steps is 0: give an integer at least 1"),
        (steps([]), r"steps has shape \(0,\): give a number of steps or"),
        (steps([[0.5]]), r"steps has shape \(1, 1\): give a number"),
        (steps([0.5, np.nan]), "steps holds t = nan: each t must be above 0"),
        (steps([0.0, 1.0]), "steps holds t = 0: each t must be above 0"),
        (steps([0.5, 0.5]), r"steps holds 0\.5 after 0\.5: each t must be larger"),
        (steps([0.5, 2.0]), "steps holds t = 2: each t must be above 0 and at"),
        (steps([0.5, 0.3]), r"steps holds 0\.3 after 0\.5: each t must be larger"),
        (steps(max_cuts=-1), "max_cuts is -1: give an integer from 0 to 40"),
        (steps(max_cuts=99), "max_cuts is 99: give an integer from 0"),
        (steps(easy=-1), "easy is -1: give an integer at least 0"),
        (
            output(lambda b, c: {"path": "a.vtk"}),
            r"path ends in '.vtk': give one of .pvd, .xdmf, .bp",
        ),
        (
            output(lambda b, c: {"path": "a.b.pvd"}),
            r"path has the name 'a.b.pvd': take the dots before the suffix out",
        ),
        (
            output(lambda b, c: {"contacts": [attached()]}),
            r"contacts\[0\] is on another mesh than u: give one",
        ),
        (
            output(lambda b, c: {"fields": [quadratic(b)]}),
            r"fields\[0\] is of .*: interpolate or project it into a Lagrange space of u's degree",
        ),
        (output(lambda b, c: {"t": np.nan}), "t is nan: give a finite number"),
    ],
    TypeError: [
        (steps(2.5), r"steps is 2\.5: give an integer"),
        (steps("abc"), "steps is 'abc': give an integer"),
        (steps(None), "steps is None: give an integer"),
        (steps(["a"]), r"steps is \['a'\]: give a number of steps or a list"),
        (steps([1j]), r"steps is \[1j\]: give a number of steps or"),
        (steps(max_cuts=None), "max_cuts is None: give an integer"),
        (steps(easy="a"), "easy is 'a': give an integer"),
        (steps(progress="no"), "progress is str 'no': give True or False"),
        (steps(update=3), "update must be a function of t, not 3"),
        (steps(update=None), "update must be a function of t, not None"),
        (steps(update=lambda: None), "takes 0 positional arguments but 1"),
        (steps(output="file"), "output must be a function of a step"),
        (steps(history=None), "history must be a list of functions, not NoneType"),
        (steps(history=3), "history must be a list of functions, not int"),
        (steps(history=[1]), "history holds a int: give fem.Functions"),
        (lambda: steps(history=scene().scalar(0.0))(), r"write history=\[function\]"),
        (steps(checkpoint=3), "checkpoint is 3: give the path of a file"),
        (steps(restart=3), "restart is 3: give the path of a file"),
        (
            lambda: cx.LoadSteps(scene().u, 1, print),
            "problem must be a ContactProblem, not Function",
        ),
        (steps(step=3), "unexpected keyword argument 'step'"),
        (output(lambda b, c: {"path": 3}), "path is 3: give the path of a file"),
        (output(lambda b, c: {"u": np.zeros(3)}), "u must be a dolfinx.fem.Function, not ndarray"),
        (
            output(lambda b, c: {"contacts": c}),
            "contacts must be a list of contactx.Contact, not Contact",
        ),
        (
            output(lambda b, c: {"contacts": [1]}),
            "contacts holds a int: pass a list of contactx.Contact",
        ),
        (
            output(lambda b, c: {"fields": c.gap}),
            "fields is Function: give a list of fem.Function and contactx.Projection",
        ),
        (
            output(lambda b, c: {"fields": [constant(1.0)]}),
            r"fields\[0\] is Constant: give a fem.Function or contactx.Projection",
        ),
        (output(lambda b, c: {"t": "0"}), "t is str '0': give a number"),
    ],
    RuntimeError: [
        (
            output(lambda b, c: {"contacts": [b.contact()]}),
            "has no results yet: pass it to a ContactProblem first",
        ),
    ],
}


@table(ROWS)
def test_refused(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused(row)


def test_a_file_that_is_closed(tmp_path: Path):
    contact, blocks = attached(), None
    u = fem.Function(contact.traction.function_space)
    out = cx.VTKOutput(tmp_path / "a.pvd", u, [contact])
    out.close()
    with pytest.raises(RuntimeError, match=r"a\.pvd is closed: write before that"):
        out.write(0.0)
    assert blocks is None


def walk(plan, fails=lambda start, t: False, iterations=lambda start, t: 5):
    """All t that are attempted, failed ones negative, until the end or the last failure."""
    tried = []
    while not plan.finished:
        start, t = plan.t, plan.next
        if fails(start, t):
            tried.append(-t)
            if not plan.cut(5):
                break
        else:
            tried.append(t)
            plan.accept(iterations(start, t))
            assert plan.t == t
    return tried


def test_equal_steps_end_at_one():
    assert walk(make_plan(10, 6, 10)) == [k / 10 for k in range(1, 11)]
    assert walk(make_plan(np.int64(1), 0, 10)) == [1.0]


def test_given_t_are_met_exactly():
    given = [0.1, 0.30000000000000004, 0.7]
    assert walk(make_plan(given, 6, 10)) == given
    assert walk(make_plan(np.array(given), 6, 10)) == given
    tried = walk(make_plan(given, 6, 10), lambda start, t: t - start > 0.07)
    assert set(given) <= set(tried)


def test_a_failed_step_is_halved_until_it_must_not_be():
    tried = walk(make_plan(2, 3, 10), lambda *_: True)
    assert tried == [-0.5, -0.25, -0.125, -0.0625]
    assert walk(make_plan(2, 0, 10), lambda *_: True) == [-0.5]


def test_they_do_not_grow_after_hard_ones():
    hard = walk(make_plan(2, 6, 10), lambda s, t: s == 0 and t > 0.2, lambda *_: 11)
    assert hard == [-0.5, -0.25, *(k / 8 for k in range(1, 9))]
    assert walk(make_plan(2, 6, 11), lambda s, t: s == 0 and t > 0.2, lambda *_: 11) == [
        *(-0.5, -0.25, 0.125, 0.25, 0.5, 1.0)
    ]


def test_the_rest_of_a_step_is_halved_where_it_fails():
    """The step has grown beyond the given t; the next attempt must be shorter than the rest."""
    given = [1.0]
    tried = walk(make_plan(given, 6, 10), lambda s, t: t - s > (0.3 if s < 0.75 else 0.1))
    assert tried == [-1.0, -0.5, 0.25, 0.5, -1.0, 0.75, -1.0, -0.875, 0.8125, *tried[9:]]
    assert tried[-1] == 1.0
    sizes = np.diff([0.0, *(t for t in tried if t > 0)])
    assert np.all(np.log2(sizes) == np.round(np.log2(sizes)))


def test_steps_that_were_cut_stay_short_in_the_next_given_one():
    hard = walk(make_plan(2, 6, 4), lambda start, t: t - start > 0.3)
    assert hard == [-0.5, 0.25, 0.5, 0.75, 1.0]


@pytest.mark.parametrize("fails_at", [2.0, 0.3])
def test_a_saved_place_is_gone_on_from(fails_at):
    def fails(start, t):
        return start == 0 and t > fails_at

    whole, place = walk(make_plan(3, 6, 4), fails), make_plan(3, 6, 4)
    for _ in range(2):
        while fails(place.t, place.next):
            place.cut(5)
        place.accept(5)
    saved = loaded(make_plan(3, 6, 4), place)
    assert saved == place
    assert saved.t == place.t
    rest = walk(saved, fails)
    assert 0 < len(rest) < len(whole)
    assert rest == whole[-len(rest) :]


def loaded(plan, place):
    """A plan that goes on from the place of another one."""
    plan.load(np.array(place.given), place.place)
    return plan


def test_a_saved_place_serves_other_given_t():
    place = make_plan(4, 6, 10)
    place.accept(5)
    place.accept(5)
    assert walk(loaded(make_plan([0.2, 0.5, 0.6, 1.0], 6, 10), place)) == [0.6, 1.0]
    assert loaded(make_plan([0.2, 0.5], 6, 10), place).finished
    with pytest.raises(ValueError, match=r"at t = 0\.5, beyond the last given t = 0\.4"):
        loaded(make_plan([0.2, 0.4], 6, 10), place)
    place.accept(5)
    place.accept(5)
    assert loaded(make_plan(4, 6, 10), place).finished


def test_steps_may_end_in_the_users_time():
    assert walk(make_plan(4, 6, 10, 10.0)) == [2.5, 5.0, 7.5, 10.0]
    assert walk(make_plan([3, 20], 6, 10, 20)) == [3.0, 20.0]
    for wrong, error in (("10", TypeError), (0, ValueError), (np.inf, ValueError)):
        with pytest.raises(error, match="t_end is"):
            make_plan(4, 6, 10, wrong)
    with pytest.raises(ValueError, match="t = 21: each t must be above 0 and at most 20"):
        make_plan([3, 21], 6, 10, 20)
    with pytest.raises(ValueError, match="at most 1, or give t_end"):
        make_plan([3, 21], 6, 10)
