# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Closed formulas of contact mechanics, to compare computed solutions with."""

from __future__ import annotations

from reference.bolted_joint import BoltedJoint
from reference.cattaneo_mindlin import CattaneoMindlin
from reference.euler_belt import belt_ratio
from reference.hertz_cylinder import HertzCylinder
from reference.hertz_sphere import HertzSphere
from reference.modulus import contact_modulus
from reference.o_ring import SqueezedCord
from reference.press_fit import PressFit
from reference.snap_fit import SnapFit

__all__ = [
    "BoltedJoint",
    "CattaneoMindlin",
    "HertzCylinder",
    "HertzSphere",
    "PressFit",
    "SnapFit",
    "SqueezedCord",
    "belt_ratio",
    "contact_modulus",
]
