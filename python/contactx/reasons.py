# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Why a Newton loop ended, and what to do about it."""

from __future__ import annotations

from petsc4py import PETSc

UNBALANCED = (
    "the loads on a body cannot be balanced: nothing holds it and nothing is in its way, or "
    "friction barely could. Support it, or turn the loads so that they press the bodies together"
)
HIDDEN = (
    "pairs went back and forth between facets and were held, and hide a penetration: refine the "
    "master there or take smaller load steps"
)
_CODE = PETSc.SNES.ConvergedReason
_REASONS = {
    _CODE.CONVERGED_FNORM_ABS: "the residual is below the tolerance",
    _CODE.DIVERGED_MAX_IT: "no convergence in snes_max_it iterations: take smaller load steps; "
    "where nodes still change their status at the end, refine the mesh in contact, else raise "
    "snes_max_it",
    _CODE.DIVERGED_LINEAR_SOLVE: "the linear solver failed: is a body free to move without "
    "touching anything? Support it; with a Krylov solver of your own try pc_type lu",
    _CODE.DIVERGED_FUNCTION_NANORINF: "the residual is not finite: the material fails, or a body "
    "is free to move without touching anything. Take smaller load steps, or support the body",
    _CODE.DIVERGED_LINE_SEARCH: "the line search failed: take smaller load steps",
}


def reason_of(code: int, converged: bool) -> str:
    """Why SNES ended.

    Args:
        code: Its reason.
        converged: Whether the contact has converged, too.
    """
    if code > 0 and not converged:
        return f"SNES stopped by itself, with reason {code}, before the end"
    return _REASONS.get(code, f"SNES stopped with reason {code}")
