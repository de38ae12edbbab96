# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scripts on several ranks: ``launch`` starts them, ``watch`` ends what hangs.

The scripts that the tests launch are here too, with what they share: ``cases`` are
solved on partitions of any kind, and ``outcome`` compares what came out.
"""
