# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demos run, print what they should and leave their pictures and files."""

import re

import belt_drum
import bolt
import bouncing_block
import cattaneo_mindlin
import closing_clip
import face_slab
import finite_strain
import folding_strip
import gear_pair
import heat_conductance
import hertz_axisymmetric
import hertz_cylinder
import hertz_sphere
import impact_bars
import incompressible
import ironing
import level_set
import numpy as np
import o_ring
import patch_test
import press_fit
import pytest
import pyvista
import rigid_cylinder
import rigid_plane
import rigid_sphere
import rolling_ring
import settling_discs
import sliding_block
import snap_fit
import stacked_blocks
from matplotlib import image


@pytest.fixture
def run(tmp_path, capsys):
    """Run a demo with a folder of the test; what it has printed, and its results."""

    def run(demo, *arguments):
        results = demo.main([*arguments, "--output", str(tmp_path)])
        return results, capsys.readouterr().out

    return run


@pytest.fixture
def check(run, tmp_path):
    """Check a demo: errors, what is printed, pictures and what is saved."""

    def check(demo, arguments, tolerances, pictures, *, texts=("converged after",), saved=True):
        results, printed = run(demo, *arguments)
        runs = len(results) // len(tolerances)
        for result, tolerance in zip(results, [*tolerances] * runs, strict=True):
            assert abs(result.error) <= tolerance, result
        shows(printed, "expected", "computed", "error", "see ", *texts)
        for picture in pictures:
            is_drawn(tmp_path / f"{demo.__name__}{picture}.png")
        if saved:
            has_pressure(tmp_path / f"{demo.__name__}.pvd")
        return printed, runs

    return check


def shows(printed, *texts):
    assert [text for text in texts if text not in printed] == []


def is_drawn(path):
    """A picture is large enough and has many colours."""
    pixels = image.imread(path)
    assert pixels.shape[0] > 300
    # One number a colour: rows of an array are slow to compare
    assert len(np.unique((255 * pixels[..., :3]).astype(np.int64) @ [65536, 256, 1])) > 50


def has_pressure(path):
    saved = pyvista.get_reader(str(path)).read()[0].point_data
    assert any(name.startswith("pressure") for name in saved)
    return saved


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
        # Normal and tangential force, half-width, peak, half-width that sticks, L2 of pressure and
        # shear; in small sliding normals of the undeformed circles are turned by much beside mu
        (cattaneo_mindlin, "finite", "0.04", (2e-4, 1e-4, 0.025, 0.01, 0.02, 0.02, 0.09)),
        (cattaneo_mindlin, "small", "0.04", (4e-4, 1e-4, 0.025, 0.01, 0.05, 0.03, 0.42)),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_demo(demo, sliding, h, tolerances, check):
    check(demo, ("--h", h, "--sliding", sliding), tolerances, ("", "_pressure"))


def test_incompressible(run, tmp_path):
    results, printed = run(incompressible)
    linear, *others = (abs(result.error) for result in results)
    assert linear > 2 and max(others) < 0.01
    shows(printed, "MINI")
    is_drawn(tmp_path / "incompressible.png")


def test_heat(check):
    texts = ("together", "in turns")
    check(heat_conductance, ("--h", "0.02"), [1e-7] * 3, ("",), texts=texts, saved=False)


def test_finite_strain(run, tmp_path):
    results, printed = run(finite_strain, "--h", "0.34")
    assert len(results) == 4
    assert all(abs(result.error) <= 0.01 for result in results)
    shows(printed, "expected", "computed", "error", "det F", "see ")
    for name in ("ball", "block"):
        is_drawn(tmp_path / f"finite_strain_{name}.png")
        has_pressure(tmp_path / f"finite_strain_{name}.pvd")


@pytest.mark.parametrize(("dim", "sliding"), [("2", "small"), ("3", "finite")])
def test_patch_test(dim, sliding, run, tmp_path):
    results, printed = run(patch_test, "--dim", dim, "--sliding", sliding)
    node_to_surface, surface_to_surface = results[:4], results[4:]
    assert all(result.error > 0.05 for result in node_to_surface)
    assert len(surface_to_surface) == 4
    assert all(result.error <= 1e-9 for result in surface_to_surface)
    shows(printed, "expected", "computed", "error", "converged after", "see ")
    for name in (*patch_test.METHODS, "pressure"):
        is_drawn(tmp_path / f"patch_test_{name}.png")
    for method in patch_test.METHODS:
        has_pressure(tmp_path / f"patch_test_{method}.pvd")


BOUNCES = 2 * (0.01, 1e-3, 1e-3, 1e-6)


@pytest.mark.parametrize(
    ("demo", "options", "tolerances", "pictures"),
    [
        (impact_bars, ["--h", "0.01", "--courant", "1"], 2 * (1e-3, 0.02, 0.025, 0.01), ("",)),
        (bouncing_block, ["--h", "0.25"], BOUNCES, ("", "_velocity")),
        (
            bouncing_block,
            ["--h", "0.5", "--method", "surface-to-surface"],
            BOUNCES,
            ("", "_velocity"),
        ),
        (rolling_ring, ["--h", "0.14"], (0.01, 0.03, 1e-6), ("", "_velocity")),
    ],
)
def test_dynamics(demo, options, tolerances, pictures, check):
    check(demo, options, tolerances, pictures, texts=("energy",), saved=False)


