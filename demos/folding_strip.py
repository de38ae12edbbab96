# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Self-contact: a strip is folded until its two halves touch, and on.

A neo-Hookean strip, 6 long and 0.06 thick, E = 1, nu = 0.3, in plane strain, friction 0.3. Both
ends are clamped: they turn upward by a right angle, then come together and turn back by 40 degrees,
which presses the halves of the strip onto each other. Its whole boundary is one surface, slave and
master at once; a node never meets what it sees through the strip, which is thinner than the way to
anything else.

What is folded is its own mirror image: nothing is carried upward where it is cut in half. So an
elastica, a beam that bends but neither stretches nor shears, has a force along the plane's normal
alone: one in the loop below the place where the halves touch, and a larger one above it. Its
contact force is compared.

The fold hangs from the place where it touches and sways with little force: a facet that is not
quite upright pushes the middle of its loop up to 0.003 to one side, and the place of contact 0.0003
of it. So the distance of the halves is taken between their centre lines, not from the plane of
symmetry. It is 0.9 % less than the thickness at h = 0.06 as at h = 0.03: where the halves
touch, bending stretches them on the side of contact, which makes that half of the thickness thinner
by nu / (1 - nu) times its mean strain, with the elastica's curvature 0.7 % of the thickness. With
nu = 0 the distance is 0.2 % less at h = 0.06, where chords of the curved sides touch.

    python demos/folding_strip.py --h 0.03
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
from closing_clip import neo_hookean

import contactx as cx
from dolfinx import fem, mesh

import plot
import story

LENGTH, THICKNESS = 6.0, 0.06
YOUNG, NU, FRICTION = 1.0, 0.3, 0.3
# Share of the steps in which the ends turn upward; how far they are apart then, and turn back
TURN, APART, BACK = 0.6, 0.1, np.radians(40)
STEPS = 20

type Array = npt.NDArray[np.float64]


class Elastica:
    """A folded beam: half of it from the middle of the loop to the clamp.

    Attributes:
        contact: Force of one half on the other.
        loop: Length from the middle of the loop to where the halves touch.
    """

    def __init__(self) -> None:
        """Solve for the curvature in the middle, forces and place of contact by Newton's method."""
        self._bending = YOUNG / (1 - NU**2) * THICKNESS**3 / 12
        p = np.array([2.0, -1.5 * self._bending, 0.38 * LENGTH, 3.0 * self._bending])
        scale = np.array([1.0, self._bending, 1.0, self._bending])
        for _ in range(100):
            off = self._mismatch(p)
            if np.abs(off).max() < 1e-11:
                break
            steps = 1e-6 * np.diag(scale)
            J = np.stack([(self._mismatch(p + d) - off) / d.max() for d in steps], axis=1)
            dp = np.linalg.solve(J, -off)
            p = p + dp * min(1.0, 0.2 / np.abs(dp / scale).max())
        self.loop, self.contact = float(p[2]), float(p[3])

    def _mismatch(self, p: Array) -> Array:
        """What is not as it should be where the halves touch, and at the clamp."""
        curvature, force, at, contact = p
        # Place along the normal of the plane, angle, curvature
        y = self._integrate(np.array([0.0, 0.0, curvature]), at, force)
        off = [y[0] - THICKNESS / 2, y[1] - np.pi / 2]
        y = self._integrate(y, LENGTH / 2 - at, force + contact)
        return np.array([*off, y[0] - THICKNESS / 2 - APART, y[1] - np.pi / 2 + BACK])

    def _integrate(self, y: Array, length: float, force: float, n: int = 200) -> Array:
        """Go along the beam by the method of Runge and Kutta."""

        def slope(y: Array) -> Array:
            return np.array([np.cos(y[1]), y[2], force / self._bending * np.sin(y[1])])

        h = length / n
        for _ in range(n):
            a = slope(y)
            b = slope(y + h / 2 * a)
            c = slope(y + h / 2 * b)
            d = slope(y + h * c)
            y = y + h / 6 * (a + 2 * b + 2 * c + d)
        return y


