# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cases solved on several ranks, all of a number of ranks in one launch, against one rank."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ranks.cases import Case
from ranks.launch import SCRIPTS, alone, launch_together
from ranks.outcome import Array, differences

SCRIPT = SCRIPTS / "cases.py"
TOLERANCE = 1e-9
# Iterations may differ: on the way out of yield rounding decides which tangent the material has,
# and early solves of the condensed solver are as rough as the preconditioner of the ranks' parts
ROUNDED = (
    "plastic",
    "hertz_condensed",
    "beam_condensed",
    # The last iterate but one leaves 0.9 to 1.1 of the tolerance
    "quadratic_tetrahedra",
)


class Runs:
    """Solves the wanted cases, all of a number of ranks in one launch."""

    def __init__(self, folder: Path, wanted: Sequence[tuple[Case, int]]):
        """Take what is wanted: cases and numbers of ranks."""
        self._folder = folder
        alone = [(Case(case.scene, case.method), 1) for case, _ in wanted]
        self._wanted = list(dict.fromkeys([*wanted, *alone]))
        self._wrong: dict[int, dict[str, str]] = {}

    def get(self, case: Case, ranks: int) -> dict[str, Array]:
        """Results of a case, which fails if it came to none."""
        if ranks not in self._wrong:
            names = [str(case) for case, n in self._wanted if n == ranks]
            self._wrong[ranks] = self._launch(ranks, names)
        if str(case) in self._wrong[ranks]:
            pytest.fail(self._wrong[ranks][str(case)])
        with np.load(self._file(str(case), ranks)) as file:
            found = dict(file)
        print(f"{found.pop('seconds'):.2f} s")
        if "error" in found:
            pytest.fail(str(found["error"]))
        return found

    def _launch(self, ranks: int, names: Sequence[str]) -> dict[str, str]:
        """Solve cases; those of one rank on all cores, as each leaves the others idle."""
        parts = min(len(names), os.cpu_count() or 1) if ranks == 1 else 1

        def part(k: int) -> dict[str, str]:
            chosen = names[k::parts]
            return launch_together(
                SCRIPT, ranks, self._folder, chosen, lambda name: self._file(name, ranks)
            )

        with alone(), ThreadPoolExecutor(parts) as pool:
            return {
                name: text for wrong in pool.map(part, range(parts)) for name, text in wrong.items()
            }

    def _file(self, name: str, ranks: int) -> Path:
        return self._folder / f"{name}-{ranks}.npz"

    @classmethod
    def selected(cls, request: Any, folder: Path) -> Runs:
        """Runs of the cases of a module of tests that pytest has selected."""
        return cls(
            folder,
            [
                (item.callspec.params["case"], item.callspec.params["ranks"])
                for item in request.session.items
                if item.path == request.path and hasattr(item, "callspec")
            ],
        )

    def check(self, case: Case, ranks: int) -> None:
        """Check that a case has the answer of one rank."""
        expected = self.get(Case(case.scene, case.method), 1)
        found = self.get(case, ranks)
        if case.scene in ROUNDED:
            found["step iterations"] = expected["step iterations"]
        texts = differences(found, expected, TOLERANCE)
        assert not texts, texts
