# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos of large rolling and sliding run by both methods, agree and leave their pictures."""

import belt_drum
import gear_pair
import pyvista
import snap_fit
from matplotlib import image


def check(demo, arguments, tolerances, pictures, folder, capsys):
    results = demo.main([*arguments, "--output", str(folder)])
    assert len(results) == 2 * len(tolerances)
    for result, tolerance in zip(results, [*tolerances, *tolerances], strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "audit: 0 faults", "see "):
        assert text in printed
    assert printed.count("hiding at most 0.") == 2
    for picture in pictures:
        assert image.imread(folder / picture).shape[0] > 300
    saved = pyvista.get_reader(str(folder / f"{demo.__name__}.pvd")).read()[0].point_data
    assert any(name.startswith("pressure") for name in saved)


def test_snap_fit(tmp_path, capsys):
    # Ratio of the forces, largest force, history, force at the end; in and out
    tolerances = (0.25, 0.1, 0.2, 1e-9) * 2
    pictures = ("snap_fit.png", "snap_fit_force.png")
    check(snap_fit, ("--h", "0.12"), tolerances, pictures, tmp_path, capsys)


def test_gear_pair(tmp_path, capsys):
    # Torques, their swing, angles, contact ratio
    tolerances = (0.01, 0.03, 1e-3, 0.08)
    pictures = ("gear_pair.png", "gear_pair_error.png")
    check(gear_pair, ("--h", "0.3"), tolerances, pictures, tmp_path, capsys)


def test_belt_drum(tmp_path, capsys):
    # Ratio of the tensions of a thin belt, and of this one
    pictures = ("belt_drum.png", "belt_drum_ratio.png")
    check(belt_drum, ("--h", "0.015"), (0.05, 0.04), pictures, tmp_path, capsys)