class Fold:
    """The strip.

    Attributes:
        u: Displacement.
        contact: Its boundary on itself.
        problem: The problem.
    """

    def __init__(self, h: float, **options: object):
        """Set the problem up.

        Args:
            h: Length of the cells.
            options: Options of the contact.
        """
        cells = [2 * round(LENGTH / h / 2), 1]
        corner = np.array([LENGTH / 2, THICKNESS / 2])
        domain = mesh.create_rectangle(
            MPI.COMM_WORLD, [-corner, corner], cells, mesh.CellType.quadrilateral
        )
        domain.topology.create_connectivity(1, 2)
        facets = mesh.exterior_facet_indices(domain.topology)
        tags = mesh.meshtags(domain, 1, facets, np.ones(len(facets), dtype=np.int32))
        # Quadratic cells bend
        self.u = u = story.displacement(domain, 2)
        V = u.function_space
        self._x = V.tabulate_dof_coordinates()[:, :2]
        self._ends = fem.Function(V)
        self._dofs = fem.locate_dofs_geometrical(V, lambda x: np.abs(x[0]) > (0.5 - 1e-9) * LENGTH)
        boundary = cx.Surface(tags, 1)
        self.contact = cx.Contact(slave=boundary, master=boundary, **options)
        self.problem = cx.ContactProblem(
            neo_hookean(u, YOUNG, NU),
            u,
            contacts=[self.contact],
            bcs=[fem.dirichletbc(self._ends, self._dofs)],
            petsc_options_prefix="fold_",
        )

    def move(self, t: float) -> None:
        """Move the ends: up on arcs of circles, and then together."""
        part, rest = min(1.0, t / TURN), max(0.0, (t - TURN) / (1 - TURN))
        angle = part * np.pi / 2
        radius = LENGTH / 2 / max(angle, 1e-9)
        apart = radius * np.sin(angle)
        apart += rest * (APART + THICKNESS / 2 - apart)
        up = radius * (1 - np.cos(angle))
        u = self._ends.x.array.reshape(-1, 2)
        for side in (-1, 1):
            at = self._x[:, 0] * side > 0
            turn = side * (angle - rest * BACK)
            rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
            arm = self._x[at] - [side * LENGTH / 2, 0]
            u[at] = arm @ rotation.T + [side * apart, up] - self._x[at]

    def run(self, steps: int = STEPS) -> None:
        """Fold in steps."""
        for _ in cx.LoadSteps(self.problem, steps, update=self.move, progress=False):
            pass

    def touching(self) -> Array:
        """Where nodes are that are slaves in contact on this rank, shape (n, 2)."""
        return self._positions()[self._closed()]

    def apart(self) -> float:
        """Mean distance of the centre lines where the halves touch, whichever of them is the slave.

        From where nodes in contact have their centre line to the nearest point of the other one.
        """
        x, now = self._x, self._positions()
        V = self.u.function_space
        on_line = np.abs(x[:, 1]) < 1e-9
        on_line[V.dofmap.index_map.size_local :] = False
        comm = V.mesh.comm
        place, line = (
            np.concatenate(comm.allgather(values)) for values in (x[on_line, 0], now[on_line])
        )
        order = np.argsort(place)
        place, line = place[order], line[order]
        touching = np.concatenate(comm.allgather(x[self._closed(), 0]))
        distances = []
        for own in touching:
            point = line[np.argmin(np.abs(place - own))]
            other = line[place * own < 0]
            along = np.diff(other, axis=0)
            reach = np.sum((point - other[:-1]) * along, axis=1) / np.sum(along**2, axis=1)
            nearest = other[:-1] + np.clip(reach, 0, 1)[:, None] * along
            distances.append(np.linalg.norm(nearest - point, axis=1).min())
        return float(np.mean(distances))

    def _closed(self) -> npt.NDArray[np.int32]:
        """Slave nodes in contact on this rank."""
        nodes: npt.NDArray[np.int32] = self.contact.slave_nodes
        return nodes[self.contact.discrete.nodes.closed]

    def _positions(self) -> Array:
        """Where all nodes of this rank are, shape (n, 2)."""
        found: Array = self._x + self.u.x.array.reshape(-1, 2)
        return found


def draw(folder: Path, fold: Fold) -> list[Path]:
    """Draw the strip and write a file for ParaView."""
    files = [folder / f"folding_strip{end}" for end in (".png", ".pvd")]
    with story.progress("drawing"):
        with cx.VTKOutput(files[1], fold.u, [fold.contact]) as output:
            output.write(1.0)
        # Pictures are of vertices
        domain = fold.u.function_space.mesh
        u = story.displacement(domain)
        u.interpolate(fold.u)
        pressure = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
        pressure.interpolate(fold.contact.pressure)
        plot.deformed_bodies(
            u,
            pressure,
            files[0],
            title="A strip that is folded onto itself",
            label="contact pressure / E",
            box=[[0.4 * LENGTH, -THICKNESS], [0.48 * LENGTH, THICKNESS]],
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Fold the strip, compare the contact force with a beam's, and draw it."""
    args = story.arguments("A strip that folds", 0.04, "of a strip 6 long", argv)
    fold = Fold(args.h, friction=FRICTION)
    with story.progress("folding"):
        fold.run()
    # Of the half that is the slave, which may be either
    force = abs(float(fold.contact.force[0]))
    results = [
        story.Result("force of one half on the other", abs(Elastica().contact), force),
        story.Result("distance of their centre lines where they touch", THICKNESS, fold.apart()),
    ]
    report = fold.problem.report
    story.console.print(
        f"{len(fold.touching())} nodes in contact, forces sum to "
        f"{np.linalg.norm(report.imbalance) / force:.1e} of that; {report.audit}",
        highlight=False,
    )
    story.show("Folding strip", results)
    story.see(draw(args.output, fold))
    return results


if __name__ == "__main__":
    main()
