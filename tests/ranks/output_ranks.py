# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_scripts.py: ParaView's files and pictures of several ranks against one."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from contactx._host.drawing import View, draw, gather
from dolfinx import fem, mesh

import plot
from meshes import Tag
from meshes.build import build_mesh
from plot.surface import deformed_surface
from ranks.agreeing import refused
from ranks.relaxed import MESHES
from scenes import Blocks

WORLD = MPI.COMM_WORLD
ROOT = WORLD.rank == 0
LABELS: dict[str, Any] = {"labels": ("x", "y"), "title": "A picture"}

Array = npt.NDArray[Any]


def functions(domain: mesh.Mesh) -> tuple[fem.Function, fem.Function]:
    """A displacement and a scalar."""
    dim = domain.geometry.dim
    u = fem.Function(fem.functionspace(domain, ("P", 1, (dim,))), name="u")
    u.interpolate(lambda x: 0.1 * np.cos(x[:dim]))
    p = fem.Function(fem.functionspace(domain, ("P", 1)), name="p")
    p.interpolate(lambda x: np.sin(x[0]) ** 2 + x[1])
    return u, p


def strain(u: fem.Function) -> ufl.core.expr.Expr:
    """An expression that has no values at nodes."""
    return ufl.sqrt(1 + ufl.inner(ufl.grad(u), ufl.grad(u)))


def table(*columns: Array) -> Array:
    """Different points with their values, in an order of their own."""
    rows: Array = np.unique(np.column_stack(columns).round(10) + 0.0, axis=0)
    return rows


def surface_tables(surface: Any) -> tuple[Array, Array]:
    """Points with values, and the middles of faces."""
    data = surface.point_data
    points = table(surface.points, data["reference"], data["scalar"])
    return points, table(surface.cell_centers().points)


def check_file(path: Path, u: fem.Function, p: fem.Function) -> None:
    """Check that a file has the cells and values of functions of one rank."""
    import pyvista

    reader = pyvista.get_reader(str(path))
    assert reader.time_values == [0.0, 1.0]
    read = reader.read()[0]
    domain = u.function_space.mesh
    dim = domain.topology.dim
    assert read.n_cells == domain.topology.index_map(dim).size_local
    x = p.function_space.tabulate_dof_coordinates()
    projected = cx.Projection(strain(u), p.function_space).function
    here = table(x, u.x.array.reshape(-1, dim), p.x.array, projected.x.array)
    data = read.point_data
    there = table(read.points, data["u"][:, :dim], data["p"], data["strain"])
    assert np.allclose(there, here, rtol=0, atol=1e-9)


def files_and_surfaces(folder: Path) -> None:
    """Cells, points and values are those of one rank."""
    for name, make in MESHES.items():
        u, p = functions(make(WORLD))
        path = folder / "new" / f"{name.replace(' ', '_')}.pvd"
        with cx.VTKOutput(path, u, [], fields={"p": p, "strain": strain(u)}) as output:
            output.write(0.0)
            output.write(1.0)
        surface = deformed_surface(u, p, 2.0)
        assert (surface is not None) == ROOT
        WORLD.Barrier()
        if ROOT:
            alone = functions(make(MPI.COMM_SELF))
            check_file(path, *alone)
            tables = (surface_tables(s) for s in (surface, deformed_surface(*alone, 2.0)))
            for several, one in zip(*tables, strict=True):
                assert np.allclose(several, one, rtol=0, atol=1e-9)
            print(f"{name}: files and surface", flush=True)


def reactions() -> None:
    """Supports are in balance with contact, and a surface has what its conditions exert."""
    for cell in (mesh.CellType.triangle, mesh.CellType.hexahedron):
        scene = Blocks(cell)
        gdim = len(scene.u)
        contact = scene.contact(master=cx.Plane([0.0] * gdim, np.eye(gdim)[-1]), friction=0.3)
        problem = scene.problem(contact)
        problem.solve()
        supports = problem.reaction()
        assert np.allclose(supports.force, -contact.force, rtol=0, atol=1e-9) and any(contact.force)
        top = problem.reaction(cx.Surface(scene.tags, Tag.UPPER_TOP))
        parts = [problem.reaction(bc).force for bc in scene.bcs[gdim:]]
        assert np.allclose(top.force, sum(parts), rtol=0, atol=1e-9)
        assert np.allclose(top.moment([0.0] * gdim), supports.moment([0.0] * gdim), atol=1e-9)
    if ROOT:
        print("reactions balance", flush=True)


