# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Files for ParaView."""

from pathlib import Path
from xml.etree import ElementTree as ET

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
    # All contacts in one
    assert data["pressure"].max() == data["pressure" + suffix].max()
    assert set(data["status"]) == ({-1, 0, 2} if contacts == 2 else {-1, 2})
    assert np.nanmax(data["gap"]) >= np.nanmin(data["gap" + suffix])
    assert np.isfinite(data["gap"]).sum() >= np.isfinite(data["gap" + suffix]).sum()


def test_names_of_contacts_are_those_of_their_fields_and_columns(tmp_path: Path):
    scene = Blocks(CellType.quadrilateral)
    surfaces = cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0), (-1, 0))
    contacts = [scene.contact(name="seat"), cx.Contact(*surfaces)]
    problem = scene.problem(*contacts)
    assert repr(contacts[0]) == "seat" and "Surface" in repr(contacts[1])
    drag = {"force_over_area": lambda: contacts[0].force[1] / contacts[0].area.sum()}
    with (
        cx.VTKOutput(tmp_path / "blocks.pvd", scene.u, contacts) as output,
        cx.CSVOutput(tmp_path / "totals.csv", contacts, columns=drag) as totals,
    ):
        problem.solve()
        output.write(1.0)
        totals.write(1.0)
    data = pyvista.get_reader(str(tmp_path / "blocks.pvd")).read()[0].point_data
    assert {"pressure_seat", "pressure_1", "pressure"} <= set(data.keys())
    header, last = (line.split(",") for line in (tmp_path / "totals.csv").read_text().splitlines())
    row = dict(zip(header, map(float, last), strict=True))
    assert row["force_over_area"] == drag["force_over_area"]() != 0
    assert row["force_y_seat"] == contacts[0].force[1]


@pytest.mark.parametrize(
    "columns, kind, text",
    [
        ({"drag": 1.0}, TypeError, r"columns\['drag'\] is .*: give a function"),
        ({"area_0": lambda: 0.0}, ValueError, "columns has 'area_0'"),
    ],
)
def test_columns_that_are_refused(tmp_path: Path, columns, kind, text):
    scene = Blocks(CellType.quadrilateral)
    surfaces = cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0), (-1, 0))
    contacts = [scene.contact(), cx.Contact(*surfaces)]
    scene.problem(*contacts)
    with pytest.raises(kind, match=text):
        cx.CSVOutput(tmp_path / "totals.csv", contacts, columns=columns)


@pytest.mark.parametrize(
    "column, text",
    [
        (lambda: np.zeros(3), r"columns\['drag'\] returns an array of shape \(3,\)"),
        (lambda: np.zeros(0).max(), "zero-size array"),
    ],
)
def test_a_column_that_fails_leaves_no_line(tmp_path: Path, column, text):
    scene = Blocks(CellType.quadrilateral)
    contact = scene.contact()
    scene.problem(contact)
    totals = cx.CSVOutput(tmp_path / "totals.csv", [contact], columns={"drag": column})
    with pytest.raises((TypeError, ValueError), match=text):
        totals.write(1.0)
    assert len((tmp_path / "totals.csv").read_text().splitlines()) == 1


def test_names_that_are_refused(tmp_path: Path):
    scene = Blocks(CellType.quadrilateral)
    surfaces = cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0), (-1, 0))
    for name, kind in ((1, TypeError), ("", ValueError), ("a seat", ValueError)):
        with pytest.raises(kind, match=r"name is .*letters, digits"):
            cx.Contact(*surfaces, name=name)
    contacts = [scene.contact(name="seat"), cx.Contact(*surfaces, name="seat")]
    scene.problem(*contacts)
    with pytest.raises(ValueError, match="several with the name 'seat'"):
        cx.CSVOutput(tmp_path / "totals.csv", contacts)
    with pytest.raises(ValueError, match="fields has the name 'gap_seat'"):
        fields = {"gap_seat": fem.Constant(scene.u.function_space.mesh, 1.0)}
        cx.VTKOutput(tmp_path / "run.pvd", scene.u, contacts[:1], fields=fields)


