# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of one contact, assembled by DOLFINx from the kernels of the C++ core."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import contact_mesh
from contactx import cpp as core
from dolfinx import cpp, fem, la


@dataclass(frozen=True)
class Pairs:
    """Pairs of slave nodes with facets of one kind.

    Attributes:
        slaves: Slave nodes, by their number in the contact, shape (num_pairs,).
        nodes: The slave node and the facet's nodes, numbered as the blocks of the
            displacement's dofmap, shape (num_pairs, 1 + num_nodes).
        data: What the kernels read of a pair, as cpp/contactx/kernel/layout.h says: shape
            (num_pairs, 9) with a facet, (num_pairs, 16) with a rigid obstacle.
    """

    slaves: npt.NDArray[np.int32]
    nodes: npt.NDArray[np.int32]
    data: npt.NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """Vectors that the kernels read.

    Attributes:
        displacement: Displacement of the bulk.
        position: Reference position of the bulk's nodes.
        multiplier: Pressure of the slave nodes, force/area.
        area: Reference area of the slave nodes.
        gap_derivative: Derivative of the complementarity function with respect to the gap.
    """

    displacement: la.Vector
    position: la.Vector
    multiplier: la.Vector
    area: la.Vector
    gap_derivative: la.Vector


class ContactForms:
    """Forms over the pairs of one contact with facets of one kind.

    The displacement's spaces borrow the dofs of the bulk, the multiplier's those of the slave
    nodes, so a form is assembled straight into vectors and matrices of either.

    Attributes:
        gap: Gap of each slave node, a vector of the slave nodes.
        residual: Contact forces -A p n . (v_s - sum_l N_l v_l), a vector of the bulk.
        stiffness: Derivative of the residual with respect to the displacement; None for small
            sliding, where it vanishes.
        traction: Derivative of the residual with respect to the multiplier.
        constraint: Derivative of the complementarity function with respect to the displacement.
    """

    def __init__(
        self,
        comm: MPI.Comm,
        sliding: str,
        pairs: Pairs,
        state: State,
        bulk_map: Any,
        slave_map: Any,
    ):
        """Create the forms.

        Args:
            comm: Communicator.
            sliding: "finite" or "small".
            pairs: The pairs.
            state: Vectors that the forms read at each assembly.
            bulk_map: Index map of the bulk's nodes.
            slave_map: Index map of the slave nodes.
        """
        num_pairs, width = pairs.nodes.shape
        gdim = state.displacement.block_size
        mesh = contact_mesh.carrier(comm, num_pairs)
        pair_map = cpp.common.IndexMap(comm, num_pairs)
        self._pair_data = la.vector(pair_map, pairs.data.shape[1])
        self.update(pairs)

        vectors = {"pair": self._pair_data, **state.__dict__}
        sites: dict[str, tuple[Any, npt.NDArray[np.int32]]] = {
            "nodes": (bulk_map, pairs.nodes),
            "pair": (pair_map, np.arange(num_pairs, dtype=np.int32)[:, None]),
            "slave": (slave_map, pairs.slaves[:, None]),
        }
        spaces: dict[tuple[str, int], Any] = {}
        self._coefficients = []
        for name, site, size in core.coefficients(width - 1):
            key = (site, size or gdim)
            if key not in spaces:
                spaces[key] = contact_mesh.borrow(mesh, *sites[site], key[1])
            self._coefficients.append(
                cpp.fem.Function_float64(spaces[key], vectors[name]._cpp_object)
            )
        U, S = spaces["nodes", gdim], spaces["slave", 1]

        def form(term: str, *arguments: Any) -> fem.Form:
            address, active = core.kernel(sliding, term, width - 1, gdim)
            cells = np.arange(num_pairs, dtype=np.int32)
            integrals = {fem.IntegralType.cell: [(0, address, cells, active)]}
            make = fem.form_cpp_class(np.float64)
            return fem.Form(
                make(list(arguments), integrals, self._coefficients, [], False, [], mesh)
            )

        self.gap = form("gap", S)
        self.residual = form("residual", U)
        self.stiffness = form("stiffness", U, U) if sliding == "finite" else None
        self.traction = form("traction", U, S)
        self.constraint = form("constraint", S, U)

    def update(self, pairs: Pairs) -> None:
        """Take over new local coordinates of the same pairs."""
        self._pair_data.array[:] = pairs.data.ravel()
