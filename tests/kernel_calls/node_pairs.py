# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels called directly, and random pairs for them."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field, replace

import numpy as np

from contactx import cpp as core

_DOUBLES = ctypes.POINTER(ctypes.c_double)
_SIGNATURE = ctypes.CFUNCTYPE(
    None, _DOUBLES, _DOUBLES, _DOUBLES, _DOUBLES, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p
)

# Vertices and edges of the reference facets
VERTICES = {
    2: np.array([[0.0], [1.0]]),
    3: np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
    4: np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]),
}
EDGES = {2: [], 3: [(0, 1), (1, 2), (2, 0)], 4: [(0, 1), (1, 3), (3, 2), (2, 0)]}


# Kinds of pairs: nodes of the facet, feature
CASES = [
    (2, "interior"),
    (2, "vertex"),
    (3, "interior"),
    (3, "edge"),
    (3, "vertex"),
    (4, "interior"),
    (4, "edge"),
    (4, "vertex"),
]


@dataclass(frozen=True)
class Pair:
    """What a kernel reads of one pair: arrays of shape (1 + num_nodes, gdim), the slave first."""

    displacement: np.ndarray
    position: np.ndarray
    pair: np.ndarray
    multiplier: np.ndarray = field(default_factory=lambda: np.array([1.3]))
    area: np.ndarray = field(default_factory=lambda: np.array([0.7]))
    gap_derivative: np.ndarray = field(default_factory=lambda: np.array([1.0]))
    law: str = "frictionless"
    slip: np.ndarray = field(default_factory=lambda: np.zeros(6))
    slip_derivative: np.ndarray = field(default_factory=lambda: np.zeros(0))
    normal_derivative: np.ndarray = field(default_factory=lambda: np.zeros(0))

    @property
    def num_nodes(self) -> int:
        return len(self.position) - 1

    @property
    def gdim(self) -> int:
        return self.position.shape[1]

    @property
    def current(self) -> np.ndarray:
        return self.position + self.displacement

    def moved(self, du: np.ndarray) -> Pair:
        return replace(self, displacement=self.displacement + du.reshape(self.displacement.shape))

    def tabulate(self, sliding: str, term: str) -> np.ndarray:
        """Call a kernel; returns the local tensor."""
        n = self.position.size
        m = 1 if self.law == "frictionless" else self.gdim
        shape = {
            "gap": (1,),
            "normal": (m,),
            "slip": (m,),
            "residual": (n,),
            "stiffness": (n, n),
            "traction": (n, m) if m > 1 else (n,),
            "constraint": (m, n) if m > 1 else (n,),
        }[term]
        names = core.coefficients(self.law, self.num_nodes, self.gdim)
        w = np.concatenate([np.ravel(getattr(self, name)) for name, _, _ in names])
        return call(core.kernel(self.law, sliding, term, self.num_nodes, self.gdim)[0], w, shape)


