# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Report of a step: iterations, pairs, balance, times."""

from __future__ import annotations

import io
import textwrap
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields

import numpy as np
import numpy.typing as npt
from rich.console import Console
from rich.table import Table

from contactx import cpp as core

# What the core counts
_OF_CORE = (
    "slaves",
    "pairs",
    "immobile",
    "frozen_pairs",
    "frozen_gap",
    "slipping",
    "slip",
    "dissipation",
    "interior",
    "limited",
    "shortened",
    "cycles",
    "corners",
    "free_modes",
    "held_force",
    "closed_for_balance",
)


@dataclass(frozen=True)
class Iteration:
    """State after one Newton iteration; number 0 is the start.

    Attributes:
        number: Number of linear solves so far.
        residual: Norm of the forces that are out of balance, and of the contact conditions.
        tolerance: Bound that the residual must fall below.
        closed: Slave nodes in contact.
        status_changes: Slave nodes that opened or closed.
        pair_changes: Slave nodes in contact that changed their facet.
        frozen_kinematics: Whether pairs, normals and projections of finite sliding were frozen
            because many nodes had changed.
        dirichlet_defect: Largest difference from a Dirichlet value.
    """

    number: int
    residual: float
    tolerance: float
    closed: int
    status_changes: int
    pair_changes: int
    frozen_kinematics: bool
    dirichlet_defect: float

    @classmethod
    def of(cls, found: core.Settled) -> Iteration:
        """The row of an iterate that was tested.

        Args:
            found: The iterate.
        """
        return cls(**{f.name: getattr(found, f.name) for f in fields(cls)})


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


