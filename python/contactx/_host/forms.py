# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of one contact, assembled by DOLFINx from the kernels of the C++ core."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host import contact_mesh
from contactx._host.parallel.reduce import everywhere, largest
from contactx.cpp import Pairs
from dolfinx import cpp, fem, la

if TYPE_CHECKING:
    from contactx._host.discrete_contact import DiscreteContact

# Pairs of one kind: numbers of slave and master nodes, whether they measure movement alone
type Kind = tuple[int, int, int]

# The part of the system that is assembled from each term of the kernels
_PARTS = {"residual": "F_u", "stiffness": "K", "traction": "B", "constraint": "C"}
_PAIR_DATA = ("pair", "slip")
# Most nodes of a facet
_MOST = 9
# Of the messages in which index maps find out who has their ghosts
_TAG = 7091


class ContactForms:
    """Residual and Jacobian of one contact, as forms of DOLFINx.

    The parts are those of [[K, B], [C, D]] and [F_u, F_lambda]; the unknowns are the displacement
    and the multipliers of the slave nodes, force/area. Each part is a list of forms that add up,
    one for each kind of master facet; it is empty where the part vanishes, as K does in small
    sliding. The forms are assembled as any others: the spaces of the displacement borrow the dofs
    of the bulk, those of the multipliers have a block a slave node. Dofs of the displacement that
    only the contact needs are further ghosts, behind those of the bulk, so that vectors and
    matrices of the forms are made with ``displacement_map``.

    The forms read the state of contact as it was at the last call of ``Contact.forms``. Gap, normal
    and slip need no form: the core assembles them.

    Attributes:
        F_u: Forces of contact, -A lambda . (v_s - sum_l N_l v_l), linear in a displacement.
        F_lambda: Complementarity function, a force, linear in a multiplier.
        K: Derivative of F_u with respect to the displacement.
        B: Derivative of F_u with respect to the multiplier.
        C: Derivative of F_lambda with respect to the displacement.
        D: Derivative of F_lambda with respect to the multiplier, a block a slave node.
        version: Counts how often the forms have been made anew, as pairs or ghosts are others:
            matrices of other versions have other patterns. The same on all ranks.
        displacement_map: Index map of the displacement's blocks, those of the bulk first.
        multiplier_map: Index map of the slave nodes: those that this rank owns, then those of
            other ranks that share facets with them.
        multiplier_size: Components of a multiplier: 1, or the geometric dimension.
    """

    def __init__(self, discrete: DiscreteContact):
        """Make the forms; all ranks must take part.

        Args:
            discrete: Discrete side of the contact.
        """
        self._discrete, self._halo = discrete, discrete.halo
        nodes, g = discrete.nodes, discrete.halo.gdim
        self.multiplier_size = size = nodes.size
        self.multiplier_map = self._slave_map()
        self.version = 0
        # What the forms read, and where it comes from
        self._sources: dict[str, Callable[[], npt.NDArray[np.float64]]] = {
            "multiplier": lambda: nodes.multiplier,
            "area": lambda: nodes.area,
            "gap_derivative": lambda: nodes.by_gap,
            "complementarity": lambda: nodes.value,
            "multiplier_derivative": lambda: nodes.by_multiplier,
        }
        sizes = dict(zip(self._sources, (size, 1, size, size, size * size), strict=True))
        if discrete.law.is_vector:
            self._sources["slip_derivative"] = lambda: nodes.by_slip
            self._sources["normal_derivative"] = lambda: nodes.by_normal
            sizes |= {"slip_derivative": g * g, "normal_derivative": g * g}
        self._state = {name: la.vector(self.multiplier_map, n) for name, n in sizes.items()}
        self._state["area"].array[:] = core.area_elsewhere
        self._nodal = self._of_nodes()
        self._made_for: tuple[str, int] | None = None
        self._pairs: dict[Kind, Pairs] = {}
        self._data: dict[Kind, dict[str, la.Vector]] = {}

    def update(self) -> None:
        """Take over the pairs and the state as they are now; all ranks must take part."""
        pairs = {_kind(group): group for group in self._discrete.pairs}
        made_for = (self._discrete.kinematics, self._halo.version)
        same = self._made_for == made_for and pairs.keys() == self._pairs.keys()
        same = same and all(group.same(self._pairs[kind]) for kind, group in pairs.items())
        if not everywhere(self._halo.comm, same):
            self._made_for = made_for
            self._make(pairs)
        self._pairs = pairs
        self._of_bulk["displacement"].array[:] = self._halo.displacement.array
        for kind, group in pairs.items():
            for name, vector in self._data[kind].items():
                vector.array[:] = getattr(group, "data" if name == "pair" else name).ravel()
        for name, source in self._sources.items():
            values = source().ravel()
            self._state[name].array[: len(values)] = values

    def _slave_map(self) -> Any:
        """Index map of the slave nodes."""
        halo, slaves = self._halo, self._discrete.slave_nodes
        n = len(slaves.owned)
        mine = cpp.common.IndexMap(halo.comm, n)
        if halo.comm.size == 1:
            return mine
        numbers = np.zeros(halo.num_owned, dtype=np.int64)
        numbers[slaves.owned] = mine.local_range[0] + np.arange(n)
        others = np.asarray(slaves.around[n:], dtype=np.int32)
        ghosts = halo.scatter_forward(numbers)[others]
        return cpp.common.IndexMap(halo.comm, n, ghosts, halo.owners(others), _TAG)

    def _make(self, pairs: dict[Kind, Pairs]) -> None:
        self.version += 1
        halo = self._halo
        self.displacement_map = halo.host.full_map
        self._of_bulk = {
            name: la.vector(self.displacement_map, halo.gdim)
            for name in ("displacement", "position")
        }
        self._of_bulk["position"].array[:] = halo.position.array
        self.F_u: list[fem.Form] = []
        self.K: list[fem.Form] = []
        self.B: list[fem.Form] = []
        self.C: list[fem.Form] = []
        self.F_lambda, self.D = ([form] for form in self._nodal)
        # All ranks have the same forms, be it without pairs
        kinds = np.zeros((_MOST + 1, _MOST + 1, 2))
        for kind in pairs:
            kinds[kind] = 1
        found = np.argwhere(largest(halo.comm, kinds)).tolist()
        self._data = {
            (s, m, is_movement): self._of_pairs((s, m, is_movement), pairs.get((s, m, is_movement)))
            for s, m, is_movement in found
        }

    def _of_nodes(self) -> tuple[fem.Form, fem.Form]:
        """Forms of the part that slave nodes have by themselves."""
        n, size = self.multiplier_map.size_local, self.multiplier_size
        mesh = contact_mesh.carrier(self._halo.comm, n)
        own = np.arange(n, dtype=np.int32)
        S, T = (
            contact_mesh.borrow(mesh, self.multiplier_map, own[:, None], width)
            for width in (size, size * size)
        )
        values, derivatives = (
            cpp.fem.Function_float64(space, self._state[name]._cpp_object)
            for space, name in ((S, "complementarity"), (T, "multiplier_derivative"))
        )
        return (
            form_of(mesh, own, [S], core.nodal_kernel(size), [0], [values]),
            form_of(mesh, own, [S, S], core.nodal_kernel(size * size), [0], [derivatives]),
        )

    def _of_pairs(self, kind_of_pairs: Kind, pairs: Pairs | None) -> dict[str, la.Vector]:
        """Append the forms of pairs of one kind; returns the vectors of their data."""
        halo, discrete = self._halo, self._discrete
        num_slaves, num_nodes, is_movement = kind_of_pairs
        num_pairs = 0 if pairs is None else len(pairs.slaves)
        slaves = np.zeros((0, num_slaves), np.int32) if pairs is None else pairs.slaves
        nodes = np.zeros((0, num_slaves + num_nodes), np.int32) if pairs is None else pairs.nodes
        kind = (num_nodes, halo.gdim, num_slaves)
        # The kernels of a tie measure movement
        law = "tied" if is_movement else discrete.law.name
        mesh = contact_mesh.carrier(halo.comm, num_pairs)
        pair_map = mesh.topology.index_map(mesh.topology.dim)
        every = np.arange(num_pairs, dtype=np.int32)
        sites: dict[str, tuple[Any, npt.NDArray[np.int32]]] = {
            "nodes": (self.displacement_map, nodes),
            "pair": (pair_map, every[:, None]),
            "slave": (self.multiplier_map, slaves),
        }
        table = core.coefficients(law, *kind)
        data = {name: la.vector(pair_map, size) for name, _, size in table if name in _PAIR_DATA}
        vectors = self._state | self._of_bulk | data
        spaces: dict[tuple[str, int], Any] = {}
        coefficients = []
        for name, site, size in table:
            if (site, size) not in spaces:
                spaces[site, size] = contact_mesh.borrow(mesh, *sites[site], size)
            coefficients.append(
                cpp.fem.Function_float64(spaces[site, size], vectors[name]._cpp_object)
            )
        U, S = spaces["nodes", halo.gdim], spaces["slave", self.multiplier_size]
        arguments = {"F_u": [U], "K": [U, U], "B": [U, S], "C": [S, U]}
        terms = core.terms(law, discrete.kinematics, *kind)
        for term, part in _PARTS.items():
            if term in terms and (term == "constraint" or not is_movement):
                address, active = core.kernel(law, discrete.kinematics, term, *kind)
                form = form_of(mesh, every, arguments[part], address, active, coefficients)
                getattr(self, part).append(form)
        return data


def _kind(pairs: Pairs) -> Kind:
    return pairs.slaves.shape[1], pairs.num_nodes, int(pairs.is_movement)


def form_of(
    mesh: Any,
    cells: npt.NDArray[np.int32],
    spaces: list[Any],
    address: int,
    active: npt.ArrayLike,
    coefficients: list[Any],
) -> fem.Form:
    """A form over cells of a carrier mesh.

    Args:
        mesh: Carrier mesh.
        cells: The cells.
        spaces: Spaces of the arguments.
        address: Address of the kernel.
        active: Numbers of the coefficients that it reads.
        coefficients: Coefficients, in the order of their values.
    """
    kernel = (0, address, cells, np.asarray(active, dtype=np.int8))
    integrals = {fem.IntegralType.cell: [kernel]}
    make = fem.form_cpp_class(np.float64)
    return fem.Form(make(spaces, integrals, coefficients, [], False, [], mesh))
