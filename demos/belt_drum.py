# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Belt on a drum: the ratio of tensions that friction holds, against Euler.

A neo-Hookean belt, E = 1, nu = 0.3, 0.02 thick, lies over half of an elastic drum of radius 1,
which is ten times as stiff. A dead load pulls at its one end, the other end is held; then the drum
is turned by its bore against the held end until all of the belt slides. With mu = 0.3 the tension
at the held end is, by Euler,

    T_2 = T_1 exp(mu pi),

where mu is less by mu t/(2 R) for the thickness t. On the way there the part of the belt that
slides grows from its ends, and the rest goes with the drum. The belt is so light that it does not
close what is between it and the chords of the drum, h^2/8 for cells of size h: these must be short,
or the audit refuses the step. Both methods run.

    python demos/belt_drum.py --h 0.015
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import contactx as cx  # isort: skip

import numpy as np
import numpy.typing as npt
import rolling

from dolfinx import fem

import meshes
import plot
import reference
import story
from meshes import Tag

E, NU, FRICTION = 1.0, 0.3, 0.3
STIFFER, THICKNESS = 10.0, 0.02
# Force per area at the pulled end, angle of the drum, steps of pulling and of turning
PULL, ANGLE, STEPS = 0.01, 0.06, (4, 8)


class BeltDrum:
    """A belt on a drum.

    Attributes:
        u: Displacement, of degree 2.
        contact: The belt on the drum.
        march: The load steps.
        angles: Angle of the drum after each step, radians.
        ratios: Tension at the held end over that at the pulled one.
    """

    def __init__(self, h: float, method: str):
        """Set up.

        Args:
            h: Length of the belt's cells.
            method: Method of contact.
        """
        data = meshes.belt(2 * round(math.pi / h / 2), thickness=THICKNESS)
        domain, tags = data.mesh, data.facet_tags
        self.u = u = story.displacement(domain, 2)
        V = u.function_space
        young = rolling.of_bodies(domain, data.cell_tags, {Tag.UPPER: E, Tag.LOWER: STIFFER * E})
        F = rolling.neo_hookean(u, young, NU)
        self._form = fem.form(F)
        self._pull = fem.Constant(domain, (0.0, 0.0))
        F += story.traction(u, tags, Tag.UPPER_X1, self._pull)
        self._held = story.fix(u, tags, 1, 0.0, Tag.UPPER_X0)
        self._bore = fem.Function(V)
        dofs = fem.locate_dofs_topological(V, 1, tags.find(Tag.LOWER_BOTTOM))
        self._x = V.tabulate_dof_coordinates()[:, :2]
        self.contact = cx.Contact(
            slave=cx.Surface(tags, Tag.UPPER_CONTACT),
            master=cx.Surface(tags, Tag.LOWER_CONTACT),
            friction=FRICTION,
            method=method,
        )
        problem = cx.ContactProblem(
            F,
            u,
            contacts=[self.contact],
            bcs=[
                self._held,
                story.fix(u, tags, 0, 0.0, Tag.UPPER_X0),
                fem.dirichletbc(self._bore, dofs),
            ],
            petsc_options_prefix="belt_",
        )
        self.march = rolling.March(problem)
        self.angles: npt.NDArray[np.float64] = np.zeros(0)
        self.ratios: npt.NDArray[np.float64] = np.zeros(0)

    def _load(self, t: float) -> None:
        """Pull first, and turn the drum then."""
        step = t * sum(STEPS)
        self._pull.value[1] = -PULL * min(1.0, step / STEPS[0])
        self._angle = -ANGLE * max(0.0, step - STEPS[0]) / STEPS[1]
        c, s = math.cos(self._angle), math.sin(self._angle)
        self._bore.x.array.reshape(-1, 2)[:] = self._x @ np.array([[c, s], [-s, c]]) - self._x

    def run(self) -> None:
        """Pull and turn."""
        angles, ratios = [], []
        for _ in self.march.steps(sum(STEPS), self._load):
            held = rolling.reaction(self._form, self._held.dof_indices()[0]).sum()
            angles.append(-self._angle)
            ratios.append(float(held / (self._pull.value[1] * THICKNESS)))
        self.angles, self.ratios = np.array(angles), np.array(ratios)

    def compare(self, name: str) -> list[story.Result]:
        """The ratio of the tensions against Euler's."""
        thick = reference.belt_ratio(FRICTION, math.pi, THICKNESS)
        return [
            story.Result(
                f"{name}: ratio of the tensions, thin belt",
                reference.belt_ratio(FRICTION, math.pi),
                float(self.ratios[-1]),
            ),
            story.Result(f"{name}: the same, of its thickness", thick, float(self.ratios[-1])),
        ]


def draw(folder: Path, runs: dict[str, BeltDrum]) -> list[Path]:
    """Draw the ratio over the angle, and the pressure of the last run."""
    files = [folder / f"belt_drum{end}" for end in (".png", "_ratio.png", ".pvd")]
    last = list(runs.values())[-1]
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], last.u, [last.contact]) as output:
            output.write(1.0)
        pressure = fem.Function(fem.functionspace(last.u.function_space.mesh, ("Lagrange", 1)))
        pressure.interpolate(last.contact.pressure)
        plot.deformed_bodies(
            rolling.at_vertices(last.u),
            pressure,
            files[0],
            title="A belt that slides on a drum",
            label="contact pressure / E of the belt",
        )
        plot.curves(
            {method: (run.angles, run.ratios) for method, run in runs.items()},
            {
                "Euler": (
                    [0, ANGLE],
                    [reference.belt_ratio(FRICTION, math.pi, THICKNESS)] * 2,
                )
            },
            files[1],
            labels=("angle of the drum", "tension held / tension pulled"),
            title="Ratio of the tensions of a belt on a drum",
            joined=True,
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Pull and turn by both methods, compare with Euler and draw."""
    args = story.arguments("A belt on a drum", 0.015, "in radii", argv)
    runs, results = {}, []
    for method in story.METHODS:
        with story.progress(f"turning, {method}"):
            run = BeltDrum(args.h, method)
            run.run()
        run.march.tell(method, args.h)
        runs[method] = run
        results += run.compare(method)
    story.show("Belt on a drum", results)
    story.see(draw(args.output, runs))
    return results


if __name__ == "__main__":
    main()
