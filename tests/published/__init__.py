# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Benchmarks of contact that others have published, solved by contactx's default options.

A family of benchmarks is a module with a list ``CASES`` of `record.Case`. ``gallery.py`` runs them
all and writes docs/gallery.md, with a picture of each; ``test_gallery.py`` checks each error.

- ``half_space``: rigid indenters on an elastic or viscoelastic half-space, with closed formulas.
- ``hertz``: two bodies that touch in a line or a point.
- ``rolling``: a roller with traction.
- ``fitted``: rings and pins in holes.
- ``joints``: a tube expanded into its plate, the root of a blade in its slot.
- ``slender``: beams, belts and layers.
- ``leaves``: leaf springs, with friction and without.
- ``masonry``: a dry arch.
- ``stacked``: round bodies between plates.
- ``folded``: bodies that fold onto themselves.
- ``impact``: bodies with inertia that hit something.
- ``nafems``: the contact benchmarks of NAFEMS R0094.
- ``sheet``: the third of them, a plastic sheet.
- ``codes``: tests that other codes ship.
- ``ironed``: one of Code_Aster's, a die that moves along a block.
"""
