# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Both sides of a contact, seen in the deformed bodies alone.

A contact that looks right from its slave nodes may still be wrong: what presses lies between two of
them, or has passed through and pushes from behind. So points within facets of either side are
looked at, and each scene knows on which side its bodies belong.

What is allowed, and why:

- A chord of length h lies inside a disc of radius R by R - sqrt(R^2 - h^2/4), which is h^2/(8 R)
  where it is small, although both of its ends are right. Gaps that are means allow as much at the
  nodes, and at the edge of contact a little more.
- What is pressed by less than a tenth of a facet is resolved as well as its mesh can. Deeper than
  ``DEEP`` facets nothing is: a mesh that sees so little of what it touches gives wrong forces. It
  is half again as much, so that no verdict hangs on how a depth is measured.
- What is smaller than a facet is not to be missed by half of its own size either, nor a thin body
  by its thickness: depths inside it end at half of that, of which they may reach most.
- Before the first node touches there is no force, although a chord lies inside. What is deeper by
  ``SEEN`` of a facet, and touched by nothing, is missed.
- Bodies that are both soft change their curvature where they touch: twice the chord.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from stress import inside
from stress.check import Check
from stress.grids import Array, Numbers
from stress.judge import DEEP
from stress.parts import Parts
from stress.tools import Tool

SEEN = 0.02
# Of nodes whose gaps are not means, relative to the size of what they touch
_EXACT = 1e-6
# Points along each facet, and of each direction where it has two
_LINE = np.linspace(0, 1, 33)
_SQUARE = np.linspace(0, 1, 9)

type View = Callable[[], Iterator[Check]]


def sampled(x: Array, facets: Numbers) -> Array:
    """Points of facets, their corners among them, shape (m, k, dim)."""
    corners = x[facets]
    if facets.shape[1] == 2:
        weights = np.stack([1 - _LINE, _LINE], axis=1)
    else:
        s, t = (a.ravel() for a in np.meshgrid(_SQUARE, _SQUARE))
        weights = np.stack([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t], axis=1)
    return np.asarray(np.einsum("kc,mcd->mkd", weights, corners))


def chord(h: Array, radius: float) -> Array:
    """How deep the middle of a chord lies in a disc."""
    half = np.minimum(h / 2, radius)
    return radius - np.sqrt(radius**2 - half**2)


def between(h: Array, radius: float | None, size: float, method: str) -> Array:
    """How deep something may lie in a facet between its nodes.

    Args:
        h: Lengths of facets.
        radius: Radius of what lies there; unknown if None.
        size: Size that nothing may be missed by: the smaller one of what is pressed together.
        method: Method of the contact.
    """
    most = np.minimum(DEEP * h, 0.4 * size)
    if radius is None:
        return most
    mean = 1.2 if method == "node-to-surface" else 3.0
    return np.minimum(mean * chord(h, radius) + _EXACT * size, most)


def unseen(h: Array, radius: float | None, size: float) -> Array:
    """How deep something may lie in a facet before any node touches it; see ``between``."""
    most = np.minimum(DEEP * h, 0.25 * size)
    if radius is not None:
        most = np.minimum(1.2 * chord(h, radius), most)
    return most + SEEN * np.minimum(h, size)


