# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a contact needs of its master side."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.forms import Pairs


class Master(ABC):
    """Pairs of the slave nodes with a master.

    Positions are those of all nodes of the bulk, shape (num_nodes, gdim).

    Attributes:
        reach: Largest distance of a pair.
        is_rigid: Whether the master has no degrees of freedom.
    """

    reach: float
    is_rigid = False

    @abstractmethod
    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> tuple[int, bool]:
        """Pair the slave nodes.

        Args:
            x: Positions.
            closed: Whether each slave node is in contact, shape (n,).

        Returns:
            Number of nodes in contact that changed their facet, and whether the forms must be
            made anew because any pair has changed.
        """

    @property
    @abstractmethod
    def paired(self) -> npt.NDArray[np.bool_]:
        """Whether each slave node has a pair, shape (n,)."""

    @abstractmethod
    def pairs(self) -> list[Pairs]:
        """Pairs by the kind of their facets, with the data of the last search."""

    @abstractmethod
    def refresh(self, x: npt.NDArray[np.float64], held: bool) -> list[Pairs] | None:
        """Data of the pairs at an iterate between two searches.

        Args:
            x: Positions.
            held: Whether normals and projections are held.

        Returns:
            The pairs, None where their data have not changed.
        """

    @abstractmethod
    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Compliance of the master at each slave node.

        Args:
            nodal: Compliance of each node of the bulk, length/force.

        Returns:
            Compliance, shape (n,).
        """

    @abstractmethod
    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """Arrays that tell this master from another one to which ``save`` would not fit."""

    @abstractmethod
    def save(self) -> dict[str, npt.NDArray[Any]]:
        """Copy of what the next search remembers, in arrays whose shapes never change."""

    @abstractmethod
    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """Take over what ``save`` gave for the same surfaces.

        Raises:
            ValueError: If it does not fit; nothing has changed.
        """

    @abstractmethod
    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """Distance from the nearest slave node to the master."""

    @abstractmethod
    def mobility(self, free: npt.NDArray[np.bool_]) -> npt.NDArray[np.float64]:
        """How much of each gap's gradient is left by Dirichlet conditions.

        Args:
            free: Which displacements are not prescribed, shape (num_nodes, gdim).

        Returns:
            Norm of the gradient over the free displacements, shape (n,): zero where slave node
            and master have nothing to yield along the normal.
        """

    @property
    def frozen(self) -> npt.NDArray[np.int32]:
        """Slave nodes whose pair went back and forth and was frozen."""
        return np.array([], dtype=np.int32)

    def forget_flips(self) -> None:
        """Let frozen pairs move again and count anew how often pairs go back and forth."""

    def deepest_frozen(self, x: npt.NDArray[np.float64]) -> float:
        """Smallest gap that the frozen pairs hide."""
        return 0.0
