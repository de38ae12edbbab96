# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of surfaces and bodies: all ranks raise, and say what one rank would."""

import numpy as np

import contactx as cx
from contactx import cpp as core
from contactx.geometry import inside
from contactx.geometry.facets import check_facets
from contactx.geometry.facing import check_facing
from contactx.geometry.inside import check_apart, check_outside
from contactx.interface import Interface, check_over_constrained
from contactx.nodal import NodalValue
from contactx.parallel.slaves import SlaveNodes
from contactx.surface import FacetList

from scenes.numbered_blocks import TwoBlocks


def said(scene, check, *arguments):
    """What a check raises, the same on all ranks; None if it does not."""
    text = None
    try:
        check(*arguments)
    except ValueError as error:
        text = str(error)
    texts = scene.halo.comm.allgather(text)
    assert texts == [text] * len(texts)
    return text


def top(scene, where=lambda x: x[0] > -1):
    """Facets of the lower block's top that are in a part of the plane."""
    height = scene.dim - 1
    return FacetList(*scene.facets(lambda x: np.isclose(x[height], 0) & where(x)))


def shape(scene):
    """Two nodes of the lower block's top are moved onto neighbours."""
    x, original = scene.halo.x, scene.halo.original
    every = scene.everywhere(x[: scene.halo.num_owned])
    before = x.copy()
    for x0 in (0.375, 1.125):
        node, onto = (
            np.linalg.norm(every - at, axis=1).argmin()
            for at in ([x0, *[0] * (scene.dim - 1)], [x0 + 0.375, *[0] * (scene.dim - 1)])
        )
        x[original == node] = every[onto]
    text = said(scene, check_facets, "the surface", "slave", top(scene), scene.halo)
    x[:] = before
    assert said(scene, check_facets, "the surface", "slave", top(scene), scene.halo) is None
    return text


def shared(scene):
    """Two parts of a surface share facets, which other ranks may have."""
    left, right = top(scene, lambda x: x[0] < 0.751), top(scene, lambda x: x[0] > 0.374)
    return said(scene, check_apart, "left", "right", left, right, scene.bodies)


def outside(scene):
    """The upper block in obstacles: wholly, in part, and where a function fails on some ranks."""
    height = scene.dim - 1
    up = np.eye(scene.dim)[height]
    nodes = np.unique(scene.facets(lambda x: np.isclose(x[height], 0.1))[1])
    nodes = nodes[nodes < scene.halo.num_owned]
    x = scene.halo.x

    def fails(x):
        if np.any(x[height] > 1):
            raise ValueError("too high")
        return -1 - x[height]

    level = cx.LevelSet(fails, lambda x: np.zeros_like(x) - up[:, None])
    texts = []
    for obstacle in (cx.Plane(0 * up, -up), cx.Plane(0.5 * up, up), level):
        gap = obstacle.evaluate(x[nodes]).gap
        arguments = "the surface", nodes, gap, obstacle, scene.bodies
        texts.append(said(scene, check_outside, *arguments))
    return texts


def over_constrained(scene):
    """Some nodes of the lower block's bottom are constrained in an obstacle, on any rank."""
    height = scene.dim - 1
    halo = scene.halo
    up = np.eye(scene.dim)[height] + 0.2 * np.eye(scene.dim)[0]
    x0 = np.eye(scene.dim)[0] - np.eye(scene.dim)[height]
    slaves = SlaveNodes(halo, FacetList(*scene.facets(lambda x: np.isclose(x[height], -1))))
    V = scene.u.function_space
    interface = Interface(
        slaves,
        core.ObstacleMaster(cx.Plane(x0, up), slaves, halo.x, None, False),
        halo,
        law=core.Frictionless(),
        friction=None,
        sliding="finite",
        has_means=False,
        offset=NodalValue(0.0, "offset", V, slaves.owned),
        markers=np.ones(halo.num_bulk * halo.gdim, dtype=np.int8),
    )
    interface.nodes.immobile[:] = True
    u = np.zeros(halo.num_bulk * halo.gdim)
    return said(scene, check_over_constrained, [interface], ["name"], u, halo)


class Pairs(core.NodeToSurface):
    """Pairs that a search has not found."""

    paired = np.zeros(1, dtype=bool)


def facing(scene):
    """The bottom of the lower block against its top, of which each rank sees its part."""
    height, halo = scene.dim - 1, scene.halo
    bottom = FacetList(*scene.facets(lambda x: np.isclose(x[height], -1)))
    slaves = SlaveNodes(halo, bottom)
    theirs = top(scene)
    theirs = theirs.offsets, theirs.nodes
    surface, outside = (kind(halo.nodes, *theirs) for kind in (core.MasterSurface, core.Outside))
    options = {"is_small": True, "measures_slip": False}
    pairs = Pairs(halo.nodes, slaves, surface, outside, 1.1, **options)
    away = said(scene, check_facing, "bottom", slaves, "top", pairs, halo)
    pairs.paired = np.full(1, halo.comm.rank == halo.comm.size - 1)
    assert said(scene, check_facing, "bottom", slaves, "top", pairs, halo) is None
    return away


def nested(comm, partition):
    """A small block in the lower one, and one that is too high by a little."""
    height = 1
    inside._PER_LOOK = 3
    for depth, refused in ((-0.7, True), (-0.35, False)):
        scene = TwoBlocks(comm, 2, partition, corner=(0.5, 0.5, depth), size=(0.4, 0.4, 0.4))
        low = depth + 1e-6
        slave = FacetList(*scene.facets(lambda x, low=low: np.isclose(x[height], low, atol=1e-5)))
        text = said(scene, check_apart, "slave", "master", slave, top(scene), scene.bodies)
        if refused:
            assert "body of the slave surface slave lies wholly inside" in text
            assert "all its 16 nodes" in text
        else:
            assert text is None


def check_errors(one, scene):
    """All ranks raise what one rank does."""
    for check in (shape, shared, outside, over_constrained, facing):
        expected = check(one)
        assert check(scene) == expected
        assert "None" not in str(expected) or check is outside
    plane, part, fails = outside(scene)
    assert "all its" in plane and part is None and fails == "too high"
