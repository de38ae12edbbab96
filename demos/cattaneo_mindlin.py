# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cattaneo and Mindlin: two elastic cylinders pressed together and pushed sideways, with friction.

Two half cylinders in plane strain, R = 8, E = 200, nu = 0.3, friction mu = 0.2. Their flat faces
stay plane and do not turn: the lower one is fixed, the upper one moves down until the contact
carries N = 10 per length, and then sideways until it carries Q = 0.93616. The contact slips at its
edges and sticks in the middle,

    c = b sqrt(1 - Q/(mu N)),   q(x) = mu p0 [sqrt(1 - x^2/b^2) - c/b sqrt(1 - x^2/c^2)],

with Hertz's half-width b and peak pressure p0. The displacements that give the forces are found by
secants. What the contact has slipped it does not forget, so Q must not overshoot: it grows the
slower the more of the contact slips, and a secant through the last steps falls short of it. Like
bodies that are pressed together do not shear each other, as the formula has it: friction begins
with the push, so that their unlike meshes do not shear each other either.

By symmetry the interface is plane, and the bodies' normals turn to it by up to b/R = 0.085. Small
sliding keeps them as they were, which is much beside mu: take finite sliding here.

Slave and master have cells of one size here. Node to surface does not spread a pressure evenly
over a master that is coarser: with a master 1.5 times coarser the multipliers' pressures are 6 to
7 % off, at h = 0.015 as at h = 0.04, and their shear, which is mu p where the contact slips, 8 to
11 %. Recovered from them, the pressure is 0.8 % off and the shear 6 to 8 %.

    python demos/cattaneo_mindlin.py --h 0.015
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import contactx as cx
from dolfinx import fem

import meshes
import plot
import reference
import story
from meshes import Tag

RADIUS, E, NU, FRICTION = 8.0, 200.0, 0.3, 0.2
NORMAL, TANGENTIAL = 10.0, 0.93616
ZONE = 1.0
# Steps to shortly below the forces
PRESS, PUSH = 10, 5


@dataclass
class Scene:
    """The problem, its contact and friction, and what presses and pushes the upper flat face."""

    problem: cx.ContactProblem
    contact: cx.Contact
    friction: fem.Constant
    press: fem.DirichletBC
    push: fem.DirichletBC


def create(
    h: float, sliding: str, method: str = story.METHODS[0], h_master: float | None = None
) -> Scene:
    """The cylinders, their flat faces and the contact; cells of one size if the master has none."""
    data = meshes.half_cylinders(RADIUS, h, h if h_master is None else h_master, zone=ZONE)
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    push, press = (story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(2))
    bcs = [*(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2)), push, press]
    upper, lower = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT)
    friction = fem.Constant(data.mesh, 0.0)
    contact = cx.Contact(
        slave=upper, master=lower, friction=friction, sliding=sliding, method=method
    )
    problem = cx.ContactProblem(
        story.elasticity(u, E, NU), u, contacts=[contact], bcs=bcs, petsc_options_prefix="mindlin_"
    )
    return Scene(problem, contact, friction, press, push)


def load(
    problem: cx.ContactProblem,
    moved: fem.DirichletBC,
    force: Callable[[], float],
    target: float,
    first: float,
    steps: int,
) -> None:
    """Move a face until a force is reached within 1e-4.

    The first move should end shortly before; secants of the last two steps do the rest.
    """
    path, end = [(0.0, force())], first
    while abs(force() - target) > 1e-4 * target:
        start = path[-1][0]

        def update(t: float, start: float = start, end: float = end) -> None:
            moved.g.value[...] = start + t * (end - start)

        for step in cx.LoadSteps(problem, steps, update=update):
            path.append((float(moved.g.value), force()))
            text = f"displacement {path[-1][0]:+.5f}: force {force():.5f}, {step.iterations}"
            story.console.print(f"{text} iterations", highlight=False)
        (u_0, f_0), (u_1, f_1) = path[-2:]
        end, steps = u_1 + (target - f_1) * (u_1 - u_0) / (f_1 - f_0), 1


def apply(scene: Scene) -> None:
    """Press without friction, then push with it."""
    problem, contact = scene.problem, scene.contact
    load(problem, scene.press, lambda: contact.force[1], NORMAL, first=-0.18, steps=PRESS)
    scene.friction.value = FRICTION
    load(problem, scene.push, lambda: -contact.force[0], TANGENTIAL, first=0.028, steps=PUSH)


