# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block pushed to and fro with friction: it holds, it slides, and the way back is another one.

An elastic block, 2 wide and 1 high, E = 1, nu = 0.3, lies on a rigid plane, then on an elastic
base. A pressure of 0.01 on its top presses it down, and the top is moved sideways, 0.06 to the
right, as far to the left and to the right again. With friction mu = 0.3 and the normal force N the
block carries no tangential force above mu N: it deforms and holds while the force is below, first
slips at its edges, and when its last node slips the force stays at mu N. Each reversal starts with
sticking again, so that force over displacement is a loop: what it encloses is lost to friction.

In 2D the plane gives mu N to rounding. In 3D the block spreads across the push, too: its nodes
first slip askew, and the force comes close to mu N only as it goes on. The elastic base dents under
the block's front: in finite sliding friction acts along the inclined surface, and the block
ploughs a little.

Nothing but contact carries the block's weight. The bodies interfere by 1e-8, so that the contact is
closed from the start; where they only touch contactx closes it by itself.

    python demos/sliding_block.py --h 0.1
    python demos/sliding_block.py --h 0.25 --dim 3
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType, Mesh, MeshTags

import meshes
import plot
import story
from meshes import Tag

E, NU, FRICTION = 1.0, 0.3, 0.3
PRESSURE, AMPLITUDE = 0.01, 0.06
SIZE, BASE = (2.0, 1.0, 1.0), (3.0, 2.0, 0.5)
INTERFERENCE = 1e-8
STEPS = 75
BASES = ("rigid plane", "elastic base")


def bodies(h: float, dim: int, base: str) -> tuple[Mesh, MeshTags, cx.Plane | cx.Surface]:
    """The block, with the base below its middle if that is elastic, and the base's surface."""
    # In 2D the second axis is the height
    size, lower = (list(s) if dim == 3 else [s[0], s[2]] for s in (SIZE, BASE))
    data = meshes.blocks(
        CellType.hexahedron if dim == 3 else CellType.quadrilateral,
        [int(np.ceil(length / h)) for length in size],
        [int(np.ceil(length / (1.3 * h))) for length in lower],
        size_upper=size,
        size_lower=lower,
        shift=[(b - s) / 2 for s, b in zip(size[:-1], lower[:-1], strict=True)],
    )
    if base == "elastic base":
        return data.mesh, data.facet_tags, cx.Surface(data.facet_tags, Tag.LOWER_CONTACT)
    up = np.eye(dim)[-1]
    return *meshes.single(data, Tag.UPPER), cx.Plane(point=np.zeros(dim), normal=up)


class Slider:
    """A pressed block whose top moves sideways.

    Attributes:
        u: Displacement.
        contact: Its lower face on what is below it.
        problem: The problem.
        weight: Force that presses it down.
        path: Displacements of the top, those of accepted steps.
        forces: Tangential forces.
        sticks: Whether some node sticks.
    """

    def __init__(self, h: float, dim: int, base: str, sliding: str, method: str = story.METHODS[0]):
        """Set the problem up; an elastic base is fixed at its bottom."""
        mesh, tags, master = bodies(h, dim, base)
        self.u = u = story.displacement(mesh)
        load = fem.Constant(mesh, -PRESSURE * np.eye(dim)[-1])
        F = story.elasticity(u, E, NU) + story.traction(u, tags, Tag.UPPER_TOP, load)
        self._push = story.fix(u, tags, 0, 0.0, Tag.UPPER_TOP)
        bcs = [self._push, *(story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(1, dim - 1))]
        if isinstance(master, cx.Surface):
            bcs += [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
        self.contact = cx.Contact(
            slave=cx.Surface(tags, Tag.UPPER_CONTACT),
            master=master,
            friction=FRICTION,
            sliding=sliding,
            method=method,
            offset=INTERFERENCE,
        )
        self.problem = cx.ContactProblem(
            F, u, contacts=[self.contact], bcs=bcs, petsc_options_prefix="slider_"
        )
        self.weight = PRESSURE * float(np.prod(SIZE[: dim - 1]))
        self.path: list[float] = []
        self.forces: list[float] = []
        self.sticks: list[bool] = []

    def _move(self, t: float) -> None:
        """Move the top to where it is at the time t: right, left and right again."""
        to_and_fro = np.interp(t, (0, 0.2, 0.6, 1), (0, 1, -1, 1))
        self._push.g.value[...] = AMPLITUDE * to_and_fro

    def run(self) -> None:
        """Press first, then push."""
        story.solve(self.problem)
        for _ in cx.LoadSteps(self.problem, STEPS, update=self._move):
            status = self.contact.status.x.array[self.contact.slave_nodes]
            self.path.append(float(self._push.g.value))
            self.forces.append(-float(self.contact.force[0]))
            self.sticks.append(bool(np.any(status == 1)))

    def compare(self, base: str) -> list[story.Result]:
        """Forces against Coulomb's law."""
        force, slides = np.array(self.forces), ~np.array(self.sticks)
        limit = FRICTION * self.weight
        first = int(np.argmax(slides))
        return [
            story.Result(f"{base}: normal force", self.weight, self.contact.force[-1]),
            story.Result(f"{base}: largest force that it holds", limit, force[:first].max()),
            story.Result(f"{base}: force when the last node slips", limit, force[first]),
            story.Result(f"{base}: force to the left", -limit, force[slides & (force < 0)][-1]),
            story.Result(f"{base}: force to the right", limit, force[slides & (force > 0)][-1]),
        ]


def draw(folder: Path, sliders: dict[str, Slider]) -> list[Path]:
    """Draw the loops and the block on the last base, and write a file for ParaView."""
    files = [folder / f"sliding_block{end}" for end in (".png", "_loop.png", ".pvd")]
    last = sliders[BASES[-1]]
    limit = FRICTION * last.weight
    ends = AMPLITUDE * np.array([-1, 1, np.nan, -1, 1])
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], last.u, [last.contact]) as output:
            output.write(1.0)
        plot.deformed_bodies(
            last.u,
            last.contact.pressure,
            files[0],
            title="A block pushed over an elastic base",
            label="contact pressure / E",
        )
        plot.curves(
            {f"on the {name}": ([0, *s.path], [0, *s.forces]) for name, s in sliders.items()},
            {"mu N, to both sides": (ends, [limit, limit, np.nan, -limit, -limit])},
            files[1],
            labels=("displacement of the top", "tangential force / E"),
            title="A block pushed to and fro",
            joined=True,
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Push the block on both bases, compare with Coulomb's law and draw the loops."""
    args = story.arguments(
        "A block pushed to and fro",
        0.1,
        "in heights of the block",
        argv,
        dimensions=(2, 3),
        methods=True,
    )
    sliders, results = {}, []
    for base in BASES:
        with story.progress("meshing"):
            slider = Slider(args.h, args.dim, base, args.sliding, args.method)
        slider.run()
        results += slider.compare(base)
        sliders[base] = slider
    story.show("Coulomb: a block that sticks and slides", results)
    story.see(draw(args.output, sliders))
    return results


if __name__ == "__main__":
    main()
