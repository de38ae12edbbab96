# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A soft block pressed through 30 % of its height: finite strain, any UFL material.

A compressible neo-Hookean block, E = 1, nu = 0.3, energy density

    mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2,

is pressed by its glued top on a rigid ball and on a wider block of the same material. contactx
takes the material as it stands in UFL. There is no closed formula, but a balance to keep: without
friction the work done on the top is the energy stored.

    python demos/finite_strain.py --h 0.2
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType, Mesh, MeshTags

import meshes
import plot
import story
from meshes import Tag

E, NU = 1.0, 0.3
DEPTH = 0.3


def energy(u: fem.Function) -> ufl.Form:
    """Energy of the neo-Hookean bodies."""
    mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
    F = ufl.Identity(3) + ufl.grad(u)
    J = ufl.det(F)
    density = mu / 2 * (ufl.tr(F.T * F) - 3 - 2 * ufl.ln(J)) + lmbda / 2 * ufl.ln(J) ** 2
    # UFL would estimate a degree far beyond what trilinear displacements deserve
    return density * ufl.dx(metadata={"quadrature_degree": 3})


class Press:
    """A unit block whose glued top moves down onto something.

    Attributes:
        u: Displacement.
        contact: The block's lower face on what is below it.
        problem: The problem.
        volume: Largest and smallest ratio of volumes of a cell, a function to call.
    """

    def __init__(self, mesh: Mesh, tags: MeshTags, master: cx.Surface | cx.Sphere, sliding: str):
        """Set the problem up; a lower block is fixed at its bottom."""
        self.u = u = story.displacement(mesh)
        bottom = [Tag.LOWER_BOTTOM] if Tag.LOWER_BOTTOM in tags.values else []
        self._top = story.fix(u, tags, 2, 0.0, Tag.UPPER_TOP)
        bcs = [
            *(story.fix(u, tags, i, 0.0, Tag.UPPER_TOP, *bottom) for i in range(2)),
            *(story.fix(u, tags, 2, 0.0, face) for face in bottom),
            self._top,
        ]
        self._energy = fem.form(energy(u))
        residual = ufl.derivative(energy(u), u)
        self._residual = fem.form(residual)
        self.contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), master, sliding=sliding)
        self.problem = cx.ContactProblem(
            residual, u, contacts=[self.contact], bcs=bcs, petsc_options_prefix="press_"
        )

    def run(self, steps: int, solve: Callable[[cx.ContactProblem], object]) -> tuple[float, float]:
        """Press in equal steps.

        Returns:
            Work done on the top, by Simpson's rule over pairs of steps, and energy stored.
        """
        forces = [0.0]
        for step in range(1, steps + 1):
            self._top.g.value[...] = -DEPTH * step / steps
            solve(self.problem)
            forces.append(self.reaction())
        weights = np.array([1, *[4, 2] * (steps // 2 - 1), 4, 1]) / 3
        work = float(weights @ forces) * DEPTH / steps
        return work, float(fem.assemble_scalar(self._energy))

    def reaction(self) -> float:
        """Force that presses the top down."""
        forces = fem.assemble_vector(self._residual).array
        return float(-forces[self._top.dof_indices()[0]].sum())

    def volume_ratios(self) -> tuple[float, float]:
        """Smallest and largest det F."""
        V = fem.functionspace(self.u.function_space.mesh, ("DG", 0))
        J = fem.Function(V)
        F = ufl.Identity(3) + ufl.grad(self.u)
        J.interpolate(fem.Expression(ufl.det(F), V.element.interpolation_points))
        return float(J.x.array.min()), float(J.x.array.max())


def on_ball(n: int, sliding: str) -> Press:
    """A block on a rigid ball."""
    data = meshes.blocks(CellType.hexahedron, (n, n, n), (1, 1, 1), shift=(-0.5, -0.5))
    mesh, tags = meshes.single(data, Tag.UPPER)
    return Press(mesh, tags, cx.Sphere(centre=(0, 0, -1), radius=1.0), sliding)


def on_block(n: int, sliding: str) -> Press:
    """A block on a wider one of other divisions."""
    wider = (n + n // 2 + 1, n + n // 2 + 1, n)
    data = meshes.blocks(
        CellType.hexahedron, (n, n, n), wider, size_lower=(1.6, 1.6, 1), shift=(0.3, 0.3)
    )
    master = cx.Surface(data.facet_tags, Tag.LOWER_CONTACT)
    return Press(data.mesh, data.facet_tags, master, sliding)


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Press both, compare work with energy and draw."""
    args = story.arguments(
        "A soft block pressed through 30 % of its height", 0.2, "in heights", argv
    )
    n = int(np.ceil(1 / args.h))
    results, presses = [], {}
    for name, make in (("ball", on_ball), ("block", on_block)):
        with story.progress("meshing"):
            press = make(n, args.sliding)
        work, stored = press.run(8, story.solve)
        force = abs(press.contact.force[2])
        least, most = press.volume_ratios()
        story.console.print(f"det F of the cells on the {name}: {least:.3f} to {most:.3f}")
        results += [
            story.Result(f"{name}: energy stored against work done", work, stored),
            story.Result(f"{name}: contact force against reaction", press.reaction(), force),
        ]
        presses[name] = press
    story.show("Finite strain", results)
    for name, press in presses.items():
        stem = args.output / f"finite_strain_{name}"
        with cx.VTKOutput(stem.with_suffix(".pvd"), press.u, [press.contact]) as output:
            output.write(DEPTH)
        with story.progress("drawing"):
            plot.deformed_bodies(
                press.u,
                press.contact.pressure,
                stem.with_suffix(".png"),
                title=f"Neo-Hookean block, pressed on a {name} through 30 % of its height",
                label="contact pressure / E",
            )
        story.see([stem.with_suffix(".png"), stem.with_suffix(".pvd")])
    return results


if __name__ == "__main__":
    main()
