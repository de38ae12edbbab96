# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Coulomb's law at the slave nodes of a solved contact."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import contactx as cx

type Array = npt.NDArray[np.float64]


def parts(contact: cx.Contact) -> tuple[Array, Array]:
    """Pressure and tangential traction of the slave nodes, shapes (n,) and (n, gdim)."""
    normal, traction = contact.discrete.nodes.normal, contact.multiplier
    p: Array = np.einsum("ij,ij->i", normal, traction)
    return p, traction - p[:, None] * normal


def check_coulomb(
    contact: cx.Contact, tolerance: float, which: npt.NDArray[np.bool_] | None = None
) -> dict[str, int]:
    """Check Coulomb's law and the normal conditions; how many nodes have which status."""
    nodes = contact.discrete.nodes
    p, t = parts(contact)
    mu = np.broadcast_to(contact.discrete.law.friction(nodes), p.shape)
    # A row of the conditions is a force: area times a traction, or times c and a length
    stress = tolerance / nodes.area
    length = stress / nodes.c + 1e-15 * np.abs(contact.discrete.positions()).max()
    stick, slips, is_open = (nodes.status == k for k in (1, 2, 0))
    which = np.ones(len(p), dtype=bool) if which is None else which
    size_t, size_s = np.linalg.norm(t, axis=1), np.linalg.norm(nodes.slip, axis=1)

    def holds(condition: Array) -> bool:
        return bool(np.all(condition[which]))

    assert holds(~is_open | (np.abs(contact.multiplier).max(axis=1) <= stress))
    assert holds(is_open | (p >= 0))
    assert holds(is_open | (np.abs(nodes.gap) <= length))
    assert holds(~is_open | np.isnan(nodes.gap) | (nodes.gap >= -length))
    assert holds(size_t <= mu * p * (1 + 1e-9) + stress)
    assert holds(~stick | (size_s <= length))
    assert holds(~slips | (np.abs(size_t - mu * p) <= 1e-9 * mu * p + stress))
    # t = -mu p s / |s|, without a direction of what is rounding
    against = t * size_s[:, None] + (mu * p)[:, None] * nodes.slip
    # On the edge of the cone slip may be as wrong as 1e-10 of the traction is worth
    edge = 1e-10 * mu * p / nodes.c
    bound = (1e-9 * mu * p + stress) * size_s + 2 * mu * p * (length + edge)
    assert holds(~slips | (np.linalg.norm(against, axis=1) <= bound))
    return {"open": int(is_open.sum()), "stick": int(stick.sum()), "slip": int(slips.sum())}
