# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Random surfaces for the C++ core, and what may be done to them without changing anything."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from hypothesis import strategies as st

# Multiples of 1/64: sums, products with them and shifts by them are often exact
fractions = st.integers(-128, 128).map(lambda n: n / 64)
anything = st.floats(-1e50, 1e50, allow_subnormal=False).filter(lambda v: v == 0 or abs(v) > 1e-50)
# Of which square roots are exact too
powers = st.integers(-20, 20).map(lambda k: 4.0**k)


@dataclass(frozen=True)
class Surfaces:
    """A slave and a master surface: offsets and nodes, over nodes of shape (num_nodes, gdim)."""

    x: np.ndarray
    slave: tuple[np.ndarray, np.ndarray]
    master: tuple[np.ndarray, np.ndarray]

    @property
    def gdim(self) -> int:
        return self.x.shape[1]

    @property
    def lists(self) -> tuple[np.ndarray, ...]:
        return (*self.slave, *self.master)

    def placed(self, x: np.ndarray) -> Surfaces:
        return replace(self, x=np.ascontiguousarray(x))

    def renumbered(self, new: np.ndarray) -> Surfaces:
        """With the node that was i as new[i]."""
        x = np.empty_like(self.x)
        x[new] = self.x
        new = new.astype(np.int32)
        slave, master = ((offsets, new[nodes]) for offsets, nodes in (self.slave, self.master))
        return Surfaces(x, slave, master)


def _list(facets: list[list[int]]) -> tuple[np.ndarray, np.ndarray]:
    offsets = np.concatenate([[0], np.cumsum([len(f) for f in facets])]).astype(np.int32)
    return offsets, np.array([node for f in facets for node in f], dtype=np.int32)


def _sheet(gdim: int, first: int, up: bool, split: list[bool]) -> list[list[int]]:
    """Two segments, or a row of two cells, of five or six nodes."""
    if gdim == 2:
        return [[i + 1, i] if up else [i, i + 1] for i in (first, first + 1)]
    facets = []
    for i, triangles in zip((first, first + 1), split, strict=True):
        a, b, c, d = i, i + 1, i + 3, i + 4
        if not up:
            b, c = c, b
        facets += [[a, b, c], [b, d, c]] if triangles else [[a, b, c, d]]
    return facets


@st.composite
def sheets(draw: st.DrawFn, gdims: tuple[int, ...] = (2, 3)) -> Surfaces:
    """Two sheets over one another, their nodes moved by up to a quarter of a cell."""
    gdim = draw(st.sampled_from(gdims))
    count = 3 if gdim == 2 else 6
    flat = np.zeros((count, gdim))
    flat[:, 0] = np.arange(count) % 3
    if gdim == 3:
        flat[:, 1] = np.arange(count) // 3
    moves = draw(st.lists(fractions, min_size=2 * count * gdim, max_size=2 * count * gdim))
    x = np.vstack([flat, flat]) + np.reshape(moves, (-1, gdim)) / 8
    x[:count, -1] += draw(fractions) / 4
    split = [draw(st.booleans()) for _ in range(4)]
    slave = _sheet(gdim, 0, False, split[:2])
    return Surfaces(x, _list(slave), _list(_sheet(gdim, count, True, split[2:])))


@st.composite
def wild_surfaces(draw: st.DrawFn) -> Surfaces:
    """Facets of any nodes at any place."""
    gdim = draw(st.sampled_from((2, 3)))
    count = draw(st.integers(1, 6))
    values = draw(st.sampled_from((fractions, anything)))
    x = draw(st.lists(values, min_size=count * gdim, max_size=count * gdim))
    node = st.integers(0, count - 1)
    sizes = (2,) if gdim == 2 else (3, 4)
    facet = st.one_of(*(st.lists(node, min_size=n, max_size=n) for n in sizes))
    slave, master = draw(st.lists(facet, max_size=4)), draw(st.lists(facet, max_size=4))
    return Surfaces(np.reshape(x, (-1, gdim)), _list(slave), _list(master))


@st.composite
def rotations(draw: st.DrawFn, gdim: int) -> np.ndarray:
    """Rotation matrices of shape (gdim, gdim)."""
    angle = draw(st.floats(-3, 3))
    c, s = np.cos(angle), np.sin(angle)
    if gdim == 2:
        return np.array([[c, -s], [s, c]])
    i = draw(st.integers(0, 2))
    rotation = np.eye(3)
    rotation[np.ix_([i, (i + 1) % 3], [i, (i + 1) % 3])] = [[c, -s], [s, c]]
    return np.roll(rotation, draw(st.integers(0, 2)), axis=0)


def shuffles(count: int) -> st.SearchStrategy[np.ndarray]:
    """Permutations."""
    return st.permutations(range(count)).map(np.array)
