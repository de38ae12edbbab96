# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Degree of the displacement of the scenes of blocks: the map can be drawn of either."""

from __future__ import annotations

import os

VARIABLE = "CONTACTX_STRESS_DEGREE"
DEGREE = int(os.environ.get(VARIABLE, "1"))
