# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes, closed formulas and pictures."""

import numpy as np
import pytest
from rows import Row, refused, scene, table

from contactx import meshes, plot, reference
from contactx.meshes import Tag
from dolfinx import fem
from dolfinx.mesh import CellType

TRIANGLE = CellType.triangle
LABELS = ("x", "y")


def blocks(**changed):
    given = {"cell_type": TRIANGLE, "n_upper": (1, 1), "n_lower": (1, 1), **changed}
    return lambda: meshes.blocks(**given)


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


LINE = {"a": ([1, 2], [1, 2])}
SQUARE = np.array([[0.0, 0], [1, 0], [0, 1]])
ROWS = [
    Row("h: zero", lambda: meshes.hertz_sphere(0), ValueError, "h is 0; give a positive number"),
    Row("h: a text", lambda: meshes.hertz_cylinder("a"), TypeError, "h is str 'a'; give a number"),
    Row("h: None", lambda: meshes.hertz_grid(None), TypeError, "h is NoneType None; give a number"),
    Row(
        "h: a list",
        lambda: meshes.half_spheres(1.0, h=[0.1], zone=0.2),
        TypeError,
        r"h is list \[0\.1\]; give a number",
    ),
    Row("n: a text", lambda: meshes.hertz_cap("a"), TypeError, "n is str 'a'; give a number"),
    Row(
        "n: NaN",
        lambda: meshes.rings(float("nan")),
        ValueError,
        "n is nan; give a whole number of cells",
    ),
    Row(
        "radii: a number",
        lambda: meshes.rings(4, radii=1.0),
        TypeError,
        r"radii is float 1\.0; give a sequence",
    ),
    Row(
        "cell type: a text",
        blocks(cell_type="triangle"),
        TypeError,
        "cell_type is str 'triangle'; give a dolfinx.mesh.CellType",
    ),
    Row(
        "cell type: a prism",
        blocks(cell_type=CellType.prism),
        ValueError,
        "cell_type is prism; give one of triangle",
    ),
    Row(
        "divisions: a number",
        blocks(n_upper=1),
        TypeError,
        "n_upper is int 1; give a sequence of numbers",
    ),
    Row(
        "divisions: texts",
        blocks(n_lower=("a", 1)),
        TypeError,
        r"n_lower\[0\] is str 'a'; give a number",
    ),
    Row(
        "divisions: too many",
        blocks(n_upper=(1, 1, 1)),
        ValueError,
        r"n_upper is \(1, 1, 1\); give 2 finite numbers",
    ),
    Row(
        "divisions: negative",
        blocks(n_upper=(1, -1)),
        ValueError,
        r"n_upper\[1\] is -1; give a whole number",
    ),
    Row("gap: a text", blocks(gap="a"), TypeError, "gap is str 'a'; give a number"),
    Row("gap: NaN", blocks(gap=np.nan), ValueError, "gap is nan; give a finite number"),
    Row("shift: a number", blocks(shift=1.0), TypeError, r"shift is float 1\.0; give a sequence"),
    Row(
        "size: zero",
        blocks(size_lower=(0, 1)),
        ValueError,
        r"size_lower\[0\] is 0; give a positive number",
    ),
    Row(
        "stack: None",
        lambda: meshes.stack(TRIANGLE, None),
        TypeError,
        "divisions is None; give the numbers of cells",
    ),
    Row(
        "stack: flat",
        lambda: meshes.stack(TRIANGLE, (1, 1)),
        TypeError,
        r"divisions\[0\] is int 1; give a sequence",
    ),
    Row(
        "slab: a text",
        lambda: meshes.FaceSlab(width="a"),
        TypeError,
        "width is str 'a'; give a number",
    ),
    Row(
        "slab: an opening",
        lambda: meshes.FaceSlab(opening=3.0),
        TypeError,
        r"opening is float 3\.0; give a sequence",
    ),
    Row(
        "slab: None",
        lambda: meshes.face_slab(None),
        TypeError,
        "model is a NoneType; give a FaceSlab",
    ),
    Row(
        "single: no model",
        lambda: meshes.single(3, Tag.UPPER),
        TypeError,
        "data is a int; give what a mesh function",
    ),
    Row(
        "single: a text",
        lambda: meshes.single(blocks()(), "UPPER"),
        TypeError,
        "body is 'UPPER'; give a Tag",
    ),
    Row(
        "single: another body",
        lambda: meshes.single(blocks()(), 7),
        ValueError,
        "body is 7, which the model does not have",
    ),
    Row(
        "formula: a text",
        lambda: reference.HertzSphere(force="a", radius=1, modulus=1),
        TypeError,
        "force is str 'a'; give a positive number",
    ),
    Row(
        "formula: NaN",
        lambda: reference.HertzSphere(force=np.nan, radius=1, modulus=1),
        ValueError,
        "force is nan; give a positive",
    ),
    Row(
        "modulus: None",
        lambda: reference.contact_modulus(None, 0.3, 1, 0.3),
        TypeError,
        "young_1 is NoneType None; give a number",
    ),
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


def gap(pair):
    contact = pair.contact()
    pair.problem(contact)
    return contact.gap


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
