# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a displacement is a solution of a problem with contact, found without contactx.

The judge is given the mesh, the residual of the bodies, their supports, the displacement at the
start and at the end of a step, and which facets may touch what. Forces of contact are those that
the bodies' own residual leaves at each node; gaps, slip and normals are found on the deformed
facets. Multipliers that were reported are compared with these forces, and serve for nothing else.

What is allowed is rounding, but for surface-to-surface: there a node stands for its facets. Its gap
is a mean over these, and so is its slip; points of the facets tell them to a part of what is not
linear on a facet, and to ``_UNSEEN`` of their range. Its normal lies between theirs and those of
what is in front of them. Where both sides are flat, and fit, this is rounding, too.

Nothing is said of

- friction where a node was apart at the start of the step: what it has slipped since it touched
  cannot be told from the ends of the step;
- nodes that are in several contacts, and friction of nodes that are prescribed in part;
- single nodes of quadratic facets by surface-to-surface: only balance of all other nodes, sums and
  moments of both sides, and penetration.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls
from scipy.spatial import cKDTree

import ufl
from dolfinx import fem

from stress import faces, inside, work
from stress.check import Check
from stress.faces import Array, Numbers
from stress.near import Contact, Measure, Near, Obstacle

__all__ = ["DEEP", "Contact", "Judge", "Obstacle", "Problem"]

_EPS = np.finfo(np.float64).eps
# Relative to the largest force, and to the largest displacement: iterations end at less
_ALLOWED = 1e-8
# What rounding leaves of an angle
_ANGLE = 1e-6
# How deep nodes of the master may lie between those of the slave, in facets of the slave
DEEP = 0.15
# Cosine between a normal and what a node can do, below which it cannot move along it
_MOVABLE = 0.3
# Slip that has a direction, over what is rounding; forces below the cone, over the same
_CLEAR = 10.0
# Part of the largest cosine by which all facets of a node oppose what it touches
_ALIKE = 0.6
# By surface-to-surface, without unit:
# part of an area that warping changes, and that may be uncovered where points show nothing of it
_WARP, _COVER = 2e-3, 0.1
# part of a range, or of a force that is shared out, that points of facets may miss
_UNSEEN = 0.2
# singular values of the shape functions at the covered points of a facet, least over largest, below
# which these are a strip
_STRIP = 0.05
# covered part of a node's facets from which on it has a gap, and points tell where its force goes
_COVERED, _MOSTLY = 0.15, 0.8
# moment, over the largest force times the body's size
_MOMENT = 1e-2


@dataclass(frozen=True)
class Problem:
    """A problem with contact.

    Attributes:
        F: Residual of the bodies with their loads, but without contact.
        u: Displacement.
        bcs: Supports.
        contacts: The contacts.
        size: Size of the smallest body.
    """

    F: ufl.Form
    u: fem.Function
    bcs: Sequence[fem.DirichletBC]
    contacts: Sequence[Contact]
    size: float


@dataclass
class _State:
    """The end of a step.

    Attributes:
        x: Positions of the nodes, shape (n, dim).
        start: Positions at the start of the step.
        forces: What acts on each node beside the bodies' stresses and loads, shape (n, dim).
        small: What of it is rounding, shape (n, dim).
        length: What of a length is rounding.
        before: The same at the start of the step, where nodes are apart by more.
        force: Largest force, now or before.
        stiffness: Of each node alone, shape (n,).
        size: Size of the smallest body.
    """

    x: Array
    start: Array
    forces: Array
    small: Array
    length: float
    before: float
    force: float
    stiffness: Array
    size: float


