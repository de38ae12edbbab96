# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The families of scenes, one for each axis of the map."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from stress.families import (
    again,
    arches,
    coarse,
    cycles,
    edges,
    folding,
    frames,
    free,
    materials,
    mixture,
    moving,
    passing,
    peers,
    places,
    rings,
    rolling,
    shapes,
    tools,
    touching,
)
from stress.scene import Scene

FAMILIES = (
    materials.stiffness,
    materials.poisson,
    shapes.mesh_ratio,
    shapes.aspect,
    shapes.noise,
    touching.gaps,
    touching.overlaps,
    touching.zero_force,
    moving.friction,
    moving.indentation,
    moving.rigid,
    frames.units,
    frames.turned,
    frames.renumbered,
    places.on_vertices,
    edges.off_an_edge,
    edges.over_a_ridge,
    edges.with_an_edge,
    free.pressed,
    free.rocking,
    rolling.rolling,
    free.stacked,
    cycles.cyclic,
    peers.hertz,
    mixture.mixture,
    tools.tools,
    coarse.rigid,
    coarse.soft,
    arches.arches,
    arches.belts,
    folding.folding,
    passing.passing,
    again.repeated,
    again.released,
    again.heated,
    rings.rings,
)


def all_scenes() -> Sequence[Scene]:
    """All scenes of the map, always in the same order."""
    scenes = [scene for family in FAMILIES for scene in family()]
    twice = [name for name, n in Counter(s.name for s in scenes).items() if n > 1]
    assert not twice, twice[:3]
    return scenes
