# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The benchmarks run on coarse meshes, so that they cannot rot; what they measure is not judged."""

import bench_audit
import bench_checkpoint
import bench_degrees
import bench_dynamics
import bench_edges
import bench_fits
import bench_forming
import bench_friction
import bench_growth
import bench_hertz
import bench_ironing
import bench_limit
import bench_locking
import bench_many
import bench_methods
import bench_nafems
import bench_path
import bench_peers
import bench_rates
import bench_scenes
import bench_skips
import bench_solvers
import bench_spheres
import bench_steps
import bench_tuning
import numpy as np
import pytest
import runner
import tables
from matplotlib import image
from peers import table

from scenes import fits
from story import METHODS

ALONE = runner.alone


@pytest.fixture(scope="module", autouse=True)
def in_this_process(tmp_path_factory):
    """All runs come into this process, which is faster, and files into a folder of the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runner, "OUTPUT", tmp_path_factory.mktemp("bench"))
        patch.setattr(runner, "alone", runner.here)
        yield


def two(text):
    """Numbers of a column that has a rule's two."""
    return [int(number) for number in text.split(":")]


def test_a_process_of_its_own(tmp_path):
    result = ALONE("hertz_case:write_mesh", h=0.2, folder=str(tmp_path))
    assert result["cells"] > 100
    assert (tmp_path / "whole" / "mesh.xdmf").exists()
    again = ALONE("hertz_case:write_mesh", h=0.2, folder=str(tmp_path))
    assert "FileExistsError" in again["failed"]


def test_hertz():
    rows = bench_hertz.main(["0.2"])
    assert [row["solver"] for row in rows] == ["direct *", "condensed"] * 2
    for row in rows:
        assert row["u_difference"] < 1e-9 and row["force_difference"] < 1e-9
        assert row["cpu"] > 0 and row["memory"] > 0
        assert 0 < row["p_l2"] < 1 and 0 <= row["pen"] < 0.1
    written = tables.read(runner.OUTPUT / "hertz.csv")
    assert [row["force"] for row in written] == [row["force"] for row in rows]
    assert image.imread(runner.OUTPUT / "hertz.png").shape[0] > 300


def test_checkpoint():
    """No rank has more than its share and a tenth."""
    rows = bench_checkpoint.main(["12"])
    assert [row["ranks"] for row in rows] == [1, 2, 4]
    for row in rows:
        assert row["dofs"] == 3 * 13**3 and row["file"] == rows[0]["file"]
        assert row["memory writing"] > 0
        assert 0.99 < row["written part"] < 1.1 and 0.99 < row["read part"] < 1.1


def test_growth():
    rows = bench_growth.main(["0.2", "0.1"])
    assert rows[0]["dofs"] < rows[1]["dofs"]
    assert image.imread(runner.OUTPUT / "growth.png").shape[0] > 300


def test_growth_of_a_power():
    rows = [{"dofs": n, "cpu": 3 * n**1.5, "memory": 2.0 * n} for n in (10, 30_000, 90_000)]
    fits, curve = bench_growth.fit(rows)
    for found in fits:
        assert found["time"] == pytest.approx(1.5) and found["memory"] == pytest.approx(1)
    assert [row["dofs"] for row in curve] == [30_000, 90_000]
    assert curve[0]["cpu"] == pytest.approx(3 * 30_000**1.5)
    assert np.isnan(tables.power_law([1.0], [1.0])).all()


def test_scenes():
    rows = bench_scenes.main(["0.1"])
    assert {row["scene"] for row in rows} == set(bench_scenes.SCENES)
    for row in rows:
        assert row["u_difference"] < 1e-7 and row["force_difference"] < 1e-7
    assert any(row["krylov"] > 0 for row in rows if "friction" in row["scene"])


def test_skips():
    rows = {row["rule"]: row for row in bench_skips.main(["0.07"])}
    assert all(row["cpu"] > 0 and row["cpu_off"] > 0 for row in rows.values())
    # What switches a rule off does so
    once, each = two(rows["bulk Jacobian once"]["assemblies"])
    assert once == 1 and each > 2
    kept, new = two(rows["hierarchies kept"]["hierarchies"])
    assert kept < new
    rough, exact = two(rows["rough early solves"]["krylov"])
    assert rough < exact
    near, every = two(rows["only nodes in reach"]["pairs"])
    assert near < every


def test_steps():
    rows = bench_steps.main(["0.2"])
    assert [row["scene"] for row in rows] == ["pressed block"] * 2 + ["Hertz"] * 2
    for row in rows:
        assert len(row["each"].split()) == bench_steps.STEPS
        assert row["ratio"] > 1


