# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures of contact problems, made off screen: deformed bodies, curves against formulas."""

from __future__ import annotations

from plot.curve import curves, pressure_curve
from plot.deformed import deformed_bodies
from plot.face_map import STATUS_NAMES, nodal_map

__all__ = ["STATUS_NAMES", "curves", "deformed_bodies", "nodal_map", "pressure_curve"]
