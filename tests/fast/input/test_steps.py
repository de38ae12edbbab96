# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Load steps, and files for ParaView."""

from pathlib import Path

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem

from inputs.rows import Row, constant, refused, scene, table
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


ROWS = [
    Row("steps: zero", steps(0), ValueError, "steps is 0: give an integer at least 1"),
    Row("steps: a fraction", steps(2.5), TypeError, r"steps is 2\.5: give an integer"),
    Row("steps: a text", steps("abc"), TypeError, "steps is 'abc': give an integer"),
    Row("steps: None", steps(None), TypeError, "steps is None: give an integer"),
    Row(
        "steps: an empty list",
        steps([]),
        ValueError,
        r"steps has shape \(0,\): give a number of steps or",
    ),
    Row("steps: a matrix", steps([[0.5]]), ValueError, r"steps has shape \(1, 1\): give a number"),
    Row(
        "steps: texts",
        steps(["a"]),
        TypeError,
        r"steps is \['a'\]: give a number of steps or a list",
    ),
    Row("steps: complex", steps([1j]), TypeError, r"steps is \[1j\]: give a number of steps or"),
    Row(
        "steps: NaN",
        steps([0.5, np.nan]),
        ValueError,
        "steps holds t = nan: each t must be above 0",
    ),
    Row(
        "steps: beyond the end",
        steps([0.5, 2.0]),
        ValueError,
        "steps holds t = 2: each t must be above 0 and at",
    ),
    Row(
        "steps: going back",
        steps([0.5, 0.3]),
        ValueError,
        r"steps holds 0\.3 after 0\.5: each t must be larger",
    ),
    Row(
        "max_cuts: negative",
        steps(max_cuts=-1),
        ValueError,
        "max_cuts is -1: give an integer from 0 to 40",
    ),
    Row(
        "max_cuts: too many",
        steps(max_cuts=99),
        ValueError,
        "max_cuts is 99: give an integer from 0",
    ),
    Row("max_cuts: None", steps(max_cuts=None), TypeError, "max_cuts is None: give an integer"),
    Row("easy: a text", steps(easy="a"), TypeError, "easy is 'a': give an integer"),
    Row("easy: negative", steps(easy=-1), ValueError, "easy is -1: give an integer at least 0"),
    Row(
        "progress: a text",
        steps(progress="no"),
        TypeError,
        "progress is str 'no': give True or False",
    ),
    Row("update: a number", steps(update=3), TypeError, "update must be a function of t, not 3"),
    Row("update: None", steps(update=None), TypeError, "update must be a function of t, not None"),
    Row(
        "update: takes nothing",
        steps(update=lambda: None),
        TypeError,
        "takes 0 positional arguments but 1",
    ),
    Row("output: a text", steps(output="file"), TypeError, "output must be a function of a step"),
    Row(
        "history: None",
        steps(history=None),
        TypeError,
        "history must be a list of functions, not NoneType",
    ),
    Row(
        "history: a number",
        steps(history=3),
        TypeError,
        "history must be a list of functions, not int",
    ),
    Row(
        "history: numbers", steps(history=[1]), TypeError, "history holds a int: give fem.Functions"
    ),
    Row(
        "history: a function",
        lambda: steps(history=scene().scalar(0.0))(),
        TypeError,
        r"write history=\[function\]",
    ),
    Row(
        "checkpoint: a number",
        steps(checkpoint=3),
        TypeError,
        "checkpoint is 3: give the path of a file",
    ),
    Row("restart: a number", steps(restart=3), TypeError, "restart is 3: give the path of a file"),
    Row(
        "problem: a function",
        lambda: cx.LoadSteps(scene().u, 1, print),
        TypeError,
        "problem must be a ContactProblem, not Function",
    ),
    Row("an unknown option", steps(step=3), TypeError, "unexpected keyword argument 'step'"),
    Row(
        "path: a number",
        output(lambda b, c: {"path": 3}),
        TypeError,
        "path is 3: give the path of a file",
    ),
    Row(
        "path: another suffix",
        output(lambda b, c: {"path": "a.vtk"}),
        ValueError,
        r"path ends in '.vtk': give one of .pvd, .xdmf, .bp",
    ),
    Row(
        "path: a dot",
        output(lambda b, c: {"path": "a.b.pvd"}),
        ValueError,
        r"path has the name 'a.b.pvd': take the dots before the suffix out",
    ),
    Row(
        "u: an array",
        output(lambda b, c: {"u": np.zeros(3)}),
        TypeError,
        "u must be a dolfinx.fem.Function, not ndarray",
    ),
    Row(
        "contacts: one alone",
        output(lambda b, c: {"contacts": c}),
        TypeError,
        "contacts must be a list of contactx.Contact, not Contact",
    ),
    Row(
        "contacts: numbers",
        output(lambda b, c: {"contacts": [1]}),
        TypeError,
        "contacts holds a int: pass a list of contactx.Contact",
    ),
    Row(
        "contacts: of another mesh",
        output(lambda b, c: {"contacts": [attached()]}),
        ValueError,
        r"contacts\[0\] is on another mesh than u: give one",
    ),
    Row(
        "contacts: too early",
        output(lambda b, c: {"contacts": [b.contact()]}),
        RuntimeError,
        "has no results yet: pass it to a ContactProblem first",
    ),
    Row(
        "fields: one alone",
        output(lambda b, c: {"fields": c.gap}),
        TypeError,
        "fields must be a list of fem.Function, not Function",
    ),
    Row(
        "fields: constants",
        output(lambda b, c: {"fields": [constant(1.0)]}),
        TypeError,
        "fields holds a Constant: pass a list of fem.Function",
    ),
    Row(
        "fields: quadratic",
        output(lambda b, c: {"fields": [quadratic(b)]}),
        ValueError,
        r"fields\[0\] is of .*: interpolate it into a Lagrange space of u's degree",
    ),
    Row("t: a text", output(lambda b, c: {"t": "0"}), TypeError, "t is str '0': give a number"),
    Row("t: NaN", output(lambda b, c: {"t": np.nan}), ValueError, "t is nan: give a finite number"),
]


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
