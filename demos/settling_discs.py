# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact of many bodies: twenty loose discs settle in a box.

Neo-Hookean discs, E = 1, nu = 0.3, in plane strain, lie loose in a box; their radii are 0.49 to 0.5
and friction is 0.3, among them and with the box. ``cx.Contact.all`` is one contact with every pair
that can meet, which nobody has to name: discs fall onto others than they were above.

Nothing but contact holds them. Their weight is carried by a drag, a force against what they move in
a step, until they touch; steps become longer as they come to rest, until none moves. Then the drag
is taken off, and the discs are at rest under their weight alone: the box carries it all, and forces
on each disc balance.

    python demos/settling_discs.py --h 0.08
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
from closing_clip import neo_hookean

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem, la, mesh

import plot
import story

YOUNG, NU, FRICTION = 1.0, 0.3, 0.3
# Largest radius and what radii are smaller by, gap between the discs, force per volume
RADIUS, SPREAD, GAP, WEIGHT = 0.5, 0.02, 0.01, 1e-3
ROWS, COLUMNS = 4, 5
# What a disc falls by in the first step; how much longer the next one is, and how much shorter
# where one failed; the way in a step below which all are at rest
FALL, LONGER, SHORTER, REST = 0.05, 2.0, 4.0, 1e-9
MOST_STEPS = 200

type Array = npt.NDArray[np.float64]


def disc(n: int, radius: float, centre: Array, turn: float) -> tuple[Array, npt.NDArray[np.int64]]:
    """Nodes and quadrilaterals of a disc, n along each quarter of its rim."""
    s = np.linspace(-1, 1, n + 1)
    p = np.stack([c.ravel() for c in np.meshgrid(s, s, indexing="ij")], axis=1)
    size = np.abs(p).max(axis=1)
    wide = np.abs(p[:, 0]) >= np.abs(p[:, 1])
    a, b = np.where(wide, p[:, 0], p[:, 1]), np.where(wide, p[:, 1], -p[:, 0])
    ratio = np.divide(b, a, out=np.zeros_like(a), where=a != 0)
    angle = np.where(wide, 0, np.pi / 2) + np.where(a < 0, np.pi, 0) + np.pi / 4 * ratio
    round_ = size[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    # Squares within, circles at the rim
    part = size[:, None] ** 2
    x = part * round_ + (1 - part) * 0.75 * p
    c, s_ = np.cos(turn), np.sin(turn)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    first = i * (n + 1) + j
    cells = np.stack([first, first + n + 1, first + 1, first + n + 2], axis=1)
    return radius * x @ np.array([[c, s_], [-s_, c]]) + centre, cells


class Box:
    """Discs in a box.

    Attributes:
        u: Displacement.
        discs: Contact of the discs with one another.
        walls: Contacts with floor and sides.
        problem: The problem.
        steps: Number of steps.
        weight: Weight of all discs.
    """

    def __init__(
        self,
        h: float,
        rows: int = ROWS,
        columns: int = COLUMNS,
        angle: float = 0.0,
        seed: int = 1,
        method: str = "node-to-surface",
    ):
        """Set the problem up.

        Args:
            h: Length of the cells at the rims.
            rows: Number of rows.
            columns: Number of discs in each.
            angle: By which the scene is turned.
            seed: Of radii, and of what discs are turned by.
            method: Method of the contacts with the box.
        """
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s], [s, c]])
        domain, width = self._mesh(h, rows, columns, turn, seed)
        self._count = rows * columns
        nodes = domain.topology.index_map(0).size_global
        self._per_disc = nodes // self._count
        domain.topology.create_connectivity(1, 2)
        facets = mesh.exterior_facet_indices(domain.topology)
        tags = mesh.meshtags(domain, 1, facets, np.ones(len(facets), dtype=np.int32))
        self.up = turn[:, 1]
        self.u = u = story.displacement(domain)
        self._before = fem.Function(u.function_space)
        self._drag = fem.Constant(domain, 0.0)
        self._load = fem.Constant(domain, -WEIGHT * self.up)
        v = ufl.TestFunction(u.function_space)
        self._F = neo_hookean(u, YOUNG, NU) - ufl.inner(self._load, v) * ufl.dx
        self.discs = cx.Contact.all(tags, friction=FRICTION, method="node-to-surface")
        rims = cx.Surface(tags, 1)
        sides = [((0.0, 0.0), (0.0, 1.0)), ((0.0, 0.0), (1.0, 0.0)), ((width, 0.0), (-1.0, 0.0))]
        self.walls = [
            cx.Contact(
                rims, cx.Plane(turn @ point, turn @ normal), friction=FRICTION, method=method
            )
            for point, normal in sides
        ]
        self.problem = cx.ContactProblem(
            self._F + self._drag * ufl.inner(u - self._before, v) * ufl.dx,
            u,
            contacts=[self.discs, *self.walls],
            petsc_options_prefix="box_",
        )
        area = fem.assemble_scalar(fem.form(fem.Constant(domain, 1.0) * ufl.dx))
        self.weight = WEIGHT * float(domain.comm.allreduce(area))
        self.steps = 0

    @staticmethod
    def _mesh(h: float, rows: int, columns: int, turn: Array, seed: int) -> tuple[mesh.Mesh, float]:
        """Mesh of the discs, every other row half a disc to the right, and width of the box."""
        random = np.random.default_rng(seed)
        n = round(np.pi / 2 * RADIUS / h)
        x, cells = [], []
        for row in range(rows):
            for column in range(columns):
                place = np.array([column + 0.5 * (row % 2), row * np.sqrt(3) / 2])
                nodes, quadrilaterals = disc(
                    n,
                    RADIUS * (1 - SPREAD * random.random()),
                    (2 * RADIUS + GAP) * place + RADIUS + GAP,
                    2 * np.pi * random.random(),
                )
                cells.append(quadrilaterals + len(x) * len(nodes))
                x.append(nodes @ turn.T)
        element = basix.ufl.element("Lagrange", "quadrilateral", 1, shape=(2,))
        is_first = MPI.COMM_WORLD.rank == 0
        domain = mesh.create_mesh(
            MPI.COMM_WORLD,
            np.concatenate(cells) if is_first else np.zeros((0, 4), dtype=np.int64),
            element,
            np.concatenate(x) if is_first else np.zeros((0, 2)),
        )
        return domain, (2 * RADIUS + GAP) * (columns + 0.5) + GAP

    def fall(self) -> Iterator[float]:
        """Let the discs fall until they rest.

        Yields:
            Longest way of a node in each step that was taken.

        Raises:
            contactx.ConvergenceError: If they come to no rest.
        """
        fall = FALL
        comm = self.u.function_space.mesh.comm
        for self.steps in range(1, MOST_STEPS):
            self._before.x.array[:] = self.u.x.array
            self._drag.value = WEIGHT / fall
            try:
                self.problem.solve()
            except cx.ConvergenceError:
                fall /= SHORTER
                if fall < FALL / SHORTER**6:
                    raise
                continue
            way = np.abs(self.u.x.array - self._before.x.array).max(initial=0.0)
            way = comm.allreduce(float(way), MPI.MAX)
            yield way
            if way <= REST:
                return
            # Not while they still fall
            if way < 0.5 * fall or fall < FALL:
                fall *= LONGER

    def settle(self) -> None:
        """Let the discs fall until they rest, and take the drag off."""
        for _ in self.fall():
            pass
        self._drag.value = 0.0
        self.problem.solve()

    def carried(self) -> float:
        """Force of the box on the discs, against their weight."""
        return float(sum(wall.force @ self.up for wall in self.walls))

    def unbalanced(self) -> float:
        """Largest force on a disc that nothing balances."""
        b = fem.assemble_vector(fem.form(self._F))
        b.scatter_reverse(la.InsertMode.add)
        halo = self.discs.discrete.halo
        forces = np.zeros((halo.num_nodes, 2))
        for contact in (self.discs, *self.walls):
            contact.discrete.add_residual(forces.ravel())
        owned = halo.num_owned
        total = b.array.reshape(-1, 2)[:owned] + halo.scatter_reverse(forces)[:owned]
        # Nodes are numbered disc by disc
        number = halo.original[:owned] // self._per_disc
        sums = np.stack(
            [np.bincount(number, total[:, k], minlength=self._count) for k in range(2)], axis=1
        )
        sums = self.u.function_space.mesh.comm.allreduce(sums)
        return float(np.linalg.norm(sums, axis=1).max())


