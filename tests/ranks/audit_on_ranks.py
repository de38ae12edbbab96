# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the audit finds of two blocks that are moved: on any ranks what one rank does."""

import numpy as np

import contactx as cx
import ufl
from contactx import cpp as core
from dolfinx import fem, mesh

from scenes.problems import make_problem


def surface(scene, height):
    """Facets of a block at a height."""
    dim, domain = scene.dim, scene.domain
    domain.topology.create_connectivity(dim - 1, dim)
    found = mesh.locate_entities_boundary(domain, dim - 1, lambda x: np.isclose(x[dim - 1], height))
    return cx.Surface(mesh.meshtags(domain, dim - 1, found, np.ones_like(found)), 1)


class Audited:
    """The bottom of the upper block on the top of the lower one, or on an obstacle."""

    def __init__(self, scene, obstacle=None, **options):
        V = scene.u.function_space
        self.u, v = fem.Function(V), ufl.TestFunction(V)
        self.X = V.tabulate_dof_coordinates()[:, : scene.dim]
        master = surface(scene, 0) if obstacle is None else obstacle
        contact = cx.Contact(surface(scene, 0.1), master, **options)
        F = ufl.inner(ufl.sym(ufl.grad(self.u)), ufl.grad(v)) * ufl.dx
        make_problem(F, self.u, [contact])
        self.halo = contact.discrete.halo
        self.contact, self.audit = contact, core.Audit(self.halo.nodes, [contact.discrete])

    def find(self, moved):
        """What is found once nodes have come to positions moved(X)."""
        self.u.x.array[:] = (moved(self.X) - self.X).ravel()
        self.halo.update_ghosts()
        (found,) = self.audit.find()
        every = [found.passed, found.inside]
        # What is in front of the slave matters to nobody
        deepest = max(found.deepest.excess if found.deepest else 0, 0)
        numbers = *((f.count, f.first) for f in every), found.is_too_deep
        assert len(set(self.halo.comm.allgather((*numbers, deepest)))) == 1
        return numbers, [deepest, found.facet_size, *(c for f in every for c in f.at)]

    def accept(self):
        """Take what was found last as the start of the next step."""
        self.audit.accept()


def check_audit(one, scene):
    """Blocks that are pushed into each other, and that bend, turn and slide."""
    dim, height = scene.dim, scene.dim - 1

    def same(both, moved):
        found, expected = (a.find(moved) for a in both)
        assert found[0] == expected[0]
        np.testing.assert_allclose(found[1], expected[1], rtol=1e-9, atol=1e-13)
        return expected[0]

    def down(by):
        def moved(x):
            upper = (x[:, height] > 0.05)[:, None]
            return x - np.where(upper, by(x[:, :1]), 0) * np.eye(dim)[height]

        return moved

    def audited(obstacle=None, **options):
        return Audited(scene, obstacle, **options), Audited(one, obstacle, **options)

    # The blocks are 0.1 apart: no node has a pair
    (passed, _), *_ = same(audited(search_distance=0.05), down(lambda x: 0.3 * (x > 0.6)))
    assert passed == 2 * 4 ** (dim - 2)
    small = audited(search_distance=0.05, sliding="small")
    _, (inside, _), _ = same(small, down(lambda x: 0.3 * (x > 0.6)))
    assert inside == 2 * 4 ** (dim - 2)
    ball = cx.Sphere([0.65] * (dim - 1) + [-0.35], 0.38)
    *_, is_too_deep = same(audited(ball), lambda x: x)
    assert not is_too_deep
    *_, is_too_deep = same(audited(ball), down(lambda x: 0.15 + 0 * x))
    assert is_too_deep
    (passed, _), *_ = same(audited(ball), down(lambda x: 1.2 + 0 * x))
    assert passed > 0
    rng = np.random.default_rng(1)
    looked = audited(search_distance=0.05)
    for run in range(6):
        wave, phase = rng.uniform(-0.3, 0.3, dim), rng.uniform(0, 6)
        way, angle = rng.uniform(-0.6, 0.6, dim), rng.uniform(0, 2)
        turn = np.eye(dim)
        c, s = np.cos(angle), np.sin(angle)
        turn[np.ix_([0, height], [0, height])] = [[c, -s], [s, c]]

        def waved(x, wave=wave, phase=phase, way=way, turn=turn):
            upper = (x[:, height] > 0.05)[:, None]
            return (x + np.sin(5 * x[:, :1] + phase) * wave + upper * way) @ turn.T

        same(looked, waved)
        if run % 2 == 1:
            for a in looked:
                a.accept()
