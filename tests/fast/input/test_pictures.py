# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures."""

import numpy as np
import pytest

from dolfinx import fem

import plot
from inputs.rows import refused, scene, table

LABELS = ("x", "y")


def bodies(**changed):
    """Draw bodies; a value that is a function makes the argument of a scene."""

    def do():
        pair = scene()
        Q = fem.functionspace(pair.u.function_space.mesh, ("Lagrange", 1))
        given = {"u": pair.u, "scalar": fem.Function(Q), "path": "never.png", "title": ""}
        given |= {name: make(pair) if callable(make) else make for name, make in changed.items()}
        plot.deformed_bodies(given.pop("u"), given.pop("scalar"), given.pop("path"), **given)

    return do


def spoilt(value):
    def make(pair):
        pair.u.x.array[3] = value
        return pair.u

    return make


def curves(computed, **changed):
    given = {"labels": LABELS, "title": "", **changed}
    return lambda: plot.curves(computed, {}, "never.png", **given)


def face(places, values, **changed):
    given = {"labels": LABELS, "title": "", "kinds": plot.STATUS_NAMES, **changed}
    return lambda: plot.nodal_map(places, values, "never.png", **given)


def gap(pair):
    contact = pair.contact()
    pair.problem(contact)
    return contact.gap


LINE = {"a": ([1, 2], [1, 2])}
SQUARE = np.array([[0.0, 0], [1, 0], [0, 1]])
ROWS = {
    TypeError: [
        (bodies(u=np.zeros(3)), "u must be a fem.Function, not ndarray"),
        (bodies(path=3), "path is 3: give the path of a file"),
        (bodies(scale="a"), "scale is str 'a'; give 1 numbers"),
        (curves([1]), r'computed is a list; give \{"name": \(x, y\)\}'),
        (curves({"a": 3}), r"computed\['a'\] is int 3; give positions and values"),
        (curves(LINE, labels=("x",)), r"labels is \('x',\); give the names of both axes"),
        (curves(LINE, marks={"m": 3}), r"marks\['m'\] is int 3; give 2 numbers"),
    ],
    ValueError: [
        (bodies(u=spoilt(np.nan)), "u is not finite at 1 dofs; replace what is NaN"),
        (
            bodies(scalar=lambda pair: gap(pair)),
            "scalar is not finite at .* dofs; .* gap is NaN off its slave surface",
        ),
        (bodies(scalar=lambda pair: pair.u), "scalar is of .*; interpolate it into a space of"),
        (bodies(scalar=lambda pair: gap(scene())), "scalar is on another mesh than u"),
        (bodies(clim=(2.0, 1.0)), r"clim is \(2\.0, 1\.0\); give the lower number first"),
        (bodies(camera=(0, 0, 0)), r"camera is \(0, 0, 0\); give a direction"),
        (bodies(camera=(0, 1)), r"camera is \(0, 1\); give 3 finite numbers"),
        (bodies(stretch=(0, 1, 1)), r"stretch is \(0, 1, 1\); give positive factors"),
        (bodies(mirror=("z",)), "mirror holds 'z'; give names of axes"),
        (bodies(box=(1, 2)), r"box is \(1, 2\); give its lowest and its highest"),
        (curves({"a": ([1, 2], [1])}), r"computed\['a'\] has positions of shape \(2,\) and values"),
        (curves(LINE, close_up=(2.0, 1.0)), r"close_up is .*; give the lower number first"),
        (face(SQUARE[:, :1], np.zeros(3)), r"places has shape \(3, 1\) and values \(3,\); give"),
        (face(SQUARE, np.zeros(4)), r"places has shape \(3, 2\) and values \(4,\); give"),
        (
            face(SQUARE, np.full(3, np.nan), kinds=None, triangles=np.array([[0, 1, 2]])),
            "values are not all finite; leave out",
        ),
        (
            face(SQUARE, np.zeros(3), kinds=None, triangles=np.array([[0, 1, 7]])),
            "triangles have nodes that are none of 0 to 2",
        ),
        (face(SQUARE, np.zeros(3), kinds=None), "triangles and kinds are None; give triangles"),
    ],
}


@table(ROWS)
def test_refused(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused(row)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", ["xyz", "png/x"])
def test_pictures_that_cannot_be_written(tmp_path, suffix):
    path = tmp_path / f"picture.{suffix}"
    with pytest.raises((ValueError, OSError), match=r"xyz|picture\.png"):
        plot.curves(LINE, {}, path, labels=LABELS, title="")
