# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""O-ring: a rubber cord is squeezed in its groove, and a fluid presses it against the wall.

The section of a long ring in plane strain, diameter 1, E = 1. The rubber is neo-Hookean and keeps
its volume: Taylor and Hood's elements, in which the displacement is a part of a mixed space. The
lid of the groove, 1.4 wide, comes down by a fifth of the diameter. Then a fluid presses from the
left with up to p = 1, and gets in between ring and groove as far as it presses more than they do;
it pushes the ring over the floor, mu = 0.1, to the wall. Known is

- the force of small squeezes, by Hertz's line contact;
- that of large ones, by Lindley's formula F/(E' d) = 1.25 C^1.5 + 50 C^6 for the squeeze C, with
  the modulus E' = 4 E/3 of plane strain: with Young's, as it is quoted for rings, it would be a
  third below Hertz's where both should hold;
- what holds the ring in the groove: the fluid's pressure on the whole height of the groove;
- why O-rings seal: rubber passes on the fluid's pressure as a fluid does, so that in contact it
  comes on top of that of squeezing, and the peak exceeds the fluid's (A. Karaszkiewicz, Industrial
  and Engineering Chemistry Research 29, 1990, pages 2134 to 2137).

The width of the contact is the sum of the areas of nodes in contact, and goes in steps of a facet
at either end: beside Hertz's it is +2.6 % at h = 0.1, -6.1 % at h = 0.05 and -1.6 % at h = 0.025,
while the force of the large squeeze is within 0.4 % of Lindley's at each.

Against rigid planes both methods of contact come to the same.

    python demos/o_ring.py --h 0.05
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import contactx as cx  # isort: skip

import numpy as np
import numpy.typing as npt
import rolling

import basix.ufl
import ufl
from dolfinx import fem, mesh

import meshes
import plot
import reference
import story
from meshes import Tag

E, DIAMETER, FRICTION = 1.0, 1.0, 0.1
SQUEEZE, WALL, PRESSURE = 0.2, 0.7, 1.0
# Steps of squeezing and of pressing; the first are small squeezes
STEPS = (5, 5)


