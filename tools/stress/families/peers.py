# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes on which other codes were measured to fail: the common Hertz problem and its like."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

import contactx as cx
from dolfinx import fem

import meshes
from meshes import Tag
from scenes import HertzSphere, pressure_error
from stress.check import Check
from stress.families.grid import scenes, variants
from stress.scene import METHODS, SLIDINGS, Case, Scene, relative

# Total forces at deep indentations, on which both methods, kinematics and meshes agree: of node-to-
# surface at h = 0.02
_FORCES = {0.02: 0.0023729, 0.1: 0.030710, 0.2: 0.095299}
# Displacement, friction, modulus of the lower body, whether the block is the slave
_SCENES: dict[str, dict[str, Any]] = {
    "as it is": {},
    "0.05 in one step": {"down": 0.05},
    "0.1 in one step": {"down": 0.1},
    "0.2 in one step": {"down": 0.2},
    "friction 0.3": {"friction": 0.3},
    "friction 0.3, 0.2 in one step": {"friction": 0.3, "down": 0.2},
    "lower body 1e4 stiffer": {"lower": 1e4},
    "lower body 1e4 softer": {"lower": 1e-4},
    "lower body 1e4 stiffer, friction": {"lower": 1e4, "friction": 0.3},
    "lower body 1e4 softer, friction": {"lower": 1e-4, "friction": 0.3},
    "block is the slave": {"swapped": True},
    "block is the slave, friction": {"swapped": True, "friction": 0.3},
}


def hertz() -> Iterator[Scene]:
    """The common Hertz problem; its slave node in the middle lies on two planes of symmetry."""
    options = list(
        variants(method=METHODS, sliding=SLIDINGS, solver=("direct", "condensed"), h=(0.04,))
    )
    options += list(variants(method=METHODS, sliding=SLIDINGS, solver=("condensed",), h=(0.02,)))
    yield from scenes("where peers fail", _SCENES, options, _hertz)


def _hertz(name, method, sliding, solver, h) -> Case:
    row = _SCENES[name]
    down, mu, lower = row.get("down", 0.02), row.get("friction", 0.0), row.get("lower", 1.0)
    swapped = row.get("swapped", False)
    young = {Tag.UPPER: 1.0, Tag.LOWER: lower}
    scene = HertzSphere(
        meshes.hertz_sphere(h),
        sliding,
        down=down,
        young=young,
        friction=mu,
        swapped=swapped,
        method=method,
        petsc_options={"pc_type": "lu" if solver == "direct" else "condensed"},
    )
    problem, contact, u = scene.problem, scene.contact, scene.problem.u

    def answers():
        if down > 0.05 or swapped:
            # Not Hertz's small contact any more, or pressures of the block's nodes
            force = 4 * abs(float(contact.force[2]))
            return [relative("force of the others", force, _FORCES[down], 0.03)]
        p = contact.pressure.x.array[_rows(contact, u)]
        error = pressure_error(problem, contact, young, p)
        # On a soft master nodal pressures scatter
        rough = 2.0 if lower < 1 and method == "node-to-surface" else 1.0
        allowed = 0.35 if lower < 1 else 0.12
        return [Check("pressure against Hertz", error, rough * allowed * (h / 0.04) ** 0.5)]

    return Case(
        problem,
        [contact],
        scene.F,
        scene.bcs,
        scene.update,
        size=1.0,
        modulus=min(1.0, lower),
        answers=answers,
    )


def _rows(contact: cx.Contact, u: fem.Function) -> np.ndarray:
    """Rows of the slave nodes in the scalar space."""
    V, Q = u.function_space, contact.pressure.function_space
    row = np.empty(V.dofmap.index_map.size_local, dtype=np.int64)
    row[V.dofmap.list.ravel()] = Q.dofmap.list.ravel()
    return row[contact.slave_nodes]
