# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What an audit found."""

from __future__ import annotations

from dataclasses import dataclass, field


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
