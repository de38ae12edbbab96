# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies of the mesh, and the bulk and contacts as the core's free bodies see them."""
