# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes of several steps with everything in them that can go wrong."""

from __future__ import annotations

from typing import Any

import numpy as np
from driven_blocks import neo_hookean
from rows import scalar, state

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import NU, Blocks
from story import traction


class Rubbing:
    """Two blocks that rub, with a switch for each thing that may become bad.

    Attributes:
        u: Displacement.
        contact: Contact.
        problem: The problem.
        history: A function that belongs to the state.
        young: Young's modulus in the residual.
        tangent: Factor of the Jacobian.
        load: Traction on the top block's side.
        friction: Coefficient.
        offset: Offset.
    """

    def __init__(self, method: str = "node-to-surface", solver: str = "lu", **kind: Any):
        self.blocks = blocks = Blocks(CellType.quadrilateral, n_upper=3, n_lower=4)
        self.u, domain = blocks.u, blocks.u.function_space.mesh
        self.young, self.tangent = fem.Constant(domain, 1.0), fem.Constant(domain, 1.0)
        self.load = fem.Constant(domain, (0.0, 0.0))
        blocks.F = neo_hookean(self.u, self.young, NU) + traction(
            self.u, blocks.tags, Tag.UPPER_X0, self.load
        )
        self.friction, self.offset = scalar(blocks, 0.2), scalar(blocks, 0.0)
        kind = {"friction": self.friction, **kind}
        self.contact = blocks.contact(method=method, offset=self.offset, **kind)
        self.problem = blocks.problem(
            self.contact,
            J=self.tangent * ufl.derivative(blocks.F, self.u),
            petsc_options={"pc_type": solver},
        )
        self._down, self._side = blocks.bcs[-1], blocks.bcs[-2]
        self.history = fem.Function(fem.functionspace(domain, ("DG", 0)))

    def update(self, t: float) -> None:
        """Press, and push to and fro."""
        self._down.g.value[...] = -0.08 * min(2 * t, 1)
        self._side.g.value[...] = 0.3 * np.sin(2 * np.pi * t)

    def state(self) -> list[bytes]:
        """Bits of the state."""
        return state(self.problem, self.history)

    def steps(self, steps: Any, **options: Any) -> cx.LoadSteps:
        """Load steps without a display."""
        options = {"history": [self.history], "progress": False, **options}
        return cx.LoadSteps(self.problem, steps, options.pop("update", self.update), **options)

    def run(self, steps: cx.LoadSteps) -> None:
        """Take the steps that are left; a material would remember each of them."""
        for step in steps:
            self.history.x.array[:] = 2 * self.history.x.array + step.index


KINDS: dict[str, dict[str, Any]] = {
    "nodes": {},
    "facets": {"method": "surface-to-surface"},
    "condensed": {"solver": "condensed"},
    "small": {"sliding": "small"},
    "tied": {"tied": True, "friction": 0.0},
    "frictionless": {"friction": 0.0},
}