class Judge:
    """Judges the states of a problem, step by step."""

    def __init__(self, problem: Problem):
        """Prepare what does not change; the first step starts here."""
        self._problem, self._u = problem, problem.u
        V = problem.u.function_space
        self._dim = V.dofmap.index_map_bs
        self._form = fem.form(problem.F)
        self._stiffness = fem.form(ufl.derivative(problem.F, problem.u))
        fixed = np.zeros(len(problem.u.x.array), dtype=bool)
        for bc in problem.bcs:
            fixed[bc.dof_indices()[0]] = True
        self._fixed = fixed.reshape(-1, self._dim)
        self._X = V.tabulate_dof_coordinates()[:, : self._dim]
        self._looks = [_Look(contact, V, self._fixed) for contact in problem.contacts]
        touching = np.concatenate([look.nodes for look in self._looks])
        self._plain = ~self._fixed
        self._plain[touching] = False
        several, times = np.unique(touching, return_counts=True)
        for look in self._looks:
            look.shared = several[times > 1]
        self._work = None
        if all(look.stores_work for look in self._looks):
            self._work = work.Work(problem.u, self.residual, fixed)
        self._start = self._positions()
        # Largest force of the state before: of a load that is taken off a part may be left
        self._before = 0.0

    def __call__(self) -> list[Check]:
        """What is violated in the present state, at which the next step starts."""
        found = self.violated()
        if self._work is not None:
            check = self._work(self._state(self._forces()).small.ravel())
            found += [] if check.holds else [check]
        self._start = self._positions()
        self._before = float(np.linalg.norm(self._forces(), axis=1).max())
        for look in self._looks:
            look.measure.accept()
        return found

    def violated(self) -> list[Check]:
        """The same, but for the work, and the step goes on."""
        return [check for check in self.checks() if not check.holds]

    def residual(self) -> Array:
        """Residual of the bodies at the present displacement, shape (num_dofs,)."""
        return np.array(fem.assemble_vector(self._form).array)

    def checks(self) -> Iterator[Check]:
        """All that is looked at but the work."""
        forces = self._forces()
        yield Check("forces are finite", float(not np.isfinite(forces).all()), 0.0)
        if np.isfinite(forces).all():
            state = self._state(forces)
            out = (np.abs(forces) / state.small)[self._plain]
            yield Check("balance of nodes that touch nothing", out.max(initial=0.0), 1.0)
            for look in self._looks:
                yield from look(state)

    def _forces(self) -> Array:
        return self.residual().reshape(-1, self._dim)

    def _positions(self) -> Array:
        return self._X + self._u.x.array.reshape(-1, self._dim)

    def _state(self, forces: Array) -> _State:
        x, size, moved = self._positions(), self._problem.size, np.abs(self._u.x.array)
        farthest = np.abs(x).max()
        rounding = 64 * _EPS * (1 + farthest / size)
        scale = max(float(np.linalg.norm(forces, axis=1).max()), self._before)
        # Forces of a stiff body that moves, and those of thin cells, are sums of large parts. A gap
        # is a difference of positions, and contact gives it back as a force.
        K = abs(fem.assemble_matrix(self._stiffness).to_scipy())
        stiffness = K.diagonal().reshape(x.shape).min(axis=1)
        small = _ALLOWED * scale + K @ (rounding * moved + 16 * _EPS * farthest)
        then = np.abs(self._start - self._X)
        length, before = (_ALLOWED * float(m.max()) + rounding * size for m in (moved, then))
        return _State(
            x, self._start, forces, small.reshape(x.shape), length, before, scale, stiffness, size
        )


