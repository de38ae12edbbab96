# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Some scenes of each family of the stress map, and runs of leaks.py; all of them: make stress."""

import subprocess
import sys

import pytest
from rich.console import Console

from stress import picture, sheet
from stress.families import FAMILIES, again, all_scenes, cycles, peers
from stress.outcome import Kind, Outcome, run
from tether import environment, tethered

# Tips that end behind each other, where their nodes have pairs, too; a plate that bends about a
# corner between its nodes; a block that comes to lie on another one; a load that is taken off; a
# disc that iterates distort, and that was pressed along the normals of these from afar. Right ones
# that a judge may take for wrong: a node beside the master by 5.7 % of its facet, a stiff slave
# whose forces are rounding, rough quadrilaterals that are no edge, a node that was apart by 1e-9,
# and slip that forces of 1e-6 undo. Facets that are far apart at first, along directions that are
# no normals of theirs; a frozen pair whose node has left its facet; nodes beside a corner of the
# master, and sides of it behind one
_HARD = (
    "past one another, way in heights: 0.1, tip:tip, 0.1, whole, n2s, 1, False",
    "past one another, way in heights: 0.6, tip:tip, 0.1, whole, n2s, 3, True",
    "past one another, way in heights: 1, plate:plate, 0.1, whole, n2s, 1, True",
    "past one another, way in heights: 1, block:block, 0.1, whole, s2s, 3, True",
    "pressed and let go, units: 1000:1e+06, 0.3, svk, s2s, 2, False",
    "arch under a disc, depth in heights: 2, 0.3, arch is the slave, linear, n2s, 1, True",
    "where peers fail: friction 0.3, 0.2 in one step, s2s, small, condensed, 0.02",
    "roller at large strains, depth in radii: 1, alike, neo-hooke, True, n2s, mu 0, 8, True",
    "past one another, way in heights: 0.6, plate:plate, 0.4, whole, n2s, 1, True",
    "past one another, way in heights: 0.3, block:block, 0.1, whole, s2s, 3, False",
    "past one another, way in heights: 1, block:block, 0.4, whole, s2s, 3, False",
    *(f"all at random: {i}" for i in ("12, 6", "7, 6", "4, 15", "0, 6", "4, 4")),
)
# A thousand steps take a minute
_SHORT = [family for family in FAMILIES if family is not cycles.cyclic]


def _some(family):
    scenes = list(family())
    if family is peers.hertz:
        scenes = [s for s in scenes if s.variant.endswith("direct, 0.04") and "finite" in s.variant]
    return [scenes[k * (len(scenes) - 1) // 3] for k in range(4)]


@pytest.mark.parametrize(
    "scene", [s for family in _SHORT for s in _some(family)], ids=lambda scene: scene.name
)
def test_scene(scene):
    outcome = run(scene)
    assert outcome.kind in (Kind.CONVERGED, Kind.CUT, Kind.RIGHTLY), outcome.reason


@pytest.mark.parametrize("name", _HARD)
def test_hard_scenes_are_not_wrong(name):
    (scene,) = (s for s in all_scenes() if s.name == name)
    outcome = run(scene)
    assert outcome.kind != Kind.WRONG, outcome.reason


@pytest.mark.parametrize("method", ["n2s", "s2s"])
def test_iterations_are_the_same_in_all_units(method):
    """Multipliers of any size beside displacements: a direct solver finds them as exactly."""
    scenes = [s for s in again.repeated() if s.variant == f"{method}, small, mu 0.3, 2, 0.05"]
    iterations = {scene.value: run(scene).iterations for scene in scenes}
    assert len(iterations) == 6
    assert len(set(iterations.values())) == 1, iterations


def test_there_are_enough_scenes_and_none_twice():
    assert len(all_scenes()) >= 2000


def test_tables_and_picture(tmp_path):
    rows = [
        Outcome("a", "1", "x", Kind.CONVERGED, steps=1, iterations=3),
        Outcome("a", "2", "x", Kind.CUT, steps=2, iterations=8, discarded=9),
        Outcome("b", "1", "", Kind.REFUSED, "too much"),
        Outcome("b", "2", "", Kind.WRONG, "balance: 1 > 0"),
    ]
    sheet.write(rows, tmp_path / "map.csv")
    assert sheet.read(tmp_path / "map.csv") == rows
    sheet.show(rows, Console(quiet=True), tmp_path / "map.md")
    text = (tmp_path / "map.md").read_text()
    assert "| all | 4 | 1 | 1 | 0 | 1 | 1 | 3 | 11 | 4 |" in text
    assert "refused: b: 1, : too much" in text
    picture.draw(rows, tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 5000
    first, other = sheet.families(rows)
    assert (first["scenes"], first["converged"], first["after cut-back"]) == (2, 1, 1)
    assert (other["refused"], other["WRONG"], other["most"]) == (1, 1, 0)
    picture.draw_families([first, other], tmp_path / "families.png", "a note", "a source")
    assert (tmp_path / "families.png").stat().st_size > 5000


# Steps before the warm-up has ended, and behind it; a form that is rarely needed is compiled in it
WARM, STEPS = 160, 260
# Growth of memory behind it, MB, and of Python's objects a step: the row of its table
BOUND, OBJECTS = 0.3, 1.2
PROGRAM = """
import contactx
import sys
from stress.memory import RUNS, objects, resident
name, warm, steps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
for step in RUNS[name](steps):
    if step == warm:
        first = objects(), resident()
    last = step
print(objects() - first[0], resident() - first[1], last)
"""


@pytest.mark.parametrize(
    "name", ["node to surface", "surface to surface", "condensed", "problems made and dropped"]
)
def test_memory_does_not_grow(name):
    """In a process of its own, whose memory is that of this run alone."""
    done = subprocess.run(
        tethered([sys.executable, "-W", "ignore", "-c", PROGRAM, name, str(WARM), str(STEPS)]),
        env=environment(),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    objects, grown, last = map(float, done.stdout.split())
    assert last >= STEPS
    assert grown <= BOUND
    assert objects <= OBJECTS * (last - WARM) + 50
