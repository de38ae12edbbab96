# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Expressions and quadrature functions as Lagrange functions, by projection."""

from __future__ import annotations

from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import basix
import dolfinx.fem.petsc
import ufl
from contactx._host.checks import described
from contactx._host.nodal_values import matching_nodes
from dolfinx import fem, la
from ufl.algorithms import extract_arguments, extract_coefficients
from ufl.domain import extract_domains

# Far below what the projection is off by itself
_RTOL = 1e-12


class Projection:
    """The Lagrange function that is closest to an expression, in the mean of squares (L2).

    Write von Mises' stress, plastic strain and whatever else has values inside of cells alone::

        P0 = fem.functionspace(mesh, ("Discontinuous Lagrange", 0))
        mises = cx.Projection(ufl.sqrt(3 / 2 * ufl.inner(s, s)), P0, name="mises")
        with cx.VTKOutput("run.pvd", u, contacts, fields=[mises]) as output:

    A discontinuous space takes each cell by itself: its values of degree 0 are means of the cells,
    within the range of the expression, and nothing is smeared over interfaces. A continuous one has
    a value at each node, which contours need, and overshoots a little where the expression jumps.
    Functions of quadrature spaces in the expression are read at their own points, whose rule is
    taken for the projection, too.

    Attributes:
        function: The function, as of the last ``update``.
    """

    def __init__(
        self,
        expression: ufl.core.expr.Expr,
        V: fem.FunctionSpace,
        *,
        dx: ufl.Measure | None = None,
        name: str | None = None,
    ):
        """Assemble the mass matrix and project; all ranks must take part.

        Args:
            expression: An expression of UFL, such as a stress, or a function, also of a quadrature
                space. Its coefficients may change later.
            V: Lagrange space of the expression's shape, continuous or not.
            dx: Measure to integrate the expression with: with other quadrature, or over a
                subdomain, outside of which the expression counts as zero. All cells, and the
                quadrature that UFL estimates, if None.
            name: Name of the function, for files.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If V is no Lagrange space or has another shape than the expression, this has
                test functions in it or is on another mesh, or its quadrature functions are of
                several rules, or of one too coarse for V.
        """
        points = _check(expression, V, dx)
        measure = ufl.dx(domain=V.mesh.ufl_domain()) if dx is None else dx
        if points is not None:
            rule = dict(zip(("quadrature_points", "quadrature_weights"), points, strict=True))
            measure = measure(metadata={"quadrature_rule": "custom", **rule})
        self.function = fem.Function(V) if name is None else fem.Function(V, name=name)
        self._form = fem.form(ufl.inner(expression, ufl.TestFunction(V)) * measure)
        self._b = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
        # All components have the mass matrix of one
        element = V.ufl_element()
        scalar = element.sub_elements[0] if element.block_size > 1 else element
        Q = fem.functionspace(V.mesh, scalar)
        self._nodes = matching_nodes(V, Q)[: V.dofmap.index_map.size_local]
        mass = ufl.TrialFunction(Q) * ufl.TestFunction(Q) * ufl.dx
        self._A = dolfinx.fem.petsc.assemble_matrix(fem.form(mass))
        self._A.assemble()
        # Well conditioned on any mesh once its diagonal is one (Wathen 1987), so that a few
        # iterations are exact, without the memory of factors; of degree 0 one iteration
        self._ksp = PETSc.KSP().create(V.mesh.comm)
        self._ksp.setOperators(self._A)
        self._ksp.setType("cg")
        self._ksp.getPC().setType("jacobi")
        self._ksp.setTolerances(rtol=_RTOL)
        self._ksp.setErrorIfNotConverged(True)
        self.update()

    def update(self) -> fem.Function:
        """Project the expression as it is now; all ranks must take part.

        Returns:
            ``function``.
        """
        size = self.function.function_space.dofmap.index_map_bs
        self._b.array[:] = 0
        fem.assemble_vector(self._b.array, self._form)
        self._b.scatter_reverse(la.InsertMode.add)
        moments = self._b.array.reshape(-1, size)[: len(self._nodes)]
        values = self.function.x.array.reshape(-1, size)[: len(self._nodes)]
        x, b = self._A.createVecs()
        for k in range(size):
            b.array[self._nodes] = moments[:, k]
            self._ksp.solve(b, x)
            values[:, k] = x.array[self._nodes]
        self.function.x.scatter_forward()
        return self.function


type _Rule = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


def _check(expression: Any, V: Any, dx: Any) -> _Rule | None:
    """Check what is to be projected.

    Returns:
        Points and weights of the quadrature functions in the expression, None if there are none.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If one does not fit.
    """
    if not isinstance(expression, ufl.core.expr.Expr):
        raise TypeError(f"expression is {described(expression)}: give an expression of UFL")
    if not isinstance(V, fem.FunctionSpace):
        raise TypeError(f"V is {described(V)}: give a fem.FunctionSpace")
    if not (dx is None or isinstance(dx, ufl.Measure)) or (dx and dx.integral_type() != "cell"):
        raise TypeError(f"dx is {described(dx)}: give a measure of cells, ufl.dx, or None")
    element, shape = V.ufl_element(), V.value_shape
    if element.element_family != basix.ElementFamily.P or element.block_size != np.prod(shape):
        raise ValueError(
            f"V is of {element}: give a Lagrange space, continuous or not, of all components, as "
            'functionspace(mesh, ("Discontinuous Lagrange", 0))'
        )
    if extract_arguments(expression):
        raise ValueError("expression has test or trial functions in it: give one of known values")
    if expression.ufl_shape != shape:
        raise ValueError(
            f"expression has the shape {expression.ufl_shape}, and functions of V have {shape}: "
            f"give V the shape of the expression, the third entry of {_wanted(expression)}"
        )
    if any(domain is not V.mesh.ufl_domain() for domain in extract_domains(expression)):
        raise ValueError("expression is on another mesh than V: give both the same mesh")
    elements = [c.ufl_element() for c in extract_coefficients(expression)]
    rules = [e.custom_quadrature() for e in elements if e.has_custom_quadrature]
    if not rules:
        return None
    points, weights = rules[0]
    if not all(len(p) == len(points) and np.allclose(p, points) for p, _ in rules):
        raise ValueError(
            "expression has functions of several quadrature rules in it: give a Projection for each"
        )
    cell = V.mesh.basix_cell()
    exact = basix.make_quadrature(cell, 2 * element.degree)
    sums = [w @ V.element.basix_element.tabulate(0, p)[0, :, :, 0] for p, w in (rules[0], exact)]
    if not np.allclose(*sums):
        raise ValueError(
            f"expression is of a quadrature rule of {len(points)} points, which is too coarse for "
            f"V of degree {element.degree}: give a space of a lower degree"
        )
    return points, weights


def _wanted(expression: ufl.core.expr.Expr) -> str:
    return f'functionspace(mesh, ("Discontinuous Lagrange", 0, {expression.ufl_shape}))'
