# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Patch test: two blocks on meshes that do not match carry a uniform pressure."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from patch_scene import Patch, Shape
from scenes import CELLS, dimension
from scenes.covering import SLIDINGS, covering
from scenes.patch import WidePatch
from scenes.transforms import rotation

SURFACE, NODE = "surface-to-surface", "node-to-surface"
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


@pytest.mark.parametrize(
    ("cell", "sliding"), [*zip(CELLS, ["finite", "small", "small", "finite"], strict=True)]
)
def test_wider_master(cell, sliding):
    """Master facets that are covered in part, by a slave whose outline they do not follow."""
    turn = rotation(np.random.default_rng(8), dimension(cell))
    aligned = Shape(cell, 3, 5, distortion=0.0, turn=turn, width_lower=5 / 3, shift=1 / 3)
    assert np.all(worst(WidePatch(aligned, sliding=sliding, method=NODE)) <= EXACT)
    shape = Shape(cell, 4, 5, turn=turn, width_lower=1.6, shift=0.27)
    assert np.all(worst(WidePatch(shape, sliding=sliding, method=SURFACE)) <= EXACT)
    assert np.all(worst(WidePatch(shape, sliding=sliding, method=NODE)) > 1e-3)


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
