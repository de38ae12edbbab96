# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia."""

from contactx.cpp import Balance
from contactx.dynamics.problem import ContactDynamics

__all__ = ["Balance", "ContactDynamics"]
