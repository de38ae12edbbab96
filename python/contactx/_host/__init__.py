# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the modules that users import are made of: contactx's host on DOLFINx and PETSc."""