@dataclass
class Report:
    """Report of a step.

    Attributes:
        history: One row for each iteration, the start first.
        discarded: Linear solves of the attempts at this step that failed: that without damping, and
            those that LoadSteps cut.
        damped: Whether Newton steps were damped, since full ones did not converge.
        converged: Whether the step converged.
        reason: Why the Newton loop ended.
        slaves: Number of slave nodes of all contacts.
        pairs: Number of slave nodes that have a master facet in reach.
        immobile: Pairs that Dirichlet conditions keep from moving along the normal; they stay open.
        corners: Nodes that are slave in several contacts and close more than one of them: they
            slide without friction there, and of parallel contacts only the deepest counts.
        krylov: Iterations of the condensed solver.
        hierarchies: Multigrid hierarchies made for it.
        factorisations: Factorisations, of the blocks of bodies or of systems not condensed.
        by_bodies: Why condensed solves had blocks of soft and stiff bodies in place of multigrid;
            an entry for each solve.
        uncondensed: Why solves were not condensed; an entry for each solve.
        interior: Iterates of the interior point, each of two linear solves.
        limited: Newton steps that were shortened so as not to turn a cell inside out.
        shortened: Newton steps that were damped.
        cycles: How often the active set cycled and steps were shortened.
        free_modes: Rigid modes of free bodies, at the end; the forces along them balance.
        held_force: Force that holds bodies along such modes where nothing but the corners between
            facets does, over those of all contacts.
        closed_for_balance: Nodes that were closed since a free body would touch there first.
        slipping: Slave nodes that slip against friction.
        slip: Sum over the slave nodes of their slip in this step, a length.
        dissipation: Work of friction in all steps so far.
        frozen_pairs: Pairs that alternated between facets and were frozen.
        frozen_gap: Smallest gap that a frozen pair hides; a negative one is a penetration.
        imbalance: Sum of all contact forces on both sides, shape (gdim,): zero but for round-off.
        force: Force on the slave side of each contact, a list of arrays of shape (gdim,).
        recovery: By how much the recovered pressures and tractions of each contact change its
            force, relative to the sum of its nodes' forces: zero on plane surfaces but for
            round-off.
        skipped: How often results of earlier iterations were used again: assembly of the bulk's
            Jacobian, hierarchies, factorisations, searches.
        audit: Findings of the audit of the converged iterate.
        balance: Energy and momentum of a time step; None of bodies without inertia.
        unread: PETSc options of the user that nothing has read, such as misspelt ones.
        times: Wall seconds of each part.
    """

    history: list[Iteration] = field(default_factory=list)
    discarded: int = 0
    damped: bool = False
    converged: bool = False
    reason: str = ""
    slaves: int = 0
    pairs: int = 0
    immobile: int = 0
    corners: int = 0
    krylov: int = 0
    hierarchies: int = 0
    factorisations: int = 0
    by_bodies: list[str] = field(default_factory=list)
    uncondensed: list[str] = field(default_factory=list)
    interior: int = 0
    limited: int = 0
    shortened: int = 0
    cycles: int = 0
    free_modes: int = 0
    held_force: float = 0.0
    closed_for_balance: int = 0
    slipping: int = 0
    slip: float = 0.0
    dissipation: float = 0.0
    frozen_pairs: int = 0
    frozen_gap: float = 0.0
    imbalance: npt.NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    force: list[npt.NDArray[np.float64]] = field(default_factory=list)
    recovery: list[float] = field(default_factory=list)
    skipped: dict[str, int] = field(default_factory=dict)
    audit: Findings = field(default_factory=Findings)
    balance: core.Balance | None = None
    unread: list[str] = field(default_factory=list)
    times: dict[str, float] = field(default_factory=dict)

    def take(self, found: core.StepReport) -> None:
        """Take the figures that the core has of the step.

        Args:
            found: The core's report.
        """
        for name in _OF_CORE:
            setattr(self, name, getattr(found, name))
        self.times |= found.seconds
        names = (f.name for f in fields(Findings))
        self.audit = Findings(**{name: getattr(found.audit, name) for name in names})

    @property
    def iterations(self) -> int:
        """Number of linear solves."""
        return self.history[-1].number if self.history else 0

    @contextmanager
    def timing(self, part: str) -> Iterator[None]:
        """Add the wall time of a with block to a part.

        Args:
            part: Name of the part in ``times``.

        Yields:
            Nothing.
        """
        start = time.perf_counter()
        try:
            yield
        finally:
            self.times[part] = self.times.get(part, 0.0) + time.perf_counter() - start

    def table(self) -> str:
        """Make a table of the iterations.

        Returns:
            The table as plain text, a row an iteration.
        """
        table = Table("it", "residual", "tolerance", "closed", "status", "pairs", "Dirichlet")
        table.title = "changes of status and pairs since the iterate before"
        for row in self.history:
            table.add_row(
                str(row.number),
                f"{row.residual:.2e}",
                f"{row.tolerance:.1e}",
                str(row.closed),
                str(row.status_changes),
                str(row.pair_changes) + (" frozen" if row.frozen_kinematics else ""),
                f"{row.dirichlet_defect:.1e}",
            )
        return render(table)

    def __str__(self) -> str:
        """The whole report."""
        frozen = f", {self.frozen_pairs} frozen (hiding a gap of {self.frozen_gap:.1e})"
        discarded = f" ({self.discarded} more in attempts that failed)"
        lines = [
            f"{'converged' if self.converged else 'NOT converged'} after "
            f"{_counted(self.iterations, 'iteration')}{discarded if self.discarded else ''}: "
            f"{self.reason}",
            self.table().rstrip(),
            f"{self.pairs} of {self.slaves} slave nodes have a pair"
            + (f", {self.immobile} immobile" if self.immobile else "")
            + (frozen if self.frozen_pairs else ""),
        ]
        for k, (force, change) in enumerate(zip(self.force, self.recovery, strict=True)):
            components = ", ".join(f"{f:.6g}" for f in force)
            lines.append(
                f"contact {k}: force on the slave ({components}); pressures averaged with their "
                f"neighbours', which changes it by {change:.1e}"
            )
        if self.krylov:
            lines.append(
                f"linear solves: {_counted(self.krylov, 'Krylov iteration')}, "
                f"{_counted(self.hierarchies, 'hierarchy', 'hierarchies')}, "
                f"{_counted(self.factorisations, 'factorisation')}"
            )
        for reason in sorted(set(self.by_bodies)):
            count = _counted(self.by_bodies.count(reason), "time")
            lines.append(f"solved with blocks of bodies {count}: {reason}")
        for reason in sorted(set(self.uncondensed)):
            lines.append(
                f"solved directly {_counted(self.uncondensed.count(reason), 'time')}: {reason}"
            )
        acted = [
            f"{self.interior} iterates of an interior point" if self.interior else "",
            f"{self.limited} steps shortened to keep cells from turning inside out"
            if self.limited
            else "",
            f"{self.shortened} steps damped, as others did not converge" if self.damped else "",
        ]
        if any(acted):
            lines.append(", ".join(text for text in acted if text))
        if self.cycles:
            lines.append(f"the status came back {self.cycles} times; steps were shortened")
        if self.corners:
            lines.append(
                f"{self.corners} nodes close several contacts at once: without friction, and only "
                "the deepest of parallel ones"
            )
        if self.closed_for_balance or self.free_modes:
            lines.append(
                f"free bodies: {self.closed_for_balance} nodes closed at first to balance them, "
                f"{self.free_modes} rigid modes left free"
                + (
                    f", held by {self.held_force:.1e} of the contact forces"
                    if self.held_force
                    else ""
                )
            )
        if self.dissipation > 0:
            lines.append(
                f"slip {self.slip:.6g} in this step, dissipation {self.dissipation:.6g} in all"
            )
        if self.balance is not None:
            lines += self.balance.lines()
        if self.force:
            lines.append(f"imbalance of contact forces: {np.linalg.norm(self.imbalance):.1e}")
        skips = ", ".join(f"{name} {count}x" for name, count in self.skipped.items() if count)
        if skips:
            lines.append(f"skipped: {skips}")
        lines.append(str(self.audit))
        times = ", ".join(f"{part} {seconds:.2f} s" for part, seconds in self.times.items())
        lines.append(f"time: {times}")
        wrapped = (line if "│" in line else textwrap.fill(line, 80) for line in lines)
        return "\n".join(wrapped)


def render(table: Table) -> str:
    """A rich table as plain text, so that it fits into files and error messages."""
    text = io.StringIO()
    Console(file=text, width=80).print(table)
    return text.getvalue()


def _counted(number: int, one: str, many: str = "") -> str:
    """A number of things: "1 iteration", "2 iterations"."""
    return f"{number} {one if number == 1 else many or one + 's'}"
