# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of a contact."""

from __future__ import annotations

from typing import Any, SupportsFloat

import numpy as np

from contactx.obstacles import Obstacle
from contactx.surface import Surface
from dolfinx import fem

_SLIDING = ("finite", "small")
_METHODS = ("node-to-surface", "surface-to-surface")


def check_options(
    slave: Any,
    master: Any,
    *,
    friction: Any,
    sliding: str,
    method: str,
    tied: bool,
    search_distance: float | None,
    offset: Any,
) -> None:
    """Check the arguments of a Contact; they are described there.

    Raises:
        TypeError: If slave, master, friction or offset is something else.
        ValueError: If the surfaces share facets, or an option is out of its range.
    """
    if not isinstance(slave, Surface):
        raise TypeError(
            f"slave must be a contactx.Surface, not {type(slave).__name__}: "
            "write Surface(facet_tags, tag)"
        )
    if not isinstance(master, Surface | Obstacle):
        raise TypeError(
            f"master must be a contactx.Surface or a rigid obstacle, not "
            f"{type(master).__name__}: write Surface(facet_tags, tag), or Plane, Sphere, "
            "Cylinder or LevelSet"
        )
    if isinstance(master, Surface) and slave.facet_tags.topology is master.facet_tags.topology:
        shared = np.intersect1d(slave.facets, master.facets)
        if len(shared) > 0:
            raise ValueError(
                f"slave and master overlap: {slave} and {master} have {len(shared)} facets in "
                "common. Give each surface its own tags"
            )
    if sliding not in _SLIDING:
        raise ValueError(f'sliding must be "finite" or "small", not {sliding!r}')
    if method not in _METHODS:
        raise ValueError(
            f'method must be "node-to-surface" or "surface-to-surface", not {method!r}'
        )
    for name, value in (("friction", friction), ("offset", offset)):
        if not isinstance(value, SupportsFloat | fem.Function):
            raise TypeError(
                f"{name} must be a number, a fem.Constant or a fem.Function, not "
                f"{type(value).__name__}"
            )
    fixed = None if isinstance(friction, fem.Constant | fem.Function) else float(friction)
    if fixed is not None and not (np.isfinite(fixed) and fixed >= 0):
        raise ValueError(f"friction is {friction}: give a number of at least 0")
    if tied and fixed != 0:
        raise ValueError("tied excludes friction: a tied slave node does not slip")
    if search_distance is not None and not search_distance > 0:
        raise ValueError(f"search_distance is {search_distance}: give a positive length")
