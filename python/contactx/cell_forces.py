# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces of the cells before their sum, which rounding errors go with where they cancel."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import basix.ufl
import ufl
from contactx.compat import forget_derivatives
from contactx.parallel.halo import Halo
from contactx.refined import degree_of
from dolfinx import fem, la


class CellForces:
    """Sizes of the contributions of cells and terms to a residual.

    A residual in a space that is broken between the cells has them side by side. What is written
    as one term, such as a stress less that of a thermal strain, has cancelled before.
    """

    def __init__(self, F: ufl.Form, u: fem.Function, halo: Halo, options: dict[str, Any]):
        """Take the residual; nothing is compiled before it is asked for.

        Args:
            F: Residual.
            u: Displacement.
            halo: Nodes of this rank.
            options: Options of the compilation of forms.
        """
        self._F = F
        self._u = u
        self._halo = halo
        self._options = options
        self._terms: list[fem.Form] = []

    def magnitudes(self) -> npt.NDArray[np.float64]:
        """Sum over cells and terms of the size of the force on each owned node, shape (num_owned,).

        All ranks must take part.
        """
        V = self._u.function_space
        if not self._terms:
            self._terms = self._compiled()
        W = self._terms[0].function_spaces[0]
        gdim = V.dofmap.index_map_bs
        cells = slice(V.mesh.topology.index_map(V.mesh.topology.dim).size_local)
        nodes, broken = V.dofmap.list[cells], W.dofmap.map()[cells]
        sums = np.zeros(self._halo.num_nodes)
        b = la.vector(W.dofmap.index_map, gdim)
        for term in self._terms:
            b.array[:] = 0
            fem.assemble_vector(b.array, term)
            b.scatter_reverse(la.InsertMode.add)
            sizes = np.linalg.norm(b.array.reshape(-1, gdim), axis=1)
            np.add.at(sums, nodes, sizes[broken])
        return self._halo.scatter_reverse(sums)

    def _compiled(self) -> list[fem.Form]:
        V = self._u.function_space
        domain = V.mesh
        element = basix.ufl.element(
            "Lagrange", domain.basix_cell(), degree_of(V), discontinuous=True,
            shape=V.ufl_element().reference_value_shape,
        )  # fmt: skip
        w = ufl.TestFunction(fem.functionspace(domain, element))
        (v,) = self._F.arguments()
        broken = ufl.replace(ufl.algorithms.expand_derivatives(self._F), {v: w})
        terms = [fem.form(ufl.Form([i]), **self._options) for i in broken.integrals()]
        forget_derivatives()
        return terms
