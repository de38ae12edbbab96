# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results of a contact as functions of the bulk.

Pressure and traction are recovered from the multipliers, for every kind of contact as
``contact/recovery.h`` describes; all else is as it was solved for.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.interface import Interface
from contactx.nodal import matching_nodes
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import total
from contactx.refined import degree_of
from dolfinx import fem

type Array = npt.NDArray[np.float64]


class Fields:
    """Results of a contact in the bulk's nodal spaces.

    Attributes:
        pressure: Contact pressure, recovered.
        master_pressure: Its means at the nodes of the master.
        traction: Traction that the master exerts on the slave, recovered.
        gap: Gap.
        status: Status.
        slip: Slip increment of the last step, zero without friction; None of a tie.
        slip_total: Its accumulated length; the same.
        force: Total force on the slave side, shape (gdim,).
        imbalance: Sum of the contact's forces on both sides, shape (gdim,).
        recovery_change: By how much the recovered tractions change the force, over the sum of the
            nodes' forces.
    """

    def __init__(
        self, interface: Interface, V: fem.FunctionSpace, slaves: core.SlaveNodes, halo: Halo
    ):
        """Create the functions.

        Args:
            interface: Discrete side of the contact.
            V: Space of the displacement.
            slaves: Slave nodes.
            halo: Nodes of this rank.
        """
        self._interface = interface
        self._halo = halo
        self._gdim = halo.gdim
        self._recovery = core.Recovery(slaves, halo.x)
        Q = fem.functionspace(V.mesh, ("Lagrange", degree_of(V)))
        # Both spaces number the nodes; where they differ the results must follow the bulk
        self._every = matching_nodes(V, Q)[: halo.num_owned]
        self._nodes = self._every[interface.slaves]
        self.pressure = fem.Function(Q, name="pressure")
        self.master_pressure = fem.Function(Q, name="master_pressure")
        self.traction = fem.Function(V, name="traction")
        self.gap = fem.Function(Q, name="gap")
        self.status = fem.Function(Q, name="status")
        tied = interface.law.is_tied
        self.slip = None if tied else fem.Function(V, name="slip")
        self.slip_total = None if tied else fem.Function(Q, name="slip_total")
        self.force = np.zeros(self._gdim)
        # Forces on the slave nodes and where they act
        self._on_slave = self._at = np.zeros((len(interface.slaves), self._gdim))
        self.imbalance = np.zeros(self._gdim)
        self.recovery_change = 0.0
        self.gap.x.array[:] = np.nan
        self.status.x.array[:] = -1
        self.status.x.array[self._nodes] = 0
        self.status.x.scatter_forward()

    def update(self) -> None:
        """Read the results from the discrete side; all ranks must take part."""
        interface = self._interface
        nodes = interface.nodes
        # Nodes that are left out have what their neighbours have; of two status the more open one
        filled = self._recovery.filled(nodes.gap)
        status = np.floor(self._recovery.filled(nodes.status.astype(np.float64)) + 1e-9)
        left_out = np.isnan(nodes.gap) & ~np.isnan(filled)
        self.gap.x.array[self._nodes] = np.where(left_out, filled, nodes.gap)
        self.status.x.array[self._nodes] = np.where(left_out, status, nodes.status)
        if interface.history is not None and self.slip is not None and self.slip_total is not None:
            slip = self.slip.x.array.reshape(-1, self._gdim)
            slip[interface.slaves] = interface.history.slip
            self.slip_total.x.array[self._nodes] = interface.history.total

        forces = self._forces()
        on_slave = self._on_slave = forces[interface.slaves]
        if interface.is_self:
            # All nodes may be slaves: those that are, as no node is on both sides
            on_slave[~nodes.closed] = 0
        self._at = interface.positions()[interface.slaves]
        comm = self._halo.comm
        self.force, sum_ = total(comm, np.stack([on_slave.sum(axis=0), forces.sum(axis=0)]))
        # The force on a rigid obstacle goes to its support
        carried = self.force if interface.master.is_rigid else 0
        self.imbalance = sum_ - carried
        self._recover(on_slave)
        if not interface.master.is_rigid:
            pressure = self.pressure.x.array[self._nodes]
            at_master = core.Transfer(interface).at_master(pressure)
            self.master_pressure.x.array[self._every] = np.nan_to_num(at_master)
        for function in vars(self).values():
            if isinstance(function, fem.Function):
                function.x.scatter_forward()

    def moment(self, point: Array) -> Array:
        """Moment of the forces on the slave side about a point; all ranks must take part.

        Args:
            point: The point, shape (gdim,).

        Returns:
            The moment, shape (1,) in 2D, counter-clockwise, and (3,) in 3D.
        """
        arm, force = self._at - point, self._on_slave
        if self._gdim == 2:
            each = (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0])[:, None]
        else:
            each = np.cross(arm, force)
        moment: Array = total(self._halo.comm, each.sum(axis=0))
        return moment

    def on_both(self, f: fem.Function, missing: float) -> fem.Function:
        """See ``Contact.on_both``."""
        result = self._empty(f)
        values = f.x.array[self._nodes]
        is_known = ~np.isnan(values)
        transfer = core.Transfer(self._interface)
        # Means of those that are known
        shares = transfer.at_master(is_known.astype(np.float64))
        with np.errstate(invalid="ignore", divide="ignore"):
            means = transfer.at_master(np.where(is_known, values, 0.0)) / shares
        result.x.array[:] = missing
        result.x.array[self._every] = np.where(np.isnan(means), missing, means)
        result.x.array[self._nodes] = np.where(is_known, values, missing)
        result.x.scatter_forward()
        return result

    def across(self, f: fem.Function) -> fem.Function:
        """See ``Contact.across``."""
        result = self._empty(f)
        own = f.x.array[self._every]
        transfer = core.Transfer(self._interface)
        means = transfer.at_master(own[self._interface.slaves])
        result.x.array[:] = f.x.array
        result.x.array[self._every] = np.where(np.isnan(means), own, means)
        differences = transfer.differences(self._halo.scatter_forward(np.ascontiguousarray(own)))
        result.x.array[self._nodes] = own[self._interface.slaves] - differences
        result.x.scatter_forward()
        return result

    def _empty(self, f: fem.Function) -> fem.Function:
        """A function of the space of these results, which f must be of as well."""
        if self._interface.master.is_rigid:
            raise ValueError(
                "the master is a rigid obstacle, which has no nodes: take the "
                "result itself, on the slave"
            )
        Q = self.pressure.function_space
        element = f.function_space.ufl_element()
        if f.function_space.mesh is not Q.mesh or element != Q.ufl_element():
            raise ValueError(
                f"f is of {element}: take the space of the contact's results, that is "
                f'functionspace(mesh, ("Lagrange", {degree_of(Q)}))'
            )
        return fem.Function(Q, name=f.name)

    def _forces(self) -> Array:
        """Forces of the multipliers on the nodes that this rank owns, shape (num_owned, gdim)."""
        forces: Array = np.zeros((self._halo.num_nodes, self._gdim))
        self._interface.add_residual(forces.ravel())
        return -self._halo.scatter_reverse(forces)

    def _recover(self, forces: Array) -> None:
        """Set pressure and traction.

        Args:
            forces: Forces of the multipliers on the slave nodes, shape (n, gdim).
        """
        nodes, slaves = self._interface.nodes, self._interface.slaves
        area, closed = nodes.area, nodes.closed
        if nodes.size == 1:
            p = self._recovery.pressure(nodes.pressure, area, closed)
            raw = nodes.multiplier.copy()
            nodes.multiplier[:] = p
            recovered = self._forces()[slaves]
            nodes.multiplier[:] = raw
            traction = recovered / area[:, None]
        else:
            p, traction = self._recovery.tractions(nodes.multiplier, nodes.normal, area, closed)
        recovered = (area * self._recovery.ratio)[:, None] * traction
        self.pressure.x.array[self._nodes] = self._between(p)
        self.traction.x.array.reshape(-1, self._gdim)[slaves] = self._between(traction)
        self.recovery_change = core.recovery_change(self._halo.nodes, forces, recovered)

    def recovered_pressure(self) -> Array:
        """Pressures of the slave nodes for the multipliers of now; all ranks must take part."""
        nodes = self._interface.nodes
        area, closed = nodes.area, nodes.closed
        if nodes.size == 1:
            p = self._recovery.pressure(nodes.pressure, area, closed)
        else:
            p, _ = self._recovery.tractions(nodes.multiplier, nodes.normal, area, closed)
        return self._between(p)

    def _between(self, values: Array) -> Array:
        """Values with those of vertices of quadratic triangles from the nodes beside them.

        Args:
            values: Tractions of the slave nodes, shape (n,) or (n, gdim).
        """
        filled = self._recovery.filled(values)
        # One that is alone in contact keeps its own
        return np.where(filled == 0, values, filled)
