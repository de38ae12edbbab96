# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checkpoints: the same answer to the last bit, and files that do not fit."""

import errno
import os

import numpy as np
import pytest

import contactx as cx
from contactx._host.checkpoint.shared_file import SharedFile
from dolfinx import fem
from dolfinx.mesh import CellType

from inputs import archive
from scenes import Blocks
from scenes.steps import QUICK, SCENES, Sheared, SlidingBlocks, check_restart, run


# The others are in tests/verify
@pytest.mark.parametrize("name", QUICK)
def test_three_steps_and_three_are_six(name, tmp_path):
    check_restart(name, tmp_path / "run.state")


@pytest.mark.parametrize(
    "name", ["triangles", "friction", "tied", "facets, small", "plastic with friction"]
)
def test_results_are_there_at_once(name, tmp_path):
    """They are computed anew from the state, which may round in another way."""
    file, scene, other = tmp_path / "run.state", SCENES[name](), SCENES[name]()
    _, steps = run(scene, until=3)
    steps.save(file)
    cx.LoadSteps(other.problem, 6, other.update, history=other.history, restart=file)
    assert np.abs(scene.contact.force).max() > 1e-3
    for field, values in vars(scene.contact.fields).items():
        if isinstance(values, fem.Function):
            array = getattr(other.contact.fields, field).x.array
            assert array == pytest.approx(values.x.array, rel=1e-11, abs=1e-13, nan_ok=True), field
    assert other.contact.force == pytest.approx(scene.contact.force, rel=1e-11, abs=1e-13)


def test_cut_steps_are_gone_on_from_as_they_were(tmp_path):
    straight, other, last = (Sheared(far=12.0) for _ in range(3))
    t = [step.t for step in straight.steps(1, easy=0)]
    assert len(t) == 15
    for step in other.steps(1, easy=0, checkpoint=tmp_path / "run.state"):
        if step.index == 4:
            break
    steps = last.steps(1, easy=0, restart=tmp_path / "run.state")
    assert steps.t == t[2]
    assert last.contact.force == pytest.approx(
        np.array([0.0, last.contact.multiplier @ last.contact.area])
    )
    assert [(step.index, step.t) for step in steps] == list(enumerate(t, start=1))[3:]
    # The loads of the file come first
    assert last.calls == t[2:]
    assert last.state() == straight.state()


def test_a_restart_brings_results_and_switches_back(tmp_path):
    scene = Sheared(far=0.1)
    steps = scene.steps(2)
    next(iter(steps))
    scene.history.x.array[:] = 5
    scene.contact.active = False
    steps.save(tmp_path / "half.state")
    other = Sheared(far=0.1)
    assert other.steps(2, restart=tmp_path / "half.state").t == 0.5
    assert not other.contact.active
    assert other.contact.force[1] > 0
    # The tractions are computed anew
    assert other.contact.traction.x.array == pytest.approx(
        scene.contact.traction.x.array, rel=1e-12
    )
    scene.contact.traction.x.array[:] = other.contact.traction.x.array
    scene.contact.fields.force[:] = other.contact.force
    assert other.state() == scene.state()


def test_a_run_that_has_ended_has_nothing_left(tmp_path):
    scene = Sheared(far=0.1)
    for _ in scene.steps(2, checkpoint=tmp_path / "end.state"):
        pass
    other = Sheared(far=0.1)
    steps = other.steps(2, restart=tmp_path / "end.state")
    assert list(steps) == []
    assert other.calls == [1.0]
    assert other.u.x.array.tobytes() == scene.u.x.array.tobytes()


def test_the_file_has_what_the_body_did(tmp_path):
    """It is written when the body has ended, and not when the body was left by an error."""
    file, scene = tmp_path / "new" / "run.state", Sheared(far=0.1)
    with pytest.raises(ZeroDivisionError):
        for step in scene.steps(4, checkpoint=file):
            scene.history.x.array[:] = step.index
            assert file.exists() == (step.index > 1)
            if step.index == 3:
                raise ZeroDivisionError
    other = Sheared(far=0.1)
    assert other.steps(4, restart=file).t == 0.5
    assert np.all(other.history.x.array == 2)
    assert os.listdir(file.parent) == [file.name]


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "No space left"), KeyboardInterrupt()])
def test_the_last_whole_file_survives(monkeypatch, tmp_path, error):
    file, scene = tmp_path / "run.state", Sheared(far=0.1)
    steps = scene.steps(4)
    next(iter(steps))
    steps.save(file)
    before = file.read_bytes()

    def half(self, at, values):
        raise error

    monkeypatch.setattr(SharedFile, "write", half)
    with pytest.raises(type(error)):
        steps.save(file)
    assert file.read_bytes() == before
    assert os.listdir(tmp_path) == ["run.state"]


