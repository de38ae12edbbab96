# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of surfaces and bodies: all ranks raise, and say what one rank would."""

import numpy as np

import contactx as cx
from contactx import cpp as core
from contactx._host.bulk_host import BulkHost
from contactx._host.nodal_values import ContactValues, NodalValue

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


def master_side(scene, slave, master, names=("slave", "master"), reach=None):
    """Slave nodes of some facets and what they are paired with: other facets or an obstacle."""
    nodes = scene.halo.nodes
    mesh = core.ReferenceMesh(nodes, scene.bodies, scene.u.function_space.dofmap.list)
    options = core.MasterOptions(is_mortar=False, is_small=True, search_distance=reach)
    slaves, law = core.SlaveNodes(nodes, *slave), core.Frictionless()
    if isinstance(master, core.Obstacle):
        pairs = core.make_obstacle_master(mesh, slaves, names[0], master, law, options)
    else:
        pairs = core.make_surface_master(mesh, slaves, names[0], *master, names[1], law, options)
    return slaves, pairs


def top(scene, where=lambda x: x[0] > -1):
    """Facets of the lower block's top that are in a part of the plane."""
    height = scene.dim - 1
    return scene.facets(lambda x: np.isclose(x[height], 0) & where(x))


def bottom(scene):
    """Facets of the lower block's bottom."""
    return scene.facets(lambda x: np.isclose(x[scene.dim - 1], -1))


def shared(scene):
    """Two parts of a surface share facets, which other ranks may have."""
    left, right = top(scene, lambda x: x[0] < 0.751), top(scene, lambda x: x[0] > 0.374)
    return said(scene, master_side, scene, left, right)


def outside(scene):
    """The upper block in obstacles: wholly, in part, and where a function fails on some ranks."""
    height = scene.dim - 1
    up = np.eye(scene.dim)[height]
    slave = scene.facets(lambda x: np.isclose(x[height], 0.1))

    def fails(x):
        if np.any(x[height] > 1):
            raise ValueError("too high")
        return -1 - x[height]

    level = cx.LevelSet(fails, lambda x: np.zeros_like(x) - up[:, None])
    obstacles = cx.Plane(0 * up, -up), cx.Plane(0.5 * up, up), level
    return [said(scene, master_side, scene, slave, obstacle) for obstacle in obstacles]


def over_constrained(scene):
    """Some nodes of the lower block's bottom are constrained in an obstacle, on any rank."""
    height = scene.dim - 1
    halo = scene.halo
    up = np.eye(scene.dim)[height] + 0.2 * np.eye(scene.dim)[0]
    x0 = np.eye(scene.dim)[0] - np.eye(scene.dim)[height]
    slaves, pairs = master_side(scene, bottom(scene), cx.Plane(x0, up))
    V = scene.u.function_space
    contact = core.Contact(
        halo.nodes,
        slaves,
        pairs,
        core.Frictionless(),
        is_small=False,
        is_mortar=False,
        prescribed=np.ones(halo.num_bulk * halo.gdim, dtype=np.int8),
    )
    contact.nodes.immobile[:] = True
    offset = NodalValue(0.0, "offset", V, slaves.owned)
    values = ContactValues(None, offset, len(slaves.owned))
    system = core.System(halo.nodes, BulkHost(scene.bulk, halo), [contact])
    problem = core.Problem(system, scene.bodies, [("name", values, None)], refuses=True)
    return said(scene, problem.prepare)


def facing(scene):
    """The bottom of the lower block against its top, of which each rank sees its part."""
    slaves, pairs = master_side(scene, bottom(scene), top(scene), reach=1.1)
    return said(scene, core.check_facing, scene.halo.nodes, slaves, "bottom", pairs, "top")


def nested(comm, partition):
    """A small block in the lower one, and one that is too high by a little."""
    height = 1
    for depth, refused in ((-0.7, True), (-0.35, False)):
        scene = TwoBlocks(comm, 2, partition, corner=(0.5, 0.5, depth), size=(0.4, 0.4, 0.4))
        low = depth + 1e-6
        slave = scene.facets(lambda x, low=low: np.isclose(x[height], low, atol=1e-5))
        text = said(scene, master_side, scene, slave, top(scene))
        if refused:
            assert "body of the slave surface slave lies wholly inside" in text
            assert "all its 16 nodes" in text
        else:
            assert text is None


def check_errors(one, scene):
    """All ranks raise what one rank does."""
    for check in (shared, outside, over_constrained, facing):
        expected = check(one)
        assert check(scene) == expected
        assert "None" not in str(expected) or check is outside
    plane, part, fails = outside(scene)
    assert "all its" in plane and part is None and fails == "too high"
