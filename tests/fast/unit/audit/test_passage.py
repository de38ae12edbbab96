# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tips of two cantilevers, one above the other, that bend past each other in one step."""

from mpi4py import MPI

import numpy as np
import pytest

import basix.ufl
import contactx as cx
from contactx import cpp as core
from contactx.audit.passage import NONE, passages
from contactx.parallel.halo import Halo
from dolfinx import fem, mesh

from scenes.numbered_blocks import SHAPES, grid

LENGTH, THICKNESS, GAP, OVERLAP = 10.0, 0.2, 0.05, 1.4


class Tips:
    """A cantilever that is fixed at the left, and one above its tip that is fixed at the right.

    Attributes:
        halo: Their nodes.
        below, above: Surfaces of the lower one's top and the upper one's bottom.
    """

    def __init__(self, dim):
        wide, narrow, edge = [1.0] * (dim - 2), [0.8] * (dim - 2), [0.1] * (dim - 2)
        counts = 25, *[2] * (dim - 2), 2
        low, cells = grid(counts, np.zeros(dim), np.array([LENGTH, *wide, THICKNESS]))
        corner = np.array([LENGTH - OVERLAP, *edge, THICKNESS + GAP])
        high, more = grid(counts, corner, np.array([LENGTH, *narrow, THICKNESS]))
        points, cells = np.concatenate([low, high]), np.concatenate([cells, more + len(low)])
        element = basix.ufl.element("Lagrange", SHAPES[dim], 1, shape=(dim,))
        domain = mesh.create_mesh(MPI.COMM_SELF, cells, element, points)
        V = fem.functionspace(domain, ("Lagrange", 1, (dim,)))
        self.dim = dim
        self.halo = Halo(fem.Function(V), V.tabulate_dof_coordinates()[:, :dim])
        heights = THICKNESS, THICKNESS + GAP
        self.below, self.above = (self._facets(V, height) for height in heights)

    def _facets(self, V, height):
        domain, dim = V.mesh, self.dim
        domain.topology.create_connectivity(dim - 1, dim)
        found = mesh.locate_entities_boundary(
            domain, dim - 1, lambda x: np.isclose(x[dim - 1], height)
        )
        tags = mesh.meshtags(domain, dim - 1, found, np.ones_like(found))
        return cx.Surface(tags, 1).facet_nodes(V)

    def bent(self, lower, upper):
        """Positions with both bent down at their tips, their sections turned."""
        x = self.halo.x.copy()
        above = x[:, -1] > THICKNESS + GAP / 2
        for which, deflection, at, way in (
            (~above, lower, 0.0, 1.0),
            (above, upper, 2 * LENGTH - OVERLAP, -1.0),
        ):
            s = way * (x[which, 0] - at) / LENGTH
            middle = THICKNESS / 2 + (THICKNESS + GAP) * (way < 0)
            w, angle = deflection * s**2, way * 2 * deflection * s / LENGTH
            up = x[which, -1] - middle
            x[which, 0] += np.sin(angle) * up - way * 2 / 3 * deflection**2 * s**3 / LENGTH
            x[which, -1] = middle - w + np.cos(angle) * up
        return x

    def both(self, x1):
        """What passes of the nodes of either, and how many there are."""
        found = []
        for own, other in ((self.above, self.below), (self.below, self.above)):
            nodes = np.unique(own.nodes)
            tolerance = np.full(len(nodes), 0.1 * THICKNESS)
            found.append(passages(self.halo, own, other, self.halo.x, x1, nodes, tolerance))
        return found


@pytest.mark.parametrize("dim", [2, 3])
def test_tips_that_pass_each_other(dim):
    tips = Tips(dim)
    # Eleven thicknesses; of the nodes 0.4 apart four a row are over the other tip
    x1 = tips.bent(-3.5 * THICKNESS, 7.5 * THICKNESS)
    above, below = tips.both(x1)
    # The lower one is wider: in space its outer rows are not under the other
    assert above.count == 4 * 3 ** (dim - 2)
    assert below.count == 4
    for found, own in ((above, tips.above), (below, tips.below)):
        node = np.flatnonzero(tips.halo.original == found.node)
        assert np.isin(node, own.nodes).all()
        np.testing.assert_array_equal(found.position, x1[node[0]])


@pytest.mark.parametrize("dim", [2, 3])
def test_tips_that_stay_apart(dim):
    tips = Tips(dim)
    for lower, upper in ((0, 0), (3.5, 2.6), (7.5, -3.5), (0.2, 0.4)):
        assert tips.both(tips.bent(lower * THICKNESS, upper * THICKNESS)) == [NONE, NONE]


def test_all_turned_around():
    tips = Tips(2)
    x1 = tips.bent(-3.5 * THICKNESS, 7.5 * THICKNESS)
    expected = [found.count for found in tips.both(x1)]
    for angle in np.radians([10, 60, 120, 180]):
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s], [s, c]])
        assert [found.count for found in tips.both(x1 @ turn.T + 7)] == expected
        assert tips.both(tips.halo.x @ turn.T + 7) == [NONE, NONE]


def test_nothing_is_looked_at_without_candidates(monkeypatch):
    tips = Tips(2)
    x1 = tips.bent(-3.5 * THICKNESS, 7.5 * THICKNESS)
    monkeypatch.setattr(core, "crossings", None)
    none, far = np.zeros(0, dtype=np.int32), np.flatnonzero(tips.halo.x[:, 0] > LENGTH + 1)
    for nodes in (none, far):
        arguments = nodes, np.full(len(nodes), 0.01)
        found = passages(tips.halo, tips.above, tips.below, tips.halo.x, x1, *arguments)
        assert found == NONE


def test_arguments_of_the_core():
    x, facet = (
        np.zeros((2, 2)),
        (np.array([0, 2], dtype=np.int32), np.array([0, 1], dtype=np.int32)),
    )
    origin, one = np.zeros(2), np.zeros((1, 2))
    good = (*facet, x, x, 2, np.zeros(18), origin, origin, one, one, one, one, np.ones(1))
    node = np.zeros(1, dtype=np.int32)
    assert len(core.crossings(*good, node)) == 0
    for place, name, bad in (
        (2, "x0 must hold", x[:1]),
        (3, "x1 must hold", x[:1]),
        (5, "moments must have 18", np.zeros(17)),
        (6, "origin0 must have 2", np.zeros(3)),
        (8, "points0 must have 2", x),
        (9, "points1 must have 2", x),
        (10, "normals0 must have 2", x),
        (11, "normals1 must have 2", x),
    ):
        with pytest.raises(ValueError, match=name):
            core.crossings(*good[:place], bad, *good[place + 1 :], node)
    with pytest.raises(ValueError, match="node must have 1"):
        core.crossings(*good, np.zeros(2, dtype=np.int32))
    with pytest.raises(ValueError, match="origin1 must have 2"):
        core.moments(*good[:5], origin, np.zeros(1))
    crossing = np.zeros(1, dtype=core.crossings(*good, node).dtype)
    assert core.passed(crossing, np.ones(1)).tolist() == [-1]
    with pytest.raises(ValueError, match="crossings must be of points"):
        core.passed(crossing, np.zeros(0))
    with pytest.raises(ValueError, match="vector must have 4 values"):
        core.unit_normals(np.zeros(3), np.ones(2), 2)
