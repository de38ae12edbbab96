# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A loop on forms gives what ContactProblem gives, on two ranks."""

from ranks.launch import SCRIPTS, launch


def test_forms_on_two_ranks():
    assert float(launch(SCRIPTS / "forms_on_ranks.py", 2)) <= 1e-10
