# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear hexahedra that bend: elasticity without shear locking, and stresses at the nodes.

A trilinear hexahedron cannot take the shape of a bent beam; it shears instead and is far too
stiff. The cure is old: each shear strain is taken in the middle of the cell as far as the two
directions that it connects go, where the false shear is zero, and with two points along the
third. All other terms keep the full rule, so that no mode of deformation without energy appears.
Shear strains are those of the cell's own directions, so that its place in space does not matter.
"""

from __future__ import annotations

from itertools import combinations, product
from typing import Any

import numpy as np
import numpy.typing as npt

import contactx  # noqa: F401 - before dolfinx
import ufl
from dolfinx import fem, la, mesh

# Two Gauss points and the middle of the unit interval
_TWO = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3)
_ONE = np.array([0.5])
_PAIRS = tuple(combinations(range(3), 2))


def _measures(domain: mesh.Mesh) -> list[ufl.Measure]:
    """Measures of all cells: the full rule, then one reduced along each pair of directions."""
    rules = [(_TWO, _TWO, _TWO)]
    for pair in _PAIRS:
        rules.append(tuple(_ONE if k in pair else _TWO for k in range(3)))
    cells = np.arange(domain.topology.index_map(3).size_local, dtype=np.int32)
    # One kernel for all rules would be wrong in FFCx 0.11: its Jacobian does not know rotations.
    # Integrals over subdomains of their own have kernels of their own.
    parts = [(i, cells) for i in range(1, 1 + len(rules))]
    measures = []
    for (i, _), rule in zip(parts, rules, strict=True):
        points = np.array(list(product(*rule)))
        metadata = {
            "quadrature_rule": "custom",
            "quadrature_points": points,
            "quadrature_weights": np.full(len(points), 1 / len(points)),
        }
        measures.append(ufl.Measure("dx", domain, subdomain_data=parts, metadata=metadata)(i))
    return measures


def strain(u: Any) -> Any:
    """Linear strain."""
    return ufl.sym(ufl.grad(u))


def isotropic(e: Any, young: Any, nu: Any) -> Any:
    """Stress of a linear strain in space, force/area."""
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    return 2 * mu * e + lmbda * ufl.tr(e) * ufl.Identity(3)


def stress(u: Any, young: Any, nu: Any) -> Any:
    """Cauchy stress of linear elasticity, force/area."""
    return isotropic(strain(u), young, nu)


def elasticity(u: fem.Function, young: Any, nu: float) -> ufl.Form:
    """Residual of linear elasticity on trilinear hexahedra that do not lock when they bend.

    Args:
        u: Displacement in the linear Lagrange space.
        young: Young's modulus, force/area, a number or constant on each cell.
        nu: Poisson's ratio.
    """
    v = ufl.TestFunction(u.function_space)
    domain = u.function_space.mesh
    J = ufl.Jacobian(domain)
    columns = [ufl.as_vector([J[k, i] for k in range(3)]) for i in range(3)]
    along = [column / ufl.sqrt(ufl.dot(column, column)) for column in columns]
    G = young / (2 * (1 + nu))
    full = ufl.inner(stress(u, young, nu), strain(v))
    dx, *reduced = _measures(domain)
    form = 0
    for (i, j), measure in zip(_PAIRS, reduced, strict=True):
        shear = 4 * G * ufl.dot(along[i], strain(u) * along[j])
        work = shear * ufl.dot(along[i], strain(v) * along[j])
        full -= work
        form += work * measure
    return form + full * dx


class NodalStress:
    """A stress at the nodes: extrapolated from the Gauss points, averaged over a node's cells.

    Bodies share no nodes, so that each has its own average.

    Attributes:
        values: The stress as a function of the linear space.
    """

    def __init__(self, stress: Any, domain: mesh.Mesh, name: str):
        """Compile the stress.

        Args:
            stress: UFL expression, a scalar.
            domain: Mesh of hexahedra.
            name: Name of the function.
        """
        points = np.array(list(product(_TWO, repeat=3)))
        Q = fem.functionspace(domain, ("Lagrange", 1))
        self.values = fem.Function(Q, name=name)
        self._expression = fem.Expression(stress, points)
        # As many points as nodes: the values at the points determine a trilinear function
        at_points = Q.element.basix_element.tabulate(0, points)[0, :, :, 0]
        self._extrapolate = np.linalg.inv(at_points)
        # Cells of other ranks are counted there
        self._cells = np.arange(domain.topology.index_map(3).size_local, dtype=np.int32)
        self._dofs = Q.dofmap.list[self._cells]
        self._count = self._sums(np.ones(self._dofs.size))

    def update(self) -> npt.NDArray[np.float64]:
        """Evaluate the stress now; all ranks must take part.

        Returns:
            The nodal values, shape (num_nodes,).
        """
        at_points = self._expression.eval(self.values.function_space.mesh, self._cells)
        nodal = at_points.reshape(len(self._dofs), -1) @ self._extrapolate.T
        self.values.x.array[:] = self._sums(nodal.ravel()) / self._count
        return self.values.x.array

    def _sums(self, values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Sums of what cells give at their nodes, over all ranks."""
        x = self.values.x
        x.array[:] = np.bincount(self._dofs.ravel(), values, minlength=len(x.array))
        x.scatter_reverse(la.InsertMode.add)
        x.scatter_forward()
        return x.array.copy()
