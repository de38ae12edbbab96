# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""All cases of the gallery, in the order of its page."""

from __future__ import annotations

from published import (
    codes,
    fitted,
    folded,
    half_space,
    hertz,
    impact,
    ironed,
    joints,
    leaves,
    masonry,
    nafems,
    rolling,
    sheet,
    slender,
    stacked,
)
from published.record import Case

CASES: list[Case] = [
    *nafems.CASES,
    *sheet.CASES,
    *fitted.CASES,
    *joints.CASES,
    *codes.CASES,
    *ironed.CASES,
    *hertz.CASES,
    *half_space.CASES,
    *rolling.CASES,
    *slender.CASES,
    *leaves.CASES,
    *masonry.CASES,
    *stacked.CASES,
    *folded.CASES,
    *impact.CASES,
]