def pressed(parts: Parts, facets: Numbers, tool: Tool, radius: float | None, method: str) -> View:
    """A tagged surface against a rigid tool.

    Args:
        parts: The bodies.
        facets: Facets of the slave surface.
        tool: The tool.
        radius: Its radius where facets touch it; None if it has no single one.
        method: Method of the contact.
    """
    loose = np.setdiff1d(facets, parts.held)
    # What is held inside the tool has no choice
    facets = facets[~np.isin(facets, parts.held).all(axis=1)]

    def look() -> Iterator[Check]:
        x = parts.positions()
        h = parts.lengths(facets, x)
        allowed = between(h, radius, tool.size, method)
        at_nodes = _EXACT * tool.size
        if method != "node-to-surface":
            most = np.zeros(len(x))
            np.maximum.at(most, facets, np.broadcast_to(allowed[:, None], facets.shape))
            at_nodes = np.maximum(most[loose], at_nodes)
        deep = -tool.distance(x[loose])
        yield Check("nodes are outside of the tool", float((deep / at_nodes).max()), 1.0)
        points = sampled(x, facets)
        deep = -tool.distance(points.reshape(-1, x.shape[1])).reshape(len(facets), -1)
        stuck = parts.held[tool.distance(x[parts.held]) < 0]
        deep[np.isin(facets, stuck).any(axis=1)] = 0.0
        worst = (deep.max(axis=1) / allowed).max()
        yield Check("facets are outside of the tool", float(worst), 1.0)
        missed = (deep.max(axis=1) > unseen(h, radius, tool.size)).any()
        if missed:
            yield Check("the tool is not missed", float(not _force(parts) > 0), 0.5)

    return look


def _force(parts: Parts) -> float:
    """Largest force, 0 if it is nothing but the rounding of what moves without strain."""
    largest = float(np.abs(parts.forces()).max())
    stiffness = parts.modulus * np.ptp(parts.x) ** (parts.x.shape[1] - 2)
    moved = float(np.abs(parts.displacements()).max())
    return largest if largest > 1e-10 * stiffness * moved else 0.0


def pushes(parts: Parts, along: Sequence[float], nodes: Numbers | None = None) -> View:
    """A tool pushes what it meets along its way, and does not pull it back.

    Args:
        parts: The bodies.
        along: Direction in which the tool moves.
        nodes: Supports of what it pushes; all if None.
    """
    held = parts.held if nodes is None else nodes

    def look() -> Iterator[Check]:
        forces = parts.forces()
        # In equilibrium supports bear what the tool gives
        given = -forces[held].sum(axis=0)
        against = -float(given @ np.asarray(along))
        most = max(float(np.abs(forces).max()), 1e-300)
        yield Check("the tool is pushed back", against / most, 1e-6)

    return look


def _triangles(facets: Numbers) -> Numbers:
    return np.concatenate([facets[:, [0, 1, 3]], facets[:, [0, 3, 2]]])


def crossings(a: Array, b: Array, x: Array, facets: Numbers) -> int:
    """How often the segment from a to b crosses facets."""
    if facets.shape[1] == 2:
        p, q = x[facets[:, 0]], x[facets[:, 1]]

        def side(u: Array, v: Array, w: Array) -> Array:
            d, e = v - u, w - u
            return np.asarray(d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0])

        apart = side(a, b, p) * side(a, b, q) < 0
        return int((apart & (side(p, q, a) * side(p, q, b) < 0)).sum())
    p, q, r = np.moveaxis(x[_triangles(facets)], 1, 0)

    def volume(u: Array, v: Array, w: Array, o: Array) -> Array:
        return np.asarray(np.einsum("ij,ij->i", np.cross(v - u, w - u), o - u))

    far, near = (np.broadcast_to(end, p.shape) for end in (b, a))
    apart = volume(p, q, r, near) * volume(p, q, r, far) < 0
    turns = [volume(near, far, u, v) > 0 for u, v in ((p, q), (q, r), (r, p))]
    same = (turns[0] == turns[1]) & (turns[1] == turns[2])
    return int((apart & same).sum())


def stays(parts: Parts, point: Callable[[], Array], facets: Numbers, back: Sequence[float]) -> View:
    """Something stays on the side of a surface that it came from.

    Args:
        parts: The bodies.
        point: A point of what moves, now.
        facets: The surface, which what moves cannot get round.
        back: From there to where it certainly is on its own side, farther than the scene is large.
    """
    back_ = np.asarray(back, dtype=float)
    # Off the lines of grids, where a crossing would count twice or not at all
    aside = 1e-4 * np.linalg.norm(back_) * np.roll(np.array([1.0, 0.37, 0.61])[: len(back_)], 1)

    def look() -> Iterator[Check]:
        start = point()
        hits = crossings(start, start + back_ + aside, parts.positions(), facets)
        yield Check("it is on its side", float(hits % 2), 0.0)

    return look


