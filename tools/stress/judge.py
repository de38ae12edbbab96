# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a state that was reported as converged is one.

The bulk's forces are assembled anew, without contactx, and penetration is looked for in the
deformed bodies. Without friction the directions of forces are compared with the deformed faces, and
the work of what moves the bodies with the energy that they store. Gaps, slip and multipliers are
what contactx says; that they are right follows from the forces and the bodies, and from what its
own tests prove.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from stress import inside, work
from stress.degree import DEGREE, split, vertex_nodes
from stress.directions import Directions
from stress.scene import Case, Check
from stress.sides import DEEP

_EPS = np.finfo(np.float64).eps
_ALLOWED = 1e-8


class Judge:
    """Judges the states of a case."""

    def __init__(self, case: Case):
        """Prepare what does not change."""
        self._case = case
        self._u = u = case.problem.u
        V = u.function_space
        self._gdim = V.dofmap.index_map_bs
        self._form = fem.form(case.F)
        self._stiffness = fem.form(ufl.derivative(case.F, u))
        self._fixed = np.zeros(len(u.x.array), dtype=bool)
        for bc in case.bcs:
            self._fixed[bc.dof_indices()[0]] = True
        self._fixed = self._fixed.reshape(-1, self._gdim)
        self._x = V.tabulate_dof_coordinates()[:, : self._gdim]
        self._node_of = vertex_nodes(V)
        self._bodies = []
        for contact, into in zip(case.contacts, case.into, strict=False):
            parts = None
            if into is not None:
                master = contact.master
                parts = inside.boundary(V.mesh, master.facet_tags, master.tags[0])
                parts = split(self._node_of[parts], V)
            self._bodies.append(parts)
        self._slaves = [
            None if parts is None else self._of_slave(contact)
            for contact, parts in zip(case.contacts, self._bodies, strict=False)
        ]
        self._directions = [
            Directions(contact, V.mesh, self._node_of) if self._is_smooth(contact) else None
            for contact in case.contacts
        ]
        self._work = work.Work(case, self._form) if work.decidable(case) else None
        # Largest force of the state before: of a load that is taken off a part may be left
        self._before = 0.0

    def __call__(self) -> list[Check]:
        """What is violated in the present state."""
        checks = [*self._balance(), *self._penetration(), *self._along()]
        if self._work is not None:
            checks.append(self._work())
        for contact in self._case.contacts:
            checks += self._conditions(contact)
            if contact.interface.law.is_vector and not contact.tied:
                checks += self._coulomb(contact)
        return [check for check in checks if not check.holds]

    def _positions(self) -> np.ndarray:
        return self._x + self._u.x.array.reshape(-1, self._gdim)

    def _rounding(self) -> float:
        """Relative rounding of a length of the scene."""
        return 64 * _EPS * (1 + np.abs(self._positions()).max() / self._case.size)

    def _small(self) -> float:
        """Length that is small for this state, or rounding."""
        moved = np.abs(self._u.x.array).max()
        return _ALLOWED * float(moved) + self._rounding() * self._case.size

    def _rounding_of_forces(self) -> np.ndarray:
        """What rounding of displacements and positions makes of each force.

        Forces of a stiff body that moves, and those of thin cells, are sums of large parts. A gap
        is a difference of positions, and contact gives it back as a force.
        """
        K = fem.assemble_matrix(self._stiffness).to_scipy()
        farthest = np.abs(self._positions()).max()
        parts = self._rounding() * np.abs(self._u.x.array) + 16 * _EPS * farthest
        return (abs(K) @ parts).reshape(-1, self._gdim)

    def _balance(self) -> Iterator[Check]:
        vector = fem.assemble_vector(self._form)
        r = vector.array.reshape(-1, self._gdim).copy()
        yield Check("forces are finite", 0.0 if np.isfinite(r).all() else 1.0, 0.0)
        largest = np.linalg.norm(r, axis=1).max()
        scale, self._before = max(largest, self._before), largest
        forces = np.zeros_like(r)
        for contact in self._case.contacts:
            contact.interface.add_residual(forces.ravel())
        allowed = _ALLOWED * scale + self._rounding_of_forces()
        out = (np.abs(r + forces) / allowed)[~self._fixed]
        yield Check("balance of nodes", out.max(initial=0.0), 1.0)
        scale = allowed.max() / _ALLOWED
        for contact in self._case.contacts:
            yield from self._of_pairs(contact, scale)

    def _of_pairs(self, contact: cx.Contact, scale: float) -> Iterator[Check]:
        """Forces and moments of a contact on both sides."""
        interface = contact.interface
        forces = np.zeros_like(self._x)
        interface.add_residual(forces.ravel())
        forces *= -1
        on_slave = forces[contact.slave_nodes]
        n = contact.interface.nodes
        if n.size == self._gdim and contact.method == "node-to-surface":
            expected = n.area[:, None] * contact.multiplier
            own = ~np.isin(contact.slave_nodes, self._master_nodes(contact))
            error = np.abs(on_slave - expected)[own].max(initial=0.0)
            yield Check("force is area times multiplier", error / scale, _ALLOWED)
        if isinstance(contact.master, cx.Surface):
            total = np.abs(forces.sum(axis=0)).max()
            yield Check("forces of both sides", total / scale, _ALLOWED)
            if contact.sliding == "finite" and not contact.tied:
                x = self._positions()
                arm = x - x[contact.slave_nodes].mean(axis=0)
                moment = np.atleast_1d(
                    np.cross(arm, forces)
                    if self._gdim == 3
                    else arm[:, 0] * forces[:, 1] - arm[:, 1] * forces[:, 0]
                )
                moment = moment.reshape(len(x), -1).sum(axis=0)
                allowed = _ALLOWED if contact.method == "node-to-surface" else 1e-2
                yield Check(
                    "moments of both sides",
                    np.abs(moment).max() / (scale * self._case.size),
                    allowed,
                )

    @staticmethod
    def _is_smooth(contact: cx.Contact) -> bool:
        """Whether its forces are along the normals of deformed faces whose facets are flat."""
        return (
            isinstance(contact.master, cx.Surface)
            and contact.sliding == "finite"
            and not contact.tied
            and not contact.interface.law.is_vector
            and DEGREE == 1
        )

    def _along(self) -> Iterator[Check]:
        """Directions of forces without friction."""
        for contact, look in zip(self._case.contacts, self._directions, strict=True):
            if look is None:
                continue
            forces = np.zeros_like(self._x)
            contact.interface.add_residual(forces.ravel())
            size = np.linalg.norm(forces, axis=1).max()
            small = _ALLOWED * size + np.linalg.norm(self._rounding_of_forces(), axis=1)
            beside = look(self._positions(), -forces, small)
            yield Check("forces without friction are along normals", beside, 1.0)

    def _least(self, contact: cx.Contact) -> float:
        """Traction that is much larger than rounding."""
        force = np.linalg.norm(self._rounding_of_forces()[contact.slave_nodes], axis=1)
        # Vertices of quadratic triangles have hardly any area
        has_area = contact.area > 1e-6 * contact.area.max(initial=0.0)
        return float((force / contact.area)[has_area].max(initial=0.0) / _ALLOWED)

    def _master_nodes(self, contact: cx.Contact) -> np.ndarray:
        if not isinstance(contact.master, cx.Surface):
            return np.zeros(0, dtype=np.int32)
        return np.unique(contact.master.facet_nodes(self._u.function_space).nodes)

    def _conditions(self, contact: cx.Contact) -> Iterator[Check]:
        nodes = contact.interface.nodes
        gap, p, closed = nodes.gap, nodes.pressure, nodes.closed
        most = max(np.abs(p).max(initial=0.0), self._least(contact))
        small = self._small()
        yield Check("multipliers are finite", 0.0 if np.isfinite(p).all() else 1.0, 0.0)
        loose = nodes.multiplier.reshape(len(p), -1)[~closed]
        yield Check("open nodes carry nothing", np.abs(loose).max(initial=0.0), 0.0)
        if contact.tied:
            return
        if most > 0:
            yield Check("pressure is not negative", (-p / most).max(initial=0.0), _ALLOWED)
        yield Check("closed nodes have no gap", np.abs(gap[closed]).max(initial=0.0) / small, 1.0)
        free = ~closed & ~nodes.immobile & ~nodes.ceded & np.isfinite(gap)
        yield Check("open nodes do not penetrate", (-gap[free]).max(initial=0.0) / small, 1.0)

    def _coulomb(self, contact: cx.Contact) -> Iterator[Check]:
        nodes = contact.interface.nodes
        p, n = nodes.pressure, nodes.normal
        traction = contact.multiplier
        t = traction - p[:, None] * n
        mu = np.broadcast_to(contact.interface.law.friction(nodes), p.shape)
        mu = np.where(nodes.smooth, 0.0, mu)
        size = np.linalg.norm(t, axis=1)
        most = max(np.linalg.norm(traction, axis=1).max(initial=0.0), self._least(contact))
        if most == 0:
            return
        excess = (size - mu * p).max(initial=0.0)
        yield Check("friction is at most mu p", excess / most, _ALLOWED)
        # On a plane of symmetry nothing moves across it, whatever a projection does
        free = (nodes.mobile > 0).all(axis=1)
        ds = contact.interface.history.slip * (nodes.mobile > 0)
        moved = np.linalg.norm(ds, axis=1)
        small = self._small()
        # Where a facet beside the plane is tilted against it the law of both is met together
        still = np.where(free, small, 1e-4 * np.abs(self._u.x.array).max())[nodes.status == 1]
        slipped = moved[nodes.status == 1] / still
        yield Check("sticking nodes do not slip", slipped.max(initial=0.0), 1.0)
        slips = (nodes.status == 2) & (moved > 10 * small) & ~nodes.smooth & free
        against = t[slips] + (mu * p)[slips, None] * ds[slips] / moved[slips, None]
        error = np.linalg.norm(against, axis=1).max(initial=0.0)
        yield Check("slip is against friction", error / most, 1e-6)

    def _depths(self, k: int) -> np.ndarray:
        parts, contact = self._bodies[k], self._case.contacts[k]
        if parts is None:
            return np.zeros(len(contact.slave_nodes))
        x = self._positions()
        return inside.depth(x[contact.slave_nodes], x, parts)

    def _of_slave(self, contact: cx.Contact) -> tuple[np.ndarray, float]:
        """Boundary of the slave's body, and the length of its longest facet in contact."""
        V = self._u.function_space
        slave = contact.slave
        parts = inside.boundary(V.mesh, slave.facet_tags, slave.tags[0])
        return split(self._node_of[parts], V), work.longest(slave, V.mesh)

    def _penetration(self) -> Iterator[Check]:
        for k, into in enumerate(self._case.into):
            if into is None or not self._case.contacts[k].active:
                continue
            nodes = self._case.contacts[k].interface.nodes
            deep = self._depths(k)[~nodes.immobile & ~nodes.ceded]
            error = deep.max(initial=0.0) / self._case.size
            yield Check("no node is inside the other body", error, into)
            slave = self._slaves[k]
            assert slave is not None
            x = self._positions()
            masters = self._master_nodes(self._case.contacts[k])
            masters = masters[~self._fixed[masters].any(axis=1)]
            deep = inside.depth(x[masters], x, slave[0]).max(initial=0.0)
            # The slave sees nothing between its nodes
            allowed = max(into * self._case.size, DEEP * slave[1])
            yield Check("no node of the master is inside the slave", deep / allowed, 1.0)
