# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz in the plane: an elastic cylinder on an elastic block."""

import hertz_cylinder
import numpy as np
import pytest

import reference


def errors(h, sliding):
    """Relative errors of half-width and peak pressure."""
    problem, contact = hertz_cylinder.create(h, sliding)
    problem.solve()
    assert problem.report.iterations <= 10
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-12
    E, nu = hertz_cylinder.E, hertz_cylinder.NU
    hertz = reference.HertzCylinder(
        force=2 * contact.force[1], radius=1.0, modulus=reference.contact_modulus(E, nu, E, nu)
    )
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    width = hertz_cylinder.half_width(x, contact.multiplier)
    result = (
        width / hertz.half_width - 1,
        contact.multiplier.max() / hertz.peak_pressure - 1,
    )
    print(f"{sliding} h={h}: half-width {result[0]:+.4f}, peak pressure {result[1]:+.4f}")
    return np.abs(result)


@pytest.mark.usefixtures("method")
@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_default_mesh(sliding):
    assert np.all(errors(0.006, sliding) <= 0.03)


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_finer_is_better(sliding):
    assert np.all(errors(0.002, sliding) < errors(0.006, sliding))
