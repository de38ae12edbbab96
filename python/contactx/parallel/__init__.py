# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What contact needs of MPI: nodes of other ranks, few messages, one answer on all ranks."""
