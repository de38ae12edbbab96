# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Inputs that tests draw from: ``rows`` of bad input to the package, random ones of the ``core``."""
