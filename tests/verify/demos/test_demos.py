# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos run, print what they should and leave their pictures."""

import bouncing_block
import finite_strain
import heat_conductance
import hertz_axisymmetric
import hertz_cylinder
import hertz_sphere
import impact_bars
import incompressible
import level_set
import numpy as np
import patch_test
import press_fit
import pytest
import pyvista
import rigid_cylinder
import rigid_plane
import rigid_sphere
import rolling_ring
from matplotlib import image


@pytest.mark.parametrize(
    ("demo", "sliding", "h", "tolerances"),
    [
        (hertz_sphere, "finite", "0.04", (1e-10, 0.05, 0.03, 0.2)),
        (hertz_cylinder, "small", "0.01", (2e-3, 0.05, 0.03)),
        (hertz_axisymmetric, "finite", "0.003", (1e-3, 0.03, 0.01, 0.02)),
        (press_fit, "finite", "0.05", (0.01, 0.01, 0.01)),
        (rigid_plane, "small", "0.04", (0.01, 0.05, 0.1)),
        (rigid_sphere, "finite", "0.04", (0.01, 0.05, 0.1)),
        (rigid_cylinder, "small", "0.02", (0.01, 0.07, 0.03)),
        (level_set, "finite", "0.04", (0.01, 0.05, 0.1)),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_demo(demo, sliding, h, tolerances, tmp_path, capsys):
    results = demo.main(["--h", h, "--sliding", sliding, "--output", str(tmp_path)])
    for result, tolerance in zip(results, tolerances, strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "converged after", "see "):
        assert text in printed
    name = demo.__name__
    for picture in (f"{name}.png", f"{name}_pressure.png"):
        pixels = image.imread(tmp_path / picture)
        assert pixels.shape[0] > 300
        assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 100
    assert "pressure" in pyvista.get_reader(str(tmp_path / f"{name}.pvd")).read()[0].point_data


def test_incompressible(tmp_path, capsys):
    results = incompressible.main(["--output", str(tmp_path)])
    linear, *others = (abs(result.error) for result in results)
    assert linear > 2 and max(others) < 0.01
    assert "MINI" in capsys.readouterr().out
    assert image.imread(tmp_path / "incompressible.png").shape[0] > 300


def test_heat(tmp_path, capsys):
    results = heat_conductance.main(["--h", "0.02", "--output", str(tmp_path)])
    assert [abs(result.error) <= 1e-7 for result in results] == [True] * 3
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "together", "in turns", "see "):
        assert text in printed
    assert image.imread(tmp_path / "heat_conductance.png").shape[0] > 300


def test_finite_strain(tmp_path, capsys):
    results = finite_strain.main(["--h", "0.34", "--output", str(tmp_path)])
    assert len(results) == 4
    assert all(abs(result.error) <= 0.01 for result in results)
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "det F", "see "):
        assert text in printed
    for name in ("ball", "block"):
        assert image.imread(tmp_path / f"finite_strain_{name}.png").shape[0] > 300
        path = str(tmp_path / f"finite_strain_{name}.pvd")
        assert "pressure" in pyvista.get_reader(path).read()[0].point_data


@pytest.mark.parametrize(("dim", "sliding"), [("2", "small"), ("3", "finite")])
def test_patch_test(dim, sliding, tmp_path, capsys):
    arguments = ("--dim", dim, "--sliding", sliding, "--output", str(tmp_path))
    results = patch_test.main(arguments)
    node_to_surface, surface_to_surface = results[:4], results[4:]
    assert all(result.error > 0.05 for result in node_to_surface)
    assert len(surface_to_surface) == 4
    assert all(result.error <= 1e-9 for result in surface_to_surface)
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "converged after", "see "):
        assert text in printed
    for name in ("node-to-surface", "surface-to-surface", "pressure"):
        assert image.imread(tmp_path / f"patch_test_{name}.png").shape[0] > 300
    for method in patch_test.METHODS:
        path = str(tmp_path / f"patch_test_{method}.pvd")
        assert "pressure" in pyvista.get_reader(path).read()[0].point_data


@pytest.mark.parametrize(
    ("demo", "options", "tolerances", "pictures"),
    [
        (impact_bars, ["--h", "0.01", "--courant", "1"], 2 * (1e-3, 0.02, 0.025, 0.01), ("",)),
        (bouncing_block, ["--h", "0.25"], 2 * (0.01, 1e-3, 1e-3, 1e-6), ("", "_velocity")),
        (
            bouncing_block,
            ["--h", "0.5", "--method", "surface-to-surface"],
            2 * (0.01, 1e-3, 1e-3, 1e-6),
            ("", "_velocity"),
        ),
        (rolling_ring, ["--h", "0.14"], (0.01, 0.03, 1e-6), ("", "_velocity")),
    ],
)
def test_dynamics(demo, options, tolerances, pictures, tmp_path, capsys):
    results = demo.main([*options, "--output", str(tmp_path)])
    for result, tolerance in zip(results, tolerances, strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "energy", "see "):
        assert text in printed
    for picture in pictures:
        pixels = image.imread(tmp_path / f"{demo.__name__}{picture}.png")
        assert pixels.shape[0] > 300
        assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 50
