# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rockfill after Duncan and Chang, the E-B model: stiffness by the stress, in increments.

Duncan, Byrne, Wong & Mabry 1980, Strength, stress-strain and bulk modulus parameters for finite
element analyses of stresses and movements in soil masses, UCB/GT/80-01.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from hexahedra import isotropic, strain

import basix.ufl
import ufl
from dolfinx import fem

Array = npt.NDArray[np.float64]

ATMOSPHERE = 0.101325
# Poisson's ratios that E and B may give
_LEAST_NU, _MOST_NU = 0.05, 0.45
# Part of the largest stress state so far below which a stress state is one of unloading
_UNLOADED = 0.75
# Part of the strength that the shear stress never exceeds in the tangent modulus
_MOST_LEVEL = 0.95
# Smallest confining stress, MPa: stones without weight on them have no stiffness
_LEAST_STRESS = 0.02


@dataclass(frozen=True)
class DuncanChang:
    """Parameters of the E-B model.

    The defaults are of the size that is published for compacted limestone rockfill; take those of
    triaxial tests for a real dam.

    Attributes:
        K: Modulus number.
        n: Its exponent.
        failure_ratio: Strength over the asymptote of the hyperbola.
        K_b: Bulk modulus number.
        m: Its exponent.
        K_ur: Modulus number of unloading and reloading.
        phi: Friction angle at one atmosphere, degrees.
        phi_loss: What it loses with a tenfold confining stress, degrees.
        unit_weight: Weight for each unit of volume, MN/m^3.
        at_rest: Horizontal stress over the vertical one as the rockfill is placed.
    """

    K: float = 940.0
    n: float = 0.35
    failure_ratio: float = 0.85
    K_b: float = 340.0
    m: float = 0.18
    K_ur: float = 1900.0
    phi: float = 54.0
    phi_loss: float = 13.0
    unit_weight: float = 21e-3
    at_rest: float = 0.4

    def level(self, largest: Array, least: Array) -> Array:
        """Shear stress over the strength.

        Args:
            largest: Largest principal stress, compression positive, MPa.
            least: Least one.
        """
        least = np.maximum(least, _LEAST_STRESS)
        phi = np.radians(self.phi - self.phi_loss * np.log10(least / ATMOSPHERE))
        strength = 2 * least * np.sin(phi) / (1 - np.sin(phi))
        return np.asarray((largest - least) / strength)

    def state(self, largest: Array, least: Array) -> Array:
        """Size of a stress state: where it falls the rockfill unloads."""
        confined = np.maximum(least, _LEAST_STRESS) / ATMOSPHERE
        return np.asarray(self.level(largest, least) * confined**0.25)

    def moduli(self, largest: Array, least: Array, most: Array) -> tuple[Array, Array]:
        """Tangent Young's modulus, MPa, and Poisson's ratio.

        Args:
            largest: Largest principal stress, compression positive, MPa.
            least: Least one.
            most: Largest stress state so far.
        """
        confined = np.maximum(least, _LEAST_STRESS) / ATMOSPHERE
        level = np.clip(self.level(largest, least), 0, _MOST_LEVEL)
        virgin = self.K * ATMOSPHERE * confined**self.n * (1 - self.failure_ratio * level) ** 2
        again = self.K_ur * ATMOSPHERE * confined**self.n
        state = self.state(largest, least)
        unloaded = np.clip((most - state) / ((1 - _UNLOADED) * np.maximum(most, 1e-30)), 0, 1)
        young = virgin + unloaded * (again - virgin)
        bulk = self.K_b * ATMOSPHERE * confined**self.m
        nu = np.clip((3 * bulk - young) / (6 * bulk), _LEAST_NU, _MOST_NU)
        return np.asarray(young), np.asarray(nu)


class Rockfill:
    """Stress of the rockfill since the slabs lie on it, in increments of constant moduli.

    The moduli of a stage are those of the stress at its start: more stages follow the stress-strain
    curve closer. They know the stress of the rockfill's own weight, a vertical stress by the depth
    below its surface and a horizontal one in proportion, which does not load the face: it was there
    before the slabs.

    Attributes:
        young: Young's modulus on each cell, MPa.
        nu: Poisson's ratio on each cell.
        history: All that belongs to the state.
    """

    def __init__(
        self,
        parameters: DuncanChang,
        u: fem.Function,
        is_rockfill: fem.Function,
        vertical: Array,
        up: Array,
        young: fem.Function,
        nu: fem.Function,
        creep: fem.Constant,
        creep_strain: Any,
    ):
        """Take the moduli of the rockfill's own weight.

        Args:
            parameters: Parameters.
            u: Displacement, m.
            is_rockfill: One in the rockfill's cells, zero elsewhere.
            vertical: Vertical stress of the own weight in all cells, compression positive, MPa.
            up: Unit vector upwards.
            young: Young's modulus of all cells; the rockfill's are overwritten.
            nu: Poisson's ratio of all cells, likewise.
            creep: Part of the creep strain that there is.
            creep_strain: All of it, in UFL.
        """
        self._parameters, self._u, self.young, self.nu = parameters, u, young, nu
        self._is_rockfill = is_rockfill
        self._cells = np.flatnonzero(is_rockfill.x.array > 0)
        by_weight = parameters.at_rest * np.eye(3) + (1 - parameters.at_rest) * np.outer(up, up)
        self._own_weight = vertical[self._cells, None, None] * by_weight
        domain = u.function_space.mesh
        element = basix.ufl.quadrature_element(domain.basix_cell(), value_shape=(3, 3), degree=2)
        Q = fem.functionspace(domain, element)
        self._stress = fem.Function(Q, name="stress")
        self._before = fem.Function(u.function_space, name="displacement before")
        self._most = fem.Function(young.function_space, name="largest stress state")
        self._creep = creep
        self._crept = fem.Function(young.function_space, name="creep before")
        self.history = [self._stress, self._before, self._most, self._crept, young, nu]
        e = strain(u - self._before) - (creep - self._crept) * creep_strain
        self._now = self._stress + isotropic(e, young, nu)
        self._expression = fem.Expression(self._now, Q.element.interpolation_points)
        self._set_moduli()

    def residual(self) -> ufl.Form:
        """Residual of the stress."""
        v = ufl.TestFunction(self._u.function_space)
        dx = ufl.dx(metadata={"quadrature_degree": 2, "quadrature_scheme": "default"})
        return self._is_rockfill * ufl.inner(self._now, strain(v)) * dx

    def commit(self) -> None:
        """Take over the stress of an accepted stage, and the moduli that it gives."""
        now = fem.Function(self._stress.function_space)
        now.interpolate(self._expression)
        self._stress.x.array[:] = now.x.array
        self._before.x.array[:] = self._u.x.array
        self._crept.x.array[:] = self._creep.value
        self._set_moduli()

    def principal_stresses(self) -> Array:
        """Principal stresses of the rockfill's cells, compression positive, MPa.

        Returns:
            The least first, shape (num_cells, 3).
        """
        dofs = self._stress.function_space.dofmap.list[self._cells]
        at_points = self._stress.x.array.reshape(-1, 3, 3)[dofs]
        total = self._own_weight - at_points.mean(axis=1)
        return np.asarray(np.linalg.eigvalsh(total))

    def _set_moduli(self) -> None:
        least, _, largest = self.principal_stresses().T
        cells, most = self._cells, self._most.x.array
        most[cells] = np.maximum(most[cells], self._parameters.state(largest, least))
        young, nu = self._parameters.moduli(largest, least, most[cells])
        self.young.x.array[cells], self.nu.x.array[cells] = young, nu
