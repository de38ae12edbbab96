# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid tools: what contactx is given, and an exact signed distance beside it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

import contactx as cx
from dolfinx import fem, mesh

from stress.grids import Array


class Tool(ABC):
    """A rigid body that moves without turning.

    Attributes:
        at: Where its centre is, shape (dim,).
        size: Its smallest radius, by which nothing may be missed.
        obstacle: The same for contactx.
    """

    size: float
    obstacle: cx.contact.Obstacle

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array):
        """Put it somewhere."""
        self._at = fem.Constant(domain, np.array(at, dtype=float))

    @property
    def at(self) -> Array:
        """Where its centre is."""
        return np.array(self._at.value)

    def move(self, to: Sequence[float] | Array) -> None:
        """Move its centre."""
        self._at.value[...] = to

    @abstractmethod
    def distance(self, x: Array) -> Array:
        """Signed distance of points from its surface, negative inside, shape (n,)."""

    def level(self, x: Array) -> Array:
        """A function that is zero on its surface, and what contactx is given if that is one."""
        return self.distance(x)


class Ball(Tool):
    """A ball, in the plane a disc."""

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array, radius: float):
        """Give it a radius."""
        super().__init__(domain, at)
        self.size = radius
        self.obstacle = cx.Sphere(self._at, radius)

    def distance(self, x: Array) -> Array:
        """See ``Tool``."""
        return np.linalg.norm(x - self.at, axis=1) - self.size


class LevelBall(Ball):
    """A ball as the zero of a function that is no distance."""

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array, radius: float):
        """Give it a radius."""
        super().__init__(domain, at, radius)
        self.obstacle = cx.LevelSet(
            lambda x: self.level(x.T), lambda x: 2 * (x.T - self.at).T / radius
        )

    def level(self, x: Array) -> Array:
        """See ``Tool``."""
        return ((x - self.at) ** 2).sum(axis=1) / self.size - self.size


class Roll(Tool):
    """An endless cylinder along the second axis in space."""

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array, radius: float):
        """Give it a radius."""
        super().__init__(domain, at)
        self.size = radius
        self.obstacle = cx.Cylinder(self._at, (0.0, 1.0, 0.0), radius)

    def distance(self, x: Array) -> Array:
        """See ``Tool``."""
        return np.linalg.norm((x - self.at)[:, [0, 2]], axis=1) - self.size


class Press(Tool):
    """All that is above a plane through its centre; the last axis points up."""

    _way = -1.0

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array, size: float = 1.0):
        """Give it the size of what it presses."""
        super().__init__(domain, at)
        self.size = size
        self.obstacle = cx.Plane(self._at, self._way * np.eye(len(at))[-1])

    def distance(self, x: Array) -> Array:
        """See ``Tool``."""
        return self._way * (x[:, -1] - self.at[-1])


class Floor(Press):
    """All that is below a plane through its centre."""

    _way = 1.0


class Wave(Tool):
    """Ground with waves along the first axis, as a function that is no distance."""

    def __init__(self, domain: mesh.Mesh, at: Sequence[float] | Array):
        """Put it somewhere."""
        super().__init__(domain, at)
        self.obstacle = cx.LevelSet(lambda x: self.level(x.T), lambda x: self._slope(x.T).T)

    def level(self, x: Array) -> Array:
        """See ``Tool``."""
        d = x - self.at
        return d[:, -1] + 0.02 * (1 - np.cos(6 * d[:, 0]))

    def _slope(self, x: Array) -> Array:
        slope = np.zeros_like(x)
        slope[:, 0], slope[:, -1] = 0.12 * np.sin(6 * (x - self.at)[:, 0]), 1.0
        return slope

    def distance(self, x: Array) -> Array:
        """See ``Tool``; to first order."""
        return self.level(x) / np.linalg.norm(self._slope(x), axis=1)


class Punch(Tool):
    """A narrow punch with round edges in the plane, as a function; its centre is in its tip."""

    def __init__(self, domain: mesh.Mesh, at: Sequence[float], half: float, high: float):
        """Give it half a width, and half a height, of which the edges take half a width, too."""
        super().__init__(domain, at)
        self.size = half
        self._round = 0.5 * half
        self._inner = np.array([half, high]) - self._round
        self._lift = np.array([0.0, high - half])
        self.obstacle = cx.LevelSet(lambda x: self.distance(x.T), lambda x: self._slope(x.T).T)

    def _corner(self, x: Array) -> tuple[Array, Array]:
        d = x - self.at - self._lift
        return np.abs(d) - self._inner, np.where(d < 0, -1.0, 1.0)

    def distance(self, x: Array) -> Array:
        """See ``Tool``."""
        q, _ = self._corner(x)
        outside = np.linalg.norm(np.maximum(q, 0), axis=1)
        return outside + np.minimum(q.max(axis=1), 0) - self._round

    def _slope(self, x: Array) -> Array:
        q, sign = self._corner(x)
        out = np.maximum(q, 0)
        size = np.linalg.norm(out, axis=1, keepdims=True)
        nearest = (q == q.max(axis=1, keepdims=True)).astype(float)
        nearest[:, 1] *= 1 - nearest[:, 0]
        return sign * np.where(size > 0, out / np.where(size > 0, size, 1), nearest)
