# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An upper block that only its contact with the lower one supports, without a search."""

import numpy as np

import contactx as cx
from contactx import cpp as core
from contactx._host.bulk_host import BulkHost
from dolfinx import mesh


class FreeBlock:
    """The bottom of the upper block is slave on the top of the lower one, with gaps as given.

    Attributes:
        scene: The blocks, with all nodes on all ranks.
        nodes: State of the slave nodes, with a gap that grows with x.
        free_bodies: What keeps the upper block's Newton step solvable.
    """

    def __init__(self, scene, *, friction=0.0, slope=0.01, gap=0.05):
        self.scene = scene
        halo, dim, domain = scene.halo, scene.dim, scene.domain
        found = [
            mesh.locate_entities_boundary(domain, dim - 1, lambda x, h=h: np.isclose(x[dim - 1], h))
            for h in (0.1, 0)
        ]
        facets = np.concatenate(found).astype(np.int32)
        values = np.repeat(np.array([1, 2], dtype=np.int32), [len(f) for f in found])
        order = facets.argsort()
        tags = mesh.meshtags(domain, dim - 1, facets[order], values[order])
        contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2), friction=friction)
        discrete = contact.attach(halo, scene.bulk.markers, scene.bodies)
        # The nodes are views of the arrays of their contact
        self.discrete, self.nodes, self.slaves = discrete, discrete.nodes, discrete.slaves
        assert discrete.master.paired.all()
        if friction:
            discrete.law.set_friction(np.full(len(self.slaves), friction))
        self.nodes.area[:] = 0.1
        self.nodes.gap[:] = gap + slope * halo.x[self.slaves, 0]
        if friction:
            self.nodes.normal[:] = discrete.master.normals()[:, :dim]
        scene.see_all()
        self.free_bodies = core.FreeBodies(
            scene.bodies,
            BulkHost(scene.bulk, halo),
            [discrete],
            halo.original[: halo.num_owned],
        )

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
            core.Forces(lambda: -force.ravel(), lambda: -force.ravel(), lambda: 1.0)
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
