# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels of pairs of two facets called directly, and random pairs for them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from contactx import cpp as core

from kernel_calls.node_pairs import VERTICES, call

# Nodes of the slave and of the master facet
KINDS = [(2, 2), (3, 3), (3, 4), (4, 3), (4, 4)]


@dataclass(frozen=True)
class FacetPair:
    """What a kernel reads of one pair: arrays over nodes have the slave's first.

    The integrals are those of the positions at ``integrated``, or of the current ones.
    """

    slaves: int
    displacement: np.ndarray
    position: np.ndarray
    law: str = "frictionless"
    integrated: np.ndarray | None = None
    multiplier: np.ndarray = field(default_factory=lambda: np.zeros(0))
    gap_derivative: np.ndarray = field(default_factory=lambda: np.zeros(0))
    slip_derivative: np.ndarray = field(default_factory=lambda: np.zeros(0))
    normal_derivative: np.ndarray = field(default_factory=lambda: np.zeros(0))
    area: np.ndarray = field(default_factory=lambda: np.zeros(0))

    @property
    def masters(self) -> int:
        return len(self.position) - self.slaves

    @property
    def gdim(self) -> int:
        return self.position.shape[1]

    @property
    def current(self) -> np.ndarray:
        return self.position + self.displacement

    @property
    def integrals(self) -> dict[str, np.ndarray]:
        n, m = self.slaves, self.masters
        offsets = [np.array([0, k], dtype=np.int32) for k in (n, m)]
        nodes = [np.arange(n, dtype=np.int32), np.arange(n, n + m, dtype=np.int32)]
        search = core.FacetSearch(offsets[0], nodes[0], offsets[1], nodes[1], self.gdim)
        x = self.current if self.integrated is None else self.integrated
        return search.integrals(search.find(x, np.inf, 0.0), x, self.position)

    @property
    def pair(self) -> np.ndarray:
        n, m = self.slaves, self.masters
        found = self.integrals
        return np.concatenate(
            [
                found["weight"][0, :n, :m].ravel(),
                found["dual"][0, :n, :n].ravel(),
                found["gap"][0, :n],
                found["normal"][0],
            ]
        )

    def moved(self, du: np.ndarray) -> FacetPair:
        return replace(self, displacement=self.displacement + du.reshape(self.displacement.shape))

    def tabulate(self, sliding: str, term: str) -> np.ndarray:
        """Call a kernel; returns the local tensor."""
        n, u = self.slaves, self.position.size
        m = n * (1 if self.law == "frictionless" else self.gdim)
        shape = {
            "gap": (n,),
            "normal": (m,),
            "slip": (m,),
            "residual": (u,),
            "stiffness": (u, u),
            "traction": (u, m),
            "constraint": (m, u),
        }[term]
        names = core.coefficients(self.law, self.masters, self.gdim, n)
        w = np.concatenate([np.ravel(getattr(self, name)) for name, _, _ in names])
        address, _ = core.kernel(self.law, sliding, term, self.masters, self.gdim, n)
        return call(address, w, shape)


def random_facet_pair(
    law: str, slaves: int, masters: int, rng: np.random.Generator, *, inside: bool = True
) -> FacetPair:
    """Two warped facets in front of one another, rotated together.

    Args:
        law: Contact law.
        slaves: Nodes of the slave facet.
        masters: Nodes of the master facet.
        rng: Random numbers.
        inside: Whether the slave facet lies within the master facet, else they overlap in part.
    """
    gdim = VERTICES[slaves].shape[1] + 1
    down = VERTICES[slaves] - VERTICES[slaves].mean(axis=0)
    up = VERTICES[masters] - VERTICES[masters].mean(axis=0)
    # The master looks the other way
    up[:, 0] *= -1
    up *= 6 if inside else 1.5
    if not inside:
        up += 0.2 * rng.standard_normal(gdim - 1)
    x = np.vstack(
        [
            np.column_stack([down, np.zeros(slaves)]),
            np.column_stack([up, np.full(masters, 0.1 * rng.standard_normal())]),
        ]
    )
    x += 0.06 * rng.standard_normal(x.shape)
    if gdim == 2:
        # The normal of a segment is its tangent turned clockwise
        x[:, 1] *= -1
    rotation = np.linalg.qr(rng.standard_normal((gdim, gdim)))[0]
    rotation[:, 0] *= np.sign(np.linalg.det(rotation))
    current = x @ rotation.T * rng.uniform(0.5, 2) + rng.standard_normal(gdim)
    displacement = 0.03 * rng.standard_normal(x.shape)
    m = 1 if law == "frictionless" else gdim
    vector = law != "frictionless"
    return FacetPair(
        slaves,
        displacement,
        current - displacement,
        law=law,
        multiplier=rng.standard_normal((slaves, m)),
        gap_derivative=rng.standard_normal((slaves, m)),
        slip_derivative=rng.standard_normal((slaves, m, m) if vector else 0),
        normal_derivative=rng.standard_normal((slaves, m, m) if vector else 0),
        area=rng.uniform(0.5, 1, slaves),
    )
