# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shape of cells and facets, and how surfaces and bodies lie in the reference configuration."""
