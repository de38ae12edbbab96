# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a contact needs of its master side."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from contactx.forms import Pairs

# What the rows of a saved array stand for: an owned slave node, an owned node of the bulk, or
# nothing where the array is the same on all ranks
type RowKind = Literal["slave", "node", "global"]

type Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Weights:
    """Matrix of slave nodes and nodes of the bulk, as triplets.

    Attributes:
        slaves: Slave nodes by their number in the contact.
        nodes: Nodes of the bulk.
        values: 1 for the slave node itself, -N_l for those of its master facet.
    """

    slaves: npt.NDArray[np.integer]
    nodes: npt.NDArray[np.integer]
    values: npt.NDArray[np.float64]


class Master(ABC):
    """Pairs of the slave nodes with a master.

    Positions are those of all nodes on this rank, shape (num_nodes, gdim). All ranks take part in
    what is marked as collective; all else is this rank's alone.

    Slip is measured from where a slave node was at the step's start; one that touches first
    within the step, from where it touched.

    Attributes:
        reach: Largest distance of a pair.
        is_rigid: Whether the master has no degrees of freedom.
        saved_rows: What the rows of each array stand for that ``save`` gives, by its name.
    """

    reach: float
    is_rigid = False
    saved_rows: Mapping[str, RowKind]

    @abstractmethod
    def accept(self, x: npt.NDArray[np.float64]) -> None:
        """Take a converged configuration, the start of the next step; collective.

        Args:
            x: Positions.
        """

    @abstractmethod
    def begin_step(self) -> None:
        """Start a step: slip is measured from its start, and pairs may move again; collective."""

    def rebuild(self) -> None:
        """Add the nodes of the pairs to the halo again, once it has shrunk; collective."""

    def halo_changed(self, scatter_forward: Callable[[Array], Array]) -> None:
        """Make positions that were kept fit a halo that has changed; collective.

        Args:
            scatter_forward: Gives those of all nodes from those of owned nodes.
        """

    @abstractmethod
    def turn(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64] | None:
        """How the master has turned under each slave node since the step before was accepted.

        Args:
            x: Positions.

        Returns:
            Rotations, shape (n, gdim, gdim); None where nothing has moved.
        """

    @abstractmethod
    def touch(
        self,
        which: npt.NDArray[np.bool_],
        x: npt.NDArray[np.float64],
        offset: npt.NDArray[np.float64],
    ) -> None:
        """Measure the slip of nodes that touch first within the step from where they do.

        That is where the straight way from the step's start to the iterate that first closes
        them, seen from the master, meets the master.

        Args:
            which: Which slave nodes, shape (n,).
            x: Positions at that iterate.
            offset: What is taken off the gap, shape (n,).
        """

    @abstractmethod
    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> int:
        """Pair the slave nodes; collective.

        Args:
            x: Positions.
            closed: Whether each slave node is in contact, shape (n,).

        Returns:
            Number of this rank's nodes in contact that changed their facet.
        """

    @property
    @abstractmethod
    def paired(self) -> npt.NDArray[np.bool_]:
        """Whether each slave node has a pair, shape (n,)."""

    @abstractmethod
    def pairs(self) -> list[Pairs]:
        """Pairs by the kind of their facets, with the data of the last search."""

    @abstractmethod
    def update(
        self, x: npt.NDArray[np.float64], frozen_kinematics: bool, offset: npt.NDArray[np.float64]
    ) -> list[Pairs] | None:
        """Data of the pairs at an iterate between two searches.

        Args:
            x: Positions.
            frozen_kinematics: Whether normals and projections stay those of the last search.
            offset: What is taken off the gap, shape (n,).

        Returns:
            The pairs, None where their data have not changed.
        """

    def normals(self) -> npt.NDArray[np.float64]:
        """Unit normals that the last search found, zero where there is no pair, shape (n, 3)."""
        normals = np.zeros((len(self.paired), 3))
        for pairs in self.pairs():
            normals[pairs.slaves[:, 0]] = pairs.normal
        return normals

    @abstractmethod
    def weights(self) -> Weights:
        """Relative movement of each slave node and its master by those of the bulk's nodes."""

    def area(self, whole: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Area that each slave node's multiplier acts on.

        Args:
            whole: Its part of the slave surface in front of the master, shape (n,).

        Returns:
            Areas, shape (n,).
        """
        return whole

    def take_front(self, faces: npt.NDArray[np.bool_]) -> None:
        """Take which corners of the slave facets face the master, in the order of their nodes.

        Only what integrates over facets on its own needs to know.
        """

    @property
    def origin(self) -> npt.NDArray[np.float64]:
        """What is taken off the movement that forms assemble, shape (n, gdim); or zero."""
        return np.zeros(1)

    @abstractmethod
    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Compliance of the master at each slave node; collective.

        Args:
            nodal: Compliance of each node of the bulk, length/force.

        Returns:
            Compliance, shape (n,).
        """

    @abstractmethod
    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """Whole numbers that tell this master from another to which ``save`` would not fit.

        Returns:
            Arrays by their names, each row on one rank alone, such as facets by the numbers of
            their nodes in the mesh as it was made. Their order has no meaning.
        """

    @abstractmethod
    def save(self) -> dict[str, npt.NDArray[Any]]:
        """What the next search remembers, in arrays of shapes that never change.

        Nothing writes to them: what changes is put into new ones. Where a rank has no row of an
        array, it has one of no rows. Facets are saved by their nodes' numbers in the mesh as it
        was made, -1 where there is none, not by a number of their own.
        """

    @abstractmethod
    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """Take over what ``save`` gave for the same surfaces; collective.

        Raises:
            ValueError: If it does not fit; nothing has changed.
        """

    @abstractmethod
    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """Distance from the nearest of this rank's slave nodes to the master; collective."""

    @abstractmethod
    def mobility(
        self, free: npt.NDArray[np.bool_]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """How much of the relative movement Dirichlet conditions leave free.

        Args:
            free: Which displacements are not prescribed, shape (num_nodes, gdim).

        Returns:
            Norms of the gradients over the free displacements: of the gap, shape (n,), and of each
            component of the movement, shape (n, gdim). They are zero where neither slave node nor
            master can move.
        """

    @property
    def frozen_pairs(self) -> npt.NDArray[np.int32]:
        """Slave nodes whose pair went back and forth and was frozen."""
        return np.array([], dtype=np.int32)

    def reset_flips(self) -> None:
        """Let frozen pairs move again and count anew how often pairs go back and forth."""

    def deepest_frozen_pair(self, x: npt.NDArray[np.float64]) -> tuple[float, float]:
        """Smallest gap that this rank's frozen pairs hide; all ranks must take part.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).

        Returns:
            The gap, and the smallest one over the length of an edge of its facet.
        """
        return 0.0, 0.0


def touching(
    before: npt.NDArray[np.float64], after: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """At which part of a straight way the gap becomes zero; 0 where it was not open before.

    Args:
        before: Gaps at the start, shape (n,).
        after: Gaps at the end, shape (n,).
    """
    part = np.zeros_like(before)
    np.divide(before, before - after, out=part, where=(before > 0) & (after < before))
    return np.clip(part, 0, 1)
