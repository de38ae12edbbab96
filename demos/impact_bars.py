# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Impact of elastic bars: one on a rigid wall, and two on each other.

A bar of the length L = 1, with E = 1, density 1 and nu = 0, hits a wall with the velocity v, or two
such bars hit each other with v each. A wave of the velocity c = sqrt(E / rho) stops the bar layer
by layer, comes back from the free end and sets it going: the contact force is rho c v A throughout,
contact ends after 2 L / c, and the bar then goes as fast as it came, without stress (Timoshenko &
Goodier, Theory of Elasticity, section 169).

``ContactDynamics`` follows this without swings of the contact force. An impact costs the kinetic
energy of the half cell at the bar's end, 1 / (2 n) with n cells, and nothing else.

    python demos/impact_bars.py --h 0.005
    python demos/impact_bars.py --h 0.005 --courant 2 --method surface-to-surface
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import contactx as cx
import ufl
from dolfinx.mesh import CellType

import meshes
import plot
import story
from meshes import Tag

LENGTH, VELOCITY = 1.0, 0.01
# Times c / L up to which is computed, and between which the force is averaged
END, BETWEEN = 2.5, (0.5, 1.5)
SCENES = ("bar on a wall", "two bars")


def strain_energy(w: ufl.core.expr.Expr) -> ufl.Form:
    """Strain energy of a displacement, E = 1 and nu = 0."""
    strain = ufl.sym(ufl.grad(w))
    return 0.5 * ufl.inner(strain, strain) * ufl.dx


class Bars:
    """Bars that hit each other, or a wall.

    The upper one falls on the lower one, or on a plane.

    Attributes:
        dynamics: The problem.
        contact: Its contact.
        width: Width of the bars.
        times: Ends of the time steps.
        forces: Mean contact forces of the time steps over rho c v A.
        energies: Energies at the start and at the end of each step.
        iterations: Linear solves of each step.
        velocity: Mean velocity of the upper bar at the end.
    """

    def __init__(
        self,
        scene: str,
        n: int,
        courant: float,
        method: str = story.METHODS[0],
        *,
        mass: str | None = None,
        part: float = 0.3,
    ):
        """Set the problem up.

        Args:
            scene: One of ``SCENES``.
            n: Number of cells along a bar.
            courant: Time step over the time that a wave takes through a cell.
            method: Method of contact.
            mass: Kind of the masses.
            part: Part of a time step after which the bars meet, above 0.
        """
        self.width, self.dt = LENGTH / n, courant * LENGTH / n
        size = (self.width, LENGTH)
        gap = (1 if scene == SCENES[0] else 2) * part * VELOCITY * self.dt
        data = meshes.blocks(
            CellType.quadrilateral,
            (1, n),
            (1, n),
            size_upper=size,
            size_lower=size,
            gap=gap,
        )
        if scene == SCENES[0]:
            mesh, tags = meshes.single(data, Tag.UPPER)
            master: cx.Plane | cx.Surface = cx.Plane(point=(0, 0), normal=(0, 1))
        else:
            mesh, tags = data.mesh, data.facet_tags
            master = cx.Surface(tags, Tag.LOWER_CONTACT)
        u = story.displacement(mesh)
        self.contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), master, method=method)
        v = ufl.TestFunction(u.function_space)
        self.dynamics = cx.ContactDynamics(
            lambda w: ufl.inner(ufl.sym(ufl.grad(w)), ufl.grad(v)) * ufl.dx,
            u,
            density=1.0,
            contacts=[self.contact],
            petsc_options_prefix="bars_",
            strain_energy=strain_energy,
            mass=mass,
        )
        self.dynamics.velocity.interpolate(
            lambda x: np.stack([0 * x[0], np.where(x[1] > gap / 2, -VELOCITY, VELOCITY)])
        )
        self._start = self.dynamics.kinetic_energy()
        self.times: list[float] = []
        self.forces: list[float] = []
        self.energies = [self._start]
        self.iterations: list[int] = []
        self.impulse = 0.0

    def run(self) -> None:
        """Take all time steps."""
        scale = VELOCITY * self.width
        steps = int(np.ceil(END / self.dt))
        for step in cx.LoadSteps(
            self.dynamics, steps, lambda t: None, t_end=steps * self.dt, progress=False
        ):
            balance = step.report.balance
            assert balance is not None
            self.times.append(step.t)
            self.forces.append(float(balance.impulse[0][1]) / balance.dt / scale)
            self.energies.append(balance.energy)
            self.iterations.append(step.iterations)
            self.impulse += float(balance.impulse[0][1])

    @property
    def velocity(self) -> float:
        """Mean velocity of the upper bar now: what the impulses of contact have made of it."""
        return self.impulse / (LENGTH * self.width) - VELOCITY

    @property
    def steady(self) -> np.ndarray:
        """Forces between 0.5 and 1.5 L / c."""
        t = np.array(self.times)
        return np.array(self.forces)[(t > BETWEEN[0]) & (t < BETWEEN[1])]

    @property
    def swing(self) -> float:
        """Largest less smallest force between these times, over rho c v A."""
        return float(np.ptp(self.steady))

    @property
    def loss(self) -> float:
        """Energy that was lost, over that of the start."""
        return 1 - self.energies[-1] / self._start

    @property
    def growth(self) -> float:
        """Largest growth of energy in a step, over that of the start."""
        return float(np.diff(self.energies).max() / self._start)

    @property
    def duration(self) -> float:
        """Time of contact."""
        pressed = np.array(self.times)[np.array(self.forces) > 0]
        # An impact within a step is at its end for the forces
        return float(pressed[-1] - pressed[0] + self.dt)

    def compare(self, scene: str) -> list[story.Result]:
        """Force, time and velocity against the waves' theory."""
        return [
            story.Result(f"{scene}: force / rho c v A", 1.0, float(self.steady.mean())),
            story.Result(f"{scene}: time of contact c / L", 2.0, self.duration),
            story.Result(f"{scene}: velocity after / v", 1.0, self.velocity / VELOCITY),
            story.Result(f"{scene}: energy after / before", 1.0, 1 - self.loss),
        ]


