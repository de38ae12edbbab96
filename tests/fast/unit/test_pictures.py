# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures and films show the deformed bodies, and pressures where contact is."""

import sys

import numpy as np
import pytest
from PIL import Image

import contactx as cx
import ufl
from contactx._host.drawing import View, draw, gather
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks

CELLS = (CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron)


def solved(cell, gap=0.0, **options):
    """Blocks, the upper one of which is pressed on the lower one, or on a sphere."""
    degree, name = options.pop("degree", 1), options.pop("name", None)
    scene = Blocks(cell, degree=degree, n_upper=4, n_lower=4, gap=gap)
    contact = scene.contact(name=name, **options)
    problem = scene.problem(contact)
    problem.solve()
    return scene, contact, problem


def marks_of(plotter):
    """Meshes with pressures that a plotter has."""
    return [mesh for mesh in plotter.meshes if "pressure" in mesh.point_data]


@pytest.mark.parametrize("cell", CELLS)
@pytest.mark.parametrize("degree", [1, 2])
def test_bodies_are_the_deformed_ones(cell, degree):
    """Of linear displacements their area, or volume, is exact; and facets point outward."""
    scene, contact, _ = solved(cell, degree=degree)
    shown = gather([contact], 1.0)
    bodies = draw(shown, View([shown]), shown.limits).meshes[0]
    domain = scene.u.function_space.mesh
    F = ufl.Identity(len(scene.u)) + ufl.grad(scene.u)
    exact = fem.assemble_scalar(fem.form(ufl.det(F) * ufl.dx(domain)))
    flat = domain.topology.dim == 2
    # Faces of deformed hexahedra are no planes
    rel = 1e-6 if degree == 1 and cell != CellType.hexahedron else 2e-3
    assert (bodies.area if flat else bodies.volume) == pytest.approx(exact, rel=rel)
    twice = gather([contact], 2.0)
    moved = scene.u.x.array.reshape(-1, len(scene.u))
    assert np.allclose((twice.x - shown.x)[:, : len(scene.u)], moved[: len(shown.x)], atol=1e-12)


@pytest.mark.parametrize("cell", CELLS)
def test_pressures_are_where_contact_is(cell):
    """Those of the slave's facets; in 2D as strips outside of it, as high as they are."""
    gdim = 2 if cell in CELLS[:2] else 3
    ball = cx.Sphere([0.6] * (gdim - 1) + [-2.0], 2.01)
    _, contact, _ = solved(cell, master=ball)
    shown = gather([contact], 1.0)
    view = View([shown])
    plotter = draw(shown, view, shown.limits)
    (marks,) = marks_of(plotter)
    closed = contact.slave_nodes[contact.pressure.x.array[contact.slave_nodes] > 0]
    assert 0 < len(closed) < len(contact.slave_nodes)
    foot = marks.points - 0.01 * view.size.max() * view.towards
    pressure = marks.point_data["pressure"]
    for node in closed:
        p = contact.pressure.x.array[node]
        at = np.linalg.norm(foot - shown.x[node], axis=1)
        near = at.argmin()
        assert at[near] < 1e-6 and pressure[near] == pytest.approx(p, rel=1e-6)
        if gdim == 2:
            # The top of the strip
            tops = foot[np.isclose(pressure, p, rtol=1e-6)] - shown.x[node]
            heights = np.linalg.norm(tops, axis=1)
            assert np.isclose(heights, view.strip * p / shown.limits[1], rtol=1e-4).any()
            assert tops[:, 1].min() < 0
    # Nothing else has colours
    corners = shown.slaves[(shown.pressure[shown.slaves] != 0).any(axis=1)]
    assert marks.n_cells == len(corners)
    assert (pressure > 0).sum() == len(closed) * (2 if gdim == 2 else 1)


def test_colours_of_the_file_are_at_the_contact(tmp_path):
    _, contact, _ = solved(CellType.triangle, name="seat")
    path = tmp_path / "new" / "seat.png"
    contact.plot(path)
    image = np.asarray(Image.open(path).convert("RGB")).astype(int)
    red = (image[..., 0] - image[..., 2]) > 40
    rows, columns = np.nonzero(red)
    shown = gather([contact], 1.0)
    view = View([shown])
    assert image.shape[:2] == (view.window[1], view.window[0])
    picture = rows < view.window[1] - 130
    # Pixels to positions
    x = view.focus[0] + (columns[picture] + 0.5 - view.window[0] / 2) * view.pixel
    y = view.focus[1] - (rows[picture] + 0.5 - view.window[1] / 2) * view.pixel
    nodes = shown.x[contact.slave_nodes]
    near = 2 * view.pixel
    assert x.min() == pytest.approx(nodes[:, 0].min(), abs=near)
    assert x.max() == pytest.approx(nodes[:, 0].max(), abs=near)
    assert y.max() == pytest.approx(nodes[:, 1].max(), abs=near)
    # And the bar below
    assert 0.4 < np.ptp(columns[~picture]) / view.window[0] < 0.6


