# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs a scene and says what came of it."""

from __future__ import annotations

import re
import time
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

import contactx as cx

from stress.judge import Judge
from stress.scene import SWAP, Case, Scene


class Kind(StrEnum):
    """What can come of a scene."""

    CONVERGED = "converged"
    CUT = "after cut-back"
    RIGHTLY = "rightly refused"
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
        discarded: Those of attempts that failed, and were damped or cut then.
        seconds: CPU time of the steps, without making the scene and judging it.
        note: What is worth knowing, though it is not wrong.
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
    note: str = ""

    def row(self) -> dict[str, Any]:
        """Values by their names."""
        return asdict(self)


def run(scene: Scene) -> Outcome:
    """Run a scene.

    Args:
        scene: The scene.
    """
    outcome = Outcome(scene.family, scene.value, scene.variant)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        refusal = ""
        try:
            _solve(scene, outcome)
        except (cx.ConvergenceError, ValueError) as error:
            # Without the table of iterations
            refusal = getattr(error, "reason", "") or str(error)
            outcome.reason = f"{type(error).__name__}: {refusal}"
            if isinstance(error, np.linalg.LinAlgError):  # A ValueError that the judge raises
                outcome.reason, refusal = f"{outcome.reason}\n{traceback.format_exc()}", ""
        except Exception as error:
            outcome.reason = f"{type(error).__name__}: {error}\n{traceback.format_exc()}"
        if refusal:
            outcome.kind = _refused(scene, refusal)
    return outcome


def rightly(case: Case) -> bool:
    """Whether a case is solved, and nothing is wrong with it."""
    scene = Scene("", "", "", lambda: case)
    return run(scene).kind in (Kind.CONVERGED, Kind.CUT)


def taken(case: Case) -> Iterator[float]:
    """Take the steps of a case as far as they go rightly; yields each t that was reached."""
    judge = Judge(case.given())
    try:
        for t in steps_of(case, Outcome("", "", "")):
            if judge() or [c for c in case.step_answers(t) if not c.holds]:
                return
            yield t
    except (cx.ConvergenceError, ValueError):
        return


def _refused(scene: Scene, text: str) -> Kind:
    """What a refusal is worth.

    It is right if what it asks for helps, or if no other way leads to a solution.
    """
    for words, helps in scene.advice.items():
        if re.search(words, text) and helps():
            return Kind.RIGHTLY
    case = scene.make()
    if case.swapped and re.search(SWAP, text) and rightly(replace(case.swapped(), swapped=None)):
        return Kind.RIGHTLY
    if not case.cut and "smaller load steps" in text and rightly(replace(case, cut=True)):
        return Kind.RIGHTLY
    if scene.solvable is None or scene.solvable():
        return Kind.REFUSED
    return Kind.RIGHTLY


def steps_of(case: Case, outcome: Outcome) -> Iterator[float]:
    """Take the steps, and count what they cost; yields each t."""
    reached = _steps_of(case, outcome)
    while True:
        begin = time.process_time()
        try:
            t = next(reached, None)
        finally:
            outcome.seconds += time.process_time() - begin
        if t is None:
            return
        yield t


def _steps_of(case: Case, outcome: Outcome) -> Iterator[float]:
    if case.cut:
        steps = cx.LoadSteps(case.problem, case.steps, update=case.update, progress=False)
        for step in steps:
            outcome.steps += 1
            outcome.iterations += step.iterations
            outcome.discarded += step.report.discarded
            yield step.t
        return
    for t in (np.arange(case.steps) + 1) / case.steps:
        case.update(float(t))
        case.problem.solve()
        outcome.steps += 1
        outcome.iterations += case.problem.report.iterations
        outcome.discarded += case.problem.report.discarded
        yield float(t)


def _solve(scene: Scene, outcome: Outcome) -> None:
    case = scene.make()
    judge = Judge(case.given())
    violated = []
    for t in steps_of(case, outcome):
        violated += [*judge(), *(c for c in case.step_answers(t) if not c.holds)]
        if violated:
            break
    else:
        violated += [check for check in case.answers() if not check.holds]
    if violated:
        outcome.reason = "; ".join(f"{c.name}: {c.error:.3g} > {c.allowed:.3g}" for c in violated)
    else:
        given = case.steps if isinstance(case.steps, int) else len(case.steps)
        outcome.kind = Kind.CUT if outcome.steps > given else Kind.CONVERGED
        outcome.note = "; ".join(c.name for c in case.notes() if not c.holds)
