# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos with friction run, print what they should and leave their pictures."""

import cattaneo_mindlin
import ironing
import numpy as np
import pytest
import pyvista
import sliding_block
import stacked_blocks
from matplotlib import image

# Normal and tangential force, half-width, peak, half-width that sticks, L2 of pressure and shear
FINITE = (2e-4, 1e-4, 0.025, 0.01, 0.02, 0.02, 0.09)
# Normals of the undeformed circles are turned by much beside mu
SMALL = (4e-4, 1e-4, 0.025, 0.01, 0.05, 0.03, 0.42)


def check(demo, arguments, tolerances, pictures, folder, capsys):
    results = demo.main([*arguments, "--output", str(folder)])
    for result, tolerance in zip(results, tolerances, strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "converged after", "see "):
        assert text in printed
    for picture in pictures:
        pixels = image.imread(folder / picture)
        assert pixels.shape[0] > 300
        assert len(np.unique(pixels.reshape(-1, pixels.shape[-1]), axis=0)) > 100
    saved = pyvista.get_reader(str(folder / f"{demo.__name__}.pvd")).read()[0].point_data
    assert any(name.startswith("pressure") for name in saved)


@pytest.mark.parametrize(("sliding", "tolerances"), [("finite", FINITE), ("small", SMALL)])
def test_cattaneo_mindlin(sliding, tolerances, tmp_path, capsys):
    pictures = ("cattaneo_mindlin.png", "cattaneo_mindlin_pressure.png")
    arguments = ("--h", "0.04", "--sliding", sliding)
    check(cattaneo_mindlin, arguments, tolerances, pictures, tmp_path, capsys)


# Force held before it slides, when the last node slips, in 3D askew, and while it slides
@pytest.mark.parametrize(
    ("dim", "h", "held", "last", "slides", "sliding", "ploughing"),
    [
        ("2", "0.2", 0.07, 1e-7, 1e-7, "finite", 0.01),
        ("2", "0.2", 0.07, 1e-7, 1e-7, "small", 0),
        ("3", "0.5", 0.35, 0.05, 1e-7, "finite", 0.01),
    ],
)
def test_sliding_block(sliding, ploughing, dim, h, held, last, slides, tmp_path, capsys):
    plane = (1e-7, held, last, slides, slides)
    base = (1e-7, held, last + ploughing, slides + ploughing, slides + ploughing)
    pictures = ("sliding_block.png", "sliding_block_loop.png")
    arguments = ("--h", h, "--dim", dim, "--sliding", sliding)
    check(sliding_block, arguments, (*plane, *base), pictures, tmp_path, capsys)


@pytest.mark.parametrize(("dim", "h", "sliding"), [("2", "0.1", "finite"), ("3", "0.25", "small")])
def test_stacked_blocks(sliding, dim, h, tmp_path, capsys):
    arguments = ("--h", h, "--dim", dim, "--sliding", sliding)
    check(stacked_blocks, arguments, [1e-7] * 10, ("stacked_blocks.png",), tmp_path, capsys)


def test_ironing(tmp_path, capsys):
    results = ironing.main(["--h", "0.15", "--output", str(tmp_path)])
    assert len(results) == 2 * (4 + 1) + 2
    assert all(abs(result.error) < 0.05 for result in results)
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "iterations", "see "):
        assert text in printed
    for picture in ("ironing.png", "ironing_force.png"):
        assert image.imread(tmp_path / picture).shape[0] > 300
    saved = pyvista.get_reader(str(tmp_path / "ironing.pvd")).read()[0].point_data
    assert any(name.startswith("pressure") for name in saved)
