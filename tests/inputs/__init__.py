# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What tests draw from: ``rows`` of bad input to the package, random input to the ``core``."""