def contact_pictures(folder: Path) -> None:
    """Rank 0 draws all bodies and pressures, and what it lacks is said on all."""
    for cell in (mesh.CellType.quadrilateral, mesh.CellType.tetrahedron):
        scene = Blocks(cell)
        contact = scene.contact()
        problem = scene.problem(contact)
        problem.solve()
        domain = scene.u.function_space.mesh
        volume = fem.form(ufl.det(ufl.Identity(len(scene.u)) + ufl.grad(scene.u)) * ufl.dx(domain))
        exact = WORLD.allreduce(fem.assemble_scalar(volume))
        largest = WORLD.allreduce(contact.pressure.x.array.max(), MPI.MAX)
        closed = WORLD.allreduce(int((contact.multiplier > 0).sum()))
        shown = gather([contact], 1.0)
        assert (shown is not None) == ROOT
        if shown is not None:
            bodies = draw(shown, View([shown]), shown.limits).meshes[0]
            assert np.isclose(bodies.area if len(scene.u) == 2 else bodies.volume, exact, rtol=1e-6)
            assert shown.limits[1] == largest > 0 and (shown.pressure > 0).sum() == closed
        with cx.animate(folder / "run.gif", problem) as film:
            film.write(0.0)
        problem.plot(folder / "run.png")
        WORLD.Barrier()
        assert all((folder / name).stat().st_size > 3000 for name in ("run.gif", "run.png"))
    modules = dict(sys.modules)
    if ROOT:
        sys.modules["pyvista"] = None  # type: ignore[assignment]
    refused(ImportError, "pictures need pyvista", lambda: contact.plot(folder / "none.png"))
    sys.modules.update(modules)
    if ROOT:
        print("pictures of contact", flush=True)


def patch(rank: int) -> tuple[Array, Array]:
    """Places and triangles of a part of a face; the last rank has nothing."""
    x, y = np.meshgrid(np.arange(3.0) + 2 * rank, [0.0, 1.0])
    places = np.stack([x.ravel(), y.ravel()], axis=1)
    triangles = np.array([[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4]])
    return (places[:0], triangles[:0]) if rank == WORLD.size - 1 else (places, triangles)


def parts(folder: Path) -> None:
    """Parts of all ranks make the picture of the whole."""
    every = [patch(rank) for rank in range(WORLD.size)]
    places, triangles = every[WORLD.rank]
    whole = np.concatenate([p for p, _ in every])
    joined = np.concatenate([t + 6 * rank for rank, (_, t) in enumerate(every)])

    def draw(name: str, x: Array, corners: Array, **options: Any) -> None:
        options |= LABELS
        plot.curves({"p": (x[:, 0], x[:, 1])}, {}, folder / f"{name} c.png", **options)
        plot.pressure_curve(*x.T, [0, 1], [0, 1], folder / f"{name} p.png", **options)
        values = x[:, 0] ** 2 + x[:, 1]
        plot.nodal_map(x, values, folder / f"{name} m.png", triangles=corners, **options)
        kinds = (x[:, 0] > 2).astype(int)
        plot.nodal_map(x, kinds, folder / f"{name} k.png", kinds=plot.STATUS_NAMES, **options)

    draw("parts", places, triangles, comm=WORLD)
    if ROOT:
        from matplotlib import image

        draw("whole", whole, joined)
        for kind in "cpmk":
            images = [image.imread(folder / f"{name} {kind}.png") for name in ("parts", "whole")]
            assert np.array_equal(*images), kind
        print("parts make the whole", flush=True)


def picture_and_errors(folder: Path) -> None:
    """A picture is drawn once, and what goes wrong on rank 0 is raised on all."""
    u, p = functions(MESHES["one block"](WORLD))
    plot.deformed_bodies(u, p, folder / "bodies.png", title="Bodies")
    assert (folder / "bodies.png").stat().st_size > 20_000
    modules = dict(sys.modules)
    if ROOT:
        sys.modules["matplotlib.colors"] = None  # type: ignore[assignment]
    there = folder / "none" / "x.png"
    needs = "needs matplotlib"
    refused(ImportError, needs, lambda: plot.deformed_bodies(u, p, there, title=""))
    sys.modules.update(modules)
    refused(
        FileNotFoundError, "", lambda: plot.curves({"p": (1, 1)}, {}, there, comm=WORLD, **LABELS)
    )
    (folder / "file").touch()
    refused(FileExistsError, "", lambda: cx.VTKOutput(folder / "file" / "a.pvd", u, []))

    def recipe(gmsh: Any) -> None:
        raise ArithmeticError("no such shape")

    refused(ArithmeticError, "no such shape", lambda: build_mesh("test", 2, recipe, WORLD))


if __name__ == "__main__":
    place = Path(sys.argv[1])
    files_and_surfaces(place)
    parts(place)
    reactions()
    contact_pictures(place)
    picture_and_errors(place)
