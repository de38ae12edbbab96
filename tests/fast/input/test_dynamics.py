# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What ContactDynamics refuses."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem

from inputs.rows import refused, scene, table


def dynamics(**changed):
    """Make a problem of which something is changed."""

    def do():
        blocks = scene()
        u = changed.pop("u", blocks.u)
        v = ufl.TestFunction(blocks.u.function_space)
        given = {
            "forces": lambda w: ufl.inner(ufl.grad(w), ufl.grad(v)) * ufl.dx,
            "density": 1.0,
            "contacts": [blocks.contact()],
            "petsc_options_prefix": "never_",
            **{k: make(blocks) if callable(make) else make for k, make in changed.items()},
        }
        cx.ContactDynamics(given.pop("forces"), u, **given)

    return do


def made(value):
    """An argument that is a function itself."""
    return lambda _: value


def negative(blocks):
    """A density that is negative in a part of the bodies."""
    x = ufl.SpatialCoordinate(blocks.u.function_space.mesh)
    return x[0] - 0.5


def around(blocks):
    """A density of an axisymmetric model whose mesh touches the axis."""
    return 2 * ufl.pi * ufl.SpatialCoordinate(blocks.u.function_space.mesh)[0]


def energy(blocks):
    return ufl.inner(blocks.u, blocks.u) * ufl.dx


ROWS = {
    TypeError: [
        (dynamics(u=3), "u must be a dolfinx.fem.Function"),
        (dynamics(forces=3), "forces is int 3: give a function"),
        (dynamics(forces=made(lambda a, b, c: a)), "takes 3 arguments: give"),
        (dynamics(forces=made(lambda a: 3)), "forces gives a int: let it"),
        (dynamics(density="1"), "density is str '1': give a number or"),
        (dynamics(loads=3.0), "loads is float 3.0: give a UFL form"),
        (dynamics(strain_energy=1), "strain_energy is int 1: give a function"),
        (dynamics(impact_travel="0.1"), "impact_travel is str '0.1': give a"),
    ],
    ValueError: [
        (dynamics(density=0.0), "density is 0.0: give a finite number above 0"),
        (dynamics(density=np.nan), "density is nan: give a finite number"),
        (dynamics(density=negative), "masses that are not positive"),
        (dynamics(density=around), 'without a mass: .* Give mass="consistent"'),
        (dynamics(loads=energy), "loads has 0 arguments: give a form"),
        (dynamics(impact_travel=0.0), "impact_travel is 0.0: give a number"),
        (dynamics(mass="none"), "mass is str 'none': give \"lumped\" or"),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)


def test_a_consistent_mass_may_touch_the_axis():
    dynamics(density=around, mass="consistent")()


def test_lumped_masses_of_quadratic_elements_are_refused():
    blocks = scene()
    V = fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 2, (2,)))
    with pytest.raises(ValueError, match="for linear elements, and u is of degree 2: leave"):
        cx.ContactDynamics(
            lambda w: ufl.inner(w, ufl.TestFunction(V)) * ufl.dx,
            fem.Function(V),
            density=1.0,
            mass="lumped",
            contacts=[blocks.contact()],
            petsc_options_prefix="never_",
        )
