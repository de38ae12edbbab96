# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ironing: a stiff round die is pressed into a soft block and dragged over it.

Die and block are neo-Hookean, E = 100 and 1, nu = 0.3. The die's bottom is round, R = 0.7 (in 3D a
sphere of R = 1); its top goes down by 0.1, an eighth of the die's width, and then 1.3 along the
block, over 15 of its facets (10 in 3D), without friction and with mu = 0.3. What passes under
the die is not the same from step to step, so that forces swing: by how much is what the method of
contact makes of it. Dragged without friction the die meets no resistance but what the ends of the
block and its cells make; with friction it is mu times the vertical force, and a little for the
wave that the die pushes ahead. Both methods run.

The swing is the largest deviation of a force from a cubic along the path, without the first fifth
in which friction builds up, over the mean vertical force.

    python demos/ironing.py --h 0.05
    python demos/ironing.py --h 0.13 --dim 3
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import plot
import story
from meshes import Tag

STIFF, SOFT, NU = 100.0, 1.0, 0.3
FRICTIONS = (0.0, 0.3)
# Lengths of block and die along the drag, across it and upward; the die's corner on the block
BLOCK, DIE, CORNER = (2.6, 1.2, 0.7), (0.8, 0.8, 0.3), (0.25, 0.2)
RADIUS, DEPTH, WAY = {2: 0.7, 3: 1.0}, 0.1, 1.3
# Cells of the block over those of the die
COARSER = 1.3
# Steps of the way down, and those a facet of the block: not whole, to see all places in it
PRESS, EACH = 5, 4.6
# Share of the drag in which friction builds up
START = 0.2


def neo_hookean(u: fem.Function, young: fem.Function) -> ufl.Form:
    """Residual of compressible neo-Hookean bodies, in plane strain where the mesh is plane."""
    mu, lmbda = young / (2 * (1 + NU)), young * NU / ((1 + NU) * (1 - 2 * NU))
    F = ufl.Identity(len(u)) + ufl.grad(u)
    J = ufl.det(F)
    density = mu / 2 * (ufl.tr(F.T * F) - len(u) - 2 * ufl.ln(J)) + lmbda / 2 * ufl.ln(J) ** 2
    return ufl.derivative(density * ufl.dx(metadata={"quadrature_degree": 3}), u)


