# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fluid that presses on what is not in contact."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.checks import described
from contactx._host.parallel.reduce import agreed, anywhere
from contactx.contact import Contact, check_contacts
from contactx.surface import Surface
from dolfinx import fem, mesh

type Marker = Callable[[npt.NDArray[np.float64]], npt.NDArray[np.bool_]]


class FluidPenetration:
    """Part of a surface that a fluid wets: it spreads from where it enters up to closed contacts.

    The fluid goes from node to node along the surface, and along the slave surfaces of the
    contacts. It does not enter a slave node in contact, or tied. A node of a meshed master is
    wetted where the slave nodes in front of it are, so that both sides end at the same place, and
    elsewhere like any other surface. See ``results/wetted.h`` and howto/fluid of the manual.

    ``wet`` is a factor of the pressure in the residual, that of a pressure which turns with the
    surface, with n = J inv(F).T N, for example::

        residual += p * fluid.wet * ufl.dot(v, J * ufl.inv(F).T * N) * ds(tags)

    It is zero at first, so that contact is found without the fluid. All ranks must take part.

    Attributes:
        surface: What may be wetted.
        entry: Where the fluid enters.
        contacts: Contacts that stop it.
        wet: 1 at vertices that are wetted, 0 at others, linear between them.
    """

    def __init__(
        self,
        domain: mesh.Mesh,
        surface: Surface,
        *,
        entry: Surface | Marker,
        contacts: Sequence[Contact],
    ):
        """Create a dry surface.

        Args:
            domain: The displacement's mesh.
            surface: Facets that may be wetted, of all bodies, those that may come into contact
                among them.
            entry: Where the fluid enters, on each body that it wets: a surface, of which the
                vertices that ``surface`` has count; or a function of positions, shape (3, n), in
                the reference configuration, that returns which of them it enters at, shape (n,),
                like those of ``mesh.locate_entities_boundary``.
            contacts: Contacts that stop the fluid, those of rigid obstacles among them. All belong
                to one problem by the first ``update``.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If a surface belongs to another mesh, or the fluid enters nowhere.
        """
        if not isinstance(domain, mesh.Mesh):
            raise TypeError(f"domain must be a dolfinx Mesh, not {described(domain)}")
        if not isinstance(surface, Surface):
            raise TypeError(
                f"surface must be a contactx.Surface, not {described(surface)}: write "
                "Surface(facet_tags, 1, 2)"
            )
        if not (isinstance(entry, Surface) or callable(entry)):
            raise TypeError(
                f"entry must be a contactx.Surface or a function of positions, not "
                f"{described(entry)}: write Surface(facet_tags, 3), or lambda x: x[1] > 2.0"
            )
        check_contacts(contacts)
        surface.cells_and_facets(domain)
        self.surface = surface
        self.entry = entry
        self.contacts = list(contacts)
        self._Q = Q = fem.functionspace(domain, ("Lagrange", 1))
        self.wet = fem.Function(Q, name="wet")
        self._entry = fem.Function(Q)
        vertices = _vertices(Q, surface)
        if isinstance(entry, Surface):
            entry.cells_and_facets(domain)
            chosen = np.intersect1d(vertices, _vertices(Q, entry))
        else:
            with agreed(domain.comm):
                x = Q.tabulate_dof_coordinates()[vertices].T
                marks = np.asarray(entry(x))
                if marks.shape != vertices.shape or marks.dtype != np.bool_:
                    raise TypeError(
                        f"entry returns an array of {marks.dtype} of shape {marks.shape} for "
                        f"positions of shape {x.shape}: return a truth value for each"
                    )
                chosen = vertices[marks]
        if not anywhere(domain.comm, len(chosen) > 0):
            raise ValueError(
                f"the fluid enters nowhere: entry has no vertex of {surface}; give one that it has"
            )
        self._entry.x.array[chosen] = 1
        self._facets: tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]] | None = None
        self._vertex: npt.NDArray[np.int32] | None = None

    def update(self) -> bool:
        """Let the fluid spread, for contacts as they are now; all ranks must take part.

        Call it between solves, and solve again while it returns true::

            while fluid.update():
                problem.solve()

        Returns:
            Whether ``wet`` has changed.

        Raises:
            RuntimeError: If a contact belongs to no problem yet.
            ValueError: If contacts belong to several problems, or to one on another mesh.
        """
        contacts = [contact.discrete for contact in self.contacts]
        halo = contacts[0].halo
        V: fem.FunctionSpace = halo.host.space
        if V.mesh is not self._Q.mesh or any(c.halo is not halo for c in contacts):
            raise ValueError(
                "the contacts of a FluidPenetration belong to several problems, or to one on "
                "another mesh: give those of one problem, on the mesh of the surface"
            )
        if self._facets is None:
            facets = self.surface.facet_nodes(V)
            self._facets = facets.offsets, facets.nodes
            self._vertex = _vertex_of_node(V, self._Q)
        assert self._vertex is not None
        vertex = self._vertex[: halo.num_owned]
        is_vertex = vertex >= 0
        entry = np.zeros(halo.num_owned, dtype=np.int8)
        entry[is_vertex] = self._entry.x.array[vertex[is_vertex]]
        wetted = core.wetted_nodes(halo.nodes, *self._facets, entry, contacts)
        before = self.wet.x.array.copy()
        self.wet.x.array[vertex[is_vertex]] = wetted[is_vertex]
        self.wet.x.scatter_forward()
        return anywhere(halo.comm, bool(np.any(self.wet.x.array != before)))


def _vertices(Q: fem.FunctionSpace, surface: Surface) -> npt.NDArray[np.int32]:
    """Dofs of a linear space at the vertices of a surface, of all ranks that have them."""
    facet_dim = Q.mesh.topology.dim - 1
    dofs = fem.locate_dofs_topological(Q, facet_dim, surface.facets)
    vertices: npt.NDArray[np.int32] = np.unique(dofs).astype(np.int32)
    return vertices


def _vertex_of_node(V: fem.FunctionSpace, Q: fem.FunctionSpace) -> npt.NDArray[np.int32]:
    """Dof of the linear space Q at each node of V, -1 at nodes that are no vertices."""
    index_map = V.dofmap.index_map
    vertex = np.full(index_map.size_local + index_map.num_ghosts, -1, dtype=np.int32)
    cells = Q.dofmap.list
    # Nodes of a cell begin with its vertices
    vertex[V.dofmap.list[:, : cells.shape[1]].ravel()] = cells.ravel()
    return vertex
