# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Both methods on the same scenes: where they agree, and where surface to surface is better."""

from dataclasses import replace

import cattaneo_mindlin
import numpy as np
import pytest
from sliding_block import BASES, FRICTION, Slider

import meshes
import scenes
from meshes import FACE_SLABS, Tag
from slab_results import laws, measure
from slab_scene import Setting
from slab_schemes import scheme_1
from story import METHODS

MORTAR = METHODS[1]


def hertz(data, sliding, method, young=None):
    """Force of the common Hertz problem and errors of its pressures, raw and recovered."""
    scene = scenes.HertzSphere(data, sliding, method=method, young=young)
    scene.problem.solve()
    contact = scene.contact
    raw, best = (
        scenes.pressure_error(scene.problem, contact, young, p)
        for p in (contact.multiplier, contact.pressure.x.array[contact.slave_nodes])
    )
    iterations = scene.problem.report.iterations
    print(f"{sliding} {method} {young}: {iterations} iterations, p_l2 {raw:.4f}, {best:.4f}")
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-12
    assert iterations <= 12
    return 4 * contact.force[2], raw, best


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_hertz_on_hexahedra(sliding):
    """The same force; raw pressures that scatter less by half.

    They are smooth already, and recovery, which flattens the edge, makes them worse.
    """
    data = meshes.hertz_grid(0.02)
    nodes, facets = (hertz(data, sliding, method) for method in METHODS)
    assert facets[0] == pytest.approx(nodes[0], rel=3e-3)
    assert facets[1] < 0.5 * nodes[1]
    assert max(nodes[2], facets[2]) < 0.07


@pytest.mark.parametrize("body", [Tag.UPPER, Tag.LOWER])
def test_one_body_is_much_stiffer(body):
    """The multipliers of a stiff slave on a soft master are the least determined."""
    data = meshes.hertz_sphere(0.02)
    _, raw, best = hertz(data, "finite", MORTAR, {body: 1e4})
    assert raw < (0.3 if body == Tag.UPPER else 0.1)
    assert best < 0.12


def test_cylinders_on_a_coarser_master():
    """Pressure and shear spread over a master 1.5 times coarser; node to surface has 6 and 8 %."""
    h = 0.02
    scene = cattaneo_mindlin.create(h, "finite", MORTAR, 1.5 * h)
    cattaneo_mindlin.apply(scene)
    results = cattaneo_mindlin.Tractions(scene).compare(cattaneo_mindlin.formula(scene.contact))
    found = {result.name: result.error for result in results}
    print(found)
    assert abs(found["peak pressure"]) < 0.01
    assert found["pressure's difference / formula's, L2"] < 0.03
    assert found["shear's difference / formula's, L2"] < 0.07


@pytest.mark.parametrize("base", BASES)
def test_sliding_block(base):
    """The same loops; on a plane, whose gap is linear, the methods are one."""
    sliders = [Slider(0.2, 2, base, "finite", method) for method in METHODS]
    for slider in sliders:
        slider.run()
    first, forces = (np.array(slider.forces) for slider in sliders)
    apart = np.abs(forces - first).max() / (FRICTION * sliders[0].weight)
    print(f"{base}: forces {apart:.1e} of mu N apart")
    assert apart < (0.03 if base == "elastic base" else 1e-12)


def test_slice():
    """Stress and rotation of the face slabs; either side may be the slave."""
    model = replace(FACE_SLABS["slice"], layers=5, matching=False)
    found = {}
    for method in METHODS:
        for cushion in (True, False):
            setting = Setting(model, method=method, cushion_is_slave=cushion)
            scene = scheme_1(setting, 0.0909, 0.3, steps=1, progress=False)
            errors = laws(scene)
            assert max(errors.balance, errors.penetration, errors.coulomb) < 1e-8
            found[method, cushion] = measure(scene)
            print(method, cushion, found[method, cushion])
    reference = found[METHODS[0], True]
    for one in found.values():
        assert one.stress == pytest.approx(reference.stress, rel=0.04)
        assert one.rotation == pytest.approx(reference.rotation, rel=1e-3)
    assert found[MORTAR, False].stress == pytest.approx(found[MORTAR, True].stress, rel=0.015)
