# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Errors that contactx raises."""

from __future__ import annotations

from typing import TYPE_CHECKING

from contactx import cpp as core

if TYPE_CHECKING:
    from contactx.report import Report


# Residual or Jacobian of the bodies are not finite: the step does not converge
NotFiniteError = core.NotFiniteError


class ConvergenceError(RuntimeError):
    """A step did not converge; the displacement and the contacts are as before it.

    Attributes:
        reason: Why the Newton loop ended.
        report: Report of the failed step, with its table of iterations.
    """

    def __init__(self, reason: str, report: Report):
        """Create the error.

        Args:
            reason: Why the Newton loop ended.
            report: Report of the failed step.
        """
        super().__init__(f"contact did not converge: {reason}\n{report.table()}")
        self.reason = reason
        self.report = report

    def __reduce__(self) -> tuple[type[ConvergenceError], tuple[str, Report], dict[str, object]]:
        """Copy it by what it was made of, to other ranks for example."""
        return type(self), (self.reason, self.report), self.__dict__
