# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What surface-to-surface contact promises: means, balance, roles, edges, exact ties."""

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes import CELLS, Blocks, hertz_sphere
from scenes.covering import SLIDINGS, covering
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean
from scenes.tower import Tower, lift

SURFACE, NODE = "surface-to-surface", "node-to-surface"
every_cell = pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
both_slidings = pytest.mark.parametrize("sliding", ["finite", "small"])


def solved(problem, contact):
    problem.solve()
    assert problem.report.iterations <= 10
    return contact


@both_slidings
def test_either_body_may_be_the_slave(sliding):
    """The same force; nothing is inside in the mean, and node-to-surface agrees within 1 %."""
    sphere = solved(*hertz_sphere(0.04, sliding, method=SURFACE))
    block = solved(*hertz_sphere(0.04, sliding, method=SURFACE, swapped=True))
    node = solved(*hertz_sphere(0.04, sliding, method=NODE))
    forces = [c.force[2] for c in (sphere, block, node)]
    print([f"{4 * f:.7f}" for f in forces])
    assert -forces[1] == pytest.approx(forces[0], rel=5e-3)
    assert forces[2] == pytest.approx(forces[0], rel=0.01)
    for contact in (sphere, block):
        assert np.nanmin(contact.discrete.nodes.gap) >= -1e-12
        assert contact.multiplier.min() >= 0


def moment(x, f):
    """Sum of x times f, shape (3,), of positions and forces of shape (n, gdim)."""
    x, f = (np.pad(a, ((0, 0), (0, 3 - a.shape[1]))) for a in (x, f))
    return np.cross(x, f).sum(axis=0)


@every_cell
@both_slidings
def test_forces_and_moments_balance(cell, sliding):
    """Of all contact forces on the scene; in small sliding about the reference positions."""
    scene = Blocks(cell)
    contact = scene.contact(sliding, method=SURFACE)
    scene.problem(contact).solve()
    gdim = len(contact.force)
    forces = np.zeros(len(scene.u.x.array))
    contact.discrete.add_residual(forces)
    forces = forces.reshape(-1, gdim)
    size = np.abs(forces).max()
    assert np.abs(forces.sum(axis=0)).max() <= 1e-12 * size
    x = scene.u.function_space.tabulate_dof_coordinates()[:, :gdim]
    if sliding == "finite":
        x = x + scene.u.x.array.reshape(-1, gdim)
    off = np.abs(moment(x, forces)).max() / size
    print(f"moment off by {off:.1e}")
    assert off <= 1e-12


@covering(cell=CELLS, sliding=SLIDINGS, n=[(4, 3), (3, 5)], aside=(0.0, 0.05))
def test_a_tie_passes_a_linear_field(cell, sliding, n, aside):
    """Tension, and shear, of blocks that do not match; their sides carry the field's stress."""
    tower = Tower(cell, *n, tied=True, nu=0.3, sliding=sliding, method=SURFACE, sides=True)
    gdim = tower.gdim
    gradient = np.zeros((gdim, gdim))
    gradient[:, -1] = lift(gdim, 0.1, aside)
    tower.stress.value[:] = hooke(gradient)
    tower.move(lambda x: x + x @ gradient.T)
    assert tower.problem.report.iterations == 1
    assert np.abs(tower.u.x.array - (tower.X @ gradient.T).ravel()).max() <= 1e-12
    assert np.abs(tower.contact.multiplier + hooke(gradient)[:, -1]).max() <= 1e-11


def hooke(gradient):
    """Stress of E = 1, nu = 0.3, in plane strain where the gradient is plane."""
    mu, lmbda = 1 / 2.6, 0.3 / (1.3 * 0.4)
    return mu * (gradient + gradient.T) + lmbda * np.trace(gradient) * np.eye(len(gradient))


@covering(cell=CELLS, sliding=SLIDINGS, n=[(2, 9), (9, 2)])
def test_very_different_meshes(cell, sliding, n):
    scene = Blocks(cell, n_upper=n[0], n_lower=n[1])
    contact = scene.contact(sliding, method=SURFACE)
    problem = scene.problem(contact)
    problem.solve()
    print(problem.report.iterations, contact.force)
    assert problem.report.iterations <= 8
    assert np.nanmin(contact.discrete.nodes.gap) >= -1e-12
    assert contact.force[-1] > 0.02


