# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes, closed formulas and pictures."""

import numpy as np
import pytest

from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import plot
import reference
from inputs.rows import refused, scene, table
from meshes import Tag

TRIANGLE = CellType.triangle


def blocks(**changed):
    given = {"cell_type": TRIANGLE, "n_upper": (1, 1), "n_lower": (1, 1), **changed}
    return lambda: meshes.blocks(**given)


def stack(**changed):
    given = {"cell_type": TRIANGLE, "divisions": [(1, 1), (1, 1)], **changed}
    return lambda: meshes.stack(**given)


def slab(**changed):
    return lambda: meshes.FaceSlab(**changed)


HALF = {"radius": 1.0, "h": 0.1, "zone": 0.2}
HERTZ = {"force": 1.0, "radius": 1.0, "modulus": 1.0}
PAIR = {**HERTZ, "force": 10.0, "friction": 0.2, "tangential": 0.0}
FIT = {"interference": 0.02, "bore": 1.0, "radius": 1.5, "rim": 2.2}
FIT |= {"young_inner": 3.0, "nu_inner": 0.2, "young_outer": 7.0, "nu_outer": 0.4}
# Numbers that must be positive: what takes them, what else it is given, and some that are not
POSITIVE = [
    (meshes.hertz_sphere, {}, {"h": (-0.1, np.inf)}),
    (meshes.hertz_cylinder, {"h": 0.1}, {"h": (-0.5,), "h_master": (-0.5,), "zone": (-0.5,)}),
    (meshes.hertz_grid, {"h": 0.1}, {"h": (0.0, np.nan), "h_master": (-0.1,)}),
    (meshes.hertz_cap, {"n": 2}, {"length": (0.0,)}),
    *(
        (make, HALF, {"radius": (0.0,), "h": (-0.5,), "h_master": (np.nan,), "zone": (0.0,)})
        for make in (meshes.half_cylinders, meshes.half_spheres)
    ),
    (meshes.FaceSlab, {}, {"width": (-1.0,), "joint_size": (0.0,)}),
    *(
        (formula, HERTZ, {"force": (0.0, np.inf), "radius": (-1.0,), "modulus": (np.nan,)})
        for formula in (reference.HertzCylinder, reference.HertzSphere)
    ),
    (reference.CattaneoMindlin, PAIR, {"force": (0.0,), "radius": (-1.0,), "friction": (np.inf,)}),
    (reference.CattaneoMindlin, PAIR, {"modulus": (np.nan,)}),
    (reference.PressFit, FIT, {"interference": (0.0,), "bore": (-1.0,), "radius": (np.nan,)}),
    (reference.PressFit, FIT, {"rim": (np.inf,), "young_inner": (0.0,), "young_outer": (-1.0,)}),
]
ROWS = {
    ValueError: [
        *(
            (
                lambda make=make, given={**usual, name: value}: make(**given),
                rf"{name} is {value}; give a positive number",
            )
            for make, usual, bad in POSITIVE
            for name, values in bad.items()
            for value in values
        ),
        (lambda: meshes.hertz_cap(0), "n is 0; give a whole number"),
        (lambda: meshes.hertz_cap(2, -2), "n_master is -2; give a whole number"),
        (
            lambda: meshes.hertz_cap(2, radius=1.5),
            r"radius is 1\.5; give at least twice the length",
        ),
        (lambda: meshes.hertz_grid(0.3), r"h is 0\.3; give at most .* 0\.2"),
        *(
            (
                lambda make=make: make(1.0, 0.1, zone=1.5),
                r"zone is 1\.5; give at most the radius, 1\.0",
            )
            for make in (meshes.half_cylinders, meshes.half_spheres)
        ),
        *(
            (
                lambda given={"n": 4, "n_master": 6, name: value}: meshes.rings(**given),
                f"{name} is {value}; give a whole number of cells",
            )
            for name, value in (("n", 0), ("n_master", -2), ("n", 2.5))
        ),
        *(
            (
                lambda radii=radii: meshes.rings(4, radii=radii),
                r"radii is \(.*\); give 3 positive numbers",
            )
            for radii in (
                *((1.0, 2.0), (1.0, 1.5, 2.0, 3.0), (0.0, 1.0, 2.0), (-1.0, 1.0, 2.0)),
                *((1.0, 1.0, 2.0), (1.0, 2.0, 1.5), (1.0, np.nan, 2.0), (1.0, 2.0, np.inf)),
            )
        ),
        (lambda: meshes.block_tag(-1), "index is -1; give the number of a block"),
        (lambda: meshes.block_tag(0.5), r"index is 0\.5; give the number of a block"),
        (
            lambda: meshes.block_tag(0, "z0"),
            "side is 'z0'; give one of bottom, top, x0, y0, x1, y1",
        ),
        (stack(cell_type=CellType.prism), "cell_type is prism; give one of triangle"),
        (stack(divisions=[]), "divisions is empty; give the numbers"),
        (
            stack(divisions=[(1, 1), (1, 1, 1)]),
            r"divisions\[1\] is \(1, 1, 1\); give 2 finite",
        ),
        (stack(divisions=[(1, 0), (1, 1)]), r"divisions\[0\]\[1\] is 0; give a whole number"),
        (stack(sizes=[(1, 1)]), "sizes has 1 entries and divisions 2; give one for each box"),
        (stack(sizes=[(1, 1), (1,)]), r"sizes\[1\] is \(1,\); give 2 finite numbers"),
        (stack(sizes=[(1, 1), (-1, 1)]), r"sizes\[1\]\[0\] is -1; give a positive number"),
        (blocks(n_lower=(1, 0)), r"n_lower\[1\] is 0; give a whole number"),
        (blocks(n_upper=(1.5, 1)), r"n_upper\[0\] is 1.5; give a whole number"),
        (blocks(size_upper=(1, -1)), r"size_upper\[1\] is -1; give a positive number"),
        (blocks(size_lower=(1,)), r"size_lower is \(1,\); give 2 finite numbers"),
        (blocks(shift=(1, 1)), r"shift is \(1, 1\); give 1 finite numbers"),
        (blocks(radius=0.0), r"radius is 0\.0; give a positive number"),
        (blocks(radius=0.5), r"radius is 0\.5; give more than 0\.5, or the corners"),
        (
            blocks(radius=0.6, size_upper=(1, 0.25)),
            r"radius is 0\.6; give more than 0\.625",
        ),
        (slab(slabs=0), "slabs is 0; give a whole number"),
        (slab(layers=2.5), r"layers is 2\.5; give a whole number"),
        (slab(growth=0.9), r"growth is 0\.9; give at least 1"),
        (slab(thickening=-0.1), r"thickening is -0\.1; give a number of at least 0"),
        (slab(opening=(0.0, -1e-3)), "give two lengths, at the top and at the bottom"),
        (lambda: meshes.DamFace(bed=1.5), r"bed is 1\.5"),
        (lambda: meshes.DamFace(shortest=0.0), "shortest"),
        *(
            (lambda given=given: reference.contact_modulus(*given), message)
            for given, message in (
                ((0.0, 0.3, 1.0, 0.3), "young_1 is 0.0"),
                ((1.0, 0.3, -1.0, 0.3), "young_2 is -1.0"),
                ((1.0, 0.6, 1.0, 0.3), "nu_1 is 0.6"),
                ((1.0, 0.3, 1.0, -1.0), "nu_2 is -1.0"),
                ((np.nan, 0.3, 1.0, 0.3), "young_1 is nan"),
                ((np.inf, 0.3, np.inf, 0.3), "at most one body may be rigid"),
            )
        ),
        *(
            (
                lambda value=value: reference.CattaneoMindlin(**{**PAIR, "tangential": value}),
                f"tangential is {value}; give a force from 0 to 2.0",
            )
            for value in (-0.1, 2.1, np.nan, np.inf)
        ),
        *(
            (
                lambda given={**FIT, name: value}: reference.PressFit(**given),
                f"{name} is {value}; give a Poisson's ratio",
            )
            for name, value in (("nu_inner", -1.0), ("nu_outer", 0.6), ("nu_inner", np.nan))
        ),
        # The radii have to increase
        *(
            (
                lambda bore=bore, rim=rim: reference.PressFit(**{**FIT, "bore": bore, "rim": rim}),
                f"bore, radius and rim are {bore}, 1.5 and {rim}",
            )
            for bore, rim in ((1.5, 2.0), (1.6, 2.0), (1.0, 1.5), (1.0, 1.4))
        ),
        (lambda: meshes.rings(float("nan")), "n is nan; give a whole number of cells"),
        (blocks(cell_type=CellType.prism), "cell_type is prism; give one of triangle"),
        (blocks(n_upper=(1, 1, 1)), r"n_upper is \(1, 1, 1\); give 2 finite numbers"),
        (blocks(n_upper=(1, -1)), r"n_upper\[1\] is -1; give a whole number"),
        (blocks(gap=np.nan), "gap is nan; give a finite number"),
        (blocks(size_lower=(0, 1)), r"size_lower\[0\] is 0; give a positive number"),
        (lambda: meshes.single(blocks()(), 7), "body is 7, which the model does not have"),
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
        (lambda: meshes.dam_face(3), "give a DamFace"),
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
PICTURES = {
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


@pytest.mark.parametrize("suffix", ["xyz", "png/x"])
def test_pictures_that_cannot_be_written(tmp_path, suffix):
    path = tmp_path / f"picture.{suffix}"
    with pytest.raises((ValueError, OSError), match=r"xyz|picture\.png"):
        plot.curves(LINE, {}, path, labels=LABELS, title="")


@table(ROWS, PICTURES)
def test_refused(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused(row)
    assert list(tmp_path.iterdir()) == []
