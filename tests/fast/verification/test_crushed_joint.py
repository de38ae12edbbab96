# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pressures at the edge of a joint that is crushed there, on few rows of nodes."""

from dataclasses import replace

import numpy as np
import pytest

from meshes import FACE_SLABS
from slab_scene import Setting
from slab_schemes import scheme_1

# Of the slabs beside it on 40 layers, MPa
STRESS = 18.15


@pytest.mark.parametrize(("method", "rows"), [("node-to-surface", 3), ("surface-to-surface", 4)])
def test_pressure_at_the_edge_of_a_joint(method, rows):
    """Three or four rows of nodes are closed, and averages of them are a third too low."""
    setting = Setting(replace(FACE_SLABS["slice"], layers=10), method=method)
    scene = scheme_1(setting, 0.0909, 0.3, steps=1, progress=False)
    joint = scene.joints[0]
    raw, area = joint.discrete.nodes.pressure, joint.discrete.nodes.area
    p = joint.pressure.x.array[joint.slave_nodes]
    assert np.sum(joint.discrete.nodes.closed) == 2 * rows
    assert p.max() == pytest.approx(STRESS, rel=0.05)
    assert p.max() > raw.max()
    assert area @ p == pytest.approx(area @ raw, rel=1e-12)
    assert np.all(p[joint.discrete.nodes.closed] > 0)