def test_methods(monkeypatch):
    monkeypatch.setattr(bench_methods, "RUNS", 1)
    rows = bench_methods.main(["0.2"])
    assert [row["method"] for row in rows] == list(METHODS) * (len(rows) // len(METHODS))
    assert {row.get("cells") for row in rows} == {"tetrahedra", "hexahedra", None}
    for row in rows:
        assert 0 < row["p_l2_best"] < 3 and row["gap"] < 1e-9
    assert all(row["ratio"] > 0 for row in rows if "cells" in row)
    assert image.imread(runner.OUTPUT / "methods.png").shape[0] > 300
    lines = (runner.OUTPUT / "methods.md").read_text().splitlines()
    assert len(lines) == 2 + sum("cells" in row for row in rows)


def test_peers(tmp_path):
    """contactx alone, as on a machine without the others; their rows stay as they are."""
    before = table.FILE.read_bytes()
    rows = bench_peers.main(["0.2", "--only", table.OURS, "--runs", "1", "--keep"])
    assert [row["setting"] for row in rows] == list(METHODS)
    assert all(0 < row["p_l2"] < 3 for row in rows)
    assert table.FILE.read_bytes() == before
    bench_peers.draw(tmp_path / "picture.png")
    assert image.imread(tmp_path / "picture.png").shape[0] > 300


def test_nafems():
    rows = bench_nafems.main(["4"])
    assert len(rows) == 14
    # The quarter is coarse
    assert all(abs(row["error"]) < 0.2 for row in rows)


def test_degrees(monkeypatch):
    monkeypatch.setattr(bench_degrees, "RUNS", 1)
    rows = bench_degrees.main(["0.2"])
    assert len(rows) == len(bench_degrees.KINDS) * len(METHODS)
    assert all(0 < row["error"] < 1 for row in rows)
    assert image.imread(runner.OUTPUT / "degrees.png").shape[0] > 300


def test_locking():
    linear, mini, quadratic, mixed = (row["n = 16"] for row in bench_locking.main(["16", "32"]))
    assert 7 < linear < 8
    # Of that at 128: 0.3 % more
    assert all(abs(ratio - 1) < 0.03 for ratio in (mini, quadratic, mixed))


def test_solvers(monkeypatch):
    monkeypatch.setattr(bench_solvers, "RUNS", 1)
    rows = bench_solvers.main(["2"], sizes=[6]) + bench_solvers.main(["mixed-2"], sizes=[6])
    rows += bench_solvers.main(["side-3"], sizes=[4])
    assert [row["friction"] for row in rows] == 3 * [0.0, 0.3]
    assert all(row["ratio"] > 0 for row in rows)


def test_tuning():
    rows = bench_tuning.main(["renewal_cost"], scenes=["rubber"], most=1)
    usual, other = (row["hierarchies"] for row in rows)
    assert usual < other


def test_limit(monkeypatch):
    monkeypatch.setattr(bench_limit, "RUNS", 1)
    rows = bench_limit.main(["0.1"])
    assert [row["scene"] for row in rows[:3]] == [bench_limit.LIMIT, *2 * [METHODS[0]]]
    assert all(row["ratio"] > 0 and row["peak"] > row["memory"] > 0 for row in rows)


def test_interior_point():
    rows = bench_path.main(["20"])
    assert len(rows) == 14
    assert rows[-1]["interior"] > 0


def test_forming():
    rows = bench_forming.main(["1"])
    assert [row["mu"] for row in rows] == [0.0, 0.1]
    assert all(row["force"] > 50 for row in rows)


def test_many():
    """Pressed and dragged: friction is where Coulomb's law has it."""
    rows = bench_many.main(["20"])
    assert [row["method"] for row in rows] == [m for m in METHODS for _ in bench_many.FRICTION]
    for row in rows:
        along, across = row["force"]
        assert abs(-along / across - row["friction"]) < 0.01
        assert 0 < row["ratio"] < 20


def test_rates():
    rows = bench_rates.main(["3", "6"])
    assert len(rows) == 2 * len(bench_rates.CASES) * len(METHODS)
    # On meshes as coarse as these no more than that errors shrink
    assert all(0.2 < row["H1 rate"] < 3 for row in rows if row["n"] == 6)


def test_spheres():
    rows = bench_spheres.main(["0.2"])
    assert len(rows) == len(bench_spheres.CASES) * len(METHODS)
    assert all(abs(row["a_best"]) < 0.2 for row in rows)


def test_audit():
    rows = bench_audit.main(["0.1"])
    assert len(rows) == 2 * len(METHODS)
    assert all(0 < row["audit"] < row["total"] for row in rows)
    assert all(0 <= row["excess"] < 1 for row in rows)


def test_ironing():
    rows = bench_ironing.main(["2", "0.17"])
    assert len(rows) == 4 * len(METHODS)
    for first, other in zip(rows[::2], rows[1::2], strict=True):
        assert other["apart"] == pytest.approx(other["down"] / first["down"] - 1)
        assert 0 < other["swing_along"] < first["swing_along"]


def test_friction():
    rows = bench_friction.main(["block", "0.5"]) + bench_friction.main(["slab", "5"])
    assert not any("failed" in row for row in rows)
    assert {row["scene"] for row in rows} >= {"slice, 5 layers, slave slabs"}
    apart = [row for row in rows if "difference" in row]
    assert len(apart) > 8 and all(np.isfinite(row["difference"]) for row in apart)


def test_dynamics():
    rows = bench_dynamics.main(["8", "40"])
    assert len(rows) == 24 + 4 + 16 + 2
    assert all(np.isfinite(row.get("growth", 0.0)) for row in rows)
    assert max(row["growth"] for row in rows if "method" in row) <= 1e-12


def test_edges():
    rows = bench_edges.main(["tip"], sizes=[10])
    rows += bench_edges.main(["ball"], sizes=[0.5])
    assert [row["method"] for row in rows] == [m for m in METHODS for _ in range(2)] * 2
    # On arms as coarse as this nothing is refused
    assert all(abs(row["lost"]) < 0.2 for row in rows[:4])
    assert all(0 < row["ratio"] < 1 for row in rows[4:])


def test_fits(monkeypatch):
    monkeypatch.setattr(fits, "TIMES", (0.5, 1.0, 1.5, 3.0))
    rows = bench_fits.main(["pin"], sizes=[(40, 24)])
    assert len(rows) == len(bench_fits.OPTIONS) * len(METHODS)
    for row in rows:
        is_adjusted = row["options"] != "chords"
        assert (row["stress"] < 1e-9) == is_adjusted
        assert (row["peak"] < 1.5 * row["right_peak"]) == is_adjusted
    rows = bench_fits.main(["taper"], sizes=[4.0])
    assert len(rows) == (len(bench_fits.OPTIONS) + 1) * len(METHODS)
    assert all(row["push_in"] > 0 > row["pull_out"] for row in rows)