def test_a_program_that_goes_to_another_folder(tmp_path: Path, monkeypatch):
    """DOLFINx writes once more when its file is destroyed."""
    scene = Blocks(CellType.quadrilateral)
    folders = [tmp_path / name for name in ("here", "there")]
    for folder in folders:
        folder.mkdir()
    contact = scene.contact()
    scene.problem(contact)
    monkeypatch.chdir(folders[0])
    output = cx.VTKOutput("blocks.pvd", scene.u, [contact])
    output.write(0.0)
    monkeypatch.chdir(folders[1])
    output.close()
    del output
    assert (folders[0] / "blocks.pvd").exists()
    assert not any(folders[1].iterdir())


@pytest.mark.parametrize("suffix", [".xdmf", ".bp"])
def test_other_formats(tmp_path: Path, suffix):
    scene = Blocks(CellType.tetrahedron)
    contact = scene.contact()
    problem = scene.problem(contact)
    with cx.VTKOutput(tmp_path / f"blocks{suffix}", scene.u, [contact]) as output:
        output.write(0.0)
        problem.solve()
        output.write(1.0)
    if suffix == ".bp":
        adios2 = {kind: tmp_path / f"blocks_{kind}.bp" for kind in ("scalars", "vectors")}
        assert all(sum(f.stat().st_size for f in p.iterdir()) > 1000 for p in adios2.values())
        return
    root = ET.parse(tmp_path / "blocks.xdmf").getroot()
    names = [a.get("Name") for a in root.iter("Attribute")]
    assert {"gap", "pressure", "status", "traction"} < set(names)
    assert names.count("pressure") == 2
    assert {float(t.get("Value")) for t in root.iter("Time")} == {0.0, 1.0}
    n = scene.u.function_space.dofmap.index_map.size_global
    assert (tmp_path / "blocks.h5").stat().st_size > 2 * 8 * 9 * n


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_totals(tmp_path: Path, friction):
    scene = Blocks(CellType.hexahedron)
    contacts = [
        scene.contact(friction=friction),
        cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0, 0), (-1, 0, 0))),
    ]
    problem = scene.problem(*contacts)
    path = tmp_path / "new" / "totals.csv"
    with cx.CSVOutput(path, contacts) as totals:
        totals.write(0.0)
        problem.solve()
        totals.write(1.0)
    header, first, last = (line.split(",") for line in path.read_text().splitlines())
    assert header[:5] == ["t", "force_x_0", "force_y_0", "force_z_0", "closed_0"]
    assert len(header) == 1 + 2 * 9
    assert float(first[3]) == 0
    row = dict(zip(header, map(float, last), strict=True))
    nodes = contacts[0].discrete.nodes
    assert row["t"] == 1
    assert [row[f"force_{axis}_0"] for axis in "xyz"] == contacts[0].force.tolist()
    assert row["closed_0"] == nodes.closed.sum() > 0
    assert row["slipping_0"] == (nodes.status == 2).sum()
    assert row["area_0"] == pytest.approx(nodes.area[nodes.closed].sum())
    assert row["largest_pressure_0"] == contacts[0].pressure.x.array.max()
    assert row["smallest_gap_0"] == pytest.approx(0, abs=1e-12)
    history = contacts[0].discrete.history
    dissipation = 0 if history is None else history.dissipation.sum()
    assert row["dissipation_0"] == pytest.approx(dissipation, rel=1e-12)
    assert 7 < row["smallest_gap_1"] < 9
    assert row["closed_1"] == 0


def test_totals_that_are_refused(tmp_path: Path):
    scene = Blocks(CellType.triangle)
    contact = scene.contact()
    scene.problem(contact)
    with pytest.raises(ValueError, match=r"path ends in '.txt': totals are written to .csv"):
        cx.CSVOutput(tmp_path / "totals.txt", [contact])
    with pytest.raises(TypeError, match=r"must be a list of contactx\.Contact, not Contact"):
        cx.CSVOutput(tmp_path / "totals.csv", contact)
    with pytest.raises(TypeError, match="contacts holds a int"):
        cx.CSVOutput(tmp_path / "totals.csv", [1])
    with pytest.raises(ValueError, match="contacts is empty"):
        cx.CSVOutput(tmp_path / "totals.csv", [])
    with pytest.raises(TypeError, match="t is str 'x': give a number"):
        cx.CSVOutput(tmp_path / "totals.csv", [contact]).write("x")
