# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loads that grow in steps."""

from contactx.steps.load_steps import LoadSteps
from contactx.steps.table import Step

__all__ = ["LoadSteps", "Step"]
