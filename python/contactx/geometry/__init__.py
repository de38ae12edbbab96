# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shape of the cells of a mesh, and of curved ones at contact surfaces."""
