# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Free bodies: those that have not enough supports of their own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.bodies.bodies import Bodies
from contactx.bodies.constraints import along, contact_rows
from contactx.bodies.modes import Array, RigidModes, by_body
from contactx.bodies.springs import independent_springs
from contactx.bulk import Bulk
from contactx.interface import Interface
from contactx.parallel import reduce

# Force along a free mode, relative to the problem's, that counts as out of balance
_BALANCED = 1e-6
# Force along free modes, relative to the residual, above which it asks for a motion
_IDLE = 1e-3
# Stiffness of springs, relative to the bulk's: of those that carry no force, and of others
_WEAK = 1e-6
_NEAR = 1e-3
# Relative difference of what is equal but for rounding
_TIE = 1e-9
# A contact, nodes of it that may balance a body, and the time in which the motion gets there
type _Found = tuple[Interface, npt.NDArray[np.integer], Array]


class FreeBodies:
    """Keeps the Newton step of bodies without enough supports solvable.

    A rigid mode that neither supports nor closed contacts resist is free and makes the Jacobian
    singular. Where the forces along free modes balance, as many springs as modes are added to the
    Jacobian: they are statically determinate, so they carry no force and change no step. Where the
    forces do not balance, the open nodes that the bodies would meet first in a rigid motion are
    closed, until the closed nodes can balance them; then those slipping nodes stick whose slip this
    motion reverses first. The residual is never touched, so no solution depends on this. All ranks
    must take part in all of it, and find the same.

    Attributes:
        free_modes: Number of free rigid modes at the last iterate.
        closed_for_balance: Nodes that were closed in this step to balance a body.
        is_unbalanced: Whether the last iterate had forces that nothing in the way can balance.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], bodies: Bodies):
        """Take the bodies.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            bodies: Bodies of the mesh.
        """
        self._bulk = bulk
        self._interfaces = interfaces
        self._bodies = bodies
        self._comm = bodies.halo.comm
        self._modes: RigidModes | None = None
        self.free_modes = self.closed_for_balance = 0
        self.is_unbalanced = False
        self._springs: Array | None = None
        # Free motions at owned dofs, and the displacements at which they were found
        self._loose: tuple[Array, Array] | None = None
        self._begins = True
        # Forces of the loads along the modes in the reference configuration, and what is balanced
        self._loads: tuple[Array, float] = np.zeros(0), 0.0

    def begin_step(self) -> None:
        """Find the free modes of the bodies."""
        x = self._places()
        if self._modes is None:
            self._modes = RigidModes(self._bulk, self._bodies, x)
        else:
            self._modes.update(x)
        self.free_modes = self.closed_for_balance = 0
        self.is_unbalanced = False
        self._springs = self._loose = None
        self._begins = True

    def reset(self) -> None:
        """Drop the rigid modes: a failed step may have found them of a spoilt stiffness."""
        self._modes = None

    def stabilise(
        self,
        residual: Callable[[], Array],
        of_bulk: Callable[[], Array],
        scale: Callable[[], float],
    ) -> bool:
        """Find the springs to add to the Jacobian at an iterate, and close nodes for balance.

        Args:
            residual: Gives the residual of the displacements without Dirichlet rows at owned
                dofs, shape (num_owned * gdim,); called only where a body has a free mode.
            of_bulk: Gives the bulk's part of it, likewise.
            scale: Gives the forces of the problem; called likewise.

        Returns:
            Whether nodes have been closed or stick on any rank.
        """
        self._springs = self._loose = None
        self.free_modes = 0
        rigid = self._modes
        if rigid is None or not rigid.any_free:
            return False
        x = self._places()
        gdim = x.shape[1]
        nodes = np.arange(self._bodies.halo.num_owned, dtype=np.int32)
        body = rigid.body[nodes]
        modes = rigid.at(nodes, x)
        size = modes.shape[2]
        forces = residual()
        balanced = _BALANCED * scale()
        pull = self._along(modes, -forces)
        if self._begins:
            self._loads = self._along(rigid.at(nodes, self._bodies.x), -of_bulk()), balanced
        closed_any = self._begins and self._close_before_springs(x, pull)
        self._begins = False
        while True:
            N = self._free_basis(x, rigid.free)
            if N.shape[1] == 0:
                self.is_unbalanced = False
                break
            # In 3D the tangent across the slip resists motions that slip to all sides does not
            lacking = self._lacking(x) if gdim == 2 else 0.0
            f = N.T @ (pull + lacking)
            # A norm that does not depend on which basis of the modes rounding has chosen
            if np.linalg.norm(f) <= balanced or self._loads_balance(N):
                self.is_unbalanced = False
                break
            # The rigid motion of bodies whose mass goes with their number of nodes
            weight = np.repeat(rigid.num_nodes, size)
            way = N @ np.linalg.solve(N.T @ (weight[:, None] * N), f)
            closed = self._close_first(x, way.reshape(rigid.count, size))
            self.closed_for_balance += closed
            if closed == 0 and not self._stick_first(x, way.ravel()):
                self.is_unbalanced = True
                # A support may have got its stiffness on the way
                rigid.update(x)
                break
            closed_any = True
        self.free_modes = N.shape[1]
        if self.free_modes > 0:
            coefficients = N.reshape(rigid.count, size, -1)[body]
            field = np.einsum("nim,nmk->nik", modes, coefficients)
            shares = field.reshape(-1, self.free_modes)
            springs = independent_springs(shares, self._bulk, self._bodies.halo)
            idle = np.linalg.norm(N.T @ pull) <= _IDLE * reduce.norm(self._comm, forces)
            # Friction resists motions across the slip
            if idle and not self._has_friction():
                free = self._bulk.markers[: len(shares)] == 0
                self._loose = shares * free[:, None], self._displacements()
            # Weak, so that they do not slow down what a little stiffness does resist, such as
            # friction that turns; a body that nothing balances yet stays near what it may meet
            self._springs = (_NEAR if self.is_unbalanced else _WEAK) * springs
        return closed_any

    def _loads_balance(self, N: Array) -> bool:
        """Whether the loads of the step balance along free modes, as linear strains see them.

        Stresses of linear strains balance in the reference configuration alone. In the current one
        they have a moment, without any load, that grows with the displacements. Contacts without
        friction have no force along free modes.

        Args:
            N: The modes, as columns.
        """
        if not self._bulk.is_linear or self._has_friction():
            return False
        loads, balanced = self._loads
        return bool(np.linalg.norm(N.T @ loads) <= balanced)

    def _along(self, modes: Array, forces: Array) -> Array:
        """Forces on all ranks along the modes of the bodies, shape (num_bodies * m,).

        Args:
            modes: Modes at owned nodes, shape (num_owned, gdim, m).
            forces: Forces at owned dofs, shape (num_owned * gdim,).
        """
        rigid = self._modes
        assert rigid is not None
        n, gdim, m = modes.shape
        sums = np.zeros((rigid.count, m))
        np.add.at(sums, rigid.body[:n], np.einsum("nim,ni->nm", modes, forces.reshape(n, gdim)))
        total: Array = reduce.total(self._comm, sums).ravel()
        return total

    def _places(self) -> Array:
        """Positions of all nodes that rigid motions are about, shape (num_nodes, gdim).

        Where all but the active set is linear these are the reference positions: a rotation about
        the current ones changes gaps and strains by what the bodies have moved.
        """
        linear = self._bulk.is_linear and not self._has_friction()
        if linear and all(interface.sliding == "small" for interface in self._interfaces):
            return self._bodies.x
        return self._interfaces[0].positions()

    def _displacements(self) -> Array:
        """Displacements at owned dofs, shape (num_owned * gdim,)."""
        owned = slice(self._bodies.halo.num_owned * self._bodies.halo.gdim)
        u: Array = self._bulk.u.x.array[owned].copy()
        return u

    def drift(self) -> Array | None:
        """What the bodies have moved along their free modes since the last call of ``stabilise``.

        Without friction, where the forces balance and kinematics are frozen, nothing asks for such
        a motion: it comes of the places of the springs, which bodies turn about as they deform, and
        takes nodes past each other. All ranks must take part.

        Returns:
            Displacements at owned dofs, shape (num_owned * gdim,); None if no mode was free, or
            something asked for a motion.
        """
        if self._loose is None:
            return None
        motions, before = self._loose
        step = self._displacements() - before
        sums = reduce.total(self._comm, motions.T @ np.column_stack([motions, step]))
        drift: Array = motions @ np.linalg.solve(sums[:, :-1], sums[:, -1])
        return drift

    @property
    def springs(self) -> Array | None:
        """Stiffness to add to the Jacobian's diagonal at owned dofs, force/length; None if none."""
        return self._springs

    def _close_before_springs(self, x: Array, pull: Array) -> bool:
        """Close the nodes that bodies on weak springs meet before these stop them.

        A Newton step would carry the bodies past what they meet.

        Args:
            x: Positions.
            pull: Forces along the modes of the bodies, shape (num_bodies * m,).

        Returns:
            Whether nodes have been closed on any rank.
        """
        rigid = self._modes
        assert rigid is not None
        Z, stiffness = by_body(rigid.weak), np.concatenate(rigid.stiffness)
        closed_any = False
        while (N := self._free_basis(x, rigid.weak)).shape[1] > 0:
            combine = Z.T @ N
            K = combine.T @ (stiffness[:, None] * combine)
            way = N @ np.linalg.solve(K, N.T @ pull)
            if not way.any():
                break
            closed = self._close_first(x, way.reshape(rigid.count, -1), within=1.0)
            self.closed_for_balance += closed
            if closed == 0:
                break
            closed_any = True
        return closed_any

    def _free_basis(self, x: Array, bases: list[Array]) -> Array:
        """Orthonormal basis of the motions that no closed node resists, as columns.

        Args:
            x: Positions.
            bases: For each body the modes that the motions are combined of, shape (m, k).
        """
        rigid = self._modes
        assert rigid is not None
        Z = by_body(bases)
        gram = np.zeros((Z.shape[1], Z.shape[1]))
        for interface in self._interfaces:
            rows = contact_rows(interface, rigid, x)
            kind = interface.nodes.status[rows.slaves]
            along = np.einsum("pi,pim->pm", rows.normal, rows.movement)[kind != core.OPEN]
            every = rows.movement[kind == core.STICK].reshape(-1, Z.shape[0])
            for part in (along @ Z, every @ Z):
                gram += part.T @ part
        gram = reduce.total(self._comm, gram)
        values, vectors = np.linalg.eigh(gram)
        null: Array = Z @ vectors[:, values <= 1e-12 * max(values.max(initial=0.0), 1.0)]
        return null

    def _close_first(self, x: Array, way: Array, within: float = np.inf) -> int:
        """Close the open nodes that bodies meet first in a rigid motion.

        Args:
            x: Positions.
            way: The motion: coefficients of each body's modes, shape (num_bodies, m).
            within: Part of the motion that they go.

        Returns:
            Number of nodes closed on all ranks.
        """
        rigid = self._modes
        assert rigid is not None
        found: list[_Found] = []
        for interface in self._interfaces:
            nodes = interface.nodes
            rows = contact_rows(interface, rigid, x)
            speed = -np.einsum("pi,pim,m->p", rows.normal, rows.movement, way.ravel())
            gap = nodes.closable_gap[rows.slaves]
            able = ~nodes.closed[rows.slaves] & np.isfinite(gap)
            able &= speed > 1e-6 * np.abs(way).max()
            time = np.maximum(gap[able], 0) / speed[able]
            found.append((interface, rows.slaves[able], time))
        lowest = self._lowest(found)
        if not np.isfinite(lowest) or lowest > within:
            return 0
        # What is closer than this touches at once
        tie = _TIE * rigid.size / np.abs(way).max()
        count = 0
        for interface, slaves, time in found:
            first = slaves[time <= lowest + tie]
            interface.nodes.close(first)
            count += len(first)
        return int(reduce.total(self._comm, count))

    def _lowest(self, found: list[_Found]) -> float:
        """Shortest of the times that nodes of all ranks need; infinite if there are none."""
        lowest = min((time.min(initial=np.inf) for _, _, time in found), default=np.inf)
        return float(reduce.least(self._comm, float(lowest)))

    def _lacking(self, x: Array) -> Array:
        """Forces of Coulomb's law at slipping nodes minus those of the iterate's tractions.

        Newton steps balance bodies with tractions that are not yet on the cone. Along the modes of
        the bodies, shape (num_bodies * m,).
        """
        rigid = self._modes
        assert rigid is not None
        lacking = np.zeros(rigid.count * rigid.free[0].shape[0])
        for interface, law in self._rubbing():
            nodes = interface.nodes
            law.evaluate(nodes)
            slips = nodes.status == core.SLIP
            rows = contact_rows(interface, rigid, x)
            force = nodes.value.reshape(nodes.normal.shape)[rows.slaves]
            force = along(rows.normal, np.where(slips[rows.slaves, None], force, 0.0))
            lacking -= np.einsum("pi,pim->m", force, rows.movement)
        total: Array = reduce.total(self._comm, lacking)
        return total

    def _stick_first(self, x: Array, way: Array) -> bool:
        """Stick the slipping nodes whose slip a rigid motion of the bodies reverses first.

        Slip to both sides may balance a body that slip along its motion alone does not.

        Args:
            x: Positions.
            way: The motion: coefficients of each body's modes, shape (num_bodies * m,).

        Returns:
            Whether any sticks on any rank.
        """
        rigid = self._modes
        assert rigid is not None
        found: list[_Found] = []
        for interface, law in self._rubbing():
            nodes, cone = interface.nodes, _on_cone(interface)
            rubs = (nodes.status == core.SLIP) & (law.friction(nodes) * nodes.pressure > 0)
            rows = contact_rows(interface, rigid, x)
            movement = along(rows.normal, rows.movement @ way)
            # Slip goes against the traction, also where it has only just begun
            back = np.einsum("pi,pi->p", cone[rows.slaves], movement) > 0
            speed = np.linalg.norm(movement, axis=1)
            able = rubs[rows.slaves] & back & (speed > 1e-6 * np.abs(way).max())
            size = np.linalg.norm(nodes.slip[rows.slaves], axis=1)
            found.append((interface, rows.slaves[able], size[able] / speed[able]))
        lowest = self._lowest(found)
        if not np.isfinite(lowest):
            return False
        for interface, slaves, time in found:
            nodes, first = interface.nodes, slaves[time <= lowest * (1 + _TIE)]
            # With the traction of slip: more than that must not pass for a solution
            nodes.multiplier.reshape(nodes.slip.shape)[first] = _on_cone(interface)[first]
            nodes.close(first)
        return True

    def _has_friction(self) -> bool:
        return any(isinstance(interface.law, core.Coulomb) for interface in self._interfaces)

    def _rubbing(self) -> Iterator[tuple[Interface, core.Coulomb]]:
        """Contacts with friction."""
        for interface in self._interfaces:
            if isinstance(interface.law, core.Coulomb):
                yield interface, interface.law


def _on_cone(interface: Interface) -> Array:
    """Tractions that slipping nodes have by Coulomb's law, shape (n, gdim)."""
    nodes = interface.nodes
    interface.law.evaluate(nodes)
    excess = along(nodes.normal, nodes.value.reshape(nodes.normal.shape))
    tractions: Array = nodes.multiplier.reshape(nodes.normal.shape) - excess / nodes.area[:, None]
    return tractions
