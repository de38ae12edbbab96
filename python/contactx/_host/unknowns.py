# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Functions that a problem solves for, and the place of the displacement in them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx._host.checks import check_displacement, described, wanted_space
from dolfinx import fem

type Index = npt.NDArray[np.int64]


class Unknowns:
    """Functions that are solved for together, one of which has the displacement.

    That is the displacement alone; one function with all there is, in a mixed space; or a function
    a block.

    Attributes:
        functions: The functions.
        displacement: Number of the displacement among the parts of a mixed space or the blocks.
        u: Displacement of the nodes, in the Lagrange space of vectors of degree 1 or 2: a copy of
            what the function has of it, kept by ``read`` and ``write``; or one of the functions
            itself.
        index: Number of the function that has the displacement.
    """

    def __init__(self, functions: Sequence[fem.Function], displacement: int, *, is_mixed: bool):
        """Find the displacement.

        Args:
            functions: The functions; of a mixed space one.
            displacement: Number of the part or block that is the displacement.
            is_mixed: Whether the parts are those of a mixed space.
        """
        self.functions = list(functions)
        self.displacement = displacement
        self.index = 0 if is_mixed else displacement
        function = self.functions[self.index]
        V = function.function_space
        part = V.sub(displacement) if is_mixed else V
        # Dofs of the function at each component of each node, ghosts included; None if it is u
        self._dofs: Index | None = None
        if not is_mixed and _is_lagrange(V.ufl_element()):
            self.u = function
        else:
            gdim, degree = V.mesh.geometry.dim, _degree_on_surface(part)
            self.u = fem.Function(fem.functionspace(V.mesh, ("Lagrange", degree, (gdim,))))
            self._dofs = _nodal_dofs(part, self.u.function_space)
            self.read()
        check_displacement(self.u)

    @property
    def is_copy(self) -> bool:
        """True if u is a copy."""
        return self._dofs is not None

    def read(self) -> None:
        """Take the displacement that the user's function has."""
        if self._dofs is not None:
            self.u.x.array[:] = self.functions[self.index].x.array[self._dofs]

    def write(self) -> None:
        """Give the user's function the displacement."""
        if self._dofs is not None:
            self.functions[self.index].x.array[self._dofs] = self.u.x.array

    @property
    def all_dofs(self) -> Index | None:
        """Dofs of that function at the displacement's, ghosts included; None if it is u itself."""
        return self._dofs

    def dofs(self) -> Index:
        """Dofs of the function that has the displacement, of owned nodes, shape (num_owned,)."""
        V = self.u.function_space
        owned = V.dofmap.index_map.size_local * V.dofmap.index_map_bs
        if self._dofs is None:
            return np.arange(owned)
        return self._dofs[:owned]

    def fields(self) -> list[tuple[int, Index]]:
        """Other fields: for each the number of its function, and its owned dofs."""
        found = []
        for k, function in enumerate(self.functions):
            V = function.function_space
            owned = V.dofmap.index_map.size_local * V.dofmap.index_map_bs
            parts = [np.arange(owned)]
            if V.num_sub_spaces > 0 and isinstance(V.ufl_element(), basix.ufl._MixedElement):
                parts = [_dofs_of(V.sub(i), owned) for i in range(V.num_sub_spaces)]
            for part in parts:
                rest = np.setdiff1d(part, self.dofs()) if k == self.index else part
                # The same on all ranks: each takes part in what is done to a field
                if k != self.index or len(parts) > 1 or self.is_copy:
                    found.append((k, rest))
        return found


def unknowns_of(u: Any, displacement: Any) -> Unknowns:
    """The unknowns of a problem.

    Args:
        u: A function, or a list of them.
        displacement: Number of the part or block that is the displacement; None for a displacement
            alone.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If there is no such part, or it is no displacement that contact can act on.
    """
    is_list = isinstance(u, Sequence) and not isinstance(u, str)
    if displacement is None and not is_list:
        check_displacement(u)
        return Unknowns([u], 0, is_mixed=False)
    functions = list(u) if is_list else [u]
    for k, function in enumerate(functions):
        if not isinstance(function, fem.Function):
            name = f"u[{k}]" if is_list else "u"
            raise TypeError(f"{name} must be a dolfinx.fem.Function, not {type(function).__name__}")
        if function.dtype != np.float64:
            raise TypeError(
                f"u holds {np.dtype(function.dtype).name} values, but contactx needs float64"
            )
    if isinstance(displacement, bool) or not isinstance(displacement, int | np.integer):
        raise TypeError(
            f"displacement is {described(displacement)}: give the number of the "
            f"{'block' if is_list else 'part of the mixed space'} that is the displacement, as in "
            "displacement=0"
        )
    if not functions:
        raise ValueError("u is an empty list: give the functions that are solved for")
    if len({id(function) for function in functions}) < len(functions):
        raise ValueError("u lists the same function twice: list each once")
    meshes = {id(function.function_space.mesh) for function in functions}
    if len(meshes) > 1:
        raise ValueError(
            "u has functions on several meshes: contact needs one that holds all, make one mesh"
        )
    V = functions[0].function_space
    is_mixed = not is_list and isinstance(V.ufl_element(), basix.ufl._MixedElement)
    if not is_list and not is_mixed:
        raise ValueError(
            f"displacement={displacement} is for a mixed space or a list of functions, but u is in "
            f"{V.ufl_element()}: leave it out"
        )
    if len(V._cpp_object.component()) > 0:
        raise ValueError("u is in a part of a mixed space: give the function of the whole")
    count = V.num_sub_spaces if is_mixed else len(functions)
    if not 0 <= displacement < count:
        raise ValueError(f"displacement is {displacement}: give a number from 0 to {count - 1}")
    part = V.sub(int(displacement)) if is_mixed else functions[displacement].function_space
    _check_part(part)
    return Unknowns(functions, int(displacement), is_mixed=is_mixed)


