# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Direct solvers: those of builds of PETSc without MUMPS, and factors that there are not."""

from petsc4py import PETSc

import numpy as np
import pytest

from contactx._host import compat
from dolfinx.mesh import CellType

from scenes.driven import DrivenBlock
from scenes.refilled import LARGEST, sizes


@pytest.mark.skipif(not PETSc.Sys.hasExternalPackage("superlu_dist"), reason="not in this PETSc")
@pytest.mark.parametrize("method", ["node-to-surface"], indirect=True)
def test_superlu_dist_goes_on_at_a_zero_pivot(monkeypatch, method):
    """It has no other rows to pivot with, and once said that the linear solver failed."""
    monkeypatch.setattr(compat, "direct_solver", lambda: "superlu_dist")
    scene = DrivenBlock(CellType.hexahedron, sliding="small", friction=0.3, n_upper=2, n_lower=3)
    scene.step(0, 0, -0.02)
    for k in range(1, 13):
        angle = np.pi / 6 * k
        scene.step(0.3 * (np.cos(angle) - 1), 0.3 * np.sin(angle), -0.02)
    assert scene.normal > 0


def test_a_matrix_without_factors_leaves_nothing_behind():
    """PETSc once raised that MUMPS was asked to solve without them, or had none ever after."""
    assert sizes([False, True, True, False]) == pytest.approx([LARGEST, np.inf, np.inf, LARGEST])
    assert sizes([True, True, False]) == pytest.approx([np.inf, np.inf, LARGEST])