class Ironing:
    """A die above a block.

    Attributes:
        u: Displacement.
        contact: The die's bottom on the block's top.
        problem: The problem.
        steps: Number of steps, down and along.
        iterations: Of each step.
        frozen_steps: Number of steps with frozen pairs.
        way: Displacements of the die along the block, those of the steps of the drag.
        forces: Forces of the die on the block at each, shape (n, dim); the last component points
            down.
    """

    def __init__(self, h: float, dim: int, friction: float, method: str, slave: str = "die"):
        """Set the problem up, nothing moved yet.

        Args:
            h: Cell size of the block.
            dim: Dimension of space.
            friction: Coulomb's coefficient.
            method: Method of contact.
            slave: "die", whose cells are smaller, or "block", which is softer.
        """
        # In 2D the second axis is the height
        block, die = ([s[i] for i in (0, 1, 2) if i != 1 or dim == 3] for s in (BLOCK, DIE))
        data = meshes.blocks(
            CellType.hexahedron if dim == 3 else CellType.quadrilateral,
            [round(COARSER * length / h) for length in die[:-1]] + [max(2, round(die[-1] / h))],
            [round(length / h) for length in block],
            size_upper=die,
            size_lower=block,
            shift=CORNER[: dim - 1],
            radius=RADIUS[dim],
        )
        tags = data.facet_tags
        self.u = u = story.displacement(data.mesh)
        young = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
        for body, value in ((Tag.UPPER, STIFF), (Tag.LOWER, SOFT)):
            young.x.array[data.cell_tags.find(body)] = value
        self._top = [story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(dim)]
        faces = [cx.Surface(tags, face) for face in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)]
        # Forces on the slave, of the die on the block
        self._sign = -1 if slave == "die" else 1
        self.contact = cx.Contact(*faces[:: -self._sign], friction=friction, method=method)
        self.problem = cx.ContactProblem(
            neo_hookean(u, young),
            u,
            contacts=[self.contact],
            bcs=[*self._top, *(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim))],
            petsc_options_prefix="ironing_",
        )
        self.steps = PRESS + round(EACH * WAY / h)
        self.iterations: list[int] = []
        self.frozen_steps = 0
        self.way: list[float] = []
        self._forces: list[npt.NDArray[np.float64]] = []

    def _move(self, t: float) -> None:
        """Move the die's top down first, and along then."""
        step = t * self.steps
        self._top[-1].g.value[...] = -DEPTH * min(1.0, step / PRESS)
        self._top[0].g.value[...] = WAY * max(0.0, step - PRESS) / (self.steps - PRESS)

    def run(self) -> None:
        """Press and drag."""
        with warnings.catch_warnings():
            # What frozen pairs do to the forces is what is measured here
            warnings.filterwarnings("ignore", ".* pairs went back and forth")
            for step in cx.LoadSteps(self.problem, self.steps, update=self._move, progress=False):
                self.iterations.append(step.iterations)
                self.frozen_steps += self.problem.report.frozen_pairs > 0
                if step.t * self.steps > PRESS + 1e-9:
                    self.way.append(float(self._top[0].g.value))
                    self._forces.append(self._sign * self.contact.force)

    @property
    def forces(self) -> npt.NDArray[np.float64]:
        """Forces of the die on the block, shape (n, dim)."""
        return np.array(self._forces)

    def settled(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Way and forces once friction has built up; the vertical force points down."""
        late = np.array(self.way) > START * WAY
        return np.array(self.way)[late], self.forces[late]

    def means(self) -> tuple[float, float]:
        """Mean forces along the drag and down."""
        _, forces = self.settled()
        return float(forces[:, 0].mean()), float(-forces[:, -1].mean())

    def swing(self, component: int) -> float:
        """Largest deviation of a component of the force from a cubic along the way."""
        way, forces = self.settled()
        scaled = way / WAY
        cubic = np.polyval(np.polyfit(scaled, forces[:, component], 3), scaled)
        return float(np.abs(forces[:, component] - cubic).max())


def compare(runs: dict[tuple[float, str], Ironing]) -> list[story.Result]:
    """Forces of each run, and of the other methods against the first one."""
    results: list[story.Result] = []
    for (friction, method), run in runs.items():
        name = f"mu = {friction}, {method}"
        along, down = run.means()
        _, first = runs[friction, story.METHODS[0]].means()
        if method != story.METHODS[0]:
            results.append(story.Result(f"{name}: vertical force, against the other", first, down))
        if friction > 0:
            results.append(
                story.Result(f"{name}: force along over vertical", friction, along / down)
            )
        results += [
            story.Result(f"{name}: swing along / vertical force", 0.0, run.swing(0) / down),
            story.Result(f"{name}: swing down / vertical force", 0.0, run.swing(-1) / down),
        ]
    return results


def draw(folder: Path, runs: dict[tuple[float, str], Ironing]) -> list[Path]:
    """Draw the forces with friction of all methods, and the bodies of the last run."""
    files = [folder / f"ironing{end}" for end in (".png", "_force.png", ".pvd")]
    rubbing = {method: run for (mu, method), run in runs.items() if mu == FRICTIONS[-1]}
    last = list(rubbing.values())[-1]
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], last.u, [last.contact]) as output:
            output.write(1.0)
        plot.deformed_bodies(
            last.u,
            last.contact.pressure,
            files[0],
            title="A stiff die ironed over a soft block",
            label="contact pressure / E of the block",
        )
        plot.curves(
            {
                f"{name}, {method}": (run.way, sign * run.forces[:, component])
                for name, component, sign in (("vertical", -1, -1), ("along", 0, 1))
                for method, run in rubbing.items()
            },
            {},
            files[1],
            labels=("displacement of the die along the block", "force / E of the block"),
            title=f"Forces of the die on the block, mu = {FRICTIONS[-1]}",
            joined=True,
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Iron with and without friction by all methods, compare them and draw."""
    args = story.arguments(
        "A die ironed over a block", 1 / 12, "of the block, 0.7 high", argv, dimensions=(2, 3)
    )
    runs = {}
    for friction in FRICTIONS:
        for method in story.METHODS:
            with story.progress(f"ironing with mu = {friction}, {method}"):
                run = Ironing(args.h, args.dim, friction, method)
                run.run()
            runs[friction, method] = run
            story.console.print(
                f"mu = {friction}, {method}: {len(run.iterations)} steps, at most "
                f"{max(run.iterations)} iterations, {run.frozen_steps} steps with frozen pairs",
                highlight=False,
            )
    results = compare(runs)
    story.show("Ironing", results)
    story.see(draw(args.output, runs))
    return results


if __name__ == "__main__":
    main()
