# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos of large rolling and sliding run by both methods, agree and leave their pictures."""

import belt_drum
import bolt
import gear_pair
import numpy as np
import o_ring
import pyvista
import snap_fit
from matplotlib import image


def check(demo, arguments, tolerances, pictures, folder, capsys):
    results = demo.main([*arguments, "--output", str(folder)])
    runs = len(results) // len(tolerances)
    for result, tolerance in zip(results, [*tolerances] * runs, strict=True):
        assert abs(result.error) <= tolerance, result
    printed = capsys.readouterr().out
    for text in ("expected", "computed", "error", "see "):
        assert text in printed
    # Neither more than 1 % of an edge is hidden nor anything found
    for text in ("hiding at most 0.", "audit: 0 faults"):
        assert printed.count(text) == runs
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
    check(belt_drum, ("--h", "0.02"), (0.05, 0.04), pictures, tmp_path, capsys)


def test_o_ring(tmp_path, capsys):
    # Force of a small and of a large squeeze, width, force of the fluid, balance, peak
    tolerances = (0.02, 0.01, 0.08, 0.02, 1e-9, 0.05)
    pictures = ("o_ring.png", "o_ring_peak.png")
    check(o_ring, ("--h", "0.1"), tolerances, pictures, tmp_path, capsys)


def test_o_rings_converge_and_seal():
    rings = [o_ring.ORing(h, o_ring.story.METHODS[1]) for h in (0.16, 0.08)]
    for ring in rings:
        ring.run()
        assert np.all(ring.peaks > ring.fluids)
    coarse, fine = ([result.error for result in ring.compare()] for ring in rings)
    # Force of the large squeeze against Lindley, of the fluid on the height of the groove
    for k in (1, 3):
        assert abs(fine[k]) < 0.6 * abs(coarse[k])


def test_bolt(tmp_path, capsys):
    # Pre-tension by VDI 2230, share, opening, open, after, friction
    tolerances = (0.18, 0.12, 0.05, 1e-6, 0.02, 0.02)
    pictures = ("bolt.png", "bolt_forces.png")
    check(bolt, ("--h", "1.2"), tolerances, pictures, tmp_path, capsys)
