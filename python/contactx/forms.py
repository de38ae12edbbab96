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
from contactx.parallel.halo import Halo
from dolfinx import cpp, fem, la


@dataclass(frozen=True)
class Pairs:
    """Pairs of slave nodes, or of slave facets, with master facets of one kind.

    Attributes:
        slaves: Slave nodes by their number in the contact, those of other ranks last: one a pair,
            or those of a slave facet, shape (num_pairs, num_slaves).
        nodes: The slave nodes and the master facet's nodes, numbered as all nodes of this rank:
            the blocks of the displacement's dofmap, then the halo, shape (num_pairs, num_slaves +
            num_nodes).
        data: What the kernels read of a pair, as cpp/contactx/kernel/layout.h says, shape
            (num_pairs, size).
        slip: What they read of slip a slave node, else None: shape (num_pairs, 6) with a facet,
            (num_pairs, 12) with a rigid obstacle.
        is_movement: Whether they measure slip alone: pairs of facets of the step's start.
    """

    slaves: npt.NDArray[np.int32]
    nodes: npt.NDArray[np.int32]
    data: npt.NDArray[np.float64]
    slip: npt.NDArray[np.float64] | None = None
    is_movement: bool = False

    @property
    def num_nodes(self) -> int:
        """Nodes of the master facet, 0 for a rigid obstacle."""
        return int(self.nodes.shape[1] - self.slaves.shape[1])

    def same(self, other: Any) -> bool:
        """Whether others have the same nodes, so that forms of these serve them, too."""
        return (
            self.is_movement == other.is_movement
            and np.array_equal(self.nodes, other.nodes)
            and np.array_equal(self.slaves, other.slaves)
        )

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """Unit normals that the search found for single slave nodes, shape (num_pairs, 3)."""
        at = core.rigid_layout if self.num_nodes == 0 else core.pair_layout
        return self.data[:, at["normal"] : at["normal"] + 3]


# Of masters in Python, or of those in the core
type AnyPairs = Pairs | core.Pairs


@dataclass(frozen=True)
class State:
    """Vectors of the slave nodes that the kernels read, those of other ranks last.

    Attributes:
        multiplier: Multiplier of the slave nodes, force/area: pressure or traction.
        area: Reference area of the slave nodes.
        gap_derivative: Derivative of the complementarity function with respect to the gap.
        slip_derivative: With respect to the slip; None for scalar multipliers.
        normal_derivative: With respect to the normal; None for scalar multipliers.
    """

    multiplier: la.Vector
    area: la.Vector
    gap_derivative: la.Vector
    slip_derivative: la.Vector | None = None
    normal_derivative: la.Vector | None = None

    @staticmethod
    def of(gdim: int, slave_map: Any, *, is_vector: bool) -> State:
        """Make the vectors, zero.

        Args:
            gdim: Geometric dimension.
            slave_map: Index map of the slave nodes.
            is_vector: Whether the multiplier is a vector.
        """

        def vector(block: int) -> la.Vector:
            return la.vector(slave_map, block)

        return State(
            multiplier=vector(gdim if is_vector else 1),
            area=vector(1),
            gap_derivative=vector(gdim if is_vector else 1),
            slip_derivative=vector(gdim * gdim) if is_vector else None,
            normal_derivative=vector(gdim * gdim) if is_vector else None,
        )


