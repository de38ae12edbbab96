# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A node that touches first within a step slips only from where it touches."""

import numpy as np
import pytest

import contactx as cx
from contactx import cpp as core

from scenes import CELLS, dimension
from scenes.covering import BOTH, covering
from scenes.driven import DrivenBlock

pytestmark = pytest.mark.usefixtures("method")


@covering(cell=CELLS, base=("plane", "elastic"), steps=(1, 2), **{"sliding,method": BOTH})
def test_sticks_where_it_touches(steps, cell, base, sliding, method):
    """Half way down: of 0.2 the gap takes 0.1; the straight way is half way aside there."""
    gdim = dimension(cell)
    scene = DrivenBlock(
        cell,
        plane=cx.Plane((0.0,) * gdim, np.eye(gdim)[-1]) if base == "plane" else None,
        friction=20.0,
        sliding=sliding,
        gap=0.1,
        width=4.0,
        n_upper=2,
        n_lower=7,
    )
    across = (0.0,) * (gdim - 2)
    if steps == 2:
        # An end of a step in the air changes nothing
        scene.step(0.3, *across, -0.06)
        assert scene.contact.force == pytest.approx(np.zeros(gdim))
    scene.step(1.0, *across, -0.2)
    interface = scene.contact.interface
    V = scene.u.function_space
    X = V.tabulate_dof_coordinates()[:, :gdim]
    u = scene.u.x.array.reshape(-1, gdim)
    if base == "plane":
        aside = u[interface.slaves, 0]
    elif method == "surface-to-surface":
        # The place on the base that it came to, in the mean
        weights, n = interface.master.weights(), len(interface.slaves)
        moved = X[:, 0] if sliding == "finite" else -u[:, 0]
        aside = -np.bincount(weights.slaves, weights.values * moved[weights.nodes], n)
    else:
        aside = np.full(len(interface.slaves), np.nan)
        at = core.pair_layout["xi"]
        for pairs in interface.master.pairs():
            xi = np.ascontiguousarray(pairs.data[:, at : at + 2])
            N = core.shape_functions(pairs.nodes.shape[1] - 1, xi)
            masters = pairs.nodes[:, 1:]
            if sliding == "finite":
                # The place on the base that it came to, in the reference
                foot = np.einsum("il,ilk->ik", N, X[masters])
                aside[pairs.slaves[:, 0]] = (foot - X[pairs.nodes[:, 0]])[:, 0]
            else:
                moved = np.einsum("il,ilk->ik", N, u[masters])
                aside[pairs.slaves[:, 0]] = (u[pairs.nodes[:, 0]] - moved)[:, 0]
    stick = interface.nodes.status == 1
    print(scene.iterations, interface.nodes.status, aside)
    assert stick.sum() >= len(stick) / 2
    # Where facets bend, the mean of places is not the place of the mean
    bends = (method, base, sliding) == ("surface-to-surface", "elastic", "finite")
    assert aside[stick] == pytest.approx(0.5, abs=0.05 if bends else 1e-8)
    assert np.abs(interface.history.slip[stick]).max() < 1e-9