def apart(
    parts: Parts,
    slave: tuple[int, Numbers],
    master: tuple[int, Numbers],
    *,
    radius: float | None,
    method: str,
    size: float | Callable[[Array], float],
) -> View:
    """Two bodies, neither inside the other.

    Args:
        parts: The bodies.
        slave: Number of the slave's body, and facets of its surface.
        master: The same for the master.
        radius: Radius of the rounder one where they touch; unknown if None.
        method: Method of the contact.
        size: Size that nothing may be missed by: the thickness of a plate, the radius of a disc; a
            function of the place where it deforms.
    """
    bodies = [parts.bodies[k].boundary for k, _ in (slave, master)]
    own, other = slave[1], master[1]

    def look() -> Iterator[Check]:
        x = parts.positions()
        # Between the slave's nodes nothing is seen
        h = parts.lengths(own, x).max()
        least = min(h, float(np.median(parts.lengths(other, x))))
        missed = False
        for (_, facets), body, name in (
            (slave, bodies[1], "slave"),
            (master, bodies[0], "master"),
        ):
            facets = facets[~np.isin(facets, parts.held).any(axis=1)]
            if len(facets) == 0:
                continue
            points = sampled(x, facets)[:, ::4].reshape(-1, x.shape[1])
            depths = inside.depth(points, x, body)
            deep = float(depths.max(initial=0.0))
            here = size(points[depths.argmax()]) if callable(size) else size
            most = 2 * float(between(np.array([h]), radius, here, method)[0])
            most = max(min(most, DEEP * h, 0.4 * here), DEEP * least)
            first = max(float(unseen(np.array([h]), radius, here)[0]), DEEP * least)
            missed = missed or deep > first
            yield Check(f"{name} is outside of the other body", deep / most, 1.0)
        if missed:
            yield Check("the other body is not missed", float(not _force(parts) > 0), 0.5)

    return look


def unfolded(parts: Parts) -> View:
    """No cell is turned inside out; corners alone may be, as nothing is integrated there."""

    def look() -> Iterator[Check]:
        yield Check("no cell is turned inside out", -_least(parts), 0.0)

    return look


def folded(parts: Parts) -> list[Check]:
    """The same of linear bodies, which have no way to tell."""
    return [Check("cells are turned inside out", -_least(parts), 0.0)]


def _least(parts: Parts) -> float:
    """Least det F at many points within cells."""
    x, X = parts.positions()[parts.cells], parts.x[parts.cells]
    dim = X.shape[2]
    if parts.cells.shape[1] == dim + 1:
        derivatives = [np.concatenate([-np.ones((1, dim)), np.eye(dim)])]
    else:
        # Gauss's points of four along each axis, as far out as any rule for such cells goes
        s = 0.5 * (1 + np.polynomial.legendre.leggauss(4)[0])
        derivatives = [
            _derivative(np.array(p)) for p in np.stack(np.meshgrid(*[s] * dim), -1).reshape(-1, dim)
        ]
    least = np.inf
    for d in derivatives:
        now, before = (np.linalg.det(np.einsum("mcd,ce->mde", y, d)) for y in (x, X))
        least = min(least, float((now / before).min()))
    return least


def _derivative(p: Array) -> Array:
    """Derivatives of the shape functions of a bilinear or trilinear cell, shape (2**dim, dim)."""
    dim = len(p)
    result = np.ones((2**dim, dim))
    for c in range(2**dim):
        for e in range(dim):
            for axis in range(dim):
                bit = (c >> axis) & 1
                if axis == e:
                    result[c, e] *= 1 if bit else -1
                else:
                    result[c, e] *= p[axis] if bit else 1 - p[axis]
    return result


def watch(*views: View) -> Callable[[float], Sequence[Check]]:
    """What all views see, as the answers of a step."""
    return lambda t: [check for view in views for check in view()]
