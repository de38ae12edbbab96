# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bulk and contacts as free bodies of the core see them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.bulk import Bulk
from contactx.parallel.halo import Halo

if TYPE_CHECKING:
    from contactx.interface import Interface

type Array = npt.NDArray[np.float64]


class BulkSide:
    """The bulk, as the core's ``Bulk`` describes it."""

    def __init__(self, bulk: Bulk, halo: Halo):
        """Take the bulk and its nodes."""
        self._bulk = bulk
        self._halo = halo
        self.gdim = halo.gdim

    @property
    def is_linear(self) -> bool:
        """Whether the stiffness does not depend on the displacement."""
        return self._bulk.is_linear

    @property
    def reference(self) -> Array:
        """Reference positions of all nodes."""
        return self._halo.x

    def positions(self) -> Array:
        """Current positions of all nodes."""
        return self._halo.positions()

    @property
    def displacements(self) -> Array:
        """Displacements at owned dofs."""
        u: Array = self._bulk.u.x.array[: self._halo.num_owned * self.gdim]
        return u

    @property
    def markers(self) -> npt.NDArray[np.int8]:
        """1 at owned dofs with a Dirichlet condition."""
        return self._bulk.markers[: self._halo.num_owned * self.gdim]

    def diagonal(self) -> Array:
        """Diagonal of the stiffness at owned dofs."""
        diagonal: Array = self._bulk.matrix().getDiagonal().array
        return diagonal

    def products(self, fields: Array) -> Array:
        """Products of the stiffness with fields at owned dofs, shape (count, num_dofs)."""
        K = self._bulk.matrix()
        x, y = K.createVecs()
        results = np.empty_like(fields)
        for field, result in zip(fields, results, strict=True):
            x.array[:] = field
            K.mult(x, y)
            result[:] = y.array
        return results


class ContactSide:
    """A contact, as the core's ``Holding`` describes it."""

    def __init__(self, interface: Interface):
        """Take the discrete side of the contact."""
        self._interface = interface

    @property
    def is_small(self) -> bool:
        """Whether sliding is small."""
        return self._interface.sliding == "small"

    @property
    def has_friction(self) -> bool:
        """Whether there is Coulomb friction."""
        return isinstance(self._interface.law, core.Coulomb)

    def pairing(self) -> tuple[npt.NDArray[Any], ...]:
        """Which slave nodes have a pair, normals, and the weights as triplets."""
        master = self._interface.master
        weights = master.weights()
        return master.paired, master.normals(), weights.slaves, weights.nodes, weights.values

    @property
    def status(self) -> npt.NDArray[np.int8]:
        """Status of the slave nodes."""
        return self._interface.nodes.status

    @property
    def closable_gap(self) -> Array:
        """Gap of the slave nodes, NaN where one cannot close."""
        return self._interface.nodes.closable_gap

    def rubbing(self) -> tuple[npt.NDArray[Any], ...]:
        """State of slave nodes with friction, at which the law is evaluated."""
        nodes, law = self._interface.nodes, self._interface.law
        assert isinstance(law, core.Coulomb)
        law.evaluate(nodes)
        rubs = law.friction(nodes) * nodes.pressure > 0
        return nodes.normal, nodes.multiplier, nodes.slip, nodes.value, nodes.area, rubs

    def close(self, which: npt.NDArray[np.int32]) -> None:
        """Close slave nodes."""
        self._interface.nodes.close(which)

    def set_tractions(self, which: npt.NDArray[np.int32], tractions: Array) -> None:
        """Set multipliers of slave nodes."""
        nodes = self._interface.nodes
        rows = nodes.multiplier.reshape(-1, nodes.size)
        rows[which] = tractions.reshape(-1, nodes.size)
