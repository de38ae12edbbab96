# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What surface-to-surface contact promises: patch test, means, balance, roles, edges, ties."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from patch_scene import Patch, Shape
from scenes import CELLS, Blocks, dimension, hertz_sphere
from scenes.covering import SLIDINGS, covering
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean
from scenes.tower import Tower, lift
from scenes.transforms import rotation

SURFACE, NODE = "surface-to-surface", "node-to-surface"
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


@covering(cell=CELLS, sliding=SLIDINGS, friction=(0.0, 0.3), method=(NODE, SURFACE))
def test_contact_is_lost_and_closes_again(cell, sliding, friction, method):
    scene = Blocks(cell)
    contact = scene.contact(sliding, friction=friction)
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


EXACT = 1e-9
# Seed of the rotation (none: upright), options of the shape, options of the patch
CASES = {
    "upright": (None, {}, {}),
    "regular": (None, {"distortion": 0.0}, {}),
    "turned": (1, {}, {}),
    "soft_upper": (2, {}, {"young": (0.1, 1.0)}),
    "soft_lower": (3, {}, {"young": (1.0, 0.1)}),
    "very_soft": (4, {}, {"young": (1.0, 1e-3)}),
    "leaning": (5, {"lean": 0.6}, {"lateral": 1.0, "young": (0.5, 1.0)}),
    "friction": (6, {}, {"friction": 0.3}),
    "tied": (7, {}, {"tied": True}),
}
SLAVES = ("upper", "lower")


def make(cell, n, case, **options):
    """A case on n[0] cells against n[1] along each edge."""
    seed, shape, patch = CASES[case]
    if seed is not None:
        shape = {**shape, "turn": rotation(np.random.default_rng(seed), dimension(cell))}
    return Patch(Shape(cell, *n, **shape), **patch, **options)


def worst(patch):
    """Largest errors of stress and pressure, relative to the pressure."""
    patch.problem.solve()
    errors = patch.stress_errors().max(), patch.pressure_errors().max()
    print(
        f"{patch.problem.report.iterations} iterations, stress {errors[0]:.1e}, p {errors[1]:.1e}"
    )
    return np.array(errors)


@covering(cell=CELLS, case=CASES, slave=SLAVES, sliding=SLIDINGS)
def test_surface_to_surface(cell, case, slave, sliding):
    patch = make(cell, (4, 3), case, slave=slave, sliding=sliding, method=SURFACE)
    assert np.all(worst(patch) <= EXACT)


@pytest.mark.parametrize(
    ("cell", "case"), [*zip(CELLS, ["friction", "tied", "very_soft", "turned"], strict=True)]
)
def test_condensed(cell, case):
    patch = make(cell, (4, 3), case, method=SURFACE, petsc_options={"pc_type": "condensed"})
    assert np.all(worst(patch) <= EXACT)


@pytest.mark.parametrize(
    ("cell", "case"),
    [*((CELLS[i % 4], case) for i, case in enumerate(CASES)), *((c, "turned") for c in CELLS[:2])],
)
def test_node_to_surface_needs_meshes_that_match(cell, case):
    """Exact where nodes meet; else off, by a tenth of the pressure and more."""
    assert np.all(worst(make(cell, (3, 3), case, method=NODE)) <= EXACT)
    assert np.all(worst(make(cell, (4, 3), case, method=NODE)) > 1e-3)


@pytest.mark.parametrize("cell", CELLS[:2], ids=lambda cell: cell.name)
def test_node_to_surface_is_no_better_on_finer_meshes(cell):
    errors = [worst(make(cell, (4 * k, 3 * k), "upright", method=NODE)) for k in (1, 2, 4)]
    assert np.all(errors[-1] > 0.5 * errors[0])
    assert np.all(worst(make(cell, (16, 12), "upright", method=SURFACE)) <= EXACT)


@covering(cell=CELLS, slave=SLAVES, seed=range(2))
def test_random_scenes(cell, slave, seed):
    rng = np.random.default_rng(seed)
    shape = Shape(
        cell,
        *(int(n) for n in rng.integers(1, 6, size=2)),
        seed=seed,
        lean=rng.uniform(-1, 1),
        turn=rotation(rng, dimension(cell)),
    )
    young = (1.0, rng.uniform(0.5, 1.0))
    assert np.all(
        worst(Patch(shape, slave=slave, young=young, lateral=1.0, method=SURFACE)) <= EXACT
    )


@pytest.mark.parametrize(
    ("seed", "sliding"), [(0, "finite"), (4, "small"), (5, "finite"), (7, "small")]
)
def test_distorted_quadrilaterals(seed, sliding):
    """Nodes move by up to a quarter of a cell; inverse maps of such facets are no polynomials."""
    shape = Shape(CellType.hexahedron, distortion=0.25, seed=seed)
    assert np.all(worst(Patch(shape, sliding=sliding, method=SURFACE)) <= EXACT)


@covering(cell=CELLS, method=(NODE, SURFACE), slave=SLAVES, sliding=SLIDINGS)
def test_slave_beyond_the_edge(cell, method, slave, sliding):
    """Of the outermost slave facets a fifth, little or next to nothing is covered.

    What little of a node is covered may bear a pressure far above the others, but no force.
    """
    n, forces = 4 if slave == "upper" else 3, {}
    area = n ** (1 - dimension(cell))
    for covered in (0.05, 1e-8, -1e-8):
        shape = Shape(cell, 4, 3, distortion=0.0, shift=1 / n - covered)
        patch = Patch(shape, slave=slave, sliding=sliding, method=method)
        patch.problem.solve()
        contact, p = patch.contact, patch.pressure
        pressure, nodal = contact.multiplier / p, contact.multiplier * contact.area / (p * area)
        forces[covered] = float(np.linalg.norm(contact.force)) / p
        print(
            f"{covered:g}: pressures up to {pressure.max():.2f}, nodal forces {nodal.max():.2f}, "
            f"force {forces[covered]:.6f}"
        )
        assert np.all((pressure >= 0) & (pressure <= 20) & (nodal <= 2))
    whole = (1 - 1 / n) ** (dimension(cell) - 1)
    assert whole <= forces[-1e-8] <= 1.5 * whole
    assert forces[1e-8] == pytest.approx(forces[-1e-8], rel=0.01)
