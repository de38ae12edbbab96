# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Calls of single kernels at random states.

- ``node_pairs``: a slave node and a master facet, and what all kernels share: the call itself,
  central differences, comparison.
- ``facet_pairs``: a slave and a master facet, with their integrals.
"""
