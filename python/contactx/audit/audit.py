# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The audit of a converged iterate, before it is accepted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.audit.deformed_cells import DeformedCells
from contactx.audit.findings import Findings
from contactx.audit.obstacles import ObstacleAudit
from contactx.audit.surfaces import SurfacesAudit
from contactx.bulk import Bulk
from contactx.errors import point_text
from contactx.interface import Interface
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, extent


class Audit:
    """Looks at a converged iterate as nothing in the Newton loop does.

    The residual says that the constraints hold which contact has set up. Whether they were the
    right ones is seen from geometry alone: from the master's side, between slave nodes, along the
    way from the last accepted configuration, and in the deformed cells.

    Attributes:
        cells: The cells of the mesh.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], halo: Halo):
        """Prepare the looks at each contact, and remember the reference configuration.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._bulk, self._interfaces, self._halo = bulk, interfaces, halo
        self.cells = DeformedCells(bulk.u.function_space)
        self._looks: list[SurfacesAudit | ObstacleAudit | None] = []
        for interface in interfaces:
            master = interface.master
            look: SurfacesAudit | ObstacleAudit | None = None
            if interface.law.is_tied:
                pass
            elif isinstance(master, core.DeformableMaster):
                look = SurfacesAudit(interface, master, halo)
            elif isinstance(master, core.ObstacleMaster) and interface.sliding == "finite":
                # In small sliding the obstacle of each node is a plane
                look = ObstacleAudit(interface, master, halo)
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
        start = self._halo.scatter_forward(self._start)
        for name, interface, look in zip(names, self._interfaces, self._looks, strict=True):
            if not interface.active:
                continue
            if isinstance(look, SurfacesAudit):
                look(name, start, findings)
            elif look is not None:
                look(name, findings)
        self._look_at_cells(findings)
        return findings

    def _look_at_cells(self, findings: Findings) -> None:
        """Cells must not be turned inside out.

        A linear material does not notice, and in small sliding nor does the contact.
        """
        if self._bulk.is_linear and all(i.sliding == "small" for i in self._interfaces):
            return
        found = self.cells.look(self._bulk.u.x.array)
        findings.smallest_det, findings.inverted = found.smallest, found.inverted
        if found.inverted == 0:
            return
        size = float(extent(self._halo.comm, self._halo.x[: self._halo.num_owned]).max())
        text = (
            f"{found.inverted} cells are turned inside out, the worst with det F = "
            f"{found.smallest:.3g} at {point_text(found.at, size)} in the reference configuration. "
        )
        if self._bulk.is_linear:
            findings.warnings.append(
                text + "A linear material does not resist that: take one for large strains"
            )
        else:
            findings.faults.append(
                text + "Take smaller load steps, or a line search (snes_linesearch_type bt)"
            )