@covering(cell=CELLS, sliding=SLIDINGS, friction=(0.0, 0.3))
def test_contact_is_lost_and_closes_again(cell, sliding, friction):
    scene = Blocks(cell)
    contact = scene.contact(sliding, friction=friction, method=SURFACE)
    problem = scene.problem(contact)
    forces = []
    for down in (0.05, -0.1, 0.05):
        scene.bcs[-1].g.value[...] = -down
        problem.solve()
        assert problem.report.iterations <= 12
        forces.append(contact.force.copy())
    assert not forces[1].any() and forces[0][-1] > 0.01
    assert forces[2] == pytest.approx(forces[0], rel=1e-2 if friction else 1e-9, abs=1e-12)


@pytest.mark.parametrize(
    ("cell", "friction"), [*zip(CELLS, [0.0, 0.3, 0.3, 0.0], strict=True)], ids=str
)
@pytest.mark.parametrize("method", [SURFACE], indirect=True)
def test_over_the_outer_edge_and_back(cell, friction, method):
    """Nodes lose their pairs beyond the edge of a base, and get them again."""
    scene = DrivenBlock(cell, friction=friction, width=2.0, shift=0.55)
    contact, paired, forces = scene.contact, [], []
    zero = (0.0,) * (scene.gdim - 2)
    for x in (0.0, 0.3, 0.6, 0.9, 1.2, 0.9, 0.6, 0.3, 0.0):
        scene.top.move((x, *zero, -0.02))
        scene.problem.solve()
        assert scene.problem.report.iterations <= 12
        assert np.isfinite(scene.u.x.array).all() and np.isfinite(contact.multiplier).all()
        paired.append(int(contact.discrete.master.paired.sum()))
        forces.append(contact.force[-1])
        assert np.all(np.isnan(contact.discrete.nodes.gap) == ~contact.discrete.master.paired)
    print(paired, [f"{f:.4f}" for f in forces])
    assert paired[4] < paired[0] == paired[-1]
    assert min(forces) > 0 and max(forces) < 0.05
    assert forces[-1] == pytest.approx(forces[0], rel=0.05)


@both_slidings
def test_a_failed_step_is_undone_and_its_repetition_is_the_same(sliding):
    """To the same bits; the next step gives what it gives without the failure."""
    results = []
    for fails in (False, True):
        scene = Blocks(CellType.tetrahedron, down=0.02)
        contact = scene.contact(sliding, friction=0.3, method=SURFACE)
        problem = scene.problem(contact)
        problem.solve()
        if fails:
            before = {name: a.copy() for name, a in contact.discrete.save().items()}
            u = scene.u.x.array.copy()
            scene.bcs[-1].g.value[...] = -1e300
            with pytest.raises(cx.ConvergenceError):
                problem.solve()
            after = contact.discrete.save()
            assert np.array_equal(scene.u.x.array, u)
            for name, array in before.items():
                np.testing.assert_array_equal(after[name], array, err_msg=name)
        scene.bcs[-1].g.value[...] = -0.04
        scene.bcs[-2].g.value[...] = 0.01
        problem.solve()
        results.append((scene.u.x.array.copy(), contact.multiplier.copy()))
    for one, other in zip(*results, strict=True):
        assert np.array_equal(one, other)


@pytest.mark.parametrize("method", [SURFACE], indirect=True)
def test_one_facet_on_one_facet(method):
    """Neo-Hookean bodies of a single cell each."""
    scene = DrivenBlock(CellType.hexahedron, material=neo_hookean, n_upper=1, n_lower=1)
    for down in (-0.1, -0.2, -0.3):
        scene.step(0.0, 0.0, down)
    assert scene.normal > 0.05
    assert max(scene.iterations) <= 10


def test_a_tower_ties_over_a_gap():
    """The gap stays, and the force is that of two boxes that are one."""
    tower = Tower(CELLS[3], 3, 4, tied=True, gap=0.1, method=SURFACE)
    tower.solve(*lift(3, 0.1))
    assert tower.contact.force == pytest.approx(lift(3, -0.05), abs=1e-12)
