# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What contact does on a part of its surfaces."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx._host.discrete_contact import Fields
from contactx._host.reaction import as_point
from contactx.surface import FacetList, Surface
from dolfinx import fem

type Array = npt.NDArray[np.float64]


class ContactPart:
    """What contact does on facets of some tags, slave or master, as of when it was asked for.

    A node that facets of other tags have, too, counts by its reference area here, so that forces,
    areas and dissipations of parts that make up the surfaces add up.

    Attributes:
        force: Force of contact on the facets, shape (gdim,).
        area: Reference area of slave nodes in contact (length in 2D), with the contact's weight.
        closed: Number of slave nodes in contact.
        slipping: Number of those that slip.
        largest_pressure: Largest contact pressure, at least 0.
        smallest_gap: Smallest gap; NaN where no slave node has a pair.
        dissipation: Work of friction so far.
    """

    def __init__(self, fields: Fields, shares: Array):
        """Sum up; all ranks must take part.

        Args:
            fields: Results of the contact.
            shares: What of each owned node is of the part, shape (num_owned,).
        """
        self._results, self._shares = fields.results, shares
        totals = self._results.totals_of(shares)
        self.force: Array = self._results.force_of(shares)
        self.area: float = totals.area
        self.closed: int = totals.closed
        self.slipping: int = totals.slipping
        self.largest_pressure: float = totals.largest_pressure
        self.smallest_gap: float = totals.smallest_gap
        self.dissipation: float = totals.dissipation

    def moment(self, point: npt.ArrayLike) -> float | Array:
        """Moment of the force about a point; all ranks must take part.

        It is that of now: take it before the next step.

        Args:
            point: The point, shape (gdim,).

        Returns:
            The moment: in 2D a number, positive counter-clockwise, in 3D of shape (3,).

        Raises:
            TypeError: If the point is not of real numbers.
            ValueError: If it has another shape, or is not finite.
            RuntimeError: If the model is axisymmetric.
        """
        moment = self._results.moment_of(as_point(point, len(self.force)), self._shares)
        return float(moment[0]) if len(moment) == 1 else moment


def shares_of(
    fields: Fields, surfaces: Sequence[Surface], tags: tuple[int, ...], V: fem.FunctionSpace
) -> Array:
    """What of each node that this rank owns is of facets with some tags; all ranks take part.

    Args:
        fields: Results of the contact.
        surfaces: Its surfaces.
        tags: Tags of the part.
        V: Space of the displacement.

    Returns:
        Shares from 0 to 1, shape (num_owned,).
    """
    chosen = [(s.facet_tags, [tag for tag in tags if tag in s.tags]) for s in surfaces]
    part = _joined([Surface(of, *some).facet_nodes(V) for of, some in chosen if some])
    whole = _joined([surface.facet_nodes(V) for surface in surfaces])
    return fields.results.shares(*part, *whole)


def checked_tags(tags: tuple[Any, ...], surfaces: Sequence[Surface]) -> tuple[int, ...]:
    """Check the tags of a part of a contact.

    Raises:
        TypeError: If one is no integer.
        ValueError: If there is none, or a surface does not have one.
    """
    there = sorted({tag for surface in surfaces for tag in surface.tags})
    for tag in tags:
        if not isinstance(tag, Integral):
            raise TypeError(f"a tag is an integer, not {tag!r}: write contact.part(1, 2)")
    if not tags or not set(tags) <= set(there):
        missing = f"tag {min(set(tags) - set(there))}" if tags else "no tag"
        raise ValueError(
            f"{missing} is of no facets of the contact, which has {', '.join(map(str, there))}: "
            "give some of these"
        )
    return tuple(map(int, tags))


def _joined(lists: Sequence[FacetList]) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Facets of several lists: offsets and nodes."""
    sizes = np.concatenate([np.diff(facets.offsets) for facets in lists])
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    return offsets, np.concatenate([facets.nodes for facets in lists])
