# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces on parts of the nodes, such as those of supports, with their moments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx._host.checks import described
from contactx._host.parallel.reduce import anywhere, total
from contactx.surface import Surface
from dolfinx import fem, la

if TYPE_CHECKING:
    from contactx.assembler import ContactAssembler

type Array = npt.NDArray[np.float64]


class Reaction:
    """Force of supports on the bodies, as of the last solve.

    Attributes:
        force: Sum over all ranks, shape (gdim,).
    """

    def __init__(self, comm: MPI.Comm, forces: Array, at: Array, *, is_axisymmetric: bool):
        """Sum up forces of nodes; all ranks must take part.

        Args:
            comm: Communicator.
            forces: Forces on nodes of this rank, shape (n, gdim).
            at: Where they act, shape (n, gdim).
            is_axisymmetric: Whether they are those of circles around an axis.
        """
        self._comm, self._forces, self._at = comm, forces, at
        self._is_axisymmetric = is_axisymmetric
        self.force: Array = total(comm, forces.sum(axis=0))

    def moment(self, point: npt.ArrayLike) -> float | Array:
        """Moment of the forces about a point; all ranks must take part.

        They act where their nodes are after the last solve.

        Args:
            point: The point, shape (gdim,).

        Returns:
            The moment, force times length: in 2D a number, positive counter-clockwise, in 3D of
            shape (3,).

        Raises:
            TypeError: If the point is not of real numbers.
            ValueError: If it has another shape, or is not finite.
            RuntimeError: If the model is axisymmetric: forces on a ring have no moment about a
                point in the plane of the mesh.
        """
        about = as_point(point, len(self.force))
        if self._is_axisymmetric:
            raise RuntimeError(
                "a contact's weight is in proportion to the radius, as in an axisymmetric model, "
                "where the forces around the axis have no moment: leave it out"
            )
        arm, force = self._at - about, self._forces
        if len(about) == 3:
            moment: Array = total(self._comm, np.cross(arm, force).sum(axis=0))
            return moment
        return float(
            total(self._comm, float(np.sum(arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0])))
        )


def as_point(point: Any, gdim: int) -> Array:
    """A point that a user gives.

    Raises:
        TypeError: If it is not of real numbers.
        ValueError: If it has another shape, or is not finite.
    """
    try:
        at = np.asarray(point, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"point is {point!r}: give {gdim} real numbers") from None
    if at.shape != (gdim,) or not np.isfinite(at).all():
        raise ValueError(f"point is {point!r}: give {gdim} finite numbers")
    return at


def reaction_of(assembler: ContactAssembler, where: fem.DirichletBC | Surface | None) -> Reaction:
    """See ``ContactProblem.reaction``."""
    bulk, halo = assembler.bulk, assembler.halo
    dofs = halo.num_owned * halo.gdim
    if where is None:
        marked = bulk.markers[:dofs] == 1
    elif isinstance(where, fem.DirichletBC):
        marked = _dofs_of(assembler, where)[:dofs]
    elif isinstance(where, Surface):
        marked = np.repeat(_nodes_of(assembler.u.function_space, where), halo.gdim)
    else:
        raise TypeError(
            f"where is {described(where)}: give a fem.DirichletBC, a contactx.Surface of facet "
            "tags, or nothing for all conditions"
        )
    forces = assembler.system.core.forces().ravel() * marked
    positions = halo.x[: halo.num_owned] + assembler.u.x.array[:dofs].reshape(-1, halo.gdim)
    return Reaction(
        halo.comm,
        forces.reshape(-1, halo.gdim),
        positions,
        is_axisymmetric=any(c.fields.results.is_axisymmetric for c in assembler.contacts),
    )


def _dofs_of(assembler: ContactAssembler, bc: fem.DirichletBC) -> npt.NDArray[np.bool_]:
    """Whether a condition prescribes the displacement's dofs, ghosts included.

    Raises:
        ValueError: If it prescribes none.
    """
    unknowns = assembler.bulk.unknowns
    function = unknowns.functions[unknowns.index]
    marked = np.zeros(len(function.x.array), dtype=np.bool_)
    if function.function_space._cpp_object.contains(bc.function_space):
        marked[bc.dof_indices()[0]] = True
    if unknowns.all_dofs is not None:
        marked = marked[unknowns.all_dofs]
    if not anywhere(assembler.halo.comm, marked.any()):
        raise ValueError(
            "where is a condition that prescribes no displacement of this problem: give one on the "
            "displacement's space, or on a component of it, that has dofs"
        )
    return marked


def _nodes_of(V: fem.FunctionSpace, surface: Surface) -> npt.NDArray[np.bool_]:
    """Whether the nodes that this rank owns are on a surface; all ranks must take part."""
    index_map = V.dofmap.index_map
    marked = la.vector(index_map, 1)
    marked.array[surface.nodes(V)] = 1
    # Its facets may be of cells of other ranks
    marked.scatter_reverse(la.InsertMode.add)
    on: npt.NDArray[np.bool_] = marked.array[: index_map.size_local] > 0
    return on
