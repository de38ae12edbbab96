# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures."""

import numpy as np
import pytest

from dolfinx import fem

import plot
from inputs.rows import Row, refused, scene, table

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
ROWS = [
    Row(
        "picture: u as an array",
        bodies(u=np.zeros(3)),
        TypeError,
        "u must be a fem.Function, not ndarray",
    ),
    Row(
        "picture: NaN displacement",
        bodies(u=spoilt(np.nan)),
        ValueError,
        "u is not finite at 1 dofs; replace what is NaN",
    ),
    Row(
        "picture: a gap",
        bodies(scalar=lambda pair: gap(pair)),
        ValueError,
        "scalar is not finite at .* dofs; .* gap is NaN off its slave surface",
    ),
    Row(
        "picture: a vector",
        bodies(scalar=lambda pair: pair.u),
        ValueError,
        "scalar is of .*; interpolate it into a space of",
    ),
    Row(
        "picture: another mesh",
        bodies(scalar=lambda pair: gap(scene())),
        ValueError,
        "scalar is on another mesh than u",
    ),
    Row("picture: a path", bodies(path=3), TypeError, "path is 3: give the path of a file"),
    Row("picture: a scale", bodies(scale="a"), TypeError, "scale is str 'a'; give 1 numbers"),
    Row(
        "picture: colours",
        bodies(clim=(2.0, 1.0)),
        ValueError,
        r"clim is \(2\.0, 1\.0\); give the lower number first",
    ),
    Row(
        "picture: a camera nowhere",
        bodies(camera=(0, 0, 0)),
        ValueError,
        r"camera is \(0, 0, 0\); give a direction",
    ),
    Row(
        "picture: a camera in the plane",
        bodies(camera=(0, 1)),
        ValueError,
        r"camera is \(0, 1\); give 3 finite numbers",
    ),
    Row(
        "picture: no length",
        bodies(stretch=(0, 1, 1)),
        ValueError,
        r"stretch is \(0, 1, 1\); give positive factors",
    ),
    Row(
        "picture: a mirror",
        bodies(mirror=("z",)),
        ValueError,
        "mirror holds 'z'; give names of axes",
    ),
    Row(
        "picture: a box",
        bodies(box=(1, 2)),
        ValueError,
        r"box is \(1, 2\); give its lowest and its highest",
    ),
    Row("curves: a list", curves([1]), TypeError, r'computed is a list; give \{"name": \(x, y\)\}'),
    Row(
        "curves: a number",
        curves({"a": 3}),
        TypeError,
        r"computed\['a'\] is int 3; give positions and values",
    ),
    Row(
        "curves: shapes",
        curves({"a": ([1, 2], [1])}),
        ValueError,
        r"computed\['a'\] has positions of shape \(2,\) and values",
    ),
    Row(
        "curves: one label",
        curves(LINE, labels=("x",)),
        TypeError,
        r"labels is \('x',\); give the names of both axes",
    ),
    Row(
        "curves: a mark",
        curves(LINE, marks={"m": 3}),
        TypeError,
        r"marks\['m'\] is int 3; give 2 numbers",
    ),
    Row(
        "curves: a close-up",
        curves(LINE, close_up=(2.0, 1.0)),
        ValueError,
        r"close_up is .*; give the lower number first",
    ),
    Row(
        "map: places",
        face(SQUARE[:, :1], np.zeros(3)),
        ValueError,
        r"places has shape \(3, 1\) and values \(3,\); give",
    ),
    Row(
        "map: values",
        face(SQUARE, np.zeros(4)),
        ValueError,
        r"places has shape \(3, 2\) and values \(4,\); give",
    ),
    Row(
        "map: NaN",
        face(SQUARE, np.full(3, np.nan), kinds=None, triangles=np.array([[0, 1, 2]])),
        ValueError,
        "values are not all finite; leave out",
    ),
    Row(
        "map: triangles",
        face(SQUARE, np.zeros(3), kinds=None, triangles=np.array([[0, 1, 7]])),
        ValueError,
        "triangles have nodes that are none of 0 to 2",
    ),
    Row(
        "map: neither",
        face(SQUARE, np.zeros(3), kinds=None),
        ValueError,
        "triangles and kinds are None; give triangles",
    ),
]


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
