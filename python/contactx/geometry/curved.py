# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Curved cells, which a displacement of a lower degree does not follow."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

import basix
from contactx import cpp as core
from contactx.parallel import reduce
from contactx.refined import degree_of
from contactx.surface import Surface
from dolfinx import fem, mesh

if TYPE_CHECKING:
    from contactx.contact import Contact

# Distance from the straight facet, over its size: less is the rounding of a mesh generator
_STRAIGHT = 1e-6


def check_straight(contacts: Sequence[Contact], V: fem.FunctionSpace) -> None:
    """Check that contact surfaces are as the displacement has them; all ranks must take part.

    Contact sees a facet at the nodes of the displacement: a linear one straight, a quadratic one
    curved where the mesh is of order 2. The bulk may be curved elsewhere.

    Args:
        contacts: Contacts of a problem.
        V: Space of the displacement.

    Raises:
        ValueError: If a contact surface is curved on any rank, on all ranks.
    """
    domain = V.mesh
    degree = domain.geometry.cmaps[0].degree
    if degree in (1, degree_of(V)):
        return
    for k, contact in enumerate(contacts):
        for name in ("slave", "master"):
            surface = getattr(contact, name)
            # One of another mesh is refused where its facets are looked for
            ours = domain.topology._cpp_object
            if isinstance(surface, Surface) and surface.facet_tags.topology is ours:
                _check_surface(f"{name} {surface} of contact {k}", surface, domain)


def _check_surface(name: str, surface: Surface, domain: mesh.Mesh) -> None:
    away, size, at = _deviations(surface, domain)
    curved = away > _STRAIGHT * size
    count = int(reduce.total(domain.comm, int(curved.sum())))
    if count == 0:
        return
    places = [tuple(x) for x in at[curved]]
    place = np.array(reduce.first(domain.comm, places, places))
    most = reduce.largest(domain.comm, float(away.max(initial=0.0)))
    extent = float(reduce.extent(domain.comm, domain.geometry.x).max())
    raise ValueError(
        f"{name} is curved: the mesh is of order {domain.geometry.cmaps[0].degree}, and {count} of "
        f"these facets have nodes up to {most:.3g} away from where straight ones have them, first "
        f"at {core.point_text(place, extent)}. Contact and the displacement take facets as "
        "straight: make the mesh of order 1, in gmsh by gmsh.model.mesh.setOrder(1), and finer "
        "where it is round; or of order 2 with a displacement of degree 2 "
        "(manual: errors/refused-mesh)"
    )


def _deviations(
    surface: Surface, domain: mesh.Mesh
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Distances of the nodes of the geometry from where straight facets have them.

    Args:
        surface: Part of the boundary.
        domain: Its mesh, of degree 2 or more.

    Returns:
        Largest distance at each facet whose cell this rank owns, the facet's size, and where the
        node is, shape (n,), (n,) and (n, gdim).
    """
    topology, geometry = domain.topology, domain.geometry
    tdim = topology.dim
    topology.create_connectivity(tdim - 1, tdim)
    topology.create_connectivity(tdim, tdim - 1)
    to_cells = topology.connectivity(tdim - 1, tdim)
    # Facets without a cell on this rank have none to look at
    facets = surface.facets[np.diff(to_cells.offsets)[surface.facets] > 0]
    cells = to_cells.array[to_cells.offsets[facets]]
    mine = cells < topology.index_map(tdim).size_local
    facets, cells = facets[mine], cells[mine]
    to_facets = topology.connectivity(tdim, tdim - 1)
    per_cell = len(to_facets.links(0)) if to_facets.num_nodes > 0 else 1
    facets_of_cell = to_facets.array.reshape(-1, per_cell)
    local = np.argmax(facets_of_cell[cells] == facets[:, None], axis=1)

    cmap = geometry.cmaps[0]
    straight, vertices = _linear_shape(cmap, topology.cell_type)
    layout = cmap.create_dof_layout()
    x = geometry.x[geometry.dofmaps[0][cells], : geometry.dim]
    ideal = np.einsum("lv,nvk->nlk", straight, x[:, vertices])
    n = len(facets)
    away, size, at = np.zeros(n), np.zeros(n), np.zeros((n, geometry.dim))
    for i in range(per_cell):
        which = np.flatnonzero(local == i)
        closure = np.array(layout.entity_closure_dofs(tdim - 1, i))
        here = x[np.ix_(which, closure)]
        distance = np.linalg.norm(here - ideal[np.ix_(which, closure)], axis=2)
        away[which] = distance.max(axis=1, initial=0.0)
        at[which] = here[np.arange(len(which)), distance.argmax(axis=1)]
        size[which] = np.linalg.norm(np.ptp(here, axis=1), axis=1)
    return away, size, at


def _linear_shape(
    cmap: Any, cell_type: mesh.CellType
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Linear shape functions at the nodes of the geometry, and which of these are vertices.

    Args:
        cmap: Coordinate element.
        cell_type: Type of the cells.

    Returns:
        Values, shape (num_nodes, num_vertices), and nodes, shape (num_vertices,).
    """
    kind = basix.CellType[cell_type.name]
    family, variant = basix.ElementFamily.P, basix.LagrangeVariant(cmap.variant)
    points = basix.create_element(family, kind, cmap.degree, variant).points
    linear = basix.create_element(family, kind, 1)
    values: npt.NDArray[np.float64] = np.asarray(linear.tabulate(0, np.asarray(points)))[0, :, :, 0]
    return values, values.argmax(axis=0)
