# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs a scene and says what came of it."""

from __future__ import annotations

import time
import traceback
import warnings
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

import contactx as cx

from stress.judge import Judge
from stress.scene import Scene


class Kind(StrEnum):
    """What can come of a scene."""

    CONVERGED = "converged"
    CUT = "after cut-back"
    REFUSED = "refused"
    WRONG = "WRONG"


@dataclass
class Outcome:
    """What came of a scene.

    Attributes:
        family: Family of the scene.
        value: Its place there.
        variant: What else tells it apart.
        kind: What came of it.
        reason: Why it was refused or is wrong.
        steps: Accepted steps.
        iterations: Linear solves of all accepted steps.
        discarded: Those of steps that were cut.
        seconds: CPU time.
    """

    family: str
    value: str
    variant: str
    kind: str = Kind.WRONG
    reason: str = ""
    steps: int = 0
    iterations: int = 0
    discarded: int = 0
    seconds: float = 0.0

    def row(self) -> dict[str, Any]:
        """Values by their names."""
        return asdict(self)


def run(scene: Scene) -> Outcome:
    """Run a scene.

    Args:
        scene: The scene.
    """
    outcome = Outcome(scene.family, scene.value, scene.variant)
    begin = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            _solve(scene, outcome)
    except (cx.ConvergenceError, ValueError) as error:
        # A refusal after a wrong state was accepted is no excuse
        if not outcome.reason:
            outcome.kind = Kind.REFUSED
            # Without the table of iterations
            text = getattr(error, "reason", "") or str(error)
            outcome.reason = f"{type(error).__name__}: {text}"
    except Exception as error:
        outcome.kind = Kind.WRONG
        outcome.reason = f"{type(error).__name__}: {error}\n{traceback.format_exc()}"
    outcome.seconds = time.process_time() - begin
    return outcome


def _solve(scene: Scene, outcome: Outcome) -> None:
    case = scene.make()
    judge = Judge(case)
    violated = []
    steps = cx.LoadSteps(case.problem, case.steps, update=case.update, progress=False)
    for step in steps:
        outcome.steps += 1
        outcome.iterations += step.iterations
        outcome.discarded += step.report.discarded
        violated += [*judge(), *(c for c in case.step_answers(step.t) if not c.holds)]
        if violated:
            break
    else:
        violated += [check for check in case.answers() if not check.holds]
    if violated:
        outcome.reason = "; ".join(f"{c.name}: {c.error:.3g} > {c.allowed:.3g}" for c in violated)
    else:
        given = case.steps if isinstance(case.steps, int) else len(case.steps)
        cut = outcome.steps > given or outcome.discarded > 0
        outcome.kind = Kind.CUT if cut else Kind.CONVERGED
