# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A material that hardly changes its volume, in several elements, under a rigid disc.

A square of nu = 0.4999, side 1, E = 1, is held at its bottom and, across them, at its sides; a
rigid disc of radius 0.5 is pressed 0.05 deep into its top, in plane strain. The force tells how
much the elements lock: linear ones, by much; with a pressure beside the displacement (Taylor and
Hood's elements, or MINI's with bubbles), or with a quadratic displacement, they do not.

Where the displacement is a part of a mixed space, ``ContactProblem`` is told which.

    python demos/incompressible.py --h 0.03
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np

import basix.ufl
import ufl
from dolfinx import fem, mesh

import plot
import story

E, NU = 1.0, 0.4999
DEPTH, RADIUS = 0.05, 0.5
# Force with Taylor and Hood's elements on 128 x 128 cells, two triangles each
FORCE = 0.109083
KINDS = ("linear", "MINI", "quadratic", "Taylor-Hood")
# Those that have a pressure beside the displacement
_MIXED = ("MINI", "Taylor-Hood")


class Square:
    """The square in some elements.

    Attributes:
        w: What is solved for: the displacement, or displacement and pressure.
        contact: The contact with the disc.
        problem: The problem.
    """

    def __init__(self, kind: str, n: int, **options: Any):
        """Set up.

        Args:
            kind: One of ``KINDS``.
            n: Number of cells along a side.
            options: Options of the contact.
        """
        domain = mesh.create_unit_square(MPI.COMM_WORLD, n, n)
        mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
        W = fem.functionspace(domain, _element(kind, domain.basix_cell()))
        is_mixed = kind in _MIXED
        self.w = fem.Function(W)
        if is_mixed:
            (u, p), (v, q) = ufl.split(self.w), ufl.TestFunctions(W)
            F = -p * ufl.div(v) * ufl.dx - q * (ufl.div(u) + p / lmbda) * ufl.dx
        else:
            u, v = self.w, ufl.TestFunction(W)
            F = lmbda * ufl.div(u) * ufl.div(v) * ufl.dx
        F += 2 * mu * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)) * ufl.dx
        V = W.sub(0) if is_mixed else W
        bottom, top, sides = (
            mesh.locate_entities_boundary(domain, 1, where)
            for where in (
                lambda x: np.isclose(x[1], 0),
                lambda x: np.isclose(x[1], 1),
                lambda x: np.isclose(x[0] * (1 - x[0]), 0),
            )
        )
        bcs = [
            fem.dirichletbc(0.0, fem.locate_dofs_topological(V.sub(i), 1, facets), V.sub(i))
            for i, facets in ((0, bottom), (1, bottom), (0, sides))
        ]
        tags = mesh.meshtags(domain, 1, np.sort(top), np.full(len(top), 1, dtype=np.int32))
        disc = cx.Sphere(centre=(0.5, 1 + RADIUS - DEPTH), radius=RADIUS)
        self.contact = cx.Contact(cx.Surface(tags, 1), disc, **options)
        self.problem = cx.ContactProblem(
            F,
            self.w,
            contacts=[self.contact],
            bcs=bcs,
            petsc_options_prefix="square_",
            displacement=0 if is_mixed else None,
        )

    @property
    def force(self) -> float:
        """Force of the disc, downwards."""
        return -float(self.contact.force[1])


def _element(kind: str, cell: str) -> Any:
    linear = basix.ufl.element("Lagrange", cell, 1)
    degree = 1 if kind == "linear" else 2
    u = basix.ufl.element("Lagrange", cell, degree, shape=(2,))
    if kind == "MINI":
        bubbles = basix.ufl.element("Bubble", cell, 3)
        u = basix.ufl.blocked_element(basix.ufl.enriched_element([linear, bubbles]), shape=(2,))
    return basix.ufl.mixed_element([u, linear]) if kind in _MIXED else u


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve in all elements, compare and draw."""
    args = story.arguments("A material that hardly changes its volume", 1 / 32, "in sides", argv)
    n = max(1, round(1 / args.h))
    results, squares = [], {}
    for kind in KINDS:
        square = squares[kind] = Square(kind, n, sliding=args.sliding)
        story.solve(square.problem)
        results.append(story.Result(f"force, {kind} elements", FORCE, square.force))
    story.show(f"Square of nu = {NU} under a rigid disc, {n} x {n} cells", results)
    files = [args.output / f"incompressible{end}" for end in (".png", ".pvd")]
    square = squares["Taylor-Hood"]
    pressure = square.w.sub(1).collapse()
    u = fem.Function(fem.functionspace(pressure.function_space.mesh, ("Lagrange", 1, (2,))))
    u.interpolate(square.problem.displacement)
    with story.progress("drawing"):
        plot.deformed_bodies(
            u,
            pressure,
            files[0],
            title="Pressure inside a square that keeps its volume",
            label="pressure / E",
        )
        with cx.VTKOutput(files[1], square.problem.displacement, [square.contact]) as output:
            output.write(0.0)
    story.see(files)
    return results


if __name__ == "__main__":
    main()
