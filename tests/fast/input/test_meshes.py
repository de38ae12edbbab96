# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes and closed formulas."""

import numpy as np

from dolfinx.mesh import CellType

import meshes
import reference
from inputs.rows import Row, refused, table
from meshes import Tag

TRIANGLE = CellType.triangle


def blocks(**changed):
    given = {"cell_type": TRIANGLE, "n_upper": (1, 1), "n_lower": (1, 1), **changed}
    return lambda: meshes.blocks(**given)


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
]


@table(ROWS)
def test_refused(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused(row)
    assert list(tmp_path.iterdir()) == []