# Force held before it slides, when the last node slips, in 3D askew, and while it slides
@pytest.mark.parametrize(
    ("dim", "h", "held", "last", "slides", "sliding", "ploughing"),
    [
        ("2", "0.2", 0.07, 1e-7, 1e-7, "finite", 0.01),
        ("2", "0.2", 0.07, 1e-7, 1e-7, "small", 0),
        ("3", "0.5", 0.35, 0.05, 1e-7, "finite", 0.01),
    ],
)
def test_sliding_block(sliding, ploughing, dim, h, held, last, slides, check):
    plane = (1e-7, held, last, slides, slides)
    base = (1e-7, held, last + ploughing, slides + ploughing, slides + ploughing)
    arguments = ("--h", h, "--dim", dim, "--sliding", sliding)
    check(sliding_block, arguments, (*plane, *base), ("", "_loop"))


@pytest.mark.parametrize(("dim", "h", "sliding"), [("2", "0.1", "finite"), ("3", "0.25", "small")])
def test_stacked_blocks(sliding, dim, h, check):
    arguments = ("--h", h, "--dim", dim, "--sliding", sliding)
    check(stacked_blocks, arguments, [1e-7] * 10, ("",))


def test_ironing(check):
    check(
        ironing, ("--h", "0.15"), [0.05] * (2 * (4 + 1) + 2), ("", "_force"), texts=("iterations",)
    )


@pytest.mark.parametrize(
    ("demo", "h", "tolerances", "picture"),
    [
        # Ratio of the forces, largest force, history, force at the end; in and out
        (snap_fit, "0.12", (0.25, 0.1, 0.2, 1e-9) * 2, "_force"),
        # Torques, their swing, angles, contact ratio
        (gear_pair, "0.3", (0.01, 0.03, 1e-3, 0.08), "_error"),
        # Ratio of the tensions of a thin belt, and of this one
        (belt_drum, "0.02", (0.05, 0.04), "_ratio"),
        # Force of a small and of a large squeeze, width, force of the fluid, balance, peak
        (o_ring, "0.1", (0.02, 0.01, 0.08, 0.02, 1e-9, 0.05), "_peak"),
        # Pre-tension by VDI 2230, share, opening, open, after, friction
        (bolt, "1.2", (0.18, 0.12, 0.05, 1e-6, 0.02, 0.02), "_forces"),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_large_sliding_by_both_methods(demo, h, tolerances, picture, check):
    """Frozen pairs are off by at most 2 % of an edge, and nothing is found."""
    printed, runs = check(demo, ("--h", h), tolerances, ("", picture), texts=())
    hidden = [float(part) for part in re.findall(r"hiding at most ([\d.]+)%", printed)]
    assert len(hidden) == printed.count("audit: 0 faults") == runs
    assert max(hidden) < 2


def test_o_rings_converge_and_seal():
    rings = [o_ring.ORing(h, o_ring.story.METHODS[1]) for h in (0.16, 0.08)]
    for ring in rings:
        ring.run()
        assert np.all(ring.peaks > ring.fluids)
    coarse, fine = ([result.error for result in ring.compare()] for ring in rings)
    # Force of the large squeeze against Lindley, of the fluid on the height of the groove
    for k in (1, 3):
        assert abs(fine[k]) < 0.6 * abs(coarse[k])


@pytest.mark.parametrize(
    ("demo", "h", "tolerances"),
    [
        (closing_clip, "0.05", (0.02, 0.05, 0.05, 0.05)),
        (folding_strip, "0.06", (0.06, 0.015)),
        (settling_discs, "0.2", (1e-8,)),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_self_contact(demo, h, tolerances, check):
    check(demo, ("--h", h), tolerances, ("",), texts=(), saved=False)


def test_the_halves_of_a_fold_that_leans_touch():
    """Their distance is between them, not from the plane of symmetry."""
    fold = folding_strip.Fold(0.06, friction=folding_strip.FRICTION)
    fold.run()
    distance = fold.apart()
    fold.u.x.array.reshape(-1, 2)[:, 0] += 0.2 * folding_strip.THICKNESS
    assert abs(fold.apart() - distance) < 1e-12
    assert abs(distance / folding_strip.THICKNESS - 1) < 0.015


class TestFaceSlab:
    PICTURES = ("mesh", "deformed", "joint", "pressure", "stress", "opening", "status")

    @pytest.fixture(autouse=True)
    def small_pictures(self, monkeypatch):
        """Drawing would take most of the time."""
        monkeypatch.setattr("plot.view._PIXELS", 350)

    def check(self, folder, stem, pictures):
        for name in pictures:
            is_drawn(folder / f"{stem}_{name}.png")
        assert "stress along the dam" in has_pressure(folder / f"{stem}.pvd")

    def test_scheme_1(self, run, tmp_path):
        (rotation, stress), printed = run(face_slab, "--preset", "slice", "--steps", "2")
        assert abs(rotation.error) < 5e-3
        assert abs(stress.error) < 0.05
        shows(printed, "try: settlement", "(wanted: 0.17)", "balance of each slab", "18.0", "see ")
        self.check(tmp_path, "face_slab_1", self.PICTURES)

    def test_scheme_2(self, run, tmp_path):
        results, printed = run(face_slab, "--scheme", "2", "--layers", "3", "5", "--steps", "4")
        assert len(results) == 4
        shows(printed, "3 layers: peak, MPa", "5 layers: push at the peak", "it moves", "see ")
        self.check(tmp_path, "face_slab_2", (*self.PICTURES, "push"))

    def test_one_slab_has_no_joint(self, run, tmp_path):
        arguments = ("--preset", "slice", "--layers", "2", "--slabs", "1", "--steps", "1")
        _, printed = run(face_slab, *arguments)
        shows(printed, "one slab has no joint", "nan")
        self.check(tmp_path, "face_slab_1", ("mesh", "deformed", "status"))

    def test_help_has_units(self, capsys):
        with pytest.raises(SystemExit):
            face_slab.main(["--help"])
        shows(capsys.readouterr().out, "degrees", "MPa", "mm", "a ratio")
