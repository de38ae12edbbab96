# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Communication of contact: nodes of other ranks, sparse messages, errors of all ranks."""