class ContactForms:
    """Forms over the pairs of one contact with facets of one kind.

    The displacement's spaces borrow the dofs of the bulk, the multiplier's those of the slave
    nodes, so a form is assembled straight into vectors and matrices of either. Forms that vanish,
    or that other pairs have, are None.

    Attributes:
        pairs: The pairs.
        gap: Gap of each slave node, a vector of the slave nodes.
        normal: Normal of its master, of unit length but for a mean over facets; for vector
            multipliers.
        slip: Its slip, or its movement along with the normal part; for vector multipliers.
        residual: Contact forces -A lambda . (v_s - sum_l N_l v_l), a vector of the bulk.
        stiffness: Derivative of the residual with respect to the displacement; it vanishes in
            small sliding, and for vector multipliers on a rigid obstacle.
        traction: Derivative of the residual with respect to the multiplier.
        constraint: Derivative of the complementarity function with respect to the displacement.
    """

    gap: fem.Form | None
    normal: fem.Form | None
    slip: fem.Form | None
    residual: fem.Form | None
    stiffness: fem.Form | None
    traction: fem.Form | None
    constraint: fem.Form | None

    def __init__(self, law: str, sliding: str, pairs: AnyPairs, state: State, halo: Halo):
        """Create the forms of this rank's pairs; they know nothing of other ranks.

        Args:
            law: "frictionless", "frictional" or "tied".
            sliding: "finite" or "small".
            pairs: The pairs.
            state: Vectors that the forms read at each assembly.
            halo: Nodes of this rank, with displacement and position, which the forms read, too.
        """
        self.pairs = pairs
        comm = MPI.COMM_SELF
        num_pairs, num_slaves = pairs.slaves.shape
        gdim = halo.gdim
        kind = (pairs.num_nodes, gdim, num_slaves)
        self._num_slaves: int = len(state.area.array)
        # The kernels of a tie measure movement
        law = "tied" if pairs.is_movement else law
        mesh = contact_mesh.carrier(comm, num_pairs)
        pair_map = cpp.common.IndexMap(comm, num_pairs)
        self._pair_data = la.vector(pair_map, pairs.data.shape[1])
        self._slip_data = None if pairs.slip is None else la.vector(pair_map, pairs.slip.shape[1])
        self.update(pairs)

        vectors = {
            "displacement": halo.displacement,
            "position": halo.position,
            "pair": self._pair_data,
            "slip": self._slip_data,
            **vars(state),
        }
        sites: dict[str, tuple[Any, npt.NDArray[np.int32]]] = {
            "nodes": (halo.index_map, pairs.nodes),
            "pair": (pair_map, np.arange(num_pairs, dtype=np.int32)[:, None]),
            "slave": (state.area.index_map, pairs.slaves),
        }
        spaces: dict[tuple[str, int], Any] = {}
        coefficients = []
        for name, site, size in core.coefficients(law, *kind):
            if (site, size) not in spaces:
                spaces[site, size] = contact_mesh.borrow(mesh, *sites[site], size)
            coefficients.append(
                cpp.fem.Function_float64(spaces[site, size], vectors[name]._cpp_object)
            )
        terms = core.terms(law, sliding, *kind)
        if pairs.is_movement:
            terms = [term for term in terms if term in ("slip", "constraint")]
        U = spaces["nodes", gdim]
        S = spaces["slave", state.multiplier.block_size]
        arguments = {
            "gap": [spaces["slave", 1]],
            "normal": [S],
            "slip": [S],
            "residual": [U],
            "stiffness": [U, U],
            "traction": [U, S],
            "constraint": [S, U],
        }

        def form(term: str, cells: npt.NDArray[np.int32]) -> fem.Form | None:
            if term not in terms:
                return None
            address, active = core.kernel(law, sliding, term, *kind)
            integrals = {fem.IntegralType.cell: [(0, address, cells, active)]}
            make = fem.form_cpp_class(np.float64)
            return fem.Form(make(arguments[term], integrals, coefficients, [], False, [], mesh))

        self._form = form
        every = np.arange(num_pairs, dtype=np.int32)
        for term in arguments:
            setattr(self, term, form(term, every))

    def blocks(self, which: npt.NDArray[np.bool_]) -> list[fem.Form | None]:
        """Forms of the Jacobian over the pairs of some slave nodes.

        Args:
            which: Slave nodes, shape (n,).

        Returns:
            Stiffness, traction and constraint; None for those that vanish.
        """
        others = np.zeros(self._num_slaves - len(which), dtype=bool)
        chosen = np.concatenate([which, others])[self.pairs.slaves].any(axis=1)
        if chosen.all():
            return [self.stiffness, self.traction, self.constraint]
        cells = np.flatnonzero(chosen).astype(np.int32)
        return [self._form(term, cells) for term in ("stiffness", "traction", "constraint")]

    def update(self, pairs: AnyPairs) -> None:
        """Take over new data of the same pairs."""
        self.pairs = pairs
        self._pair_data.array[:] = pairs.data.ravel()
        if self._slip_data is not None and pairs.slip is not None:
            self._slip_data.array[:] = pairs.slip.ravel()
