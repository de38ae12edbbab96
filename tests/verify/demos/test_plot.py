# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the pictures."""

import sys
from pathlib import Path

from mpi4py import MPI

import numpy as np
import pytest
from matplotlib import image

from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag, blocks, hertz_cap, hertz_sphere
from plot import STATUS_NAMES, curves, deformed_bodies, nodal_map, pressure_curve
from plot.style import COLOURS, INK
from plot.surface import deformed_surface, mirrored, peak_body


def pressed(data, degree=1):
    """Invent a displacement downwards and a pressure near the origin on the upper body."""
    mesh, tags = data.mesh, data.facet_tags
    assert tags is not None
    dim = mesh.geometry.dim
    u = fem.Function(fem.functionspace(mesh, ("P", degree, (dim,))))
    u.interpolate(lambda x: -0.02 * np.eye(dim)[-1][:, None] * np.cos(x[0]))
    pressure = fem.Function(fem.functionspace(mesh, ("P", 1)), name="contact pressure")
    mesh.topology.create_connectivity(dim - 1, dim)
    space = pressure.function_space
    nodes = fem.locate_dofs_topological(space, dim - 1, tags.find(Tag.UPPER_CONTACT))
    radius = np.linalg.norm(space.tabulate_dof_coordinates()[nodes], axis=1)
    pressure.x.array[nodes] = np.maximum(1 - (radius / 0.3) ** 2, 0)
    pressure.x.scatter_forward()
    return u, pressure


def shared(tmp_path, name):
    """Agree on one file for all ranks."""
    return Path(MPI.COMM_WORLD.bcast(tmp_path, root=0)) / name


def colours(path):
    """Read the colours of an image file, one for each pixel, on all ranks."""
    MPI.COMM_WORLD.barrier()
    pixels = image.imread(path)[..., :3]
    return np.asarray((pixels.reshape(-1, 3) * 255).round().astype(np.int64))


@pytest.mark.parametrize(
    ("make", "arguments", "mirror"),
    [
        (hertz_cap, (4,), ("x", "y")),
        (blocks, (CellType.quadrilateral, (4, 4), (3, 3)), ()),
    ],
)
def test_picture_of_bodies(tmp_path, make, arguments, mirror):
    """The file is there, is large enough, and shows white paper, bodies and pressure."""
    u, pressure = pressed(make(*arguments))
    path = shared(tmp_path, "bodies.png")
    deformed_bodies(u, pressure, path, title="Two bodies", mirror=mirror, scale=2.0)
    pixels = colours(path)
    assert path.stat().st_size > 20_000
    assert pixels.shape[0] > 500_000
    assert len(np.unique(pixels, axis=0)) > 200
    white = np.all(pixels == 255, axis=1).mean()
    assert 0.1 < white < 0.9
    red = (pixels[:, 0] > 150) & (pixels[:, 1] < 100)
    assert red.mean() > 0.002


def test_colours_are_those_of_the_bar(tmp_path):
    """A uniform value fills the close-up with exactly one colour of the map."""
    u, pressure = pressed(blocks(CellType.triangle, (1, 1), (1, 1)))
    pressure.x.array[:] = 1.0
    path = shared(tmp_path, "uniform.png")
    deformed_bodies(u, pressure, path, title="", clim=(0.0, 2.0))
    middle = [int(COLOURS[2][i : i + 2], 16) for i in (1, 3, 5)]
    close = np.abs(colours(path) - middle).max(axis=1) <= 3
    assert close.mean() > 0.3


def test_picture_without_load(tmp_path):
    """A scalar that is zero everywhere has an overview and no close-up."""
    u, pressure = pressed(hertz_cap(2))
    pressure.x.array[:] = 0
    path = shared(tmp_path, "unloaded.png")
    deformed_bodies(u, pressure, path, title="Unloaded")
    assert len(np.unique(colours(path), axis=0)) > 50


def test_surface_is_deformed_and_joined():
    """On any number of ranks the surface is that of the bodies, and a P2 displacement fits."""
    u, pressure = pressed(blocks(CellType.hexahedron, (2, 2, 2), (3, 3, 3)), degree=2)
    surface = deformed_surface(u, pressure, 10.0)
    if MPI.COMM_WORLD.rank != 0:
        assert surface is None
        return
    assert surface.n_cells == 6 * 4 + 6 * 9
    reference = surface.point_data["reference"]
    assert np.allclose(surface.points[:, 2], reference[:, 2] - 0.2 * np.cos(reference[:, 0]))


def test_mirror_and_peak_body():
    """Mirror images double the outer faces; the peak is below the upper body."""
    u, pressure = pressed(blocks(CellType.hexahedron, (2, 2, 2), (3, 3, 3)))
    surface = deformed_surface(u, pressure, 0.0)
    if surface is None:
        return
    both = mirrored(surface, ("x",))
    assert both.n_cells == 2 * 5 * (4 + 9)
    assert both.bounds.x_min == pytest.approx(-1)
    body, normal = peak_body(surface)
    assert body.n_cells == 6 * 4
    assert body.bounds.z_min == pytest.approx(0)
    # Only the node in the origin is loaded here, which lies on three faces.
    assert normal == pytest.approx(-1 / 3)


def test_normal_of_a_loaded_face():
    """The normal points out of the loaded face and not out of its neighbours."""
    u, pressure = pressed(hertz_sphere(0.05, MPI.COMM_SELF))
    body, normal = peak_body(deformed_surface(u, pressure, 0.0))
    assert body.bounds.z_min == pytest.approx(0)
    assert normal[2] < -0.95


