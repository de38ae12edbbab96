# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bolt: tightened, its joint pulled until it opens, released, and pushed sideways until it slips.

A bolt of diameter 1, its head as wide as the sleeve that it clamps on a tapped block; E = 1,
nu = 0.3, half of it, linear tetrahedra with a quadratic displacement. The thread is tied to the
block; sleeve on block and head on sleeve rub with mu = 0.2. The shank is given a strain that would
shorten it by 0.004 if it were free: that is the pre-tension. A load is then spread over a band
around the sleeve: upwards, beyond what opens the joint; off again; and sideways by springs whose
ends are moved. The joint is two springs, the bolt and the sleeve (VDI 2230), so that

- the pre-tension is the shortening over the sum of their resiliences; a thread that is tied yields
  less than one with flanks, so that the bolt is stiffer by a tenth than the guideline has it;
- of a load F the bolt feels the share phi F while the joint is closed, and all of it once that is
  open; phi is the resilience of the sleeve below the load over the sum that the pre-tension tells;
- the joint opens at F_V/(1 - phi), and once the load is off the pre-tension F_V is back;
- the sleeve slips on the block when friction carries mu F_V. The bolt, bent, carries some more.

Both methods run.

    python demos/bolt.py --h 0.3
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import contactx as cx  # isort: skip

import numpy as np
import numpy.typing as npt
import rolling

import ufl
from dolfinx import fem

import meshes
import plot
import reference
import story
from meshes import BoltTag

E, NU, FRICTION, SHORTENING = 1.0, 0.3, 0.2, 0.004
MEASURES = meshes.BoltMeasures()
# Load over the one that should open the joint, and sideways displacement of the springs, both at
# most; their stiffness
PULL, PUSH, SPRINGS = 1.35, 0.005, 10.0
# Steps that tighten, pull, release and push
STEPS = (1, 4, 2, 4)


def springs() -> reference.BoltedJoint:
    """The joint as two springs."""
    m = MEASURES
    return reference.BoltedJoint(E, m.shank, m.hole, m.outer, m.grip)


def part() -> float:
    """Part of the sleeve that the load relieves."""
    return sum(MEASURES.band) / 2 / MEASURES.grip


