# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The demo of the face slabs runs, prints what it should and leaves its pictures."""

import face_slab
import numpy as np
import pytest
import pyvista
from matplotlib import image

PICTURES = ("mesh", "deformed", "joint", "pressure", "stress", "opening", "status")


@pytest.fixture(autouse=True)
def small_pictures(monkeypatch):
    """Drawing would take most of the time."""
    monkeypatch.setattr("plot.view._PIXELS", 350)


def check(folder, stem, pictures):
    for name in pictures:
        pixels = image.imread(folder / f"{stem}_{name}.png")
        assert pixels.shape[0] > 300
        # One number a colour: rows of an array are slow to compare
        assert len(np.unique((255 * pixels[..., :3]).astype(np.int64) @ [65536, 256, 1])) > 50
    saved = pyvista.get_reader(str(folder / f"{stem}.pvd")).read()[0].point_data
    assert "stress along the dam" in saved
    assert any(name.startswith("pressure") for name in saved)


def test_scheme_1(tmp_path, capsys):
    arguments = ("--preset", "slice", "--steps", "2", "--output", str(tmp_path))
    rotation, stress = face_slab.main(arguments)
    assert abs(rotation.error) < 5e-3
    assert abs(stress.error) < 0.05
    printed = capsys.readouterr().out
    for text in ("try: settlement", "(wanted: 0.17)", "balance of each slab", "18.0", "see "):
        assert text in printed
    check(tmp_path, "face_slab_1", PICTURES)


def test_scheme_2(tmp_path, capsys):
    arguments = ("--scheme", "2", "--layers", "3", "5", "--steps", "4", "--output", str(tmp_path))
    results = face_slab.main(arguments)
    assert len(results) == 4
    printed = capsys.readouterr().out
    for text in ("3 layers: peak, MPa", "5 layers: push at the peak", "it moves", "see "):
        assert text in printed
    check(tmp_path, "face_slab_2", (*PICTURES, "push"))


def test_one_slab_has_no_joint(tmp_path, capsys):
    arguments = ("--preset", "slice", "--layers", "2", "--slabs", "1", "--steps", "1")
    face_slab.main([*arguments, "--output", str(tmp_path)])
    printed = capsys.readouterr().out
    assert "one slab has no joint" in printed and "nan" in printed
    check(tmp_path, "face_slab_1", ("mesh", "deformed", "status"))


def test_help_has_units(capsys):
    with pytest.raises(SystemExit):
        face_slab.main(["--help"])
    printed = capsys.readouterr().out
    for unit in ("degrees", "MPa", "mm", "a ratio"):
        assert unit in printed