def test_without_contact_the_picture_says_so(tmp_path):
    scene = Blocks(CellType.triangle, gap=0.2)
    contact = scene.contact()
    problem = scene.problem(contact)
    problem.solve()
    shown = gather([contact], 1.0)
    plotter = draw(shown, View([shown]), shown.limits)
    assert marks_of(plotter) == []
    problem.plot(tmp_path / "open.jpg", scale=3)
    assert (tmp_path / "open.jpg").stat().st_size > 5000


def test_ties_under_tension_have_colours_of_both_signs():
    scene = Blocks(CellType.triangle, down=-0.05)
    contact = scene.contact(tied=True)
    scene.problem(contact).solve()
    shown = gather([contact], 1.0)
    assert shown.limits[0] < 0
    plotter = draw(shown, View([shown]), shown.limits)
    low, high = plotter.scalar_bars[""].GetLookupTable().GetTableRange()
    assert low == -high == min(shown.limits[0], -shown.limits[1])


@pytest.mark.parametrize("cell", [CellType.triangle, CellType.tetrahedron])
def test_films(tmp_path, cell):
    """A picture for each time, all of one size; also where an error ends the steps."""
    scene = Blocks(cell, down=0.0)
    contact = scene.contact()
    problem = scene.problem(contact)

    def update(t):
        scene.bcs[-1].g.value[...] = -0.05 * t

    with pytest.raises(ArithmeticError), cx.animate(tmp_path / "run.gif", problem, fps=5) as film:
        for step in cx.LoadSteps(problem, 3, update=update, progress=False):
            film.write(step.t)
        raise ArithmeticError
    with pytest.raises(RuntimeError, match=r"run\.gif is closed"):
        film.write(2.0)
    image = Image.open(tmp_path / "run.gif")
    assert image.n_frames == 3 and image.info["duration"] == 200
    frames = []
    for k in range(3):
        image.seek(k)
        frame = np.asarray(image.convert("RGB")).astype(int)
        frames.append(np.count_nonzero(frame[:-130, :, 0] - frame[:-130, :, 2] > 40))
    # The pressure, and with it the strips, grow; facets do not
    assert frames[0] < frames[1] < frames[2] or cell == CellType.tetrahedron


def test_pictures_that_are_refused(tmp_path, monkeypatch):
    scene = Blocks(CellType.triangle)
    contact = scene.contact()
    with pytest.raises(RuntimeError, match="has no results yet"):
        contact.plot(tmp_path / "x.png")
    problem = scene.problem(contact)
    with pytest.raises(ValueError, match=r"path ends in '.bmp': give one of .png, .jpg"):
        contact.plot(tmp_path / "x.bmp")
    with pytest.raises(ValueError, match=r"path ends in '.png': give one of .gif, .mp4"):
        cx.animate(tmp_path / "x.png", problem)
    with pytest.raises(TypeError, match="scale is str"):
        contact.plot(tmp_path / "x.png", scale="2")
    with pytest.raises(ValueError, match=r"camera is \(0, 0, 0\)"):
        contact.plot(tmp_path / "x.png", camera=(0, 0, 0))
    with pytest.raises(ValueError, match="fps is int 0"):
        cx.animate(tmp_path / "x.gif", problem, fps=0)
    with pytest.raises(TypeError, match=r"problem is .* give a contactx"):
        cx.animate(tmp_path / "x.gif", contact)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ImportError, match=r"path ends in \.mp4, which needs imageio"):
        cx.animate(tmp_path / "x.mp4", problem)
    monkeypatch.setitem(sys.modules, "pyvista", None)
    for draws in (lambda: contact.plot(tmp_path / "x.png"), contact.plot):
        with pytest.raises(ImportError, match="pictures need pyvista"):
            draws()
    assert not any(tmp_path.iterdir())
