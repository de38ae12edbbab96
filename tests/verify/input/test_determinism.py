# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""On one rank and thread the same run has the same bits: here, elsewhere, and restarted."""

import hashlib
import json
import subprocess
import sys
from pathlib import Path

import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes import steps as restarts
from scenes.steps import KINDS, DentedBlock, LooseBlock, Rubbing, SlidingBlocks, state
from tether import environment, tethered

SCENES = {
    **{f"rubbing, {kind}": lambda kind=kind: Rubbing(**KINDS[kind]) for kind in KINDS},
    "tetrahedra, friction": lambda: SlidingBlocks(CellType.tetrahedron, friction=0.2),
    "hexahedra, facets": lambda: SlidingBlocks(
        CellType.hexahedron, friction=0.2, method="surface-to-surface"
    ),
    "free block": LooseBlock,
    "plastic with friction": lambda: DentedBlock(friction=0.3),
}


def run(name):
    """Digest of all states of a run of which one step is cut, and of its iterations."""
    scene = SCENES[name]()
    history = scene.history if isinstance(scene.history, list) else [scene.history]
    digest, failed = hashlib.sha256(), []

    def update(t):
        scene.update(t)
        if t > 0.4 and not failed:
            failed.append(t)
            raise cx.ConvergenceError("as if it had not converged", scene.problem.report)

    for step in cx.LoadSteps(scene.problem, 4, update, history=history, progress=False):
        if hasattr(scene, "commit"):
            scene.commit()
        for bits in state(scene.problem, *history):
            digest.update(bits)
        rows = [(row.residual, row.closed, row.pair_changes) for row in step.report.history]
        digest.update(repr((step.t, rows)).encode())
    assert failed
    return digest.hexdigest()


@pytest.fixture(scope="module")
def elsewhere():
    """Digests of another process, whose sets and dictionaries have another order."""
    env = environment(Path(__file__).parent) | {"PYTHONHASHSEED": "12345"}
    program = (
        "import contactx, json, test_determinism as t\n"
        "print(json.dumps({name: t.run(name) for name in t.SCENES}))"
    )
    done = subprocess.run(
        tethered([sys.executable, "-c", program]),
        env=env,
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", SCENES)
def test_the_same_bits(name, elsewhere):
    assert elsewhere[name] == run(name)


@pytest.mark.parametrize("name", [name for name in restarts.SCENES if name not in restarts.QUICK])
def test_three_steps_and_three_are_six(name, tmp_path):
    restarts.check_restart(name, tmp_path / "run.state")


@pytest.mark.parametrize("name", ["hexahedra", "facets, friction"])
def test_a_new_process_goes_on_to_the_same_bits(name, tmp_path):
    straight, _ = restarts.run(restarts.SCENES[name]())
    restarts.run(restarts.SCENES[name](), until=4, checkpoint=tmp_path / "run.state")
    program = (
        "import contactx, sys, scenes.steps as t\n"
        f"bits, _ = t.run(t.SCENES[{name!r}](), restart='run.state')\n"
        "sys.stdout.buffer.write(b''.join(bits))"
    )
    done = subprocess.run(
        tethered([sys.executable, "-c", program]),
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        check=True,
    )
    assert done.stdout == b"".join(straight)