def draw(folder: Path, bars: dict[str, Bars]) -> list[Path]:
    """Draw forces over time."""
    file = folder / "impact_bars.png"
    with story.progress("drawing"):
        plot.curves(
            {name: (b.times, b.forces) for name, b in bars.items()},
            {"exact": ([0, 0, 2, 2, END], [0, 1, 1, 0, 0])},
            file,
            labels=("time c / L", "contact force / rho c v A"),
            title="Impact of elastic bars",
            joined=True,
            close_up=(0, 0.25),
        )
    return [file]


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Let the bars hit, compare with the waves' theory and draw the forces."""
    parser = argparse.ArgumentParser(description="Impact of elastic bars")
    parser.add_argument("--h", type=float, default=0.005, help="cell size, in lengths of the bar")
    parser.add_argument("--courant", type=float, default=0.5, help="Courant number")
    parser.add_argument("--method", choices=story.METHODS, default=story.METHODS[0])
    parser.add_argument("--output", type=Path, default=Path(__file__).parent / "output")
    args = parser.parse_args(argv)
    bars, results = {}, []
    for scene in SCENES:
        with story.progress(scene):
            bars[scene] = Bars(scene, round(LENGTH / args.h), args.courant, args.method)
            bars[scene].run()
        results += bars[scene].compare(scene)
        story.console.print(
            f"{scene}: the force swings by {100 * bars[scene].swing:.2g} %, energy grows by "
            f"{bars[scene].growth:.1e} of the start's in a step",
            highlight=False,
        )
    story.show("Impact of bars", results)
    story.see(draw(args.output, bars))
    return results


if __name__ == "__main__":
    main()
