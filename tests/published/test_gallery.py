# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each published value is met within its tolerance, or the page says why not.

Cases that take more than 20 s run in ``make gallery``.
"""

import pytest

from published.cases import CASES
from published.record import TOLERANCE, Result

FAST = [case for case in CASES if not case.slow]


@pytest.mark.parametrize("case", FAST, ids=[case.name for case in FAST])
def test_published_value(case):
    result = Result(case, case.run())
    print(result.row)
    assert abs(result.error) <= case.tolerance
    # A step whose extrapolated start is its answer takes no solve of its own
    assert sum(result.answer.iterations) > 0


def test_names_and_explanations():
    names = [case.name for case in CASES]
    assert len(set(names)) == len(names) >= 25
    assert all(case.source and case.quantity for case in CASES)
    # A larger tolerance is a miss, which is explained
    wide = {case.name for case in CASES if case.tolerance > TOLERANCE}
    assert wide == {"r0094_3_formed", "r0094_3_formed_friction", "mindlin_sphere_force"}
    assert all(case.note for case in CASES if case.name in wide or case.options)
