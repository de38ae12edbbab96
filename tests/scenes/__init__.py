# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Problems that tests and benchmarks solve, and what they are made of.

Two blocks, the upper one on the lower one:

- ``blocks``: ``Blocks``, both elastic, supported and pressed; for whatever needs some contact.
- ``driven``: ``DrivenBlock``, whose top goes any way, on a plane or on a base that goes any way;
  each step is checked against Coulomb's law.
- ``tower``: ``Tower``, boxes of one width, tied or not, to which known fields are given.
- ``exact_blocks``: blocks whose solution is known, by the formulas in ``exact``.
- ``coupled``: blocks whose displacement is solved for with a pressure or a temperature; ``heat``:
  blocks in line that heat presses together, with the exact answer.
- ``transforms``: any two bodies, solved in other units, axes and numbers.

Others:

- ``cracked``: a block with a closed crack, whose faces share the nodes of its tip.
- ``hertz``: ``HertzSphere``, the common Hertz problem, and its error against Hertz.
- ``two_spheres``: ``TwoSpheres``, a soft one and a stiff one, pressed by a force.
- ``ball_at_edge``: ``BallAtEdge``, a ball that is pushed on the edge of a plate.
- ``fits``: ``PinInHole`` and ``Taper``, round things that exactly fill their holes.
- ``steps``: scenes of several load steps, with all that may fail, and the state that they leave.

What they are made of:

- ``materials``: neo-Hookean and plastic bodies, and values that differ between bodies; the linear
  material is that of the demos' ``story``.
- ``problems``: the contact of two bodies, and the problem of some contacts; ``grids``: meshes.
- ``supports``: faces that are fixed or driven.
- ``coulomb``: the check of Coulomb's law at slave nodes.
- ``covering``: which combinations of parameters a test runs (needs pytest, as nothing else here).
"""

from scenes.blocks import CELLS, NU, Blocks, dimension
from scenes.hertz import (
    HertzSphere,
    hertz_of,
    hertz_sphere,
    integrated_error,
    pressure_error,
)

__all__ = [
    "CELLS",
    "NU",
    "Blocks",
    "HertzSphere",
    "dimension",
    "hertz_of",
    "hertz_sphere",
    "integrated_error",
    "pressure_error",
]
