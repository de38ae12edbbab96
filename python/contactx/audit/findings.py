# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Findings of an audit and their messages."""

from __future__ import annotations

from dataclasses import dataclass, field

from contactx import cpp as core
from contactx.interface import Interface

_FAR = (
    "the body has come to its far side, or is too thin for the overlap. Take smaller load steps, "
    "or start without the overlap"
)
_UNPAIRED = (
    'sliding="small" pairs nodes in the reference configuration, once: give a larger '
    'search_distance, or take sliding="finite"'
)


@dataclass
class Findings:
    """Findings of the audit of a converged iterate.

    Attributes:
        far_side: Slave nodes inside their master, or on the far side of a rigid one.
        passed: Nodes that went through the other surface within the step.
        depth: Largest depth of a master below a slave facet, between its nodes, a length.
        excess: Largest ratio of such a depth to what the mesh explains; more than 1 is a fault.
        radius_in_facets: Smallest radius of curvature of an obstacle where slave nodes touch it, by
            the size of the facets there; infinite where none is curved. Below 4 there is a warning.
        chords: Where round surfaces fit each other, what gaps are off because facets are chords,
            over what pressures there press in; 0 where none fit. Above 0.4 there is a warning.
        edges: Where edges of a master press a smooth slave, what the force there is off the slave's
            normals, over the normal force; infinite where an edge between slave nodes would need
            more force than they take. Above 0.05 there is a warning.
        inverted: Cells that are turned inside out.
        smallest_det: Smallest det F of the cells; NaN where none was looked at.
        faults: What is wrong and what to do about it, a text each.
        warnings: The same of what is only warned of.
    """

    far_side: int = 0
    passed: int = 0
    depth: float = 0.0
    excess: float = 0.0
    radius_in_facets: float = float("inf")
    chords: float = 0.0
    edges: float = 0.0
    inverted: int = 0
    smallest_det: float = float("nan")
    faults: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def add(
        self, name: str, interface: Interface, found: core.ContactFindings, size: float
    ) -> None:
        """Add what was found of a contact.

        Args:
            name: Name of the contact.
            interface: Discrete side of the contact.
            found: What was found of it.
            size: Size of the scene.
        """
        master, deepest = interface.master, found.deepest
        self.passed += found.passed.count
        self.far_side += found.inside.count
        if deepest is not None and deepest.excess > self.excess:
            self.excess, self.depth = deepest.excess, max(deepest.depth, 0.0)
        if found.roundness is not None:
            self.radius_in_facets = min(self.radius_in_facets, found.roundness.facets)
        if found.chords is not None:
            self.chords = max(self.chords, found.chords.ratio)
        if found.edges is not None:
            self.edges = max(self.edges, found.edges.ratio)
        self.warnings += [f"{name}: {text}" for text in found.warnings]
        if isinstance(master, core.ObstacleMaster):
            kind = f"rigid {type(master.obstacle).__name__}"
            if found.passed.count > 0:
                self.faults.append(
                    f"{name}: {found.passed.count} slave nodes and facets went through the {kind} "
                    "within the step and are on its far side. Take smaller load steps (manual: "
                    "errors/passed-through)"
                )
            self._add_inside(name, f"{kind}, which they face away from", found, size, _FAR)
            self._add_depth(name, kind, found, "around", "Refine the slave surface")
            return
        if found.passed.count > 0:
            self.faults.append(
                f"{name}: {found.passed.count} nodes went through the other surface within the "
                f"step, the first is at {core.point_text(found.passed.at, found.facet_size)}. Take "
                "smaller load steps (manual: errors/passed-through)"
            )
        advice = _UNPAIRED if interface.sliding == "small" else _FAR
        self._add_inside(name, "master, and have no pair with it", found, size, advice)
        if interface.is_self:
            self._add_depth(name, "surface", found, "at", "Refine it, or take smaller load steps")
            return
        advice = "Swap slave and master, or refine the slave surface"
        self._add_depth(name, "master", found, "at", advice)

    def _add_inside(
        self, name: str, what: str, found: core.ContactFindings, size: float, advice: str
    ) -> None:
        """Add a text on slave nodes inside their master, if there are any."""
        inside = found.inside
        if inside.count > 0:
            self.faults.append(
                f"{name}: {inside.count} slave nodes are inside the {what}, first node "
                f"{inside.first} of the mesh as it was made, at "
                f"{core.point_text(inside.at, size)}: {advice} (manual: errors/nodes-inside)"
            )

    def _add_depth(
        self, name: str, what: str, found: core.ContactFindings, place: str, advice: str
    ) -> None:
        """Add a text on what reaches through a slave facet, if it is deeper than explained."""
        worst = found.deepest
        if found.is_too_deep and worst is not None:
            self.faults.append(
                f"{name}: the {what} reaches {worst.depth:.3g} deep through a slave facet of size "
                f"{worst.size:.3g} {place} {core.point_text(worst.at, worst.size)}, between its "
                "nodes"
                + ("" if worst.is_held else ", which are open")
                + f": the slave surface is too coarse to see it. {advice} (manual: "
                "errors/slave-too-coarse)"
            )

    def __str__(self) -> str:
        """One line."""
        parts = [
            f"{self.far_side} slave nodes on the far side, {self.passed} passed through",
            f"master between slave nodes at {self.excess:.2g} of what the mesh explains "
            f"({self.depth:.2g} deep)",
        ]
        if self.radius_in_facets < float("inf"):
            parts.append(f"smallest radius of an obstacle {self.radius_in_facets:.3g} facets")
        if self.chords > 0:
            parts.append(f"gaps off by chords: {self.chords:.2g} of what is pressed in")
        if self.edges > 0.01:
            parts.append(f"off by edges of the master: {self.edges:.2g} of the force")
        if self.smallest_det == self.smallest_det:
            parts.append(
                f"{self.inverted} cells inside out, smallest det F {self.smallest_det:.3g}"
            )
        return "audit: " + "; ".join(parts)
