# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Self-contact: a clip, a ring with a slit, is pressed together until its tips meet.

The ring has the radius R = 1, the thickness t = 0.1 and a slit of the width s = 0.1 in the middle
of its faces; it is neo-Hookean, E = 1000, nu = 0.3, in plane strain. Its whole boundary is one
surface, slave and master at once. A force P presses the two faces of the slit together. In beam
theory they come closer by 3 pi P R^3 / (E' I), E' = E / (1 - nu^2), I = t^3 / 12, and turn by
2 pi P R^2 / (E' I); they are cut such that they meet in parallel. From then on they carry what P is
larger than the force that closes the slit. Pressed in 1, 4 and 16 steps the clip comes to the same.

    python demos/closing_clip.py --h 0.02
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh

import plot
import story

YOUNG, NU = 1000.0, 0.3
RADIUS, THICKNESS, SLIT = 1.0, 0.1, 0.1
BOUNDARY, UPPER_TIP, LOWER_TIP = 1, 2, 3
STEPS = (1, 4, 16)
# Force over the one that closes the slit, and where the gap before that is looked at
LOAD, HALF = 2.0, 0.5
# Force that closes the slit in beam theory, force/thickness
CLOSING = SLIT * YOUNG / (1 - NU**2) * THICKNESS**3 / 12 / (3 * np.pi * RADIUS**3)


class Clip:
    """The ring.

    Attributes:
        u: Displacement.
        contact: Its boundary on itself.
        problem: The problem.
    """

    def __init__(self, h: float, angle: float = 0.0, **options: object):
        """Set the problem up.

        Args:
            h: Length of the cells along the ring.
            angle: By which the scene is turned.
            options: Options of the contact.
        """
        count = round(2 * np.pi * RADIUS / h)
        # Quadratic cells bend
        domain = mesh.create_rectangle(
            MPI.COMM_WORLD, [[0, 0], [1, 1]], [count, 1], mesh.CellType.quadrilateral
        )
        along, across = domain.geometry.x[:, 0].copy(), domain.geometry.x[:, 1].copy()
        r = RADIUS + THICKNESS * (across - 0.5)
        # They turn by two thirds of the slit over the radius, and are not radial
        half = SLIT / 2 * (1 + 2 / 3 * (r - RADIUS) / RADIUS) / r
        theta = 2 * np.pi - half - along * (2 * np.pi - 2 * half) + angle
        domain.geometry.x[:, 0], domain.geometry.x[:, 1] = r * np.cos(theta), r * np.sin(theta)
        self.tangent = np.array([-np.sin(angle), np.cos(angle)])
        self._radial = np.array([np.cos(angle), np.sin(angle)])
        tags = self._tags(domain)
        self.u = u = story.displacement(domain, 2)
        everywhere = cx.Surface(tags, BOUNDARY, UPPER_TIP, LOWER_TIP)
        self.contact = cx.Contact(slave=everywhere, master=everywhere, **options)
        self._load = fem.Constant(domain, np.zeros(2))
        F = neo_hookean(u) + sum(
            story.traction(u, tags, face, sign * self._load)
            for face, sign in ((UPPER_TIP, -1.0), (LOWER_TIP, 1.0))
        )
        self.problem = cx.ContactProblem(
            F,
            u,
            contacts=[self.contact],
            bcs=[self._held(u)],
            petsc_options_prefix="clip_",
        )

    def _tags(self, domain: mesh.Mesh) -> mesh.MeshTags:
        """Tag the boundary, and the faces of the slit apart."""
        domain.topology.create_connectivity(1, 2)
        facets = mesh.exterior_facet_indices(domain.topology)
        middles = mesh.compute_midpoints(domain, 1, facets)[:, :2]
        height, ahead = middles @ self.tangent, middles @ self._radial
        values = np.full(len(facets), BOUNDARY, dtype=np.int32)
        near = (np.abs(height) < SLIT) & (np.abs(ahead - RADIUS) < 0.1 * THICKNESS)
        values[near & (height > 0)] = UPPER_TIP
        values[near & (height < 0)] = LOWER_TIP
        order = np.argsort(facets)
        return mesh.meshtags(domain, 1, facets[order], values[order])

    def _held(self, u: fem.Function) -> fem.DirichletBC:
        """Hold the ring opposite to the slit."""

        def is_held(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
            ahead, height = self._radial @ x[:2], self.tangent @ x[:2]
            held: npt.NDArray[np.bool_] = (ahead < 0) & (np.abs(height) < 1e-9)
            return held

        V = u.function_space
        return fem.dirichletbc(fem.Function(V), fem.locate_dofs_geometrical(V, is_held))

    def press(self, force: float) -> None:
        """Set the force on each face, force/thickness."""
        self._load.value[:] = force / THICKNESS * self.tangent

    def run(self, force: float, steps: int) -> None:
        """Press in steps."""
        for _ in cx.LoadSteps(
            self.problem, steps, update=lambda t: self.press(t * force), progress=False
        ):
            pass

    @property
    def contact_force(self) -> float:
        """Force between the tips, force/thickness."""
        return float(abs(self.contact.force @ self.tangent))

    @property
    def penetration(self) -> float:
        """Largest depth of a node behind the surface that it meets, of both sides."""
        gap = self.contact.discrete.nodes.gap
        own = max(0.0, -np.nanmin(gap, initial=0.0))
        comm = self.u.function_space.mesh.comm
        return max(comm.allreduce(own, MPI.MAX), self.problem.report.audit.depth)

    def gap(self) -> float:
        """Gap between the middles of the faces of the slit, from their displacements."""
        V = self.u.function_space
        x = V.tabulate_dof_coordinates()[: V.dofmap.index_map.size_local, :2]
        height, ahead = x @ self.tangent, x @ self._radial
        at = (np.abs(ahead - RADIUS) < 0.1 * THICKNESS) & (np.abs(height) < 0.51 * SLIT)
        moved = (x + self.u.x.array.reshape(-1, 2)[: len(x)])[at] @ self.tangent
        return float(V.mesh.comm.allreduce(float(moved @ np.sign(height[at]))))


def neo_hookean(u: fem.Function, young: float = YOUNG, nu: float = NU) -> ufl.Form:
    """Residual of a compressible neo-Hookean material in plane strain."""
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    F = ufl.Identity(2) + ufl.grad(u)
    J = ufl.det(F)
    density = mu / 2 * (ufl.tr(F.T * F) - 2 - 2 * ufl.ln(J)) + lmbda / 2 * ufl.ln(J) ** 2
    return ufl.derivative(density * ufl.dx(metadata={"quadrature_degree": 5}), u)


def draw(folder: Path, clip: Clip) -> list[Path]:
    """Draw the clip and write a file for ParaView."""
    files = [folder / f"closing_clip{end}" for end in (".png", ".pvd")]
    with story.progress("drawing"):
        with cx.VTKOutput(files[1], clip.u, [clip.contact]) as output:
            output.write(1.0)
        # Pictures are of vertices
        domain = clip.u.function_space.mesh
        u = story.displacement(domain)
        u.interpolate(clip.u)
        pressure = fem.Function(fem.functionspace(domain, ("Lagrange", 1)))
        pressure.interpolate(clip.contact.pressure)
        plot.deformed_bodies(
            u,
            pressure,
            files[0],
            title="A clip that is pressed together",
            label="contact pressure",
            box=[[0.7 * RADIUS, -0.3 * RADIUS], [1.1 * RADIUS, 0.3 * RADIUS]],
        )
    return files


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Press the clip, compare it with beam theory and draw it."""
    args = story.arguments("A clip that closes", 0.05, "of a ring of radius 1", argv)
    before = Clip(args.h)
    before.run(HALF * CLOSING, 1)
    results = [story.Result("gap at half of the force that closes it", HALF * SLIT, before.gap())]
    for steps in STEPS:
        with story.progress(f"pressing in {steps} steps"):
            clip = Clip(args.h)
            clip.run(LOAD * CLOSING, steps)
        results.append(
            story.Result(
                f"force between the tips, {steps} steps", (LOAD - 1) * CLOSING, clip.contact_force
            )
        )
        story.console.print(
            f"{steps} steps: the tips penetrate each other by "
            f"{clip.penetration / THICKNESS:.1e} of the thickness",
            highlight=False,
        )
    story.show("Closing clip", results)
    story.see(draw(args.output, clip))
    return results


if __name__ == "__main__":
    main()