class Bolt:
    """A bolted joint; forces are those of the whole.

    Attributes:
        u: Displacement, of degree 2.
        seat: The head on the sleeve.
        joint: The sleeve on the block.
        march: The load steps.
        loads: Load upwards after each step.
        bolts: Force in the bolt after each step.
        clamps: Force between sleeve and block after each step.
        sides: Load sideways after each step.
        shears: Friction between sleeve and block after each step.
    """

    def __init__(self, h: float, method: str):
        """Set up.

        Args:
            h: Cell size.
            method: Method of contact.
        """
        data = meshes.bolt(h, MEASURES)
        domain, tags = data.mesh, data.facet_tags
        self.u = u = story.displacement(domain, 2)
        self._domain, self._tags = domain, tags
        v = ufl.TestFunction(u.function_space)
        mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
        shank = rolling.of_bodies(domain, data.cell_tags, {BoltTag.SHANK: 1.0})
        self._strain = fem.Constant(domain, 0.0)
        axis = ufl.as_vector([0.0, 0.0, 1.0])
        strain = ufl.sym(ufl.grad(u)) + shank * self._strain * ufl.outer(axis, axis)
        stress = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(3)
        F = ufl.inner(stress, ufl.grad(v)) * ufl.dx(metadata={"quadrature_degree": 4})
        ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)(int(BoltTag.SLEEVE_BAND))
        area = fem.assemble_scalar(fem.form(fem.Constant(domain, 1.0) * ds))
        self._pull, self._push, self._spring = (fem.Constant(domain, 0.0) for _ in range(3))
        side = self._spring * (self._push - u[0])
        # Of the load half is on half of the joint
        F -= (side * v[0] + self._pull * v[2]) / (2 * area) * ds
        self._side = fem.form(side / area * ds)
        surface = {tag: cx.Surface(tags, tag) for tag in BoltTag if tags.find(tag).size}
        self.seat = cx.Contact(
            surface[BoltTag.BOLT_SEAT],
            surface[BoltTag.SLEEVE_TOP],
            friction=FRICTION,
            method=method,
        )
        self.joint = cx.Contact(
            surface[BoltTag.SLEEVE_BOTTOM],
            surface[BoltTag.BLOCK_TOP],
            friction=FRICTION,
            method=method,
        )
        thread = cx.Contact(
            surface[BoltTag.BOLT_THREAD], surface[BoltTag.BLOCK_THREAD], tied=True, method=method
        )
        problem = cx.ContactProblem(
            F,
            u,
            contacts=[self.seat, self.joint, thread],
            bcs=[
                *(story.fix(u, tags, i, 0.0, BoltTag.BLOCK_BOTTOM) for i in range(3)),
                story.fix(u, tags, 1, 0.0, BoltTag.SYMMETRY),
            ],
            petsc_options_prefix="bolt_",
        )
        self.march = rolling.March(problem)
        self.loads: npt.NDArray[np.float64] = np.zeros(0)
        self.bolts: npt.NDArray[np.float64] = np.zeros(0)
        self.clamps: npt.NDArray[np.float64] = np.zeros(0)
        self.sides: npt.NDArray[np.float64] = np.zeros(0)
        self.shears: npt.NDArray[np.float64] = np.zeros(0)

    def _load(self, t: float) -> None:
        """Tighten, pull, release and push."""
        step, parts = t * sum(STEPS), []
        for steps in STEPS:
            parts.append(min(1.0, max(0.0, step / steps)))
            step -= steps
        tighten, pull, release, push = parts
        spring = springs()
        opening = spring.preload(SHORTENING) / (1 - spring.share(part()))
        self._strain.value = SHORTENING / MEASURES.grip * tighten
        self._pull.value = PULL * opening * (pull - release)
        # Springs come when there is nothing to hold yet
        self._spring.value = SPRINGS * E if push > 0 else 0.0
        self._push.value = PUSH * push

    def run(self) -> None:
        """Go through all of it."""
        rows = []
        for _ in self.march.steps(sum(STEPS), self._load):
            rows.append(
                [
                    float(self._pull.value),
                    2 * self.seat.force[2],
                    2 * self.joint.force[2],
                    fem.assemble_scalar(self._side),
                    -2 * self.joint.force[0],
                ]
            )
        self.loads, self.bolts, self.clamps, self.sides, self.shears = np.array(rows).T

    def ends(self) -> list[int]:
        """Last step of tightening, pulling, releasing and pushing."""
        n = len(self.loads)
        top = int(self.loads.argmax())
        off = top + 1 + int(np.argmin(self.loads[top + 1 :] > 0))
        return [int(np.argmax(self.loads > 0)) - 1, top, off, n - 1]

    def compare(self, name: str) -> list[story.Result]:
        """Forces against the two springs."""
        spring = springs()
        tight, top, off, end = self.ends()
        preload = self.bolts[tight]
        share = part() * spring.clamped * preload / SHORTENING
        felt = (self.bolts[tight + 2] - preload) / self.loads[tight + 2]
        # Where the force between sleeve and block would be gone, by the last two steps with one
        closed = np.flatnonzero(self.clamps[: top + 1] > 1e-6 * preload)[-2:]
        slope = np.diff(self.clamps[closed]) / np.diff(self.loads[closed])
        opening = float(self.loads[closed[-1]] - self.clamps[closed[-1]] / slope[0])
        return [
            story.Result(f"{name}: pre-tension", spring.preload(SHORTENING), preload),
            story.Result(f"{name}: share of the load", share, felt),
            story.Result(f"{name}: load that opens", preload / (1 - felt), opening),
            story.Result(f"{name}: bolt, open", self.loads[top], self.bolts[top]),
            story.Result(f"{name}: pre-tension after", preload, self.bolts[off]),
            story.Result(f"{name}: friction, slipping", FRICTION * preload, self.shears[end]),
        ]


def draw(folder: Path, runs: dict[str, Bolt]) -> list[Path]:
    """Draw the forces over the load, and the bent joint."""
    files = [folder / f"bolt{end}" for end in (".png", "_forces.png", ".pvd")]
    last = list(runs.values())[-1]
    spring = springs()
    preload, phi = spring.preload(SHORTENING), spring.share(part())
    opening = preload / (1 - phi)
    loads = np.array([0.0, 1.0, PULL]) * opening
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], last.u, [last.seat, last.joint]) as output:
            output.write(1.0)
        pressure = fem.Function(fem.functionspace(last.u.function_space.mesh, ("Lagrange", 1)))
        pressure.interpolate(last.joint.pressure)
        plot.deformed_bodies(
            rolling.at_vertices(last.u),
            pressure,
            files[0],
            title="A bolted joint that slips",
            label="pressure between sleeve and block / E",
            scale=30.0,
            camera=(0.3, -1.0, 0.3),
        )
        computed = {}
        for method, run in runs.items():
            tight, top, _, _ = run.ends()
            steps = slice(tight, top + 1)
            computed[f"bolt, {method}"] = (run.loads[steps], run.bolts[steps])
            computed[f"sleeve, {method}"] = (run.loads[steps], run.clamps[steps])
        plot.curves(
            computed,
            {
                "bolt, VDI 2230": (loads, [preload, opening, PULL * opening]),
                "sleeve, VDI 2230": (loads, [preload, 0.0, 0.0]),
            },
            files[1],
            labels=("load / (E d^2)", "force / (E d^2)"),
            title="A bolted joint that is pulled open",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Load by both methods, compare and draw."""
    args = story.arguments("A bolt with pre-tension", 0.3, "in diameters", argv)
    runs, results = {}, []
    for method in story.METHODS:
        with story.progress(f"loading, {method}"):
            run = Bolt(args.h, method)
            run.run()
        run.march.tell(method, args.h)
        runs[method] = run
        results += run.compare(method)
    story.show("Bolt", results)
    story.see(draw(args.output, runs))
    return results


if __name__ == "__main__":
    main()
