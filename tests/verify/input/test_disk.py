# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Disks that are full, and checkpoints that are damaged, anywhere."""

import os
import resource
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import contactx as cx

from scenes.steps import Rubbing
from tether import environment, tethered


@contextmanager
def room_for(size):
    """A file may not grow beyond a size, as on a disk that is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    action = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, action)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A checkpoint after one step of four, its scene, and the end of the run."""
    path, scene = tmp_path_factory.mktemp("whole") / "run.state", Rubbing()
    steps = scene.steps(4)
    for step in steps:
        scene.history.x.array[:] = 2 * scene.history.x.array + step.index
        if step.index == 1:
            steps.save(path)
    return path, scene


@pytest.mark.parametrize("part", [0.0, 0.01, 0.3, 0.7, 0.99, 0.9999])
def test_a_full_disk(tmp_path, whole, part):
    """The error says so, the last file is whole, and the run goes on."""
    size = whole[0].stat().st_size
    path, scene = tmp_path / "run.state", Rubbing()
    steps = scene.steps(4, checkpoint=path)
    for step in steps:
        scene.history.x.array[:] = 2 * scene.history.x.array + step.index
        if step.index == 2:
            break
    before = path.read_bytes()
    at_two = scene.state()
    message = f"cannot write the checkpoint {path}: File too large; an older file of this name is"
    with pytest.raises(OSError, match=message), room_for(int(part * size)):
        steps.save(path)
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == [path.name]
    assert scene.state() == at_two
    assert steps.t == 0.5
    other = Rubbing()
    assert other.steps(4, restart=path).t == 0.25
    # The disk has room again
    scene.run(steps)
    assert scene.state() == whole[1].state()
    assert other.steps(4, restart=path).t == 1


def test_a_disk_that_fills_up_amid_a_loop(tmp_path, whole):
    path, scene = tmp_path / "run.state", Rubbing()
    steps = scene.steps(4, checkpoint=path)
    with pytest.raises(OSError, match="cannot write the checkpoint"), room_for(100):
        scene.run(steps)
    assert steps.t == 0.25
    assert os.listdir(tmp_path) == []
    scene.run(steps)
    assert scene.state() == whole[1].state()


KILLED = """\
import contactx, os, signal
from contactx._host.checkpoint.shared_file import SharedFile
from scenes.steps import Rubbing

whole, calls = SharedFile.write, []

def write(self, at, values):
    calls.append(at)
    whole(self, at, values[: len(values) // 2] if len(calls) == {last} else values)
    if len(calls) == {last}:
        os.kill(os.getpid(), signal.SIGKILL)

steps = Rubbing().steps(4, restart="run.state", checkpoint="run.state")
SharedFile.write = write
for step in steps:
    pass
"""


@pytest.mark.parametrize("last", [1, 5, 12])
def test_a_kill_leaves_the_last_file(tmp_path, whole, last):
    """Also where it comes amid an array; the next run writes over what it has left."""
    path = tmp_path / "run.state"
    path.write_bytes(whole[0].read_bytes())
    killed = subprocess.run(
        tethered([sys.executable, "-c", KILLED.format(last=last)]),
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
    )
    assert killed.returncode in (-signal.SIGKILL, 128 + signal.SIGKILL), killed.stderr
    assert path.read_bytes() == whole[0].read_bytes()
    assert sorted(os.listdir(tmp_path)) == ["run.state", "run.state.tmp"]
    assert "it is truncated, or no checkpoint at all" in refused(tmp_path / "run.state.tmp")
    scene = Rubbing()
    scene.run(scene.steps(4, restart=path, checkpoint=path))
    assert scene.state() == whole[1].state()
    assert os.listdir(tmp_path) == ["run.state"]


def refused(path, error=ValueError):
    """Check that a restart says which file is bad, and changes nothing."""
    scene = Rubbing()
    before = scene.state()
    with pytest.raises(error) as info:
        scene.steps(4, restart=path)
    assert str(path) in str(info.value)
    assert scene.state() == before
    return str(info.value)


@pytest.mark.parametrize(
    "content",
    [b"", b"contactx", b"\x93NUMPY", np.random.default_rng(0).bytes(1000)],
    ids=["nothing", "beginning of a checkpoint", "beginning of an array", "noise"],
)
def test_files_of_other_kinds(tmp_path, content):
    path = tmp_path / "other.state"
    path.write_bytes(content)
    assert "truncated, or no checkpoint at all" in refused(path)


def test_what_is_no_file(tmp_path):
    assert "is a folder, not a checkpoint: give the name of a file" in refused(tmp_path)
    assert "there is no checkpoint" in refused(tmp_path / "none.state", FileNotFoundError)
    # Of an older version, and no danger
    np.savez(tmp_path / "pickled.npz", u=np.array([os.system]), allow_pickle=True)
    assert "it is of an older contactx for Python" in refused(tmp_path / "pickled.npz")


@pytest.mark.parametrize("place", ["a folder", "below a file", "no regular file"])
def test_places_that_cannot_be_written(tmp_path, place):
    (tmp_path / "file").write_text("")
    os.mkfifo(tmp_path / "pipe")
    path, error, message = {
        "a folder": (tmp_path, ValueError, "checkpoint is the folder .*: give the name of a file"),
        "below a file": (
            tmp_path / "file" / "x.state",
            OSError,
            "cannot make the folder of checkpoint",
        ),
        "no regular file": (
            tmp_path / "pipe",
            ValueError,
            "checkpoint .* is no regular file: give",
        ),
    }[place]
    scene = Rubbing()
    with pytest.raises(error, match=message):
        scene.steps(4, checkpoint=path)
    steps = scene.steps(4)
    with pytest.raises(error):
        steps.save(path)
    assert sorted(os.listdir(tmp_path)) == ["file", "pipe"]


def paraview(path, scene):
    with cx.VTKOutput(path, scene.u, [scene.contact]) as output:
        output.write(0.0)
        output.write(1.0)


@pytest.mark.parametrize("size", [0, 200, 3000])
def test_results_that_cannot_be_written(tmp_path, size):
    """DOLFINx says nothing of a file that is not whole."""
    scene = Rubbing()
    paraview(tmp_path / "good.pvd", scene)
    assert (tmp_path / "good_p0_000001.vtu").stat().st_size > 3000
    with (
        pytest.raises(OSError, match=r"cannot write .*run.*(whole: is the disk full)?"),
        room_for(size),
    ):
        paraview(tmp_path / "run.pvd", scene)


def test_a_collection_that_cannot_be_written(tmp_path):
    scene = Rubbing()
    output = cx.VTKOutput(tmp_path / "run.pvd", scene.u, [scene.contact])
    Path(tmp_path / "run.pvd").mkdir()
    with pytest.raises(OSError, match=r"cannot write .*run.pvd"):
        output.write(0.0)
    output.close()
    assert not (tmp_path / "run.pvd~").exists()
