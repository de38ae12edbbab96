# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Constraints on the bulk by dolfinx_mpc are refused, not left out."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks
from story import elasticity


class Constraint:
    """What contactx sees of a MultiPointConstraint."""

    def __init__(self, V):
        self.finalized = True
        self.function_space = V


def test_a_space_that_a_constraint_has_made_is_refused(monkeypatch):
    monkeypatch.setitem(
        sys.modules, "dolfinx_mpc", SimpleNamespace(MultiPointConstraint=Constraint)
    )
    scene = Blocks(CellType.triangle)
    V = scene.u.function_space
    constraint = Constraint(V)
    with pytest.raises(ValueError, match="u is in the function space of a MultiPointConstraint"):
        scene.problem(scene.contact())
    constraint.function_space = fem.functionspace(V.mesh, ("Lagrange", 1, (2,)))
    scene.problem(scene.contact()).solve()


def test_with_dolfinx_mpc():
    dolfinx_mpc = pytest.importorskip("dolfinx_mpc")
    scene = Blocks(CellType.triangle)
    V = scene.u.function_space
    mpc = dolfinx_mpc.MultiPointConstraint(V)
    mpc.create_periodic_constraint_geometrical(
        V,
        lambda x: np.isclose(x[0], x[0].max()),
        lambda x: np.stack([x[0] - x[0].max() + x[0].min(), x[1], x[2]]),
        [],
    )
    mpc.finalize()
    # The space that it was made of is as it was
    scene.problem(scene.contact()).solve()
    u = fem.Function(mpc.function_space)
    with pytest.raises(ValueError, match="u is in the function space of a MultiPointConstraint"):
        cx.ContactAssembler(elasticity(u, 1.0, 0.3), u, contacts=[scene.contact()])
