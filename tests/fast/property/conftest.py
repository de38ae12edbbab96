# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The same examples in each run, none kept from one to the next."""

from hypothesis import settings

settings.register_profile("contactx", derandomize=True, deadline=None, database=None)
settings.load_profile("contactx")
