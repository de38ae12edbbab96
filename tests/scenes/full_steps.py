# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton steps that nothing shortens but the test of damped ones."""

from __future__ import annotations


def limit(loop, step, correction):
    """In place of ``core.Loop.limit``, which keeps cells from turning inside out as well."""
    rule = loop.length
    rule.begin(loop.size_of(step), 1.0)
    while rule.has_trial:
        rule.judge(correction(rule.part))
    return rule.part
