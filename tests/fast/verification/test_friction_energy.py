# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Work of the supports is energy stored, work of friction and work of what opens or closes."""

import numpy as np
import pytest

import contactx as cx
from contactx import cpp as core

from scenes import CELLS, dimension
from scenes.coulomb import parts
from scenes.covering import METHODS, covering
from scenes.driven import DrivenBlock

pytestmark = pytest.mark.usefixtures("method")


class Balance:
    """State of a scene with small sliding at the end of a step, to set against the one before."""

    def __init__(self, scene):
        contact = scene.contact
        self.u = scene.u.x.array.copy()
        self.f = scene.reactions
        self.p, self.t = parts(contact)
        self.closed = contact.discrete.nodes.closed.copy()
        self.dissipation = contact.discrete.history.dissipation.copy()
        self.total = contact.discrete.history.total.copy()

    @property
    def energy(self):
        """Of a linear bulk."""
        return 0.5 * self.f @ self.u


def relative(scene, du):
    """Movement of the slave nodes relative to their masters, shape (n, gdim)."""
    discrete = scene.contact.discrete
    du = du.reshape(-1, scene.gdim)
    way = du[discrete.slaves].copy()
    if isinstance(discrete.master, core.SurfaceToSurface):
        weights = discrete.master.weights()
        way[:] = 0
        np.add.at(way, weights.slaves, weights.values[:, None] * du[weights.nodes])
        return way
    for pairs in discrete.master.pairs():
        if pairs.nodes.shape[1] == 1:
            continue
        at = core.pair_layout["xi"]
        xi = np.ascontiguousarray(pairs.data[:, at : at + 2])
        N = core.shape_functions(pairs.nodes.shape[1] - 1, xi)
        way[pairs.slaves[:, 0]] -= np.einsum("il,ilk->ik", N, du[pairs.nodes[:, 1:]])
    return way


@covering(cell=CELLS, base=("plane", "elastic"), friction=(0.3, 0.9), method=METHODS)
def test_balance_of_each_step(friction, cell, base):
    gdim = dimension(cell)
    up = np.eye(gdim)[-1]
    scene = DrivenBlock(
        cell,
        plane=cx.Plane((0.0,) * gdim, up) if base == "plane" else None,
        friction=friction,
        sliding="small",
    )
    driven = np.concatenate([d.bc.dof_indices()[0] for d in (scene.top, scene.bottom) if d])
    across = (0.0,) * (gdim - 2)
    area = scene.contact.area
    scene.step(0.0, *across, -0.02)
    old = Balance(scene)
    defects, kept = [], []
    for x, down in [
        (0.005, -0.02),
        (0.08, -0.02),
        (0.2, -0.03),
        (0.195, -0.03),
        (0.19, -0.02),
        (0.1, -0.02),
        (0.1, -0.01),
        (-0.1, -0.02),
        (0.0, -0.02),
    ]:
        scene.step(x, *across, down)
        new = Balance(scene)
        du = new.u - old.u
        way = relative(scene, du)
        dg = way @ up
        slip = scene.contact.discrete.history.slip
        assert np.abs(slip @ up).max() < 1e-14
        # A node that has opened or closed has gone a part of its way in contact only
        stays = old.closed & new.closed
        kept.append(np.array_equal(old.closed, new.closed))
        assert slip[stays] == pytest.approx((way - np.outer(dg, up))[stays], abs=1e-13)
        ds = np.where(stays[:, None], slip, way - np.outer(dg, up))
        friction_work = area @ np.einsum("ij,ij->i", old.t + new.t, ds) / 2
        normal_work = area @ ((old.p + new.p) * dg) / 2
        if kept[-1]:
            assert abs(normal_work) < 1e-14
        work = (old.f + new.f)[driven] @ du[driven] / 2
        defects.append(work - (new.energy - old.energy - friction_work - normal_work))
        # What friction takes in the step, with the traction at its end
        lost = -np.einsum("ij,ij->i", new.t, slip)
        assert lost.min() >= -1e-14
        assert new.dissipation - old.dissipation == pytest.approx(area * lost, abs=1e-15)
        length = np.linalg.norm(slip, axis=1)
        assert new.total - old.total == pytest.approx(length, abs=1e-14)
        old = new
    cycle = old.dissipation.sum()
    print(
        scene.iterations, f"{sum(kept)} of {len(kept)} steps kept their nodes in contact,", end=""
    )
    print(f" off by {np.abs(defects).max() / cycle:.1e} of {cycle:.3g}")
    assert any(kept)
    assert np.abs(defects).max() <= 1e-6 * cycle
    # The fields are those of the history
    nodes = scene.contact.slave_nodes
    field = scene.contact.slip.x.array.reshape(-1, gdim)[nodes]
    np.testing.assert_array_equal(field, scene.contact.discrete.history.slip)
    assert scene.contact.slip_total.x.array.sum() == pytest.approx(old.total.sum(), rel=1e-12)
