# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The audit of a converged iterate, before it is accepted."""

from __future__ import annotations

from collections.abc import Sequence

from contactx import cpp as core
from contactx.audit.deformed_cells import DeformedCells
from contactx.audit.findings import Findings
from contactx.bulk import Bulk
from contactx.interface import Interface
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import extent


class Audit:
    """Checks a converged iterate by its geometry, which the residual does not see.

    The residual says that the constraints hold which contact has set up. Whether they were the
    right ones is seen from geometry alone: of contacts by the core, see ``audit/audit.h``, and in
    the deformed cells.

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
        self._size = float(extent(halo.comm, halo.x[: halo.num_owned]).max())
        self._read_offsets()
        self._contacts = core.Audit(halo.nodes, list(interfaces))

    def accept(self) -> None:
        """Take the configuration of now as the one before the next step; collective."""
        self._contacts.accept()

    def begin_step(self) -> None:
        """Start a step, from wherever the displacement is now; collective."""
        self._read_offsets()
        self._contacts.begin_step()

    def _read_offsets(self) -> None:
        """Hand the core the current offsets: nodes may be behind the master by as much."""
        with agreed(self._halo.comm):
            for interface in self._interfaces:
                interface.set_offset(interface.offset())

    def __call__(self, names: Sequence[str]) -> Findings:
        """Look at the state of now; all ranks must take part.

        Args:
            names: Names of the contacts, for messages.
        """
        findings = Findings()
        looks = zip(names, self._interfaces, self._contacts.look(), strict=True)
        for name, interface, found in looks:
            findings.add(name, interface, found, self._size)
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
        text = (
            f"{found.inverted} cells are turned inside out, the worst with det F = "
            f"{found.smallest:.3g} at {core.point_text(found.at, self._size)} in the reference "
            "configuration. "
        )
        if self._bulk.is_linear:
            findings.warnings.append(
                text + "A linear material does not resist that: take one for large strains "
                "(manual: errors/cells-inside-out)"
            )
        else:
            findings.faults.append(
                text + "Take smaller load steps, or a line search (snes_linesearch_type bt) "
                "(manual: errors/cells-inside-out)"
            )
