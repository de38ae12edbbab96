# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results of a contact as functions of the bulk."""

from __future__ import annotations

import numpy as np

from contactx.interface import Interface
from contactx.nodal import matching_nodes
from dolfinx import fem


class Fields:
    """Results of a contact in the bulk's nodal spaces.

    Attributes:
        pressure: Contact pressure.
        traction: Traction that the master exerts on the slave.
        gap: Gap.
        status: Status.
        slip: Slip increment of the last step; None without friction.
        slip_total: Its accumulated length; None without friction.
        force: Total force on the slave side, shape (gdim,).
        imbalance: Sum of the contact's forces on both sides, shape (gdim,).
    """

    def __init__(self, interface: Interface, V: fem.FunctionSpace):
        """Create the functions.

        Args:
            interface: Discrete side of the contact.
            V: Space of the displacement.
        """
        self._interface = interface
        self._gdim = V.mesh.geometry.dim
        Q = fem.functionspace(V.mesh, ("Lagrange", 1))
        # Both spaces number the vertices; where they differ the results must follow the bulk
        self._nodes = matching_nodes(V, Q)[interface.slaves]
        self.pressure = fem.Function(Q, name="pressure")
        self.traction = fem.Function(V, name="traction")
        self.gap = fem.Function(Q, name="gap")
        self.status = fem.Function(Q, name="status")
        measured = interface.history is not None
        self.slip = fem.Function(V, name="slip") if measured else None
        self.slip_total = fem.Function(Q, name="slip_total") if measured else None
        self.force = np.zeros(self._gdim)
        self.imbalance = np.zeros(self._gdim)
        self.gap.x.array[:] = np.nan
        self.status.x.array[:] = -1
        self.status.x.array[self._nodes] = 0

    def update(self) -> None:
        """Read the results from the discrete side."""
        interface = self._interface
        nodes = interface.nodes
        area = nodes.area[:, None]
        self.pressure.x.array[self._nodes] = nodes.pressure
        self.gap.x.array[self._nodes] = nodes.gap
        self.status.x.array[self._nodes] = nodes.status
        if interface.history is not None and self.slip is not None and self.slip_total is not None:
            slip = self.slip.x.array.reshape(-1, self._gdim)
            slip[interface.slaves] = interface.history.slip
            self.slip_total.x.array[self._nodes] = interface.history.total

        forces = np.zeros_like(self.traction.x.array)
        interface.add_residual(forces)
        forces = -forces.reshape(-1, self._gdim)
        on_slave = forces[interface.slaves]
        traction = self.traction.x.array.reshape(-1, self._gdim)
        traction[interface.slaves] = np.divide(
            on_slave, area, out=np.zeros_like(on_slave), where=area > 0
        )
        self.force = on_slave.sum(axis=0)
        # What a rigid obstacle is pushed with goes to its support
        carried = self.force if interface.master.is_rigid else 0
        self.imbalance = forces.sum(axis=0) - carried
