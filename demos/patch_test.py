# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The patch test: two blocks on each other must carry a uniform pressure exactly.

Two elastic blocks, E = 1, nu = 0.3, are pressed on each other through 1 % of their height, without
friction and with free sides; the whole scene is tilted. The exact stress is the same everywhere, a
pressure p = 0.01 across the interface. Linear elements contain this solution, whatever their size
and shape: what a method makes of it is its own error, and the same on any mesh. The upper block,
the slave, has one cell more along each edge than the lower one, and nodes are moved at random by up
to 0.15 cells, those of the faces within their planes.

Node-to-surface contact has no nodal forces on the master that are those of a uniform pressure:
pressures are some 10 % off, stresses beside the interface more, and a finer mesh does not help.
Surface-to-surface contact is exact to rounding.

    python demos/patch_test.py
    python demos/patch_test.py --h 0.1 --dim 2
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from rich.table import Table

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

import plot
import story
from patch_scene import Array, Patch, Shape

METHODS = ("node-to-surface", "surface-to-surface")
CELLS = {
    2: (CellType.triangle, CellType.quadrilateral),
    3: (CellType.tetrahedron, CellType.hexahedron),
}
TILT = np.radians(25.0)
CAMERA = (1.0, -0.8, 0.4)


def tilted(dim: int) -> Array:
    """Rotation of the scene, in 3D about two axes."""
    c, s = np.cos(TILT), np.sin(TILT)
    if dim == 2:
        return np.array([[c, -s], [s, c]])
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ np.array(
        [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    )


def compare(name: str, patch: Patch) -> list[story.Result]:
    """What is furthest from the exact stress and pressure."""
    return [
        story.Result(f"{name}: stress", 0.0, float(patch.stress_errors().max())),
        story.Result(f"{name}: pressure", 0.0, float(patch.pressure_errors().max())),
    ]


def show(results: dict[str, list[story.Result]]) -> None:
    """Print both methods side by side."""
    table = Table("largest deviation / p", "expected", title="Patch test: error of a uniform state")
    for method in METHODS:
        table.add_column(f"computed,\n{method}", justify="right")
    for rows in zip(*results.values(), strict=True):
        table.add_row(rows[0].name, "0", *(f"{row.computed:.1e}" for row in rows))
    story.console.print(table)


def draw(folder: Path, patches: dict[str, Patch]) -> list[Path]:
    """Draw stresses and pressures of both methods, and write files for ParaView."""
    files = []
    nodal = {method: at_nodes(patch) for method, patch in patches.items()}
    highest = max(error.x.array.max() for error in nodal.values())
    for method, patch in patches.items():
        stem = folder / f"patch_test_{method}"
        with cx.VTKOutput(stem.with_suffix(".pvd"), patch.u, [patch.contact]) as output:
            output.write(1.0)
        plot.deformed_bodies(
            patch.u,
            nodal[method],
            stem.with_suffix(".png"),
            title=f"Error of a uniform stress: {method}",
            label="deviation of the stress / p",
            clim=(0.0, highest),
            camera=CAMERA if patch.shape.dim == 3 else None,
        )
        files += [stem.with_suffix(".png"), stem.with_suffix(".pvd")]
    files.append(folder / "patch_test_pressure.png")
    computed = {}
    for method, patch in patches.items():
        x = patch.u.function_space.tabulate_dof_coordinates()[patch.contact.slave_nodes]
        along = x[:, : patch.shape.dim] @ patch.shape.frame[:, 0]
        order = np.argsort(along)
        computed[method] = (along[order], patch.contact.multiplier[order] / patch.pressure)
    plot.curves(
        computed,
        {"exact": ([0, 1], [1, 1])},
        files[-1],
        labels=("position along the interface", "pressure of the slave nodes / p"),
        title="A uniform pressure on meshes that do not match",
    )
    return files


def at_nodes(patch: Patch) -> fem.Function:
    """Error of the stress at the nodes, the mean over their cells."""
    Q = fem.functionspace(patch.u.function_space.mesh, ("Lagrange", 1))
    error, nodes = fem.Function(Q), Q.dofmap.list
    of_cells = np.repeat(patch.stress_errors(), nodes.shape[1])
    error.x.array[:] = np.bincount(nodes.ravel(), of_cells) / np.bincount(nodes.ravel())
    return error


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve with both methods, print their errors side by side and draw the last cell type."""
    args = story.arguments(
        "Two blocks under uniform pressure", 0.25, "in heights of a block", argv, dimensions=(3, 2)
    )
    n = max(2, int(np.ceil(1 / args.h)))
    results: dict[str, list[story.Result]] = {method: [] for method in METHODS}
    patches = {}
    for cell in CELLS[args.dim]:
        for method in METHODS:
            with story.progress("meshing"):
                shape = Shape(cell, n, n - 1, turn=tilted(args.dim))
                patch = Patch(shape, sliding=args.sliding, method=method)
            story.solve(patch.problem)
            results[method] += compare(cell.name, patch)
            patches[method] = patch
    show(results)
    with story.progress("drawing"):
        files = draw(args.output, patches)
    story.see(files)
    return [result for rows in results.values() for result in rows]


if __name__ == "__main__":
    main()