def formula(contact: cx.Contact) -> reference.CattaneoMindlin:
    """The closed formula for the computed forces."""
    return reference.CattaneoMindlin(
        force=contact.force[1],
        radius=RADIUS / 2,
        modulus=reference.contact_modulus(E, NU, E, NU),
        friction=FRICTION,
        tangential=-contact.force[0],
    )


class Tractions:
    """What the contact carries, from left to right.

    Attributes:
        x: Positions of the slave nodes, shape (n,).
        area: Their areas.
        p: Their pressures.
        q: Their shear against the push; by symmetry the interface stays in the plane y = 0.
        status: Their status, 1 where they stick.
    """

    def __init__(self, scene: Scene):
        """Sort the results."""
        contact, V = scene.contact, scene.problem.u.function_space
        x = V.tabulate_dof_coordinates()[contact.slave_nodes, 0]
        order = np.argsort(x)
        nodes = contact.slave_nodes[order]
        self.x, self.area = x[order], contact.area[order]
        self.p, self.status = (f.x.array[nodes] for f in (contact.pressure, contact.status))
        self.q = -contact.traction.x.array.reshape(-1, 2)[nodes, 0]

    def half_width(self, inside: np.ndarray) -> float:
        """Half the width of a strip of nodes, which ends half-way to the next node outside."""
        first, last = np.flatnonzero(inside)[[0, -1]]
        return float(self.x[last : last + 2].sum() - self.x[first - 1 : first + 1].sum()) / 4

    def compare(self, exact: reference.CattaneoMindlin) -> list[story.Result]:
        """Widths, peak and curves against the formula."""
        stick = self.half_width(self.status == 1)
        return [
            story.Result("normal force", NORMAL, exact.force),
            story.Result("tangential force", TANGENTIAL, exact.tangential),
            story.Result("half-width", exact.half_width, self.half_width(self.status > 0)),
            story.Result("peak pressure", exact.peak_pressure, self.p.max()),
            story.Result("half-width that sticks", exact.stick_half_width, stick),
            story.Result.of_curves(
                "pressure's difference / formula's, L2",
                self.area,
                self.p,
                exact.pressure(self.x),
            ),
            story.Result.of_curves(
                "shear's difference / formula's, L2", self.area, self.q, exact.shear(self.x)
            ),
        ]


def draw(
    folder: Path, scene: Scene, tractions: Tractions, exact: reference.CattaneoMindlin
) -> list[Path]:
    """Draw the bodies, and pressure and shear against the formula; write a file for ParaView."""
    files = [folder / f"cattaneo_mindlin{end}" for end in (".png", "_pressure.png", ".pvd")]
    near = np.abs(tractions.x) < ZONE
    x, p, q = (values[near] for values in (tractions.x, tractions.p, tractions.q))
    line = np.linspace(-ZONE, ZONE, 800)
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], scene.problem.u, [scene.contact]) as output:
            output.write(0.0)
        plot.deformed_bodies(
            scene.problem.u,
            scene.contact.pressure,
            files[0],
            title="Two cylinders pressed together and pushed sideways",
            label="contact pressure",
        )
        plot.curves(
            {"pressure": (x, p), "shear / mu": (x, q / FRICTION)},
            {
                "Hertz": (line, exact.pressure(line)),
                "Cattaneo and Mindlin": (line, exact.shear(line) / FRICTION),
            },
            files[1],
            labels=("distance from the middle", "traction"),
            title="Tractions of the slave nodes",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Press, push, compare with the formula and draw."""
    args = story.arguments(
        "Two cylinders with friction", 0.015, "a length; R is 8", argv, methods=True
    )
    with story.progress("meshing"):
        scene = create(args.h, args.sliding, args.method)
    problem, contact = scene.problem, scene.contact
    apply(scene)
    story.console.print(str(problem.report), highlight=False)
    exact, tractions = formula(contact), Tractions(scene)
    results = tractions.compare(exact)
    story.show("Cattaneo and Mindlin: partial slip, forces per length", results)
    story.see(draw(args.output, scene, tractions, exact))
    return results


if __name__ == "__main__":
    main()
