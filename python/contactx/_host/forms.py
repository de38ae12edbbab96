# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of one contact, assembled by DOLFINx from the kernels of the C++ core."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host import contact_mesh
from contactx._host.parallel.halo import Halo
from contactx.cpp import Pairs
from dolfinx import cpp, fem, la


@dataclass(frozen=True)
class State:
    """Vectors of the slave nodes that the kernels read, those of other ranks last.

    They are copies: the core owns what the slave nodes have (``take``).

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
        """Make the vectors, zero but for areas of one.

        Args:
            gdim: Geometric dimension.
            slave_map: Index map of the slave nodes.
            is_vector: Whether the multiplier is a vector.
        """

        def vector(block: int) -> la.Vector:
            return la.vector(slave_map, block)

        area = vector(1)
        # Quotients by the area of slave nodes of other ranks are not used
        area.array[:] = 1
        return State(
            multiplier=vector(gdim if is_vector else 1),
            area=area,
            gap_derivative=vector(gdim if is_vector else 1),
            slip_derivative=vector(gdim * gdim) if is_vector else None,
            normal_derivative=vector(gdim * gdim) if is_vector else None,
        )

    def take(self, nodes: core.NodeState) -> None:
        """Copy the state of this rank's slave nodes as it is now.

        Args:
            nodes: The state.
        """
        for vector, values in (
            (self.multiplier, nodes.multiplier),
            (self.area, nodes.area),
            (self.gap_derivative, nodes.by_gap),
            (self.slip_derivative, nodes.by_slip),
            (self.normal_derivative, nodes.by_normal),
        ):
            if vector is not None:
                vector.array[: len(values)] = values


class ContactForms:
    """Forms over the pairs of one contact with facets of one kind.

    The displacement's spaces borrow the dofs of the bulk, the multiplier's those of the slave
    nodes, so a form is assembled straight into vectors and matrices of either. Forms that vanish,
    or that other pairs have, are None. Gap, normal and slip need no form: the core assembles them.

    Attributes:
        pairs: The pairs.
        residual: Contact forces -A lambda . (v_s - sum_l N_l v_l), a vector of the bulk.
        stiffness: Derivative of the residual with respect to the displacement; it vanishes in
            small sliding, and for vector multipliers on a rigid obstacle.
        traction: Derivative of the residual with respect to the multiplier.
        constraint: Derivative of the complementarity function with respect to the displacement.
    """

    residual: fem.Form | None
    stiffness: fem.Form | None
    traction: fem.Form | None
    constraint: fem.Form | None

    def __init__(self, law: str, sliding: str, pairs: Pairs, state: State, halo: Halo):
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
            terms = ["constraint"]
        U = spaces["nodes", gdim]
        S = spaces["slave", state.multiplier.block_size]
        arguments = {
            "residual": [U],
            "stiffness": [U, U],
            "traction": [U, S],
            "constraint": [S, U],
        }

        make, every = fem.form_cpp_class(np.float64), np.arange(num_pairs, dtype=np.int32)
        for term, spaces_of in arguments.items():
            form = None
            if term in terms:
                address, active = core.kernel(law, sliding, term, *kind)
                integrals = {fem.IntegralType.cell: [(0, address, every, active)]}
                form = fem.Form(make(spaces_of, integrals, coefficients, [], False, [], mesh))
            setattr(self, term, form)

    def update(self, pairs: Pairs) -> None:
        """Take over new data of the same pairs."""
        self.pairs = pairs
        self._pair_data.array[:] = pairs.data.ravel()
        if self._slip_data is not None and pairs.slip is not None:
            self._slip_data.array[:] = pairs.slip.ravel()
