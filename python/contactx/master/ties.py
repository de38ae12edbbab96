# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pairs that stay those of the reference configuration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.facets import FacetMaster
from contactx.master.mortar import MortarMaster

_AT = core.slip_layout


class FacetTie(FacetMaster):
    """Slave nodes tied to facets of a deformable body."""

    def __init__(self, *args: Any, **options: Any):
        """Create the pairs, none yet; the arguments are those of ``FacetMaster``."""
        super().__init__(*args, **options)
        self._found = False
        self._offset = np.zeros(len(self._slaves))

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``; only the first search counts."""
        if self._found:
            return 0
        self._found = True
        found = super().search(x, closed)
        x = self._at
        self._xi, self._gap = self._pairing.feet(x, x[self._slaves])
        foot, self._normal = self._pairing.places(x, self._xi)
        self._arm = x[self._slaves] - foot
        return found

    def update(
        self, x: npt.NDArray[np.float64], frozen_kinematics: bool, offset: npt.NDArray[np.float64]
    ) -> list[Pairs] | None:
        """See ``Master``; the offset is what a tie is longer by."""
        if np.array_equal(offset, self._offset):
            return None
        self._offset = offset
        return self.pairs()

    def _slip(self) -> npt.NDArray[np.float64]:
        data = np.zeros((len(self._slaves), _AT["size"]))
        data[:, _AT["xi"] : _AT["xi"] + 2] = self._xi
        data[:, _AT["gap"]] = self._gap + self._offset
        origin = self._arm + self._offset[:, None] * self._normal
        data[:, _AT["origin"] : _AT["origin"] + origin.shape[1]] = origin
        return data


class MortarTie(MortarMaster):
    """Slave facets tied to facets of a deformable body."""

    def __init__(self, *args: Any, **options: Any):
        """Create the pairs, none yet; the arguments are those of ``FacetMaster``."""
        super().__init__(*args, **{**options, "measures_slip": False})
        self._offset = np.zeros(len(self._paired))

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``; only the first search counts."""
        return super().search(x, closed) if self._found is None else 0

    def begin_step(self) -> None:
        """See ``Master``; nothing changes."""

    def update(
        self, x: npt.NDArray[np.float64], frozen_kinematics: bool, offset: npt.NDArray[np.float64]
    ) -> list[Pairs] | None:
        """See ``Master``; the offset is what a tie is longer by."""
        if np.array_equal(offset, self._offset):
            return None
        self._offset = offset
        return self.pairs()

    def pairs(self) -> list[Pairs]:
        """See ``Master``."""
        mortar, sides = self._mortar, self._sides
        longer = mortar.weight.sum(axis=2) * sides.at_corners(self._offset, mortar.slave)
        return sides.pairs(replace(mortar, gap=mortar.gap + longer), self._dual, self._normal)

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``; the pairs are those of the reference."""
        self._x0 = self._halo.scatter_forward(saved["before"])
