# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The judge of the stress map finds what is wrong in a state, and nothing in a solution."""

import ast
from pathlib import Path

import numpy as np
import pytest

from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from stress import inside
from stress import judge as judges
from stress.blocks import Blocks
from stress.families import all_scenes
from stress.families.edges import _edge
from stress.families.moving import _rigid
from stress.judge import Judge
from stress.outcome import Outcome, steps_of
from stress.scene import METHODS, Case
from stress.work import Work

CELLS = [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]


def test_the_judge_knows_nothing_of_contactx():
    """Neither its modules nor any module of the map that they import."""
    folder, seen, waiting = Path(judges.__file__).parent, set(), {"judge"}
    while waiting:
        name = waiting.pop()
        seen.add(name)
        for node in ast.walk(ast.parse((folder / f"{name}.py").read_text())):
            found = []
            if isinstance(node, ast.Import):
                found = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                found = [f"{node.module}.{alias.name}" for alias in node.names]
            assert not any(module.startswith(("contactx", "scenes", "meshes")) for module in found)
            own = {m.split(".")[1] for m in found if m.startswith("stress.")}
            waiting |= own - seen
    assert {"near", "faces", "inside", "work"} <= seen


class Solved:
    """A scene at its solution, and what may be spoiled of it.

    Attributes:
        judge: Its judge, which finds nothing.
        u: Displacement, shape (n, dim).
        forces: What the bodies leave at the nodes, shape (n, dim).
        start: Positions at the start of the last step, shape (n, dim).
        slaves: Nodes of the slave that can move.
        masters: Those of the master.
        body: Nodes of the slave's body.
        node: The slave node that most acts on.
        normal: Along what.
    """

    def __init__(self, case: Case):
        given = case.given()
        (self._contact,) = given.contacts
        self._reported = self._contact.reported
        self.judge = Judge(given)
        for _ in steps_of(case, Outcome("", "", "")):
            start = self.judge._start
            assert self.judge() == []
        # The last step is judged again
        self.judge._start = self.start = start
        self.size, (look,) = case.size, self.judge._looks
        u = case.problem.u
        self.u = u.x.array.reshape(-1, len(u))
        self.X = u.function_space.tabulate_dof_coordinates()[:, : len(u)]
        self.forces = self.judge.residual().reshape(self.u.shape)
        self._kept = [a.copy() for a in (self.u, self.start, self.forces)]
        loose = ~look._fixed.any(axis=1)
        self.slaves = look._slaves[loose[look._slaves]]
        self.masters = look._masters[loose[look._masters]]
        self.both = np.union1d(self.slaves, self.masters)
        self.inner = np.setdiff1d(np.flatnonzero(loose), look.nodes)
        self.is_mean, self.friction = self._contact.is_mean, self._contact.friction
        self.is_rigid = len(look._masters) == 0
        self.body = np.arange(len(self.u)) if self.is_rigid else np.unique(look._bodies[1])
        size = np.linalg.norm(self.forces, axis=1)
        order = np.argsort(-size[self.slaves])
        self.node, self.other = self.slaves[order[:2]]
        self.open = self.slaves[order[-1]]
        self.pressed = self.masters[np.argsort(-size[self.masters])][:2]
        self.normal = self.forces[self.slaves].sum(axis=0)
        if self._contact.friction > 0:
            self.normal = np.eye(len(u))[-1]
        self.normal = self.normal / np.linalg.norm(self.normal)
        self.across = np.eye(len(u))[0] - self.normal[0] * self.normal
        self.most = size[self.node]

    def violated(self, spoil):
        """What is found once it is spoiled; then it is as before."""
        self.judge.residual = lambda: self.forces.ravel().copy()
        try:
            spoil(self)
            return self.judge.violated()
        finally:
            del self.judge.residual
            vars(self._contact)["reported"] = self._reported
            for array, kept in zip((self.u, self.start, self.forces), self._kept, strict=True):
                array[:] = kept

    def report(self, change):
        """Have other multipliers reported."""
        numbers, values = self._reported()
        vars(self._contact)["reported"] = lambda: (numbers, change(values.copy()))


def _largest(values):
    return np.abs(values.reshape(len(values), -1)).sum(axis=1).argmax()


def one_multiplier(s):
    def change(values):
        values[_largest(values)] *= 0.99
        return values

    s.report(change)


def multipliers_exchanged(s):
    def change(values):
        k = _largest(values)
        values[[k, k - 1]] = 1.1 * values[[k - 1, k]]
        return values

    s.report(change)


def forces_scaled(s):
    s.forces[s.both] *= 1.001


def forces_of_one_side(s):
    s.forces[s.slaves] *= 1.00001


def one_force(s):
    s.forces[s.node] *= 1.0001


