# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The audit of a converged iterate, before it is accepted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.audit.findings import Findings
from contactx.audit.obstacles import ObstacleAudit
from contactx.audit.surfaces import SurfacesAudit
from contactx.interface import Interface
from contactx.master.facets import FacetMaster
from contactx.master.mortar import MortarMaster
from contactx.master.obstacle import ObstacleMaster
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere


class Audit:
    """Looks at a converged iterate as nothing in the Newton loop does.

    The residual says that the constraints hold which contact has set up. Whether they were the
    right ones is seen from geometry alone: from the master's side, between slave nodes, along the
    way from the last accepted configuration, and in the deformed cells.
    """

    def __init__(self, interfaces: Sequence[Interface], halo: Halo):
        """Prepare the looks at each contact, and remember the reference configuration.

        Args:
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._interfaces, self._halo = interfaces, halo
        self._looks: list[SurfacesAudit | ObstacleAudit | None] = []
        for interface in interfaces:
            master = interface.master
            look: SurfacesAudit | ObstacleAudit | None = None
            if interface.law.is_tied:
                pass
            elif isinstance(master, ObstacleMaster):
                # Normals of small sliding are those of the reference, and so is their facing
                look = ObstacleAudit(interface, master, halo) if _is_finite(interface) else None
            elif isinstance(master, FacetMaster | MortarMaster):
                look = SurfacesAudit(interface, master, halo)
            self._looks.append(look)
        self.accept()

    def accept(self) -> None:
        """Take the configuration of now as the one before the next step; collective."""
        self._start = self._owned()
        for look in self._looks:
            if look is not None:
                look.accept()

    def begin_step(self) -> None:
        """Start a step, from wherever the displacement is now; collective."""
        if anywhere(self._halo.comm, not np.array_equal(self._start, self._owned())):
            self.accept()

    def _owned(self) -> npt.NDArray[np.float64]:
        return np.array(self._halo.positions()[: self._halo.num_owned])

    def __call__(self, names: Sequence[str]) -> Findings:
        """Look at the state of now; all ranks must take part.

        Args:
            names: Names of the contacts, for messages.
        """
        findings = Findings()
        for name, interface, look in zip(names, self._interfaces, self._looks, strict=True):
            if look is not None and interface.active:
                look(name, findings)
        return findings


def _is_finite(interface: Interface) -> bool:
    return interface.sliding == "finite"
