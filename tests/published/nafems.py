# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Problems 1 and 2 of NAFEMS R0094 with and without friction, by the scenes of ``scenes.nafems``.

Problem 3 is in ``sheet``, problem 4 in ``fitted``.
"""

from __future__ import annotations

from published.drawing import deformed
from published.record import Answer, Case, solve
from scenes import nafems

R0094 = "A. W. A. Konter, Advanced Finite Element Contact Benchmarks, NAFEMS R0094, 2006"


def roller(friction: float) -> Answer:
    benchmark = nafems.roller(0.5, friction=friction)
    iterations = solve(benchmark.problem)
    drawn = deformed(benchmark.u, box=(0, 60, -40, 60))
    return Answer(benchmark.depth(), iterations, drawn)


def punch(friction: float) -> Answer:
    benchmark = nafems.punch(1.0, dim=2, friction=friction)
    iterations = solve(benchmark.problem)
    drawn = deformed(benchmark.u, scale=50, box=(0, 110, -110, 110))
    return Answer(benchmark.depth(), iterations, drawn)


CASES = [
    Case(
        "r0094_1",
        "NAFEMS R0094 problem 1: roller",
        R0094,
        "vertical displacement under the roller, mm",
        lambda: roller(0.0),
        published=nafems.ROLLER,
    ),
    Case(
        "r0094_1_friction",
        "NAFEMS R0094 problem 1: roller, friction 0.1",
        "Code_Aster, manual V6.03.154, model D (of R0094)",
        "vertical displacement under the roller, mm",
        lambda: roller(0.1),
        published=-1.3026356448389,
    ),
    Case(
        "r0094_2",
        "NAFEMS R0094 problem 2 (Code_Aster SSNA122): rounded punch",
        f"{R0094}; Code_Aster, manual V6.01.122: -0.132897",
        "vertical displacement under the punch, mm",
        lambda: punch(0.0),
        published=nafems.PUNCH[0.0],
        note="The published value is that of a quarter in space; on the section, with finer cells, "
        "the displacement comes to rest 1.1 % beyond it.",
    ),
    Case(
        "r0094_2_friction",
        "NAFEMS R0094 problem 2 (Code_Aster SSNA122): rounded punch, friction 0.1",
        R0094,
        "vertical displacement under the punch, mm",
        lambda: punch(0.1),
        published=nafems.PUNCH[0.1],
    ),
]
