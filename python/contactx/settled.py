# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An accepted iterate with its residual, its changes, and whether the loop may end."""

from __future__ import annotations

from dataclasses import dataclass, fields

from contactx import cpp as core
from contactx.report import Iteration

_FAILURES = {
    core.Verdict.hidden: "pairs went back and forth between facets and were frozen, and hide a "
    "penetration: refine the coarser surface there, swap slave and master where that is the slave, "
    "or take smaller load steps (manual: errors/frozen-pairs)",
    core.Verdict.ran_away: "a body that nothing holds has moved by {moved:.3g}, more than the size "
    "of the scene: no place was found where the forces of contact balance. Support it. Where a "
    'ring can turn in another one, take method="surface-to-surface", or numbers of facets that are '
    "no multiples of each other (manual: errors/body-ran-away)",
    core.Verdict.turned: "a body that nothing holds has turned by {moved:.3g} degrees, which "
    "linear strains take for a stretch. Support it, or take a material with finite strains "
    "(manual: errors/body-turned)",
    core.Verdict.unbalanced: "the loads on a body cannot be balanced: it has no support and "
    "nothing is in its way, or friction barely could. Support it, or turn the loads so that they "
    "press the bodies together (manual: errors/unbalanced-loads)",
    core.Verdict.not_finite: "the residual is not finite: the material fails, or a body is free to "
    "move without touching anything. Take smaller load steps, or support the body "
    "(manual: errors/residual-not-finite)",
    core.Verdict.stuck: "no step is short enough to lead on: cells would turn inside out, or the "
    "residual does not fall. Take smaller load steps (manual: errors/no-step-leads-on)",
}

# What may help where iterations do not converge: where loads scale, and else
_MORE = {
    True: "smaller load steps would not help, as this step from rest, of linear bodies without "
    "gaps, is the same for any size of its load: take what presses the bodies together first and "
    "what shears them afterwards, swap slave and master, take the other method, or meshes that "
    "match or are finer where nodes still change their status at the end; else raise {limit}",
    False: "take smaller load steps; where nodes still change their status at the end, refine the "
    "mesh in contact, else raise {limit}",
}


@dataclass(frozen=True)
class Settled(Iteration):
    """An accepted iterate after its pairs and its active set were updated.

    Attributes:
        scale: Forces of the problem, which ``tolerance`` is relative to: norm of the bulk's
            residual.
        converged: True if it is a solution: the residual of the updated pairs and status is below
            the tolerance, and the audit has found no fault.
        failure: Why no solution is to be expected any more, and what to do; empty while one is.
        is_final: True if damped steps would fail as well.
    """

    scale: float
    converged: bool
    failure: str
    is_final: bool

    def row(self) -> Iteration:
        """The row of a report."""
        return Iteration(**{f.name: getattr(self, f.name) for f in fields(Iteration)})


def no_convergence(count: str, limit: str, *, is_homogeneous: bool) -> str:
    """Say that iterations did not converge, and what may help.

    Args:
        count: Number of iterations, or what limits it.
        limit: Name of the limit.
        is_homogeneous: Whether a smaller load is the same problem, scaled.
    """
    more = _MORE[is_homogeneous].format(limit=limit)
    return f"no convergence in {count} iterations: {more} (manual: errors/no-convergence)"


def settled(
    number: int,
    verdict: core.Verdict,
    iterate: core.Iterate,
    *,
    scale: float,
    moved: float,
    faults: str,
) -> Settled:
    """Describe an iterate.

    Args:
        number: Number of linear solves so far.
        verdict: What the core says of it.
        iterate: Its figures.
        scale: Forces of the problem.
        moved: Length or degrees that a body which nothing holds has moved by.
        faults: What the audit has found, if it was a solution for the core.
    """
    failure = faults or _FAILURES.get(verdict, "").format(moved=moved)
    slow = verdict in (core.Verdict.not_finite, core.Verdict.stuck)
    return Settled(
        number=number,
        residual=iterate.residual,
        tolerance=iterate.tolerance,
        closed=iterate.closed,
        status_changes=iterate.status_changes,
        pair_changes=iterate.pair_changes,
        frozen_kinematics=iterate.is_frozen,
        dirichlet_defect=iterate.defect,
        scale=scale,
        converged=verdict == core.Verdict.solution and not faults,
        failure=failure,
        is_final=bool(failure) and not slow,
    )