def draw(folder: Path, box: Box) -> list[Path]:
    """Draw the discs and write a file for ParaView."""
    files = [folder / f"settling_discs{end}" for end in (".png", ".pvd")]
    with story.progress("drawing"):
        with cx.VTKOutput(files[1], box.u, [box.discs, *box.walls]) as output:
            output.write(1.0)
        plot.deformed_bodies(
            box.u,
            box.discs.pressure,
            files[0],
            title="Twenty loose discs at rest in a box",
            label="contact pressure / E",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Let the discs settle, compare what the box carries with their weight, and draw them."""
    args = story.arguments("Discs that settle in a box", 0.13, "at the rims of the discs", argv)
    box = Box(args.h)
    with story.progress("settling"):
        box.settle()
    carried, each = box.carried(), box.weight / (ROWS * COLUMNS)
    results = [story.Result("force of the box on the discs", box.weight, carried)]
    closed = int(box.discs.discrete.nodes.closed.sum())
    story.console.print(
        f"at rest after {box.steps} steps, {closed} nodes in contact with other discs; the box "
        f"carries their weight but for {abs(carried / box.weight - 1):.1e} of it; of the weight of "
        f"a disc {box.unbalanced() / each:.1e} are not balanced; {box.problem.report.audit}",
        highlight=False,
    )
    story.show("Settling discs", results)
    story.see(draw(args.output, box))
    return results


if __name__ == "__main__":
    main()