def test_pressure_curve(tmp_path):
    """The file shows points and a line."""
    r = np.linspace(0, 1, 20)
    path = tmp_path / "curve.png"
    pressure_curve(r, 1 - r**2, r, 1 - r**2, path, labels=("r", "p"), title="A curve")
    pixels = colours(path)
    assert path.stat().st_size > 5_000
    for colour in ("#22262b", COLOURS[3]):
        rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
        assert np.all(pixels == rgb, axis=1).sum() > 50


def test_box_and_stretch(tmp_path):
    """A close-up of a box is a second picture; a stretched body fills more of the first."""
    u, pressure = pressed(blocks(CellType.hexahedron, (4, 1, 4), (3, 1, 3)))
    sizes = []
    for name, options in {
        "plain": {"box": None},
        "box": {"box": ((0.3, -1.0, -0.2), (0.7, 1.0, 0.2))},
        "wide": {"box": ((0.3, -1.0, -0.2), (0.7, 1.0, 0.2)), "stretch": (3.0, 1.0, 1.0)},
    }.items():
        path = tmp_path / f"{name}.png"
        pressure.x.array[:] *= 0 if name == "plain" else 1
        deformed_bodies(u, pressure, path, title="", camera=(0, -1, 0), **options)
        sizes.append(image.imread(path).shape[1])
    assert sizes[0] < sizes[1] < sizes[2]
    with pytest.raises(ValueError, match="holds no node of the surface; make it larger"):
        box = ((5.0, 5.0, 5.0), (6.0, 6.0, 6.0))
        deformed_bodies(u, pressure, tmp_path / "x.png", title="", box=box)


def test_marks_and_close_up(tmp_path):
    """A mark adds dark points, a close-up a second pair of axes."""
    x = np.linspace(-1, 1, 50)
    dark, widths = [], []
    for marks, close_up in ((None, None), ({"here": (0.5, 0.5)}, None), (None, (-0.1, 0.1))):
        path = tmp_path / "curve.png"
        arguments = {"marks": marks, "close_up": close_up}
        curves({"p": (x, x**2)}, {}, path, labels=("x", "y"), title="", **arguments)
        ink = [int(INK[i : i + 2], 16) for i in (1, 3, 5)]
        dark.append(int(np.all(colours(path) == ink, axis=1).sum()))
        widths.append(image.imread(path).shape[1])
    assert dark[1] > dark[0] + 100
    assert widths[2] == 2 * widths[0]


def test_map(tmp_path):
    """Values are interpolated between nodes; kinds have a colour and a count each."""
    places = np.stack(np.meshgrid(np.linspace(0, 4, 20), [0, 1]), axis=-1).reshape(-1, 2)
    left = np.arange(19)
    triangles = np.concatenate([[left, left + 1, left + 20], [left + 1, left + 21, left + 20]], 1).T
    labels = ("x", "y")
    options = {"labels": labels, "title": ""}
    path = tmp_path / "values.png"
    nodal_map(places, places[:, 0], path, label="p", triangles=triangles, **options)
    assert len(np.unique(colours(path), axis=0)) > 200
    # Of a signed quantity what is below zero is blue
    nodal_map(places, places[:, 0] - 2, path, label="p", triangles=triangles, **options)
    pixels = colours(path).astype(int)
    blue, red = (((pixels[:, k] - pixels[:, 2 - k]) > 60).sum() for k in (2, 0))
    assert 0.5 < blue / red < 2
    status = (places[:, 0] > 2).astype(int)
    nodal_map(places, status, tmp_path / "kinds.png", kinds=STATUS_NAMES, **options)
    pixels = colours(tmp_path / "kinds.png")
    for kind in ("c7ccd3", "2b6cb0"):
        rgb = [int(kind[i : i + 2], 16) for i in (0, 2, 4)]
        assert np.all(pixels == rgb, axis=1).sum() > 100
    with pytest.raises(ValueError, match="give triangles to interpolate values on"):
        nodal_map(places, status, tmp_path / "x.png", **options)


def test_curves(tmp_path):
    """Each curve has its colour; lines between the points add to it."""
    x = np.linspace(-1, 1, 8)
    computed = {"p": (x, 1 - x**2), "q": (x, x)}
    counts = []
    for joined in (False, True):
        path = tmp_path / f"{joined}.png"
        curves(computed, {"zero": (x, 0 * x)}, path, labels=("x", "y"), title="", joined=joined)
        pixels = colours(path)
        rgb = [[int(c[i : i + 2], 16) for i in (1, 3, 5)] for c in (COLOURS[3], COLOURS[2])]
        counts.append([int(np.all(pixels == c, axis=1).sum()) for c in rgb])
    assert np.all(np.array(counts[0]) > 50)
    assert np.all(np.array(counts[1]) > 1.5 * np.array(counts[0]))


@pytest.mark.parametrize("package", ["pyvista", "matplotlib"])
def test_missing_package(package, tmp_path, monkeypatch):
    """The message names the package and the extra."""
    u, pressure = pressed(blocks(CellType.triangle, (1, 1), (1, 1)))
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setitem(sys.modules, package, None)
    message = rf"needs {package}; install it with: pip install contactx\[demo\]"
    with pytest.raises(ImportError, match=message):
        deformed_bodies(u, pressure, tmp_path / "x.png", title="")
