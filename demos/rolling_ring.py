# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A thin elastic ring rolls down a slope.

A ring of the outer radius R = 1, thickness 0.05 and density 1 is let go on a rigid slope of a = 20
degrees. With mu = 0.5 above tan(a) / 2 it does not slip, and goes down with the acceleration
g sin a / (1 + k^2 / R^2), with the radius of gyration k: half of g sin a if it is thin. The ring is
a polygon that lands on one node after the other. What these impacts take, and the elastic ring's
swinging under its weight, which is not there at the start, show in the velocity as small waves; the
mean slope of it is compared.

    python demos/rolling_ring.py --h 0.07
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import moving
import numpy as np

import contactx as cx
from dolfinx import fem

import meshes
import plot
import story
from meshes import Tag

RADIUS, THICKNESS = 1.0, 0.05
YOUNG, NU, FRICTION, ANGLE = 1e6, 0.3, 0.5, np.radians(20)
TIME, STEPS = 1.0, 500


class Ring(moving.Run):
    """A ring on the slope.

    Attributes:
        contact: Its outer face on the slope.
        gyration: Square of its radius of gyration.
    """

    def __init__(self, h: float, sliding: str, method: str):
        """Set the problem up."""
        n = max(4, round(np.pi / 2 * RADIUS / h))
        data = meshes.hoop(n, 1, radius=RADIUS, thickness=THICKNESS)
        u = story.displacement(data.mesh)
        self.contact = cx.Contact(
            cx.Surface(data.facet_tags, Tag.UPPER_CONTACT),
            cx.Plane(point=(0, 0), normal=(0, 1)),
            friction=FRICTION,
            sliding=sliding,
            method=method,
        )
        dynamics = moving.on_a_slope(u, [self.contact], YOUNG, NU, ANGLE, "ring_")
        # Of a ring of 4 n straight cells
        inner = RADIUS - THICKNESS
        area = 2 * n * np.sin(np.pi / (2 * n)) * (RADIUS**2 - inner**2)
        self.gyration = (RADIUS**2 + inner**2) / 2
        super().__init__(dynamics, area)

    def speed(self) -> fem.Function:
        """Speeds of the nodes now."""
        V = self.dynamics.velocity.function_space
        speed = fem.Function(fem.functionspace(V.mesh, ("Lagrange", 1)))
        speed.x.array[:] = np.linalg.norm(self.dynamics.velocity.x.array.reshape(-1, 2), axis=1)
        return speed

    def compare(self) -> list[story.Result]:
        """Acceleration and energy."""
        pull = moving.GRAVITY * np.sin(ANGLE)
        slope = float(np.polyfit(self.times, self.velocities(0), 1)[0])
        lost = self.totals[0] - self.totals[-1]
        return [
            story.Result("acceleration", pull / (1 + self.gyration / RADIUS**2), slope),
            story.Result("the same, thin ring: g sin a / 2", pull / 2, slope),
            story.Result("energy lost in contact", lost, self.loss),
        ]


def draw(folder: Path, ring: Ring) -> list[Path]:
    """Draw the velocity over time, and the ring at the end."""
    files = [folder / f"rolling_ring{end}" for end in ("_velocity.png", ".png")]
    t = np.array([0, TIME])
    exact = moving.GRAVITY * np.sin(ANGLE) / (1 + ring.gyration / RADIUS**2) * t
    with story.progress("drawing"):
        plot.curves(
            {"computed": (ring.times[::5], ring.velocities(0)[::5])},
            {"rigid ring": (t, exact)},
            files[0],
            labels=("time", "velocity down the slope"),
            title="A ring rolls down a slope",
        )
        plot.deformed_bodies(
            ring.dynamics.displacement,
            ring.speed(),
            files[1],
            title="The ring after it has rolled down the slope",
            label="speed",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Let the ring roll, compare with a rigid one and draw its velocity."""
    args = story.arguments("A ring rolls down a slope", 0.07, "in radii", argv, methods=True)
    ring = Ring(args.h, args.sliding, args.method)
    with story.progress("rolling"):
        ring.take(STEPS, TIME)
    story.console.print(
        f"energy less the work of loads grows by {ring.growth:.1e} in a step", highlight=False
    )
    results = ring.compare()
    story.show("A ring that rolls", results)
    story.see(draw(args.output, ring))
    return results


if __name__ == "__main__":
    main()