def inner_force(s):
    s.forces[s.inner[len(s.inner) // 2], 0] += 1e-6 * s.most


def force_at_another_node(s):
    """The sum remains, the moment does not."""
    a, b = (s.node, s.other) if s.is_rigid else s.pressed
    part = 0.6 * s.forces[a]
    s.forces[a] -= part
    s.forces[b] += part


def forces_along_the_surface(s):
    """Both sides' forces as of the next node: neither sum nor moment changes by much."""
    for side in (s.slaves, s.masters):
        order = side[np.argsort(s.X[side, 0], kind="stable")]
        s.forces[order] = s.forces[np.roll(order, 1)]


def tension(s):
    s.forces[s.both] *= -1


def tension_of_a_pair(s):
    part = -2 * s.forces[s.node]
    s.forces[s.node] += part
    if not s.is_rigid:
        s.forces[s.pressed[0]] -= part


def tilted(angle):
    def spoil(s):
        f = s.forces[s.both]
        c, n = np.cos(angle), np.sin(angle)
        turned = f.copy()
        turned[:, 0], turned[:, -1] = c * f[:, 0] - n * f[:, -1], n * f[:, 0] + c * f[:, -1]
        s.forces[s.both] = turned

    return spoil


def friction_the_other_way(s):
    """Where there is none, there is some."""
    along = s.forces[s.both] - (s.forces[s.both] @ s.normal)[:, None] * s.normal
    if np.abs(along).max() < 0.01 * s.most:
        along = 0.1 * (s.forces[s.both] @ s.normal)[:, None] * s.across
    s.forces[s.both] -= 2 * along


def friction_scaled(s):
    along = s.forces[s.both] - (s.forces[s.both] @ s.normal)[:, None] * s.normal
    if np.abs(along).max() < 0.01 * s.most:
        along = 0.1 * (s.forces[s.both] @ s.normal)[:, None] * s.across
    s.forces[s.both] += 0.2 * along


def slip_the_other_way(s):
    """The slave's body has come from the other side, as far; without friction it is too deep."""
    if s.friction == 0:
        s.u[s.body] -= 1e-2 * s.size * s.normal
        return
    moved = s.u[s.body] + s.X[s.body] - s.start[s.body]
    s.start[s.body] += 2 * (moved - (moved @ s.normal)[:, None] * s.normal)


def shifted(by):
    """The slave's body along the normal; where gaps are means by what a mesh of few cells shows."""

    def spoil(s):
        s.u[s.body] += by * (1000 if s.is_mean else 1) * s.size * s.normal

    return spoil


def node_shifted(by):
    def spoil(s):
        s.u[s.node] += by * s.size * s.normal

    return spoil


def body_along_the_surface(s):
    s.u[s.body] += 0.05 * s.size * s.across


def force_on_what_is_apart(s):
    s.u[s.open] += 0.01 * s.size * s.normal
    s.forces[s.open] = 0.1 * s.most * s.normal


def tip_of_the_master(s):
    """A node of the master, or of the slave, far inside the other body."""
    if s.is_rigid:
        s.u[s.open] -= 0.3 * s.size * s.normal
    else:
        s.u[s.pressed[0]] += 0.3 * s.size * s.normal


SPOILINGS = {
    "multipliers scaled": lambda s: s.report(lambda values: 0.999 * values),
    "multipliers too large": lambda s: s.report(lambda values: 1.2 * values),
    "multipliers negative": lambda s: s.report(lambda values: -values),
    "multipliers not finite": lambda s: s.report(lambda values: np.nan * values),
    "one multiplier": one_multiplier,
    "multipliers exchanged": multipliers_exchanged,
    "forces scaled": forces_scaled,
    "forces of one side": forces_of_one_side,
    "one force": one_force,
    "inner force": inner_force,
    "force at another node": force_at_another_node,
    "forces along the surface": forces_along_the_surface,
    "tension": tension,
    "tension of a pair": tension_of_a_pair,
    "tilted": tilted(0.4),
    "tilted back": tilted(-0.4),
    "friction the other way": friction_the_other_way,
    "friction scaled": friction_scaled,
    "apart by a little": shifted(1e-6),
    "deep by a little": shifted(-1e-6),
    "apart": shifted(1e-2),
    "deep": shifted(-1e-2),
    "node apart": node_shifted(1e-3),
    "node deep": node_shifted(-1e-3),
    "along the surface": body_along_the_surface,
    "slip the other way": slip_the_other_way,
    "force on what is apart": force_on_what_is_apart,
    "tip inside": tip_of_the_master,
}
SCENES = {
    "quad, n2s, friction": Blocks(friction=0.3, side=0.1).case,
    "tria, n2s, sticks": Blocks(
        cell=CellType.triangle, friction=2.0, side=0.02, n_upper=(5, 2)
    ).case,
    "tetr, n2s, friction, 2 steps": Blocks(
        cell=CellType.tetrahedron, friction=0.3, side=0.1, steps=2
    ).case,
    "quad, n2s, round": Blocks(n_upper=(8, 4), n_lower=(10, 3), radius=2.0).case,
    "quad, n2s, friction, small": Blocks(friction=0.3, side=0.1, sliding="small").case,
    "tip, n2s": lambda: _edge(5, METHODS[0], "block", 0.1),
    "plane, n2s, friction": lambda: _rigid(
        0.05, CELLS[1], "plane", method=METHODS[0], friction=0.3, sliding="finite"
    ),
    "ball, n2s": lambda: _rigid(
        0.1, CELLS[1], "ball", method=METHODS[0], friction=0.0, sliding="finite"
    ),
    "quad, s2s, friction": Blocks(friction=0.3, side=0.1, method=METHODS[1]).case,
    "tria, s2s, round": Blocks(
        cell=CellType.triangle, n_upper=(8, 4), n_lower=(10, 3), radius=2.0, method=METHODS[1]
    ).case,
    "tetr, s2s, friction": Blocks(
        cell=CellType.tetrahedron, friction=0.3, side=0.1, method=METHODS[1]
    ).case,
    "tetr, s2s, small": Blocks(cell=CellType.tetrahedron, method=METHODS[1], sliding="small").case,
    "tip, s2s": lambda: _edge(5, METHODS[1], "block", 0.1),
    "ball, s2s, friction": lambda: _rigid(
        0.1, CELLS[2], "ball", method=METHODS[1], friction=0.3, sliding="finite"
    ),
}
_MEANS = {"apart by a little", "deep by a little", "node apart", "node deep", "along the surface"}
# What is not found. Directions that are fixed in the reference configuration feel no movement along
# flat faces. Where an edge presses, or facets are coarse for a ball, gaps differ by much over a
# node's facets, and means of them say little.
MISSED = {
    "quad, n2s, friction, small": {"along the surface"},
    "tetr, s2s, small": {"along the surface"},
    "tria, s2s, round": {"friction scaled"},
    "tip, s2s": _MEANS | {"slip the other way"},
    "ball, s2s, friction": _MEANS | {"deep", "slip the other way"},
}


@pytest.mark.parametrize("name", SCENES)
def test_what_is_spoiled_is_found(name):
    solved = Solved(SCENES[name]())
    assert solved.violated(lambda s: None) == []
    missed = {what for what, spoil in SPOILINGS.items() if not solved.violated(spoil)}
    assert missed <= MISSED.get(name, set())


def test_nineteen_of_twenty_are_found():
    assert sum(map(len, MISSED.values())) <= 0.05 * len(SCENES) * len(SPOILINGS)


@pytest.mark.parametrize("part, right", [(1e-10, True), (1e-6, False)])
def test_forces_that_are_left_of_those_before(part, right):
    """Without any load none are left, and nothing else is there to compare them with."""
    blocks = Blocks()
    case = blocks.case()
    judge = Judge(case.given())
    case.update(1.0)
    case.problem.solve()
    assert judge() == []
    blocks.u.x.array[:] *= part
    blocks.contact.discrete.nodes.multiplier[:] = 0
    assert (judge() == []) == right
    # In the next step they would be forces of their own
    assert judge.violated() != []


@pytest.mark.parametrize("method", METHODS)
def test_work_that_is_not_stored(method):
    """What friction takes is lost, whether it is small or not."""
    lost = []
    for friction in (0.0, 0.1):
        blocks = Blocks(
            method=method, friction=friction, n_lower=(5, 2), down=0.02, side=0.4, steps=20
        )
        case = blocks.case()
        judge = Judge(case.given())
        judge._work = Work(blocks.u, judge.residual, judge._fixed.ravel())
        small = np.zeros(judge._fixed.size)
        checks = [judge._work(small) for _ in steps_of(case, Outcome("", "", ""))]
        lost.append(checks[-1].error / checks[-1].allowed)
    assert lost[0] < 0.5
    assert lost[1] > 1


def test_energy_of_an_arch_that_snaps_is_lost():
    """It leaves its symmetric shape within one of few steps; a tenth of its work is not stored."""
    (scene,) = (
        scene
        for scene in all_scenes()
        if scene.family.startswith("arch under a disc")
        and (scene.value, scene.variant) == ("0.5", "0.8, arch is the slave, svk, s2s, 4, True")
    )
    case = scene.make()
    judge = Judge(case.given())
    work = Work(case.problem.u, judge.residual, judge._fixed.ravel())
    checks, given = [], []
    for _ in steps_of(case, Outcome("", "", "")):
        checks.append(work(np.zeros(judge._fixed.size)))
        given.append(work._given)
    assert all(check.holds for check in checks)
    # The last step snaps and is left out, the others are not
    assert np.all(np.diff(given)[:-1] > 0) and given[-1] == given[-2]


@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_depth(cell):
    dim = 2 if cell in CELLS[:2] else 3
    data = meshes.blocks(cell, (2,) * dim, (3,) * dim, size_lower=(2.0,) * dim, gap=0.1)
    parts = inside.boundary(data.mesh, data.facet_tags, Tag.LOWER_CONTACT)
    x = data.mesh.geometry.x[:, :dim]
    rng = np.random.default_rng(0)
    points = rng.uniform(-2.5, 2.5, (400, dim))
    # The lower block: from 0 to 2 along the surface, from -2 to 0 in height
    low, high = np.zeros(dim), np.full(dim, 2.0)
    low[-1], high[-1] = -2.0, 0.0
    exact = np.minimum(points - low, high - points).min(axis=1).clip(min=0)
    assert (exact > 0).sum() > 10
    np.testing.assert_allclose(inside.depth(points, x, parts), exact, atol=1e-12)