class _Look:
    """Looks at a contact.

    Attributes:
        measure: Measures gaps and slip.
        nodes: Nodes of both sides.
        shared: Nodes of both sides, or of several contacts.
        stores_work: Whether all work is stored that is put into its bodies.
    """

    shared: Numbers

    def __init__(self, contact: Contact, V: fem.FunctionSpace, fixed: Array):
        self._contact, self._fixed = contact, fixed
        self._x0 = X = V.tabulate_dof_coordinates()[:, : V.dofmap.index_map_bs]
        self._slave = faces.surface(V, contact.tags, contact.slave)
        self._slaves = np.unique(self._slave)
        self._master, self._masters = None, self._slaves[:0]
        self._bodies: list[Numbers] = []
        if not isinstance(contact.master, Obstacle):
            self._master = faces.surface(V, contact.tags, contact.master)
            self._masters = np.unique(self._master)
            firsts = contact.master[0], contact.slave[0]
            self._bodies = [faces.body(V, contact.tags, tag) for tag in firsts]
        self.nodes = np.concatenate([self._slaves, self._masters])
        self.measure = Measure(contact, self._slave, self._master, X)
        # Part of what is not linear on a facet that its points may miss, by their number on a line
        per = len(self.measure.parts) / len(self._slave) * (2 if self._slave.shape[1] == 3 else 1)
        self._unseen = max(0.25, 6 / per ** (1 / (len(X[0]) - 1)))
        self._areas = faces.areas(self._slave, X)
        # Vertices of quadratic triangles have parts of the areas beside them
        self._is_split = V.ufl_element().degree > 1
        self._areas *= 2.0 if self._is_split else 1.0
        # Nodes of quadratic facets stand for all of them, with functions of either sign
        self._is_nodal = not (self._is_split and contact.is_mean)
        self.stores_work = (
            self._master is not None
            and contact.friction == 0
            and contact.offset() == 0
            and not fixed[self.nodes].any()
            and (not contact.is_mean or work.covers(self._slave, self._master, X))
        )

    def __call__(self, state: _State) -> Iterator[Check]:
        """Check a state."""
        self._force = np.where(self._fixed, 0.0, state.forces)
        self._small = np.linalg.norm(state.small, axis=1)
        self._loaded = (np.abs(self._force) > state.small).any(axis=1)
        # Whether all facets of a node count for its area
        self._has_area = np.zeros(len(state.x), dtype=bool)
        # Slip that is undone by forces that are rounding, as the softer body yields
        self._yields = _ANGLE * state.force / float(state.stiffness[self.nodes].min())
        # Largest angle of the normals that a node has by surface-to-surface
        self._tilt = np.zeros(len(state.x))
        near = self.measure(state.x, state.start)
        by_node = self._means(near) if self._contact.is_mean else self._singles(near)
        worst: dict[str, float] = {}
        nodes = []
        for node, rows, weight in by_node if self._is_nodal else ():
            found = self._of_mean if self._contact.is_mean else self._of_single
            for name, error in found(node, rows, weight, state):
                worst[name] = max(worst.get(name, 0.0), error)
            if not self._contact.is_mean:
                rows = rows[np.abs(rows.gap) <= state.length]
                weight = np.full(len(rows.gap), 1 / max(len(rows.gap), 1))
            nodes.append((node, rows, weight))
        yield from (Check(name, error, 1.0) for name, error in worst.items())
        if self._master is not None:
            yield from self._of_both(nodes, near, state)
        yield from self._of_bodies(state)
        yield from self._of_reported([node for node, *_ in nodes])

    # Nodes, what they stand for, and with which weights

    def _singles(self, near: Near) -> Iterator[tuple[int, Near, Array]]:
        rows = _grouped(near.point, len(self._slaves))
        for node, own in zip(self._slaves.tolist(), rows, strict=True):
            if self._is_known(node):
                yield node, near[own], np.ones(len(own))

    def _means(self, near: Near) -> Iterator[tuple[int, Near, Array]]:
        """With weights of dual functions on the covered parts of facets.

        A field that is linear on the facets has its nodal values by them, whatever part of a facet
        is covered.
        """
        m, k = self._slave.shape
        per = len(self.measure.parts) // m
        N, parts = self.measure.points.weights[:per], self.measure.parts[:per]
        self._whole = np.bincount(self._slave.ravel(), np.tile(parts @ N, m), len(self._x0))
        row = np.full(m * per, -1)
        row[near.point] = np.arange(len(near.point))
        weights = np.zeros((m * per, k))
        for facet, covered in enumerate((row >= 0).reshape(m, per)):
            root = np.sqrt(parts[covered])[:, None]
            dual = np.linalg.pinv(root * N[covered], rcond=1e-6).T * root
            weights[facet * per : (facet + 1) * per][covered] = dual * (parts[covered] @ N[covered])
        facets = _grouped(self._slave.ravel(), len(self._x0))
        for node in self._slaves.tolist():
            if self._is_known(node):
                facet, corner = np.divmod(facets[node], k)
                points = (facet[:, None] * per + np.arange(per)).ravel()
                covered = row[points] >= 0
                weight = weights[points, np.repeat(corner, per)][covered]
                yield node, near[row[points[covered]]], weight

    def _is_known(self, node: int) -> bool:
        return not self._fixed[node].all() and node not in self.shared

    def _rough(self, weight: Array, near: Near, values: Array, part: float = 1.0) -> float:
        """By how much a mean of values at points may be off that over the facets.

        Args:
            weight: Weights of the points.
            near: The points.
            values: Values there.
            part: Of what is not linear on a facet, as much as points may miss.
        """
        facet = self.measure.facet[near.point]
        rest = 0.0
        for f in np.unique(facet):
            own = facet == f
            N, value = self.measure.points.weights[near.point[own]], values[own]
            fit, _, _, singular = np.linalg.lstsq(N, value, rcond=1e-6)
            # Points that lie in a narrow strip tell nothing of the nodes
            off = value - N @ fit if singular[-1] > _STRIP * singular[0] else value
            rest = max(rest, float(np.abs(off).max()))
        return part * rest * float(np.abs(weight).sum()) + _UNSEEN * float(np.ptp(values))

    # Errors of a slave node, over what is allowed

    def _of_single(
        self, node: int, near: Near, weight: Array, state: _State
    ) -> Iterator[tuple[str, float]]:
        """A node that is measured by itself, on any of the facets that it may be paired with."""
        size = float(np.linalg.norm(self._force[node]))
        small = self._small[node] + _ANGLE * size
        if len(near.gap) == 0:
            yield "nothing acts on what is apart", size / small if self._loaded[node] else 0.0
            return
        if self._is_movable(node, near):
            gap = np.abs(near.gap).min() if self._loaded[node] else -near.gap.max()
            if self._loaded[node] or self._is_under(node, near, state):
                yield self._gap_name(node), float(gap) / state.length
        near = near[np.abs(near.gap) <= state.length]
        if self._loaded[node] and len(near.gap) > 0:
            self._has_area[node] = self._faces_all(node, near)
            none = np.zeros(len(near.gap))
            known = (near.before <= state.before).all()
            yield from self._of_force(
                node,
                small,
                near.normal,
                near.normal,
                near.slip if known else None,
                none,
                0.0,
                state,
            )

    def _of_mean(
        self, node: int, near: Near, weight: Array, state: _State
    ) -> Iterator[tuple[str, float]]:
        """A node that stands for its facets."""
        covered = float(weight.sum()) / self._whole[node]
        if covered < _COVERED:
            return
        self._has_area[node] = covered > 1 - _ANGLE and self._faces_all(node, near)
        weight = weight / weight.sum()
        size = float(np.linalg.norm(self._force[node]))
        small = self._small[node] + _ANGLE * size
        part = self._unseen if covered > _MOSTLY else 1.0
        gap, rough = float(weight @ near.gap), self._rough(weight, near, near.gap, part)
        own = -self.measure.own[near.point]
        if not self._contact.is_finite:
            # Gaps are along normals midway between those of both
            rough += float((np.linalg.norm(own - near.normal, axis=1) * near.apart).max())
        off = max(abs(gap) if self._loaded[node] else -gap, 0.0) - rough
        if off > state.length and not self._loaded[node] and self._bodies:
            points = self.measure.points.at(state.x)[near.point]
            off = min(off, float(inside.depth(points, state.x, self._bodies[0]).max()))
        if self._is_movable(node, near):
            yield self._gap_name(node), off / state.length
        if not self._loaded[node]:
            return
        facets = (self._slave == node).any(axis=1)
        # On an edge of the slave normals are those of all that its facets have in front of them
        edge = self.measure.edge & self._contact.is_finite
        at, ahead = self.measure.ahead
        ahead = ahead[(facets & edge)[at]]
        dim = state.x.shape[1]
        own = -self.measure.corners[facets & ~edge].reshape(-1, dim)
        cone = np.concatenate([near.normal, own, ahead])
        small += size * float(np.linalg.norm([self._rough(weight, near, n) for n in near.normal.T]))
        middle = cone.mean(axis=0) / np.linalg.norm(cone.mean(axis=0))
        tilt = self._tilt[node] = float(np.linalg.norm(cone - middle, axis=1).max())
        slip = None
        if self._contact.friction > 0 and np.isfinite(near.before).all():
            before = float(weight @ near.before) - self._rough(weight, near, near.before)
            slip = (weight @ near.slip)[None] if before <= state.before else None
        loose = np.zeros(1)
        if slip is not None:
            loose[0] = np.linalg.norm([self._rough(weight, near, s) for s in near.slip.T])
            # Other normals give gaps parts along the surface
            loose += tilt * (np.linalg.norm(slip) + near.apart.max())
        yield from self._of_force(node, small, cone, middle[None], slip, loose, tilt, state)

    def _faces_all(self, node: int, near: Near) -> bool:
        """Whether all facets of a node oppose what it touches about as much: they have its area."""
        own = self.measure.corners[(self._slave == node).any(axis=1)].mean(axis=1)
        against = -own @ near.normal.T
        return not self._is_split and bool(against.min() > _ALIKE * against.max())

    def _gap_name(self, node: int) -> str:
        return "what is loaded has no gap" if self._loaded[node] else "nothing penetrates"

    def _is_movable(self, node: int, near: Near) -> bool:
        free = near.normal[:, ~self._fixed[node]]
        return bool(np.linalg.norm(free, axis=1).min() > _MOVABLE)

    def _is_under(self, node: int, near: Near, state: _State) -> bool:
        """Whether a node is measured where it would be inside a body.

        Beside all facets it may be paired, but need not.
        """
        if not self._bodies:
            return True
        if near.beyond.min() > 0:
            return False
        if not self._contact.is_finite:
            return True
        if near.gap.max() >= -state.length:
            return False
        return bool(inside.depth(state.x[[node]], state.x, self._bodies[0])[0] > state.length)

    def _of_force(
        self,
        node: int,
        small: float,
        cone: Array,
        normal: Array,
        slip: Array | None,
        loose: Array,
        tilt: float,
        state: _State,
    ) -> Iterator[tuple[str, float]]:
        """The force on a slave node: its direction, Coulomb's law.

        Args:
            node: The node.
            small: Size of a force that is rounding.
            cone: Normals that it may have, and all between, shape (m, dim).
            normal: Those that friction is measured by, any of which may hold, shape (n, dim).
            slip: For each of these, shape (n, dim); None if unknown.
            loose: What is allowed of it, shape (n,).
            tilt: Angle by which the normals may be off.
            state: The state.
        """
        force, free, mu = self._force[node], ~self._fixed[node], self._contact.friction
        if mu == 0:
            out = beside(force[free], cone[:, free])
            yield "forces without friction are along normals", out / small
            return
        if not free.all():
            return
        size = float(np.linalg.norm(force))
        small = (small + tilt * size) * (1 + mu)
        pressure = normal @ force
        along = force - pressure[:, None] * normal
        bound = mu * pressure
        beyond = np.linalg.norm(along, axis=1) - bound
        yield "pressure is not negative", float(-pressure.max()) / small
        yield "friction is at most mu p", float(beyond.min()) / small
        if slip is None:
            return
        moved = np.linalg.norm(slip, axis=1)
        scale = np.where(moved > 0, moved, 1.0)
        against = np.linalg.norm(along + (bound / scale)[:, None] * slip, axis=1)
        against /= small + loose / scale * size
        still = moved / (state.length + self._yields + loose) / _CLEAR
        sticks = beyond < -_CLEAR * small
        error = np.where(still > 1, against, np.where(sticks, still * _CLEAR, 0.0))
        yield "slip is against friction, or none", float(error.min())

    # Both sides together

    def _of_both(
        self, nodes: Sequence[tuple[int, Near, Array]], near: Near, state: _State
    ) -> Iterator[Check]:
        """Forces of the master, sums and moments of those of both sides."""
        assert self._master is not None
        contact, forces = self._contact, self._force
        X = state.x if contact.is_finite else self._x0
        masters = np.setdiff1d(self._masters, self.shared)
        expected, allowed, unknown = np.zeros_like(forces), state.small.copy(), self._fixed.copy()
        tree = cKDTree(X[masters])
        reach = sum(faces.sizes(X[side]).max() for side in (self._slave, self._master))
        arms = 0.0
        for node, rows, weight in nodes:
            if contact.is_mean:
                covered = float(weight.sum())
                weight = weight / max(covered, 1e-300)
            corners = self._master[rows.facet]
            unknown[corners] |= self._fixed[node]
            np.add.at(allowed, corners, self._small[node])
            if not self._loaded[node]:
                continue
            size = float(np.linalg.norm(forces[node]))
            feet = np.einsum("nk,nkd->nd", rows.weights, X[corners])
            np.subtract.at(
                expected, corners, (weight[:, None] * rows.weights)[..., None] * forces[node]
            )
            if contact.is_mean:
                middle = feet.mean(axis=0) if len(feet) else X[node]
                far = reach + np.linalg.norm(feet - middle, axis=1).max(initial=0.0)
                pressed = masters[tree.query_ball_point(middle, far)]
                # Of what is covered in part only the place is known
                allowed[pressed] += (
                    np.inf if covered < _MOSTLY * self._whole[node] else _UNSEEN * size
                )
            elif len(weight) > 1:
                # Facets that it lies on by as much differ in their weights
                each = np.zeros((len(weight), len(forces)))
                np.put_along_axis(each, corners, rows.weights, axis=1)
                allowed += np.ptp(each, axis=0)[:, None] * size
            if not contact.is_finite and len(feet):
                off = np.linalg.norm(self.measure.points.at(X)[rows.point] - feet, axis=1).max()
                arms += (contact.friction + self._tilt[node]) * size * off
        error = np.where(unknown, 0.0, np.abs(forces - expected) / allowed)[masters]
        if self._is_nodal:
            yield Check("forces of the master are those of the slave", error.max(initial=0.0), 1.0)
        known = ~unknown[np.unique(self._master[near.facet])].any(axis=0)
        known &= ~self._fixed[np.unique(self.measure.points.nodes[near.point])].any(axis=0)
        if len(self.shared):
            return
        own = np.unique(self.nodes)
        scale = float(state.small.max())
        total = np.abs(forces[own].sum(axis=0))[known].max(initial=0.0)
        yield Check("forces of both sides cancel", total / scale, 1.0)
        if known.all():
            moment = np.abs(_moment((X - X[self._slaves].mean(axis=0))[own], forces[own])).max()
            most = scale * state.size * (_MOMENT / _ALLOWED if contact.is_mean else 1.0) + arms
            yield Check("moments of both sides cancel", moment / most, 1.0)

    def _of_bodies(self, state: _State) -> Iterator[Check]:
        """Nodes inside the other body."""
        into = self._contact.into
        if into is None or not self._bodies:
            return
        depths = []
        for nodes, other in zip((self._slaves, self._masters), self._bodies, strict=True):
            loose = np.setdiff1d(nodes[~self._fixed[nodes].any(axis=1)], self.shared)
            depths.append(inside.depth(state.x[loose], state.x, other).max(initial=0.0))
        yield Check("no node is inside the other body", depths[0] / state.size, into)
        # The slave sees nothing between its nodes
        most = max(into * state.size, DEEP * float(faces.sizes(self._x0[self._slave]).max()))
        yield Check("no node of the master is inside the slave", depths[1] / most, 1.0)

    def _of_reported(self, nodes: Sequence[int]) -> Iterator[Check]:
        """Multipliers are the forces over areas, which are at most those of the nodes' facets."""
        numbers, values = self._contact.reported()
        yield Check("multipliers are finite", float(not np.isfinite(values).all()), 0.0)
        known = np.array([node for node in nodes if not self._fixed[node].any()], dtype=np.int64)
        force, small = self._force[known], self._small[known]
        size = np.linalg.norm(force, axis=1)
        got = np.zeros((len(self._force), 1 if values.ndim == 1 else values.shape[1]))
        got[numbers] = values.reshape(len(numbers), -1)
        got = got[known]
        # A pressure alone has a sign, a traction a direction
        signed = got[:, 0] if values.ndim == 1 else np.linalg.norm(got, axis=1)
        most = self._areas[known] * signed
        # Pressures along several normals add up to less than their sum
        slack = self._tilt[known] ** 2 if values.ndim == 1 else np.zeros(len(known))
        if self._contact.is_mean and self._slave.shape[1] == 4:
            # Facets that are warped have the areas of their projections
            slack = np.maximum(slack, _WARP)
        slack = np.abs(most) * slack
        allowed = small + _ALLOWED * np.abs(most)
        error = (size - most - slack) / allowed
        least = most - slack - (_COVER * most if self._contact.is_mean else 0.0)
        error = np.maximum(error, np.where(self._has_area[known], least - size, 0.0) / allowed)
        if values.ndim > 1:
            unit = got / np.maximum(np.linalg.norm(got, axis=1), 1e-300)[:, None]
            off = np.linalg.norm(force - size[:, None] * unit, axis=1)
            error = np.maximum(error, off / (small + _ANGLE * size))
        yield Check("multipliers are forces over areas", error.max(initial=0.0), 1.0)


def beside(vector: Array, cone: Array) -> float:
    """Distance of a vector from the cone of some directions."""
    return float(nnls(np.unique(np.round(cone, 12), axis=0).T, vector)[1])


def _moment(arm: Array, force: Array) -> Array:
    """Moment of forces, shape () or (3,)."""
    if arm.shape[1] == 2:
        return np.asarray((arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).sum())
    return np.asarray(np.cross(arm, force).sum(axis=0))


def _grouped(values: Numbers, n: int) -> list[Numbers]:
    """Rows of each value from 0 to n - 1."""
    order = np.argsort(values, kind="stable")
    return np.split(order, np.searchsorted(values[order], np.arange(1, n)))
