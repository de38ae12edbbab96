# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One contact on a discrete bulk: the core's contact with what DOLFINx has of it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.forms import ContactForms
from contactx._host.nodal_values import matching_nodes
from contactx._host.nodes import degree_of
from contactx._host.parallel.halo import Halo
from dolfinx import fem

type Array = npt.NDArray[np.float64]
# Name of a surface, and its facets: offsets and nodes, as in Surface.facet_nodes
type NamedSurface = tuple[str, npt.NDArray[np.int32], npt.NDArray[np.int32]]


class DiscreteContact(core.Contact):
    """A contact on the discrete bulk: see ``contact/contact.h``.

    The core has slave nodes, pairs, state and law. Here are the forms, for those who ask.

    Attributes:
        slaves: Slave nodes that this rank owns, numbered as the blocks of the displacement's
            dofmap, shape (n,).
        num_others: Number of slave nodes of other ranks that share facets with these.
        halo: Nodes of this rank.
    """

    def __init__(
        self,
        contact_mesh: core.ReferenceMesh,
        slave: NamedSurface,
        master: NamedSurface | core.Obstacle,
        halo: Halo,
        *,
        options: core.ContactOptions,
        is_self: bool,
        level: npt.NDArray[np.int8],
        weight: Callable[[npt.NDArray[np.int32]], npt.NDArray[np.float64]] | None,
        markers: npt.NDArray[np.int8],
    ):
        """Pair the slave nodes in the reference configuration; all ranks must take part.

        Args:
            contact_mesh: The mesh on this rank.
            slave: Name, offsets and nodes of the slave facets.
            master: The same of the master, or an obstacle.
            halo: Nodes of this rank.
            options: Options of the contact.
            is_self: Whether slave and master are the same surface.
            level: Where nodes are on quadratic facets, shape (num_bulk,), or none.
            weight: Factor of contact's integrals at some nodes; None for one.
            markers: 1 at dofs of the bulk with a Dirichlet condition, shape (num_dofs,).

        Raises:
            ValueError: As ``problem/make_contact.h`` says.
        """
        super().__init__(
            contact_mesh,
            slave,
            master,
            options,
            is_self=is_self,
            level=level,
            weight=weight,
            prescribed=markers,
        )
        self.halo = halo
        slaves = self.slave_nodes
        self.slaves = slaves.owned
        self.num_others = len(slaves.around) - len(slaves.owned)
        self._forms: ContactForms | None = None

    def positions(self) -> npt.NDArray[np.float64]:
        """Current positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.positions()

    def forms(self) -> ContactForms:
        """Forms of the current pairs, see ``Contact.forms``; all ranks must take part."""
        if self._forms is None:
            self._forms = ContactForms(self)
        self._forms.update()
        return self._forms

    @property
    def current_forms(self) -> ContactForms:
        """The forms as of the last call of ``forms``."""
        assert self._forms is not None
        return self._forms


class Fields:
    """Results of a contact in the bulk's nodal spaces; see ``results/results.h``.

    Attributes:
        results: The core's results, which its driver of a step updates and restores.
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

    def __init__(self, discrete: DiscreteContact, V: fem.FunctionSpace):
        """Create the functions; all ranks must take part.

        Args:
            discrete: The contact on the discrete bulk.
            V: Space of the displacement.
        """
        self.results = core.Results(discrete)
        Q = fem.functionspace(V.mesh, ("Lagrange", degree_of(V)))
        # Both spaces number the nodes; where they differ the results must follow the bulk
        self._every = matching_nodes(V, Q)[: discrete.halo.num_owned]
        self._slaves, self._nodes = discrete.slaves, self._every[discrete.slaves]
        self.pressure = fem.Function(Q, name="pressure")
        self.master_pressure = fem.Function(Q, name="master_pressure")
        self.traction = fem.Function(V, name="traction")
        self.gap = fem.Function(Q, name="gap")
        self.status = fem.Function(Q, name="status")
        tied = discrete.law.is_tied
        self.slip = None if tied else fem.Function(V, name="slip")
        self.slip_total = None if tied else fem.Function(Q, name="slip_total")
        self.gap.x.array[:] = np.nan
        self.status.x.array[:] = -1
        self.update()

    def evaluate(self) -> None:
        """Evaluate the results for the state of now; all ranks must take part."""
        self.results.update()
        self.update()

    def update(self) -> None:
        """Take the core's results as they are; all ranks must take part."""
        results = self.results
        self.force, self.imbalance = results.force, results.imbalance
        self.recovery_change = results.recovery_change
        for name, f in vars(self).items():
            if isinstance(f, fem.Function):
                values = getattr(results, name)
                rows = self._every if f is self.master_pressure else self._nodes
                if values.ndim == 1:
                    f.x.array[rows] = values
                else:
                    f.x.array.reshape(-1, values.shape[1])[self._slaves] = values
                f.x.scatter_forward()

    def moment(self, point: Array) -> Array:
        """Moment of the forces on the slave side about a point; all ranks must take part.

        Args:
            point: The point, shape (gdim,).

        Returns:
            The moment, shape (1,) in 2D, counter-clockwise, and (3,) in 3D.

        Raises:
            RuntimeError: If the model is axisymmetric.
        """
        return self.results.moment(point)

    def totals(self) -> core.Totals:
        """Sums and extremes over all ranks, which must take part."""
        return self.results.totals()

    def on_both(self, f: fem.Function, missing: float) -> fem.Function:
        """See ``Contact.on_both``."""
        result = self._empty(f)
        result.x.array[:] = missing
        result.x.array[self._every] = self.results.on_both(f.x.array[self._nodes], missing)
        result.x.scatter_forward()
        return result

    def across(self, f: fem.Function) -> fem.Function:
        """See ``Contact.across``."""
        result = self._empty(f)
        result.x.array[self._every] = self.results.across(f.x.array[self._every])
        result.x.scatter_forward()
        return result

    def _empty(self, f: fem.Function) -> fem.Function:
        """A function of the space of these results, which f must be of as well."""
        Q = self.pressure.function_space
        element = f.function_space.ufl_element()
        if f.function_space.mesh is not Q.mesh or element != Q.ufl_element():
            raise ValueError(
                f"f is of {element}: take the space of the contact's results, that is "
                f'functionspace(mesh, ("Lagrange", {degree_of(Q)}))'
            )
        return fem.Function(Q, name=f.name)

    def recovered_pressure(self) -> Array:
        """Pressures of the slave nodes for the multipliers of now; all ranks must take part."""
        return self.results.recovered_pressure()
