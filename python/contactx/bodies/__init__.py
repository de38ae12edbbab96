# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies of the mesh, their rigid modes, and what keeps free bodies solvable."""
