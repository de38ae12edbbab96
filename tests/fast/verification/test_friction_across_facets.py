# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sliding over many facets in one step, and over the outer edge of the master."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from scenes import CELLS
from scenes.coulomb import parts
from scenes.covering import METHODS, covering
from scenes.driven import DrivenBlock

MU = 0.3


def block(cell, n_lower, **options):
    """A block on a flat base that is fixed everywhere; nu = 0 keeps it from moving across."""
    return DrivenBlock(
        cell, n_upper=3, n_lower=n_lower, nu=0.0, friction=MU, rigid_base=True, **options
    )


def facets(scene):
    """Nodes of the facet that each slave node is paired with."""
    result = [()] * len(scene.contact.area)
    for pairs in scene.contact.discrete.master.pairs():
        for slave, nodes in zip(pairs.slaves[:, 0], pairs.nodes[:, 1:], strict=True):
            result[slave] = tuple(nodes)
    return result


def check_full_slide(scene, exact, method):
    """All slide against friction times pressure; returns the size of the friction force.

    Args:
        scene: Scene.
        exact: Whether all slide in the same direction.
        method: By surface-to-surface normals are the slave's, which bends at its free edges.
    """
    contact = scene.contact
    p, t = parts(contact)
    w = contact.area
    assert np.all(contact.discrete.nodes.status[p > 0] == 2)
    assert w @ np.linalg.norm(t, axis=1) == pytest.approx(MU * (w @ p), rel=1e-8)
    flat = method == "node-to-surface"
    assert scene.normal == pytest.approx(w @ p, rel=1e-12 if flat else 0.02)
    size = np.linalg.norm(scene.tangential)
    assert size == pytest.approx(MU * scene.normal, rel=(1e-8 if exact else 1e-3) if flat else 0.1)
    return size


@covering(cell=CELLS, n_lower=(2, 5, 12), direction=[(1.0, 0.0), (0.6, 0.8)], method=METHODS[:1])
def test_many_facets_in_one_step(direction, n_lower, cell, method):
    """Facets of 1.5, 0.6 and 0.25 under a block whose nodes stand 0.33 apart."""
    scene = block(cell, n_lower)
    across = np.array(direction[: scene.gdim - 1]) if scene.gdim == 3 else np.array([1.0])
    # nu = 0 keeps hexahedra from moving across an axis
    exact = scene.gdim == 2 or (cell == CellType.hexahedron and direction[1] == 0)
    scene.step(*0 * across, -0.02)
    place = 0 * across
    crossed = []
    for length in (0.4, 0.6, -1.3, 0.5):
        place = place + length * across
        before = facets(scene)
        scene.step(*place, -0.02)
        crossed.append(np.mean([a != b for a, b in zip(before, facets(scene), strict=True)]))
        size = check_full_slide(scene, exact, method)
        cosine = -np.sign(length) * (scene.tangential @ across) / size
        assert cosine == pytest.approx(1, abs=1e-8 if exact else 1e-2)
    print(scene.iterations, "changed facet:", crossed)
    assert max(crossed) > (0.5 if n_lower == 2 else 0.9)
    assert max(scene.iterations) <= 10


@covering(cell=CELLS, method=METHODS)
def test_over_the_outer_edge(cell, method):
    """Nodes beyond the edge open; the others go on with friction times what they carry."""
    scene = block(cell, 4, width=2.0, shift=0.55)
    zero = (0.0,) * (scene.gdim - 2)
    open_nodes = []
    for x in (0.0, 0.3, 0.7, 1.0, 1.2):
        scene.step(x, *zero, -0.02)
        open_nodes.append(int((scene.contact.discrete.nodes.status == 0).sum()))
        if x > 0:
            check_full_slide(scene, cell != CellType.tetrahedron, method)
    print(scene.iterations, open_nodes)
    # A block that hangs over tilts and may lift one more
    assert open_nodes[:2] == [0, 0]
    if method == "node-to-surface":
        assert open_nodes[2] >= scene.gdim**2 // 4
    else:
        # Part of its facets still carries
        assert open_nodes[-1] >= scene.gdim**2 // 4
    assert np.all(np.diff(open_nodes) >= 0)
