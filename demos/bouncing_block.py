# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block slides down a slope with friction, resting on it and bouncing.

An elastic block, 2 long and 0.5 high, density 1, is let go on a rigid slope of 30 degrees, or above
it. With Coulomb's friction mu = 0.2 it goes down with the acceleration g (sin a - mu cos a) in the
mean, also where it bounces: friction takes mu times the impulse of the normal forces, and all of
them together carry what of the weight does not become momentum normal to the slope. With m for the
mass, p_n for this momentum at the end and T for the time, the velocity along the slope is

    v = g sin a T - mu (g cos a T + p_n / m).

Energy grows in no step by more than loads have worked, and what is lost is what contact has taken,
to rounding. The block's material is Saint Venant and Kirchhoff's, which may turn; its midpoint rule
keeps energy (``moving.py``).

    python demos/bouncing_block.py --h 0.25
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import moving
import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

import meshes
import plot
import story
from meshes import Tag

SIZE = (2.0, 0.5)
YOUNG, NU, FRICTION, ANGLE = 1e6, 0.3, 0.2, np.pi / 6
TIME, STEPS = 1.0, 500
DROPS = {"resting": 1e-9, "bouncing": 0.05}
ALONG, ACROSS = moving.GRAVITY * np.sin(ANGLE), moving.GRAVITY * np.cos(ANGLE)


class Block(moving.Run):
    """A block on the slope, or above it.

    Attributes:
        contact: Its lower face on the slope.
    """

    def __init__(self, h: float, drop: float, sliding: str, method: str):
        """Set the problem up."""
        n = [max(1, round(length / h)) for length in SIZE]
        data = meshes.blocks(
            CellType.quadrilateral, n, n, size_upper=SIZE, size_lower=SIZE, gap=drop
        )
        mesh, tags = meshes.single(data, Tag.UPPER)
        u = story.displacement(mesh)
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Plane(point=(0, 0), normal=(0, 1)),
            friction=FRICTION,
            sliding=sliding,
            method=method,
        )
        dynamics = moving.on_a_slope(u, [self.contact], YOUNG, NU, ANGLE, "block_")
        super().__init__(dynamics, SIZE[0] * SIZE[1])

    def exact(self) -> np.ndarray:
        """Velocities along the slope, from those normal to it."""
        t = np.array(self.times)
        return ALONG * t - FRICTION * (ACROSS * t + self.velocities(1))

    def compare(self, name: str) -> list[story.Result]:
        """Velocity, friction and energy."""
        lost = self.totals[0] - self.totals[-1]
        return [
            story.Result(
                f"{name}: acceleration", ALONG - FRICTION * ACROSS, self.velocities(0)[-1] / TIME
            ),
            story.Result(f"{name}: velocity after T", self.exact()[-1], self.velocities(0)[-1]),
            story.Result(
                f"{name}: friction / normal impulse", FRICTION, -self.impulse[0] / self.impulse[1]
            ),
            story.Result(f"{name}: energy lost in contact", lost, self.loss),
        ]


def draw(folder: Path, blocks: dict[str, Block]) -> list[Path]:
    """Draw velocities over time, and the bouncing block at the end."""
    files = [folder / f"bouncing_block{end}" for end in ("_velocity.png", ".png")]
    t = np.array([0, TIME])
    resting = (ALONG - FRICTION * ACROSS) * t
    with story.progress("drawing"):
        # Lines of a point every tenth step
        plot.curves(
            {
                **{
                    f"{n}, along": (b.times[::10], b.velocities(0)[::10]) for n, b in blocks.items()
                },
                "bouncing, normal": (
                    blocks["bouncing"].times[::10],
                    blocks["bouncing"].velocities(1)[::10],
                ),
            },
            {"g (sin a - mu cos a) t": (t, resting)},
            files[0],
            labels=("time", "mean velocity of the block"),
            title="A block on a slope with friction",
            joined=True,
        )
        last = blocks["bouncing"]
        plot.deformed_bodies(
            last.dynamics.displacement,
            last.contact.pressure,
            files[1],
            title="The block after it has bounced down the slope",
            label="contact pressure",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Let the blocks go, compare with Coulomb's law and draw their velocities."""
    args = story.arguments(
        "A block slides and bounces down a slope",
        0.25,
        "in heights of two blocks",
        argv,
        methods=True,
    )
    blocks, results = {}, []
    for name, drop in DROPS.items():
        with story.progress(f"{name} block"):
            blocks[name] = Block(args.h, drop, args.sliding, args.method)
            blocks[name].take(STEPS, TIME)
        results += blocks[name].compare(name)
        story.console.print(
            f"{name}: energy less the work of loads grows by {blocks[name].growth:.1e} in a step",
            highlight=False,
        )
    story.show("Coulomb: a block on a slope", results)
    story.see(draw(args.output, blocks))
    return results


if __name__ == "__main__":
    main()
