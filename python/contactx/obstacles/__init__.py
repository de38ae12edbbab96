# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid bodies that deformable ones come into contact with."""

from __future__ import annotations

from contactx.cpp import Obstacle
from contactx.obstacles.cylinder import Cylinder
from contactx.obstacles.level_set import LevelSet
from contactx.obstacles.plane import Plane
from contactx.obstacles.sphere import Sphere

__all__ = ["Cylinder", "LevelSet", "Obstacle", "Plane", "Sphere"]
