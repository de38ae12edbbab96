# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem in a file, and back, on any number of ranks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx import cpp as core
from contactx._host.checkpoint.shared_file import opened, replaced
from contactx._host.nodes import original_nodes, reference_positions
from contactx._host.parallel.mpi_host import MPIRanks
from contactx.problem import ContactProblem
from dolfinx import fem

type Array = npt.NDArray[np.float64]
type Numbers = npt.NDArray[np.int64]


class Checkpoint:
    """State of a problem: see ``problem/checkpoint.h``. All ranks must take part in all of it."""

    def __init__(self, problem: ContactProblem, history: Sequence[fem.Function]):
        """Find the rows of all functions.

        Args:
            problem: The problem.
            history: Functions that belong to its state.

        Raises:
            ValueError: If such a function is of a space that cannot be saved.
        """
        V = problem.displacement.function_space
        self._problem = problem
        self._comm = V.mesh.comm
        names = ["u", *(f"history[{k}]" for k in range(len(history)))]
        self._functions = [problem.displacement, *history]
        keys, self._dofs = zip(*map(_keyed_dofs, self._functions, names), strict=True)
        discrete = [contact.discrete for contact in problem.contacts]
        # What slip starts from; a problem of one's own may have no contacts
        halo = next((contact.halo.nodes for contact in discrete), None)
        self._core = core.Checkpoint(
            MPIRanks(self._comm),
            discrete,
            [(n, k, d.shape[1]) for n, k, d in zip(names, keys, self._dofs, strict=True)],
            reference_positions(V)[: V.dofmap.index_map.size_local],
            _cell_nodes(V),
            halo,
        )

    def write(self, path: Path, steps: Mapping[str, npt.NDArray[Any]]) -> None:
        """Write all that the next step's answer depends on.

        Args:
            path: The file; one of this name is replaced when the new one is whole.
            steps: Numbers that are the same on all ranks, by their names.

        Raises:
            OSError: If it cannot be written; the old file is still there.
        """
        for function in self._functions[1:]:
            # Rows of cells may have dofs of other ranks
            function.x.scatter_forward()
        values = (f.x.array[d] for f, d in zip(self._functions, self._dofs, strict=True))
        with replaced(self._comm, path) as file:
            self._core.write(file, values, steps)

    def read(self, path: Path) -> core.CheckpointState:
        """Read what ``write`` has written for the same problem, be it another object.

        Args:
            path: The file.

        Raises:
            OSError: If it is not there, or cannot be read.
            ValueError: If it is of another problem, damaged or not finite.
        """
        with opened(self._comm, path) as file:
            return self._core.read(file)

    def apply(self, state: core.CheckpointState) -> None:
        """Go on from a state.

        Args:
            state: What ``read`` gave.

        Raises:
            ValueError: If it does not fit the contacts; some of the state may have changed.
        """
        for f, dofs, values in zip(self._functions, self._dofs, state.functions, strict=True):
            f.x.array[dofs] = values.reshape(dofs.shape)
            f.x.scatter_forward()
        self._problem.update_ghosts()
        self._core.apply(state)
        for contact in self._problem.contacts:
            contact.fields.evaluate()


def _keyed_dofs(function: fem.Function, name: str) -> tuple[Numbers, npt.NDArray[np.int32]]:
    """Rows of a function by their numbers in the mesh as it was made.

    Lagrange spaces of degree 1 or 2 have a row a node, others a row a cell.

    Args:
        function: The function.
        name: What it is called in errors.

    Returns:
        Keys of this rank's rows, shape (n, k), and their dofs, shape (n, width).

    Raises:
        ValueError: If its values are not of double precision, or the order of its dofs in a cell
            changes from rank to rank, on more than one.
    """
    V = function.function_space
    element, size = V.ufl_element(), V.dofmap.bs
    if function.x.array.dtype != np.float64:
        raise ValueError(
            f"{name} has values of type {function.x.array.dtype}: give a function of float64"
        )
    if not isinstance(element, basix.ufl._MixedElement) and (
        element.element_family == basix.ElementFamily.P
        and not element.discontinuous
        and element.degree in (1, 2)
    ):
        keys = original_nodes(V)[: V.dofmap.index_map.size_local, None]
        blocks = np.arange(len(keys), dtype=np.int32)[:, None]
    else:
        is_fixed = _has_fixed_order(element) and not V.element.needs_dof_transformations
        if V.mesh.comm.size > 1 and not is_fixed:
            raise ValueError(
                f"{name} is of {element}, whose dofs change their order from rank to rank: take a "
                "Lagrange space of degree 1 or 2, a mixed one of such, a quadrature or a "
                "discontinuous space, or one rank"
            )
        keys = _cell_nodes(V)
        blocks = V.dofmap.list[: len(keys)]
    dofs = blocks[:, :, None] * np.int32(size) + np.arange(size, dtype=np.int32)
    return keys, dofs.reshape(len(keys), blocks.shape[1] * size)


def _cell_nodes(V: fem.FunctionSpace) -> Numbers:
    """Nodes of each owned cell by their numbers in the mesh as it was made, shape (n, k)."""
    domain = V.mesh
    owned = domain.topology.index_map(domain.topology.dim).size_local
    nodes: Numbers = domain.geometry.input_global_indices[domain.geometry.dofmaps[0][:owned]]
    return nodes


def _has_fixed_order(element: Any) -> bool:
    """Whether no edge or face has several dofs, which its direction would tell apart."""
    if element.sub_elements:
        return all(map(_has_fixed_order, element.sub_elements))
    return all(len(dofs) <= 1 for entities in element.entity_dofs[:-1] for dofs in entities)
