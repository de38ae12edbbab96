# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What an audit found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from typing import NamedTuple

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx.errors import point_text
from contactx.parallel import reduce
from contactx.parallel.halo import Halo, first_node


class Depth(NamedTuple):
    """How deep a master is below a slave facet, between its nodes.

    Attributes:
        excess: Ratio to what the mesh explains.
        depth: The depth.
        size: Size of the facet.
        is_held: Whether a node of the facet is in contact.
        at: Where that is, shape (gdim,).
    """

    excess: float
    depth: float
    size: float
    is_held: bool
    at: npt.NDArray[np.float64]


_FAR = (
    "the body has come to its far side, or is too thin for the overlap. Take smaller load steps, "
    "or start without the overlap"
)


@dataclass
class Findings:
    """What an audit of a converged iterate found.

    Attributes:
        far_side: Slave nodes inside their master, or on the far side of a rigid one.
        passed: Nodes that went through the other surface within the step.
        depth: Largest depth of a master below a slave facet, between its nodes, a length.
        excess: Largest ratio of such a depth to what the mesh explains; more than 1 is a fault.
        inverted: Cells that are turned inside out.
        smallest_det: Smallest det F of the cells; NaN where none was looked at.
        faults: What is wrong and what to do about it, a text each.
        warnings: The same of what is only warned of.
    """

    far_side: int = 0
    passed: int = 0
    depth: float = 0.0
    excess: float = 0.0
    inverted: int = 0
    smallest_det: float = float("nan")
    faults: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def add_far_side(
        self, name: str, bad: npt.NDArray[np.int32], what: str, halo: Halo, advice: str = ""
    ) -> None:
        """Add slave nodes inside their master; all ranks must take part.

        Args:
            name: Name of the contact.
            bad: The nodes on this rank.
            what: What they are inside of.
            halo: Nodes of this rank.
            advice: Why, and what to do, if it is not that the body came to the far side.
        """
        count = int(reduce.total(halo.comm, len(bad)))
        if count == 0:
            return
        first, at = first_node(halo, bad, halo.positions())
        size = float(reduce.extent(halo.comm, halo.x[: halo.num_owned]).max())
        self.far_side += count
        self.faults.append(
            f"{name}: {count} slave nodes are inside the {what}, first node {first} of the mesh as "
            f"it was made, at {point_text(at, size)}: {advice or _FAR}"
        )

    def add_depth(
        self,
        name: str,
        what: str,
        mine: Depth | None,
        advice: str,
        comm: MPI.Comm,
        *,
        is_fault: bool,
        place: str = "at",
    ) -> None:
        """Add the deepest place of a master below slave facets; all ranks must take part.

        Args:
            name: Name of the contact.
            what: What reaches through the facet.
            mine: The deepest one on this rank, by what the mesh explains; None where there is none.
            advice: What to do.
            comm: Communicator.
            is_fault: Whether it is one where it is too deep; else something else was found already.
            place: The word before the place.
        """
        found: Sequence[Depth] = [d for d in comm.allgather(mine) if d is not None]
        if not found:
            return
        worst = max(found, key=attrgetter("excess"))
        if worst.excess > self.excess:
            self.excess, self.depth = worst.excess, max(worst.depth, 0.0)
        if worst.excess > 1 and is_fault:
            self.faults.append(
                f"{name}: the {what} reaches {worst.depth:.3g} deep through a slave facet of size "
                f"{worst.size:.3g} {place} {point_text(worst.at, worst.size)}, between its nodes"
                + ("" if worst.is_held else ", which are open")
                + f": the slave surface is too coarse to see it. {advice}"
            )

    def __str__(self) -> str:
        """One line."""
        parts = [
            f"{self.far_side} slave nodes on the far side, {self.passed} passed through",
            f"master between slave nodes at {self.excess:.2g} of what the mesh explains "
            f"({self.depth:.2g} deep)",
        ]
        if self.smallest_det == self.smallest_det:
            parts.append(
                f"{self.inverted} cells inside out, smallest det F {self.smallest_det:.3g}"
            )
        return "audit: " + "; ".join(parts)
