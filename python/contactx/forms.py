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
        slip: What they read where slip is measured, else None: shape (num_pairs, 6) or
            (num_pairs, 12).
    """

    slaves: npt.NDArray[np.int32]
    nodes: npt.NDArray[np.int32]
    data: npt.NDArray[np.float64]
    slip: npt.NDArray[np.float64] | None = None

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """Unit normals that the search found, shape (num_pairs, 3)."""
        at = core.rigid_layout if self.nodes.shape[1] == 1 else core.pair_layout
        return self.data[:, at["normal"] : at["normal"] + 3]


@dataclass(frozen=True)
class State:
    """Vectors that the kernels read.

    Attributes:
        displacement: Displacement of the bulk.
        position: Reference position of the bulk's nodes.
        multiplier: Multiplier of the slave nodes, force/area: pressure or traction.
        area: Reference area of the slave nodes.
        gap_derivative: Derivative of the complementarity function with respect to the gap.
        slip_derivative: With respect to the slip; None for scalar multipliers.
        normal_derivative: With respect to the normal; None for scalar multipliers.
    """

    displacement: la.Vector
    position: la.Vector
    multiplier: la.Vector
    area: la.Vector
    gap_derivative: la.Vector
    slip_derivative: la.Vector | None = None
    normal_derivative: la.Vector | None = None

    @staticmethod
    def of(u: fem.Function, X: la.Vector, slave_map: Any, *, is_vector: bool) -> State:
        """Make the vectors of the slave nodes, zero.

        Args:
            u: Displacement.
            X: Reference positions of its nodes.
            slave_map: Index map of the slave nodes.
            is_vector: Whether the multiplier is a vector.
        """
        gdim = X.block_size

        def vector(block: int) -> la.Vector:
            return la.vector(slave_map, block)

        return State(
            displacement=u.x,
            position=X,
            multiplier=vector(gdim if is_vector else 1),
            area=vector(1),
            gap_derivative=vector(gdim if is_vector else 1),
            slip_derivative=vector(gdim * gdim) if is_vector else None,
            normal_derivative=vector(gdim * gdim) if is_vector else None,
        )


class ContactForms:
    """Forms over the pairs of one contact with facets of one kind.

    The displacement's spaces borrow the dofs of the bulk, the multiplier's those of the slave
    nodes, so a form is assembled straight into vectors and matrices of either.

    Attributes:
        gap: Gap of each slave node, a vector of the slave nodes.
        normal: Unit normal of its master; None for scalar multipliers.
        slip: Its slip; None for scalar multipliers.
        residual: Contact forces -A lambda . (v_s - sum_l N_l v_l), a vector of the bulk.
        stiffness: Derivative of the residual with respect to the displacement; None where it
            vanishes: small sliding, and vector multipliers on a rigid obstacle.
        traction: Derivative of the residual with respect to the multiplier.
        constraint: Derivative of the complementarity function with respect to the displacement.
    """

    def __init__(
        self,
        comm: MPI.Comm,
        law: str,
        sliding: str,
        pairs: Pairs,
        state: State,
        bulk_map: Any,
        slave_map: Any,
    ):
        """Create the forms.

        Args:
            comm: Communicator.
            law: "frictionless", "frictional" or "tied".
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
        self._slip_data = None if pairs.slip is None else la.vector(pair_map, pairs.slip.shape[1])
        self.update(pairs)

        vectors = {"pair": self._pair_data, "slip": self._slip_data, **state.__dict__}
        sites: dict[str, tuple[Any, npt.NDArray[np.int32]]] = {
            "nodes": (bulk_map, pairs.nodes),
            "pair": (pair_map, np.arange(num_pairs, dtype=np.int32)[:, None]),
            "slave": (slave_map, pairs.slaves[:, None]),
        }
        spaces: dict[tuple[str, int], Any] = {}
        coefficients = []
        for name, site, size in core.coefficients(law, width - 1, gdim):
            if (site, size) not in spaces:
                spaces[site, size] = contact_mesh.borrow(mesh, *sites[site], size)
            coefficients.append(
                cpp.fem.Function_float64(spaces[site, size], vectors[name]._cpp_object)
            )
        is_vector = pairs.slip is not None
        U, S = spaces["nodes", gdim], spaces["slave", gdim if is_vector else 1]

        def form(term: str, *arguments: Any) -> fem.Form:
            address, active = core.kernel(law, sliding, term, width - 1, gdim)
            cells = np.arange(num_pairs, dtype=np.int32)
            integrals = {fem.IntegralType.cell: [(0, address, cells, active)]}
            make = fem.form_cpp_class(np.float64)
            return fem.Form(make(list(arguments), integrals, coefficients, [], False, [], mesh))

        turns = sliding == "finite" and not (is_vector and width == 1)
        self.gap = form("gap", spaces["slave", 1])
        self.normal = form("normal", S) if is_vector else None
        self.slip = form("slip", S) if is_vector else None
        self.residual = form("residual", U)
        self.stiffness = form("stiffness", U, U) if turns else None
        self.traction = form("traction", U, S)
        self.constraint = form("constraint", S, U)

    def update(self, pairs: Pairs) -> None:
        """Take over new data of the same pairs."""
        self._pair_data.array[:] = pairs.data.ravel()
        if self._slip_data is not None and pairs.slip is not None:
            self._slip_data.array[:] = pairs.slip.ravel()
