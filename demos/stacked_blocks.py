# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Five free blocks on a rigid floor: nothing but contact and friction holds them.

Five elastic blocks, 1 wide and 0.2 high, E = 1, nu = 0.3, lie on each other on the plane of height
zero; their meshes do not match. A pressure of 0.01 and a shear of 0.001 load the top of the
highest. There is no Dirichlet condition: contact carries the pressure, and friction, mu = 0.3,
the shear. By equilibrium each interface transmits what is applied on top,

    N = pressure * area,   Q = shear * area,   Q < mu N.

The blocks interfere by 1e-8, so that all contacts are closed from the start; where bodies only
touch contactx closes them by itself.

    python demos/stacked_blocks.py --h 0.1
    python demos/stacked_blocks.py --h 0.25 --dim 3
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import plot
import story
from meshes import block_tag

BLOCKS, HEIGHT = 5, 0.2
E, NU, FRICTION = 1.0, 0.3, 0.3
PRESSURE, SHEAR = 0.01, 0.001
INTERFERENCE = 1e-8
STEPS = 2


def create(
    h: float, sliding: str, dim: int, **options: Any
) -> tuple[cx.ContactProblem, list[cx.Contact], fem.Constant]:
    """The blocks, the contacts from the floor upwards, and the load on top, zero at first."""
    cells = int(np.ceil(1 / h))
    data = meshes.stack(
        CellType.hexahedron if dim == 3 else CellType.quadrilateral,
        # Each block is finer than the one below, whose top is its master
        [(*[cells + i] * (dim - 1), 2) for i in range(BLOCKS)],
        sizes=[(*[1.0] * (dim - 1), HEIGHT)] * BLOCKS,
    )
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    load = fem.Constant(data.mesh, np.zeros(dim))
    top = block_tag(BLOCKS - 1, "top")
    F = story.elasticity(u, E, NU) + story.traction(u, tags, top, load)
    floor = cx.Plane(point=np.zeros(dim), normal=np.eye(dim)[-1])
    masters = [floor, *(cx.Surface(tags, block_tag(i, "top")) for i in range(BLOCKS - 1))]
    contacts = [
        cx.Contact(
            slave=cx.Surface(tags, block_tag(i, "bottom")),
            master=master,
            friction=FRICTION,
            sliding=sliding,
            offset=INTERFERENCE,
        )
        for i, master in enumerate(masters)
    ]
    problem = cx.ContactProblem(F, u, contacts=contacts, petsc_options_prefix="stack_", **options)
    return problem, contacts, load


def compare(contacts: Sequence[cx.Contact]) -> list[story.Result]:
    """Force through each interface against the load on top; its area is one."""
    results = []
    for i, contact in enumerate(contacts):
        name = "floor" if i == 0 else f"interface {i}"
        results += [
            story.Result(f"{name}: normal force", PRESSURE, contact.force[-1]),
            story.Result(f"{name}: tangential force", SHEAR, -contact.force[0]),
        ]
    return results


def draw(folder: Path, problem: cx.ContactProblem, contacts: Sequence[cx.Contact]) -> list[Path]:
    """Draw the blocks with the pressures of all interfaces, and write a file for ParaView."""
    files = [folder / f"stacked_blocks{end}" for end in (".png", ".pvd")]
    pressure = fem.Function(contacts[0].pressure.function_space)
    for contact in contacts:
        pressure.x.array[:] += contact.pressure.x.array
    with story.progress("drawing"):
        with cx.VTKOutput(files[1], problem.u, contacts) as output:
            output.write(1.0)
        plot.deformed_bodies(
            problem.u,
            pressure,
            files[0],
            title="Five free blocks on a rigid floor",
            label="contact pressure / E",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Load the stack, compare with equilibrium and draw."""
    args = story.arguments(
        "Five free blocks on a rigid floor", 0.1, "in widths of the blocks", argv, dimensions=(2, 3)
    )
    with story.progress("meshing"):
        problem, contacts, load = create(args.h, args.sliding, args.dim)
    final = np.zeros(args.dim)
    final[0], final[-1] = SHEAR, -PRESSURE

    def update(t: float) -> None:
        load.value[:] = t * final

    for _ in cx.LoadSteps(problem, STEPS, update=update):
        story.console.print(str(problem.report), highlight=False)
    results = compare(contacts)
    story.show("Equilibrium of five free blocks", results)
    story.see(draw(args.output, problem, contacts))
    return results


if __name__ == "__main__":
    main()
