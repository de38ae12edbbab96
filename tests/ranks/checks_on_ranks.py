# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of surfaces and bodies: all ranks raise, and say what one rank would."""

import numpy as np

import contactx as cx
from contactx import cpp as core
from contactx.audit.passage import NONE, _normals, passages
from contactx.geometry import inside
from contactx.geometry.facets import check_facets
from contactx.geometry.facing import check_facing
from contactx.geometry.inside import check_apart, check_outside
from contactx.interface import Interface, check_over_constrained
from contactx.nodal import NodalValue
from contactx.parallel.slaves import SlaveNodes
from contactx.search import slave_facets
from contactx.surface import FacetList
from dolfinx import mesh

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


def outward(scene, at):
    """Facets whose cells this rank owns, on the boundary where a function of the position holds."""
    tdim = scene.dim
    scene.domain.topology.create_connectivity(tdim - 1, tdim)
    found = mesh.locate_entities_boundary(scene.domain, tdim - 1, at)
    tags = mesh.meshtags(scene.domain, tdim - 1, found, np.ones_like(found))
    return cx.Surface(tags, 1).facet_nodes(scene.u.function_space)


def passed(scene, x1, one_way):
    """What passes: nodes of the upper block's bottom, or those of the lower block's top."""
    height, halo = scene.dim - 1, scene.halo
    low = outward(scene, lambda x: np.isclose(x[height], 0))
    high = outward(scene, lambda x: np.isclose(x[height], 0.1))
    own, facets = (high, low) if one_way else (low, high)
    nodes = slave_facets(halo, own).nodes
    nodes = np.unique(nodes[nodes < halo.num_owned])
    found = passages(halo, own, facets, halo.x, x1(halo.x), nodes, np.full(len(nodes), 0.02))
    assert len(set(halo.comm.allgather((found.count, found.node)))) == 1
    return found


def check_passages(one, scene):
    """Part of the upper block is pushed into the lower one, and all is turned."""
    dim, height = scene.dim, scene.dim - 1
    turn = np.eye(dim)
    turn[np.ix_([0, height], [0, height])] = [[0.0, -1.0], [1.0, 0.0]]

    def moved(down):
        def x1(x):
            upper = (x[:, height] > 0.05)[:, None]
            return (x - np.where(upper, down(x[:, :1]), 0) * np.eye(dim)[height]) @ turn.T + 5

        return x1

    for down, count in ((lambda x: 0.4 * (x > 0.6), 2), (lambda x: 0.4 + 0 * x, 4)):
        found = passed(scene, moved(down), True)
        expected = passed(one, moved(down), True)
        assert found.count == expected.count == count * 4 ** (dim - 2)
        assert found.node == expected.node
        assert np.abs(found.position - expected.position).max() <= 1e-14
    # At 0.375 and 0.75 it is under the upper block
    found, expected = (passed(s, moved(lambda x: 0.4 + 0 * x), False) for s in (scene, one))
    assert found.count == expected.count == 2 ** (dim - 1)
    assert found.node == expected.node
    for down in (0.0, 0.1, -3.0):
        assert passed(scene, moved(lambda x, down=down: down + 0 * x), True) == NONE
    # Bodies that bend, turn and slide: how the surface moves as a whole matters, and all of it
    rng = np.random.default_rng(1)
    for _ in range(6):
        wave, phase = rng.uniform(-0.6, 0.6, dim), rng.uniform(0, 6)
        way, angle = rng.uniform(-0.8, 0.8, dim), rng.uniform(1, 3)

        def waved(x, wave=wave, phase=phase, way=way, angle=angle):
            upper = (x[:, height] > 0.05)[:, None]
            x = x + np.sin(5 * x[:, :1] + phase) * wave + upper * way
            turn = np.eye(dim)
            c, s = np.cos(angle), np.sin(angle)
            turn[np.ix_([0, height], [0, height])] = [[c, -s], [s, c]]
            return x @ turn.T

        for one_way in (True, False):
            found, expected = (passed(s, waved, one_way) for s in (scene, one))
            assert (found.count, found.node) == (expected.count, expected.node)
        normals = []
        for s in (scene, one):
            own = outward(s, lambda x: np.isclose(x[height], 0) | np.isclose(x[0], 0))
            x = waved(s.halo.x)
            normals.append(s.everywhere(_normals(s.halo, own, s.halo.x, x)[1]))
        assert np.abs(normals[0] - normals[1]).max() <= 1e-13
