# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""contactx comes first: it loads the wheels' MPI and PETSc before a test imports petsc4py."""

import contactx  # noqa: F401