def _is_lagrange(element: Any) -> bool:
    return bool(element.element_family == basix.ElementFamily.P and element.degree in (1, 2))


def _degree_on_surface(V: fem.FunctionSpace) -> int:
    """Degree of a space whose dofs on facets are those of Lagrange spaces; 0 if it is another one.

    Args:
        V: Space of vectors.
    """
    cell, tdim = V.mesh.basix_cell(), V.mesh.topology.dim
    layout = V.dofmap.dof_layout
    for degree in (1, 2):
        wanted = basix.create_element(
            basix.ElementFamily.P, cell, degree, basix.LagrangeVariant.gll_warped
        ).entity_dofs
        same = all(
            len(layout.entity_dofs(dim, i)) == len(dofs)
            for dim in range(tdim)
            for i, dofs in enumerate(wanted[dim])
        )
        # Inside there may be more
        if same and len(layout.entity_dofs(tdim, 0)) >= len(wanted[tdim][0]):
            return degree
    return 0


def _check_part(V: fem.FunctionSpace) -> None:
    """Check that a part has a displacement of nodes.

    Args:
        V: Its space.

    Raises:
        ValueError: If it is not Lagrange of vectors of degree 1 or 2, but for bubbles.
    """
    element = V.ufl_element()
    gdim = V.mesh.geometry.dim
    if (
        not isinstance(element, basix.ufl._BlockedElement)
        or element.reference_value_shape != (gdim,)
        or element.block_size != gdim
    ):
        raise ValueError(
            f"the displacement is in {element}, which is no space of vectors of {gdim} Lagrange "
            f"components: contact needs {wanted_space(gdim)}"
        )
    if _degree_on_surface(V) == 0:
        raise ValueError(
            f"the displacement is in {element}; contact needs degree 1 or 2 on the surface, which "
            f"may be enriched by bubbles inside of cells: {wanted_space(gdim)}"
        )


def _nodal_dofs(part: fem.FunctionSpace, V: fem.FunctionSpace) -> Index:
    """Dofs of a part of a space at each component of each node of a Lagrange space.

    Args:
        part: A space with a block of dofs at each node, whole or part of a mixed one.
        V: Lagrange space of vectors.

    Returns:
        Dofs of the whole space, ghosts included, shape (num_nodes * gdim,).
    """
    gdim = V.mesh.geometry.dim
    layout, own = part.dofmap.dof_layout, V.dofmap.dof_layout
    nodes = V.dofmap.list
    # Local dof of the part at each node of a cell
    local = np.empty(nodes.shape[1], dtype=np.int64)
    for dim, entities in enumerate(basix.topology(V.mesh.basix_cell())):
        for i in range(len(entities)):
            for node, dof in zip(own.entity_dofs(dim, i), layout.entity_dofs(dim, i), strict=False):
                local[node] = dof
    blocks = part.dofmap.list
    index_map = V.dofmap.index_map
    dofs = np.empty((index_map.size_local + index_map.num_ghosts, gdim), dtype=np.int64)
    for i, dof in enumerate(local):
        for k in range(gdim):
            # In a mixed space the components of a block have dofs of their own
            is_blocked = part.dofmap.bs == gdim
            at = gdim * blocks[:, dof] + k if is_blocked else blocks[:, gdim * dof + k]
            dofs[nodes[:, i], k] = at
    return dofs.ravel()


def _dofs_of(part: fem.FunctionSpace, owned: int) -> Index:
    """Owned dofs of a part of a mixed space, in order."""
    dofmap = part.dofmap
    dofs = np.unique(dofmap.bs * dofmap.list[:, :, None] + np.arange(dofmap.bs))
    return dofs[dofs < owned].astype(np.int64)
