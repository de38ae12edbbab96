# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files for ParaView."""

from pathlib import Path

import numpy as np
import pytest
import pyvista

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks

pytestmark = pytest.mark.usefixtures("method")


@pytest.mark.parametrize("contacts", [1, 2])
def test_paraview_output(tmp_path: Path, contacts):
    scene = Blocks(CellType.hexahedron)
    scene.u.name = "displacement"
    all_contacts = [
        scene.contact(),
        cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0, 0), (-1, 0, 0))),
    ][:contacts]
    problem = scene.problem(*all_contacts)
    path = tmp_path / "new" / "blocks.pvd"
    height = fem.Function(all_contacts[0].pressure.function_space, name="height")
    height.interpolate(lambda x: x[2])
    with cx.VTKOutput(path, scene.u, all_contacts, fields=[height]) as output:
        output.write(0.0)
        problem.solve()
        output.write(1.0)
    reader = pyvista.get_reader(str(path))
    assert reader.time_values == [0.0, 1.0]
    reader.set_active_time_value(1.0)
    data = reader.read()[0].point_data
    assert data["height"].max() == pytest.approx(height.x.array.max())
    suffix = "_0" if contacts == 2 else ""
    assert data["displacement"].shape[1] == 3
    assert data["pressure" + suffix].max() == pytest.approx(all_contacts[0].pressure.x.array.max())
    assert np.nanmin(data["gap" + suffix]) == pytest.approx(0, abs=1e-12)
    assert set(data["status" + suffix]) <= {-1, 0, 2}
