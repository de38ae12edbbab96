# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes and closed formulas."""

import numpy as np

from dolfinx.mesh import CellType

import meshes
import reference
from inputs.rows import refused, table
from meshes import Tag

TRIANGLE = CellType.triangle


def blocks(**changed):
    given = {"cell_type": TRIANGLE, "n_upper": (1, 1), "n_lower": (1, 1), **changed}
    return lambda: meshes.blocks(**given)


ROWS = {
    ValueError: [
        (lambda: meshes.hertz_sphere(0), "h is 0; give a positive number"),
        (lambda: meshes.rings(float("nan")), "n is nan; give a whole number of cells"),
        (blocks(cell_type=CellType.prism), "cell_type is prism; give one of triangle"),
        (blocks(n_upper=(1, 1, 1)), r"n_upper is \(1, 1, 1\); give 2 finite numbers"),
        (blocks(n_upper=(1, -1)), r"n_upper\[1\] is -1; give a whole number"),
        (blocks(gap=np.nan), "gap is nan; give a finite number"),
        (blocks(size_lower=(0, 1)), r"size_lower\[0\] is 0; give a positive number"),
        (lambda: meshes.single(blocks()(), 7), "body is 7, which the model does not have"),
        (
            lambda: reference.HertzSphere(force=np.nan, radius=1, modulus=1),
            "force is nan; give a positive",
        ),
    ],
    TypeError: [
        (lambda: meshes.hertz_cylinder("a"), "h is str 'a'; give a number"),
        (lambda: meshes.hertz_grid(None), "h is NoneType None; give a number"),
        (lambda: meshes.half_spheres(1.0, h=[0.1], zone=0.2), r"h is list \[0\.1\]; give a number"),
        (lambda: meshes.hertz_cap("a"), "n is str 'a'; give a number"),
        (lambda: meshes.rings(4, radii=1.0), r"radii is float 1\.0; give a sequence"),
        (blocks(cell_type="triangle"), "cell_type is str 'triangle'; give a dolfinx.mesh.CellType"),
        (blocks(n_upper=1), "n_upper is int 1; give a sequence of numbers"),
        (blocks(n_lower=("a", 1)), r"n_lower\[0\] is str 'a'; give a number"),
        (blocks(gap="a"), "gap is str 'a'; give a number"),
        (blocks(shift=1.0), r"shift is float 1\.0; give a sequence"),
        (lambda: meshes.stack(TRIANGLE, None), "divisions is None; give the numbers of cells"),
        (lambda: meshes.stack(TRIANGLE, (1, 1)), r"divisions\[0\] is int 1; give a sequence"),
        (lambda: meshes.FaceSlab(width="a"), "width is str 'a'; give a number"),
        (lambda: meshes.FaceSlab(opening=3.0), r"opening is float 3\.0; give a sequence"),
        (lambda: meshes.face_slab(None), "model is a NoneType; give a FaceSlab"),
        (lambda: meshes.single(3, Tag.UPPER), "data is a int; give what a mesh function"),
        (lambda: meshes.single(blocks()(), "UPPER"), "body is 'UPPER'; give a Tag"),
        (
            lambda: reference.HertzSphere(force="a", radius=1, modulus=1),
            "force is str 'a'; give a positive number",
        ),
        (
            lambda: reference.contact_modulus(None, 0.3, 1, 0.3),
            "young_1 is NoneType None; give a number",
        ),
    ],
}


@table(ROWS)
def test_refused(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused(row)
    assert list(tmp_path.iterdir()) == []
