# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The coefficient of friction zero, by whatever way, is contact without friction."""

import functools

from mpi4py import MPI

import numpy as np
import pytest

from dolfinx import fem, mesh

from scenes import hertz_sphere
from scenes.covering import METHODS, SLIDINGS, covering

pytestmark = pytest.mark.usefixtures("method")


def constant(value):
    return fem.Constant(mesh.create_unit_interval(MPI.COMM_SELF, 1), value)


@functools.cache
def solved(sliding, method):
    problem, contact = hertz_sphere(0.04, sliding)
    problem.solve()
    return problem, contact


both_slidings = pytest.mark.parametrize("sliding", ["finite", "small"])


@covering(friction=(0, 0.0, constant(0.0), 1e-12), sliding=SLIDINGS, method=METHODS)
def test_hertz_is_the_same(sliding, friction, method):
    first, plain = solved(sliding, method)
    problem, contact = hertz_sphere(0.04, sliding, friction=friction)
    problem.solve()
    size = np.abs(first.u.x.array).max()
    off = {
        "u": np.abs(problem.u.x.array - first.u.x.array).max() / size,
        "force": np.abs(contact.force - plain.force).max() / plain.force[2],
        "pressure": np.abs(contact.pressure.x.array - plain.pressure.x.array).max()
        / plain.pressure.x.array.max(),
        "traction": np.abs(contact.traction.x.array - plain.traction.x.array).max()
        / plain.pressure.x.array.max(),
    }
    print(problem.report.iterations, {name: f"{value:.1e}" for name, value in off.items()})
    # Surface-to-surface has unit normals with friction, which lie in planes of symmetry; without
    # it the forces of a node's facets are added, each along its own normal
    same = method == "node-to-surface" or friction in (0, 0.0)
    assert max(off.values()) <= (1e-8 if same else 0.01)
    assert np.array_equal(contact.status.x.array > 0, plain.status.x.array > 0)
    gap, expected = contact.gap.x.array, plain.gap.x.array
    assert np.array_equal(np.isnan(gap), np.isnan(expected))
    assert np.nanmax(np.abs(gap - expected)) <= (1e-8 if same else 1e-4) * size


@both_slidings
def test_nothing_tangential_exists_without_friction(sliding, method):
    _, contact = solved(sliding, method)
    discrete = contact.discrete
    assert contact.multiplier.shape == (len(contact.slave_nodes),)
    assert discrete.history is None
    for array in (discrete.nodes.slip, discrete.nodes.normal, discrete.nodes.mobile):
        assert array.size == 0
    for array in (discrete.nodes.by_slip, discrete.nodes.by_normal):
        assert array.size == 0
    assert all(pairs.slip is None for pairs in discrete.pairs)
    forms = contact.forms()
    assert forms.multiplier_size == 1
    for form in forms.K + forms.B + forms.C:
        assert len(form._cpp_object.coefficients) == 6
    for name in ("slip", "slip_total"):
        assert not getattr(contact, name).x.array.any()