@pytest.fixture
def file(tmp_path):
    path, scene = tmp_path / "whole.state", Sheared(far=0.1)
    steps = scene.steps(2)
    next(iter(steps))
    steps.save(path)
    return path


def refused(file, message, scene=None, **options):
    """Check that a restart fails, naming the file, and changes nothing."""
    scene = scene or Sheared(far=0.1)
    before = scene.state()
    with pytest.raises(ValueError, match=message) as info:
        scene.steps(2, restart=file, **options)
    assert str(file) in str(info.value)
    assert scene.state() == before
    assert scene.calls == []


def test_files_of_other_kinds(file, tmp_path):
    """Also of older versions, which say what they are by their first bytes."""
    np.savez(tmp_path / "old.npz", contactx_checkpoint=np.array(5))
    refused(tmp_path / "old.npz", "of an older contactx for Python.*, and contactx .* reads format")
    old = tmp_path / "old.h5"
    old.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    refused(old, "of an older contactx for C\\+\\+.* finish that run with the contactx")
    data = bytearray(file.read_bytes())
    data[24:30], data[48] = b"9.9.9\0", 7
    file.write_bytes(data)
    refused(file, r"contactx 9\.9\.9 wrote it in format 7, and contactx .* reads format 6")


def test_files_of_other_problems(file, tmp_path):
    refused(file, r"'history\[0\]' is only in the file: were contacts", history=[])
    scene = Sheared(far=0.1)
    message = r"'history\[0\]' has 1 values of type f8 a row in the file, but 2 of type f8 here"
    refused(file, message, scene, history=[scene.u])
    other = fem.Function(scene.contact.pressure.function_space)
    refused(file, r"'history\[0\]' has 18 rows in the file, but 16 here", scene, history=[other])

    scene = Blocks(CellType.triangle)
    problem = scene.problem(scene.contact())
    history = [fem.Function(fem.functionspace(scene.u.function_space.mesh, ("DG", 0)))]
    with pytest.raises(ValueError, match=r"(only|missing) in the file"):
        cx.LoadSteps(problem, 2, print, history=history, restart=file)
    assert not scene.u.x.array.any()

    scene = SlidingBlocks(CellType.triangle, sliding="small")
    run(scene, until=2, checkpoint=tmp_path / "blocks.state")
    with pytest.raises(ValueError, match="'contact 0: identity' is another one here"):
        run(SlidingBlocks(CellType.triangle), restart=tmp_path / "blocks.state")
    moved = SlidingBlocks(CellType.triangle, sliding="small")
    moved.u.function_space.mesh.geometry.x[3] += 1e-3
    with pytest.raises(ValueError, match=r"'mesh: coordinates' is another one here"):
        run(moved, restart=tmp_path / "blocks.state")


def test_values_that_cannot_be(file, tmp_path):
    refused(archive.change(file, u=np.nan), r"'u' is not finite at 32 dofs")
    refused(archive.change(file, u=0.0, multiplier=np.inf), "'contact 0: multiplier' is not finite")


def test_pairs_that_cannot_be(tmp_path):
    file = tmp_path / "blocks.state"
    run(SlidingBlocks(CellType.triangle), until=2, checkpoint=file)
    scene = SlidingBlocks(CellType.triangle)
    with pytest.raises(ValueError, match="a pair with a facet that does not exist"):
        run(scene, restart=archive.change(file, master_facet_nodes=99))
    assert not scene.u.x.array.any()


def test_a_file_beyond_the_last_step(file):
    scene = Sheared(far=0.1)
    with pytest.raises(ValueError, match=r"at t = 0\.5, beyond the last given t = 0\.4"):
        scene.steps([0.4], restart=file)
    assert not scene.u.x.array.any()


def test_loads_that_cannot_be_set_undo_a_restart(file):
    scene = Sheared(far=0.1)
    before = scene.state()

    def update(t):
        raise RuntimeError("no loads")

    with pytest.raises(RuntimeError, match="no loads"):
        scene.steps(2, restart=file, update=update)
    assert scene.state() == before
