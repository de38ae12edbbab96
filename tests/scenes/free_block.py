# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An upper block that only its contact with the lower one supports, without a search."""

from types import SimpleNamespace

import numpy as np

from contactx import cpp as core
from contactx.bodies.free_bodies import FreeBodies


class FreeBlock:
    """Each node of the upper block's bottom is paired with the nearest one of the lower's top.

    Attributes:
        scene: The blocks, with all nodes on all ranks.
        nodes: State of the slave nodes, with a gap that grows with x.
        free_bodies: What keeps the upper block's Newton step solvable.
    """

    def __init__(self, scene, *, friction=0.0, slope=0.01, gap=0.05):
        self.scene = scene
        halo, dim = scene.halo, scene.dim
        x = scene.everywhere(halo.x[: halo.num_owned])
        upper = scene.everywhere(scene.bodies.number[: halo.num_owned])[:, 0] == 1
        height = x[:, -1]
        bottom = np.flatnonzero(upper & np.isclose(height, 0.1))
        top = np.flatnonzero(~upper & np.isclose(height, 0))
        nearest = top[np.linalg.norm(x[bottom, None] - x[top], axis=2).argmin(axis=1)]
        place = dict(zip(halo.original.tolist(), range(halo.num_nodes), strict=True))
        here = [(place[s], place[m]) for s, m in zip(bottom, nearest, strict=True)]
        here = [(s, m) for s, m in here if s < halo.num_owned]
        slaves, masters = np.array(here, dtype=np.int32).reshape(-1, 2).T
        n = len(slaves)
        law = core.Coulomb() if friction else core.Frictionless()
        if isinstance(law, core.Coulomb):
            law.set_friction(np.full(n, friction))
        self.nodes = core.NodeState(n, dim, law.is_vector)
        self.nodes.area[:] = 0.1
        self.nodes.gap[:] = gap + slope * halo.x[slaves, 0]
        up = np.zeros((n, 3))
        up[:, dim - 1] = 1
        self.nodes.normal[:] = up[: len(self.nodes.normal), :dim]
        self.slaves = slaves
        numbers = np.repeat(np.arange(n), 2)
        weights = SimpleNamespace(
            slaves=numbers,
            nodes=np.column_stack([slaves, masters]).ravel(),
            values=np.tile([1.0, -1], n),
        )
        master = SimpleNamespace(
            paired=np.ones(n, dtype=bool), weights=lambda: weights, normals=lambda: up
        )
        interface = SimpleNamespace(
            positions=halo.positions, nodes=self.nodes, master=master, law=law, sliding="finite"
        )
        self.free_bodies = FreeBodies(scene.bulk, [interface], scene.bodies)

    def slip(self, p=1.0, aside=0.02):
        """All nodes slip along x, by what grows with x, under a pressure."""
        nodes, x = self.nodes, self.scene.halo.x[self.slaves]
        nodes.status[:] = core.SLIP
        nodes.gap[:] = 0
        traction = nodes.multiplier.reshape(nodes.slip.shape)
        traction[:, -1], traction[:, 0] = p, -aside
        nodes.slip[:, 0] = 0.01 + 0.01 * x[:, 0]

    def stabilise(self, *load, growth=1.0):
        """Begin a step and stabilise the block under a load on its nodes that grows with x."""
        halo = self.scene.halo
        force = np.array(load) * (1 + growth * halo.x[: halo.num_owned, :1])
        force[self.scene.bodies.number[: halo.num_owned] == 0] = 0
        self.free_bodies.begin_step()
        changed = self.free_bodies.stabilise(
            lambda: -force.ravel(), lambda: -force.ravel(), lambda: 1.0
        )
        stiffness = self.free_bodies.springs
        status = np.full(halo.num_owned, -1)
        status[self.slaves] = self.nodes.status
        free = self.free_bodies
        counts = changed, free.free_modes, free.closed_for_balance, free.is_unbalanced
        none = np.zeros(halo.num_owned * halo.gdim)
        return (
            counts,
            self.scene.everywhere(status),
            self.scene.everywhere(none if stiffness is None else stiffness),
        )
