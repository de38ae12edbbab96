# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The bulk as the core sees it."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import basix.ufl
import ufl
from contactx._host.bulk import Bulk
from contactx._host.compat import forget_derivatives
from contactx._host.nodes import degree_of, linear_cells, parts_of_cells
from contactx._host.parallel.halo import Halo
from dolfinx import fem, la

type Array = npt.NDArray[np.float64]


class BulkHost:
    """The bulk, as the core's ``newton::Bulk`` describes it."""

    def __init__(self, bulk: Bulk, halo: Halo):
        """Take the bulk and its nodes."""
        self._bulk = bulk
        self._halo = halo
        self.gdim = halo.gdim
        V = bulk.u.function_space
        topology = V.mesh.topology
        owned = topology.index_map(topology.dim).size_local
        self.cells = linear_cells(V)[: owned * parts_of_cells(V)]
        self.nodes_per_cell = self.cells.shape[1]
        self.fields = FieldsHost(bulk) if bulk.fields else None
        self._cell_forces: CellForces | None = None
        if bulk.residual_form is not None:
            self._cell_forces = CellForces(bulk.residual_form, bulk.u, halo, bulk.form_options)

    def read(self) -> None:
        """Take what the user's functions have now, and give ghosts the owners' displacements."""
        self._bulk.read()
        self._halo.update_ghosts()

    @property
    def has_own_jacobian(self) -> bool:
        """True if the user gave the Jacobian."""
        return self._bulk.has_own_jacobian

    @property
    def is_linear(self) -> bool:
        """True if the stiffness does not depend on the displacement."""
        return self._bulk.is_linear

    @property
    def reference(self) -> Array:
        """Reference positions of all nodes."""
        return self._halo.x

    def positions(self) -> Array:
        """Current positions of all nodes."""
        return self._halo.positions()

    @property
    def displacements(self) -> Array:
        """Displacements at owned dofs."""
        u: Array = self._bulk.u.x.array[: self._halo.num_owned * self.gdim]
        return u

    @property
    def markers(self) -> npt.NDArray[np.int8]:
        """1 at owned dofs with a Dirichlet condition."""
        return self._bulk.markers[: self._halo.num_owned * self.gdim]

    def diagonal(self) -> Array:
        """Diagonal of the stiffness at owned dofs."""
        return self._bulk.diagonal()

    def products(self, fields: Array) -> Array:
        """Products of the stiffness with fields at owned dofs, shape (count, num_dofs)."""
        return self._bulk.products(fields)

    def residual(self) -> Array:
        """Forces at owned dofs, without Dirichlet conditions."""
        return self._bulk.residual()

    def defect(self) -> Array:
        """Displacements minus Dirichlet values at owned dofs."""
        return self._bulk.dirichlet_defect()[: self._halo.num_owned * self.gdim]

    def lifted(self) -> Array:
        """Residual of other rows from Dirichlet values that displacements do not have yet."""
        return self._bulk.lifted()

    def set_displacements(self, u: Array) -> None:
        """Set displacements at owned dofs, and those of other ranks' nodes."""
        self._bulk.u.x.array[: len(u)] = u
        self._halo.update_ghosts()
        self._bulk.write()

    def cell_sizes(self) -> Array:
        """Size of the largest cell around each owned node."""
        return self._bulk.cell_sizes()

    def cell_forces(self) -> Array:
        """Sum over cells and terms of the size of their force on each owned node."""
        assert self._cell_forces is not None
        return self._cell_forces.magnitudes()


class FieldsHost:
    """The fields beside the displacement, as the core's ``newton::Fields`` describes them."""

    def __init__(self, bulk: Bulk):
        """Take the bulk."""
        self._bulk = bulk
        self._functions = bulk.unknowns.functions
        self.offsets = np.cumsum([0, *(len(dofs) for _, dofs in bulk.fields)]).tolist()

    def values(self) -> Array:
        """Values of now."""
        return self._bulk.of_fields([w.x.array for w in self._functions])

    def set(self, values: Array) -> None:
        """Set them, ghosts included."""
        parts = np.split(values, self.offsets[1:-1])
        for (k, dofs), part in zip(self._bulk.fields, parts, strict=True):
            self._functions[k].x.array[dofs] = part
        for k in sorted({k for k, _ in self._bulk.fields}):
            self._functions[k].x.scatter_forward()

    @property
    def follow_contacts(self) -> bool:
        """True if their residuals depend on contacts."""
        return bool(self._bulk.conductances)

    def residual(self) -> Array:
        """Their rows of the residual assembled last."""
        return self._bulk.rows_of_fields("residual")

    def lifted(self) -> Array:
        """Their rows of what was lifted last."""
        return self._bulk.rows_of_fields("lifted")

    def defect(self) -> Array:
        """Values minus Dirichlet values, zero elsewhere."""
        return self._bulk.of_fields(self._bulk.blocks.defects())

    def markers(self) -> npt.NDArray[np.int8]:
        """1 at prescribed values."""
        return self._bulk.of_fields(self._bulk.blocks.markers)

    def absolute_products(self, sizes: Array) -> Array:
        """Products of the Jacobian with sizes of all unknowns, all entries by their size."""
        return self._bulk.absolute_products(sizes)


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