def call(address: int, w: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Call the kernel at an address; returns the local tensor."""
    out = np.zeros(shape)
    none = ctypes.cast(None, _DOUBLES)
    _SIGNATURE(address)(
        out.ctypes.data_as(_DOUBLES), w.ctypes.data_as(_DOUBLES), none, none, None, None, None
    )
    return out


def difference(pair: Pair, sliding: str, term: str) -> np.ndarray:
    """Derivative of a kernel's result with respect to the displacement, by central differences."""
    h = 1e-5
    columns = []
    for i in range(pair.position.size):
        du = np.zeros(pair.position.size)
        du[i] = h
        plus, minus = pair.moved(du), pair.moved(-du)
        columns.append(
            (np.ravel(plus.tabulate(sliding, term)) - np.ravel(minus.tabulate(sliding, term)))
            / (2 * h)
        )
    return np.column_stack(columns)


def assert_close(computed: np.ndarray, reference: np.ndarray, relative: float) -> None:
    assert np.abs(computed - reference).max() <= relative * np.abs(reference).max()


def states(num_nodes: int, kind: str) -> range:
    """Numbers of all edges or vertices of a facet; two for its interior."""
    return range({"interior": 2, "edge": len(EDGES[num_nodes]), "vertex": num_nodes}[kind])


def random_pair(num_nodes: int, kind: str, rng: np.random.Generator, which: int = 0) -> Pair:
    """A warped, rotated and stretched facet with a slave node near a feature of it.

    Args:
        num_nodes: Nodes of the facet.
        kind: "interior", "edge" or "vertex".
        rng: Random numbers.
        which: Number of the edge or vertex.
    """
    vertices = VERTICES[num_nodes]
    gdim = vertices.shape[1] + 1
    flat = np.column_stack([vertices, np.zeros(num_nodes)])
    x = flat + 0.1 * rng.standard_normal(flat.shape)
    rotation = np.linalg.qr(rng.standard_normal((gdim, gdim)))[0]
    rotation[:, 0] *= np.sign(np.linalg.det(rotation))
    x = x @ rotation.T * rng.uniform(0.5, 2)

    feature, xi, cone = 0, rng.uniform(0.1, 0.6, gdim - 1), np.zeros(3)
    if num_nodes == 3:
        xi *= 0.6
    if kind == "edge":
        feature, along = 1 + which, rng.uniform(0.1, 0.9)
        i, j = EDGES[num_nodes][which]
        xi = (1 - along) * vertices[i] + along * vertices[j]
        cone = np.array([0.0, *_unit(rng, 2)])
    elif kind == "vertex":
        feature = 1 + len(EDGES[num_nodes]) + which
        xi = vertices[which]
        cone = _unit(rng, 3) if gdim == 3 else np.insert(_unit(rng, 2), 1, 0.0)
    centre = x.mean(axis=0)
    slave = centre + 0.2 * rng.standard_normal(gdim)
    if kind == "interior":
        slave = _on_facet(x, xi) + 0.1 * rng.standard_normal() * _normal(x, xi)
    normal = [*_unit(rng, gdim), *np.zeros(3 - gdim)]
    data = np.array([feature, *xi, *np.zeros(3 - gdim), *cone, *normal])
    displacement = 0.05 * rng.standard_normal((num_nodes + 1, gdim))
    current = np.vstack([slave, x])
    return Pair(displacement, current - displacement, data)


def random_vector_pair(
    law: str, num_nodes: int, kind: str, rng: np.random.Generator, which: int = 0
) -> Pair:
    """As ``random_pair``, with a traction, slip from a random point and random derivatives."""
    pair = random_pair(num_nodes, kind, rng, which)
    gdim = pair.gdim
    xi = [*rng.uniform(-0.1, 0.7, gdim - 1), *np.zeros(3 - gdim)]
    origin = [*rng.standard_normal(gdim), *np.zeros(3 - gdim)]
    return replace(
        pair,
        law=law,
        multiplier=rng.standard_normal(gdim),
        slip=np.array([*xi, 0.2 * rng.standard_normal(), *origin]),
        gap_derivative=rng.standard_normal(gdim),
        slip_derivative=rng.standard_normal(gdim * gdim),
        normal_derivative=rng.standard_normal(gdim * gdim),
    )


def shape(num_nodes: int, xi: np.ndarray) -> np.ndarray:
    """Shape functions."""
    if num_nodes == 2:
        return np.array([1 - xi[0], xi[0]])
    s, t = xi
    if num_nodes == 3:
        return np.array([1 - s - t, s, t])
    return np.array([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t])


def _on_facet(x: np.ndarray, xi: np.ndarray) -> np.ndarray:
    return shape(len(x), xi) @ x


def _normal(x: np.ndarray, xi: np.ndarray) -> np.ndarray:
    steps = np.eye(len(xi)) * 1e-3
    t = [(_on_facet(x, xi + d) - _on_facet(x, xi - d)) / 2e-3 for d in steps]
    n = np.array([t[0][1], -t[0][0]]) if len(t) == 1 else np.cross(*t)
    return n / np.linalg.norm(n)


def _unit(rng: np.random.Generator, size: int) -> np.ndarray:
    v = rng.standard_normal(size)
    return v / np.linalg.norm(v)
