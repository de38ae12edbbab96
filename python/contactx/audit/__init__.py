# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a converged iterate is what it seems, by its geometry alone."""
