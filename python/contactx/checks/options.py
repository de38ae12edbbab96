# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Options of a contact."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactx.checks.kinds import check_switch, described, is_number
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
    sliding: Any,
    method: Any,
    tied: Any,
    search_distance: Any,
    offset: Any,
) -> None:
    """Check the arguments of a Contact; they are described there.

    Raises:
        TypeError: If an argument is of another kind.
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
    if not isinstance(sliding, str) or sliding not in _SLIDING:
        raise ValueError(f'sliding must be "finite" or "small", not {sliding!r}')
    if not isinstance(method, str) or method not in _METHODS:
        raise ValueError(
            f'method must be "node-to-surface" or "surface-to-surface", not {method!r}'
        )
    for name, value in (("friction", friction), ("offset", offset)):
        if not (is_number(value) or isinstance(value, fem.Constant | fem.Function)):
            raise TypeError(
                f"{name} must be a number, a fem.Constant or a fem.Function, not {described(value)}"
            )
    for name, value in (("friction", friction), ("offset", offset)):
        if is_number(value) and not (np.isfinite(value) and (name == "offset" or value >= 0)):
            wanted = "a finite number" if name == "offset" else "a number of at least 0"
            raise ValueError(f"{name} is {value}: give {wanted}")
    check_switch("tied", tied)
    if tied and not (is_number(friction) and friction == 0):
        raise ValueError("tied excludes friction: a tied slave node does not slip")
    if search_distance is not None:
        if not is_number(search_distance):
            raise TypeError(
                f"search_distance is {described(search_distance)}: give a length, or None"
            )
        if not search_distance > 0:
            raise ValueError(f"search_distance is {search_distance}: give a positive length")