class ORing:
    """A ring in its groove.

    Attributes:
        w: Displacement and pressure of the rubber.
        floor: Contact with the floor of the groove.
        lid: Contact with the lid.
        wall: Contact with the wall away from the fluid.
        march: The load steps.
        squeezes: Squeeze after each step.
        fluids: Pressure of the fluid after each step.
        forces: Force of the lid after each step, downwards.
        peaks: Largest pressure under the lid after each step.
        width: Width of the contact under the lid, before the fluid comes.
    """

    def __init__(self, h: float, method: str = story.METHODS[0]):
        """Set up.

        Args:
            h: Cell size.
            method: Method of contact.
        """
        data = meshes.cord(h, radius=DIAMETER / 2)
        domain, tags = data.mesh, data.facet_tags
        cell = domain.basix_cell()
        linear = basix.ufl.element("Lagrange", cell, 1)
        quadratic = basix.ufl.element("Lagrange", cell, 2, shape=(2,))
        W = fem.functionspace(domain, basix.ufl.mixed_element([quadratic, linear]))
        self.w = fem.Function(W)
        (u, p), (v, q) = ufl.split(self.w), ufl.TestFunctions(W)
        F = ufl.Identity(2) + ufl.grad(u)
        J, cofactor = ufl.det(F), ufl.det(F) * ufl.inv(F).T
        dx = ufl.dx(metadata={"quadrature_degree": 4})
        stress = E / 3 * (F - ufl.inv(F).T) - p * cofactor
        residual = ufl.inner(stress, ufl.grad(v)) * dx - q * (J - 1) * dx
        # Pressure of the fluid on the deformed surface, where that is wet
        self._wet = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
        self._fluid = fem.Constant(domain, 0.0)
        ds = ufl.Measure(
            "ds", domain=domain, subdomain_data=tags, metadata={"quadrature_degree": 4}
        )(int(Tag.UPPER_CONTACT))
        load = self._fluid * self._wet * cofactor * ufl.FacetNormal(domain)
        residual += ufl.dot(load, v) * ds
        self._push = fem.form(-load[0] * ds)
        surface = cx.Surface(tags, Tag.UPPER_CONTACT)
        self._lid = fem.Constant(domain, (0.0, DIAMETER / 2))
        self.floor, self.lid, self.wall = (
            cx.Contact(surface, cx.Plane(point, normal), friction=FRICTION, method=method)
            for point, normal in (
                ((0, -DIAMETER / 2), (0, 1)),
                (self._lid, (0, -1)),
                ((WALL, 0), (-1, 0)),
            )
        )
        problem = cx.ContactProblem(
            residual,
            self.w,
            displacement=0,
            contacts=[self.floor, self.lid, self.wall],
            petsc_options_prefix="ring_",
        )
        self._ways = self._sides()
        self.march = rolling.March(problem)
        self.squeezes: npt.NDArray[np.float64] = np.zeros(0)
        self.fluids: npt.NDArray[np.float64] = np.zeros(0)
        self.forces: npt.NDArray[np.float64] = np.zeros(0)
        self.peaks: npt.NDArray[np.float64] = np.zeros(0)
        self.width = 0.0

    @property
    def u(self) -> fem.Function:
        """The displacement."""
        return self.march.problem.displacement

    def _sides(self) -> list[npt.NDArray[np.int32]]:
        """Vertices of the surface from the fluid's end to the floor, and to the lid."""
        domain = self._wet.function_space.mesh
        facets = mesh.locate_entities_boundary(domain, 1, lambda x: np.full(x.shape[1], True))
        dofs = fem.locate_dofs_topological(self._wet.function_space, 1, facets)
        x, y = self._wet.function_space.tabulate_dof_coordinates()[dofs, :2].T
        order = np.argsort(x, kind="stable")
        return [dofs[order[(x[order] < 0) & (side * y[order] >= 0)]] for side in (-1, 1)]

    def _wetten(self) -> bool:
        """Let the fluid in by one vertex, where it presses more than the contact does.

        Returns:
            Whether it has come further.
        """
        pressure, has_moved = fem.Function(self._wet.function_space), False
        for way, contact in zip(self._ways, (self.floor, self.lid), strict=True):
            pressure.interpolate(contact.pressure)
            dry = way[self._wet.x.array[way] == 0]
            if len(dry) > 0 and pressure.x.array[dry[0]] < self._fluid.value:
                self._wet.x.array[dry[0]] = 1.0
                has_moved = True
        return has_moved

    def _load(self, t: float) -> None:
        """Squeeze first, and press then."""
        step = t * sum(STEPS)
        self._squeeze = SQUEEZE * min(1.0, step / STEPS[0])
        self._lid.value[1] = (0.5 - self._squeeze) * DIAMETER
        self._fluid.value = PRESSURE * max(0.0, step - STEPS[0]) / STEPS[1]

    def _open(self) -> None:
        """Wet all that is open."""
        pressure = fem.Function(self._wet.function_space)
        for way, contact in zip(self._ways, (self.floor, self.lid), strict=True):
            pressure.interpolate(contact.pressure)
            closed = np.flatnonzero(pressure.x.array[way] > 0)
            self._wet.x.array[way[: closed.min(initial=len(way))]] = 1.0

    def run(self) -> None:
        """Squeeze and press."""
        rows = []
        for step in self.march.steps(sum(STEPS), self._load):
            if round(step.t * sum(STEPS), 9) == STEPS[0]:
                self.width = float(self.lid.area[story.nodal_pressure(self.lid) > 0].sum())
                self._open()
            while self._wetten():
                self.march.problem.solve()
            peak = story.nodal_pressure(self.lid).max()
            rows.append([self._squeeze, float(self._fluid.value), -self.lid.force[1], peak])
        self.squeezes, self.fluids, self.forces, self.peaks = np.array(rows).T

    def compare(self) -> list[story.Result]:
        """Forces and pressures against formulas."""
        cord = reference.SqueezedCord(DIAMETER, E)
        first, last = self.squeezes[0], STEPS[0] - 1
        held = self.floor.force + self.lid.force + self.wall.force
        push = float(fem.assemble_scalar(self._push))
        height = (1 - SQUEEZE) * DIAMETER
        return [
            story.Result(f"force at a squeeze of {first:.2g}", cord.hertz(first), self.forces[0]),
            story.Result(
                f"force at a squeeze of {SQUEEZE:.2g}", cord.lindley(SQUEEZE), self.forces[last]
            ),
            story.Result("width of the contact there", cord.width(self.forces[last]), self.width),
            story.Result("force of the fluid", PRESSURE * height, push),
            story.Result("forces of the groove against it", push, -float(held[0])),
            story.Result(
                "peak under the lid, with the fluid",
                float(self.peaks[last]) + PRESSURE,
                float(self.peaks[-1]),
            ),
        ]


def draw(folder: Path, ring: ORing) -> list[Path]:
    """Draw the pressure in the ring, and the peak under the lid over the fluid's pressure."""
    files = [folder / f"o_ring{end}" for end in (".png", "_peak.png", ".pvd")]
    pressed = np.arange(len(ring.fluids)) >= STEPS[0] - 1
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], ring.u, [ring.floor, ring.lid, ring.wall]) as output:
            output.write(1.0)
        plot.deformed_bodies(
            rolling.at_vertices(ring.u),
            ring.w.sub(1).collapse(),
            files[0],
            title="A fluid presses an O-ring into the corners of its groove",
            label="pressure in the rubber / E",
        )
        ends = np.array([0, PRESSURE])
        plot.curves(
            {"computed": (ring.fluids[pressed], ring.peaks[pressed])},
            {
                "pressure of squeezing + fluid's": (ends, ring.peaks[STEPS[0] - 1] + ends),
                "fluid's: leaks below": (ends, ends),
            },
            files[1],
            labels=("pressure of the fluid / E", "largest pressure under the lid / E"),
            title="An O-ring seals the better, the more it is pressed",
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Squeeze, press, compare and draw."""
    args = story.arguments("An O-ring in its groove", 0.05, "in diameters", argv, methods=True)
    with story.progress("squeezing and pressing"):
        ring = ORing(args.h, args.method)
        ring.run()
    ring.march.tell(args.method, args.h)
    results = ring.compare()
    story.show("O-ring", results)
    story.see(draw(args.output, ring))
    return results


if __name__ == "__main__":
    main()
