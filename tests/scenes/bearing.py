# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Five rollers of steel between the rings of a bearing, without clearance, in mm and N."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI

import gmsh
import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io import gmsh as gmshio

from scenes.problems import make_problem
from story import elasticity

YOUNG, POISSON = 210e3, 0.3
# Radii of the inner ring, where the rollers are on it, of these, and of the rim
BORE, INNER, ROLLER, RIM = 22.0, 30.0, 6.0, 50.0
OUTER = INNER + 2 * ROLLER
ANGLES = np.deg2rad([-48.0, -24.0, 0.0, 24.0, 48.0])
INNER_TAG, OUTER_TAG, BORE_TAG, RIM_TAG, FIRST_ROLLER = 1, 2, 3, 4, 10


def make_mesh(size: float) -> Any:
    """Mesh the sector below the axis."""
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Verbosity", 1)
        _draw(size)
        gmsh.model.mesh.generate(2)
        return gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=2)
    finally:
        gmsh.finalize()


def _draw(size: float) -> None:
    occ = gmsh.model.occ

    def sector(inner: float, outer: float) -> int:
        disc = occ.addDisk(0, 0, 0, outer, outer)
        ring = occ.cut([(2, disc)], [(2, occ.addDisk(0, 0, 0, inner, inner))])[0]
        half = np.deg2rad(60)
        corners = [
            occ.addPoint(0, 0, 0),
            occ.addPoint(-99 * np.sin(half), -99 * np.cos(half), 0),
            occ.addPoint(99 * np.sin(half), -99 * np.cos(half), 0),
        ]
        lines = [occ.addLine(corners[k], corners[(k + 1) % 3]) for k in range(3)]
        wedge = occ.addPlaneSurface([occ.addCurveLoop(lines)])
        return int(occ.intersect(ring, [(2, wedge)])[0][0][1])

    middle = INNER + ROLLER
    bodies = [sector(BORE, INNER), sector(OUTER, RIM)]
    bodies += [
        occ.addDisk(middle * np.sin(a), -middle * np.cos(a), 0, ROLLER, ROLLER) for a in ANGLES
    ]
    occ.synchronize()
    for number, body in enumerate(bodies):
        gmsh.model.addPhysicalGroup(2, [body], number + 1)
        lines: dict[int, list[int]] = {}
        for _, line in gmsh.model.getBoundary([(2, body)], oriented=False):
            ends = gmsh.model.getParametrizationBounds(1, line)
            x, y, _ = gmsh.model.getValue(1, line, [0.5 * sum(float(end[0]) for end in ends)])
            r = np.hypot(x, y)
            radii = {INNER_TAG: INNER, OUTER_TAG: OUTER, BORE_TAG: BORE, RIM_TAG: RIM}
            tags = [tag for tag, radius in radii.items() if abs(r - radius) < 0.01]
            if number > 1:
                lines.setdefault(FIRST_ROLLER + number - 2, []).append(line)
            elif tags:
                lines.setdefault(tags[0], []).append(line)
        for tag, found in lines.items():
            gmsh.model.addPhysicalGroup(1, found, tag)
    points = [
        occ.addPoint(r * np.sin(a), -r * np.cos(a), 0) for a in ANGLES for r in (INNER, OUTER)
    ]
    occ.synchronize()
    field = gmsh.model.mesh.field
    field.add("Distance", 1)
    field.setNumbers(1, "PointsList", points)
    field.add("Threshold", 2)
    sizes = {"InField": 1, "SizeMin": size, "SizeMax": 1.5, "DistMin": 0.3, "DistMax": 6}
    for name, value in sizes.items():
        field.setNumber(2, name, value)
    field.setAsBackgroundMesh(2)
    for name in ("FromPoints", "FromCurvature", "ExtendFromBoundary"):
        gmsh.option.setNumber(f"Mesh.MeshSize{name}", 0)


class Bearing:
    """The inner ring is pushed down, the outer one is held.

    Attributes:
        contacts: Of the rollers with the inner and with the outer ring.
    """

    def __init__(self, size: float = 0.06, **options: Any):
        data = make_mesh(size)
        assert data.cell_tags is not None and data.facet_tags is not None
        self._cells = data.cell_tags
        V = fem.functionspace(data.mesh, ("Lagrange", 1, (2,)))
        self.u = fem.Function(V, name="displacement")
        self._down = fem.Constant(data.mesh, (0.0, 0.0))
        still = fem.Constant(data.mesh, (0.0, 0.0))

        def at(tag: int, value: fem.Constant) -> fem.DirichletBC:
            return fem.dirichletbc(
                value, fem.locate_dofs_topological(V, 1, data.facet_tags.find(tag)), V
            )

        tags = range(FIRST_ROLLER, FIRST_ROLLER + len(ANGLES))
        rollers = cx.Surface(data.facet_tags, *tags)
        self.contacts = [
            cx.Contact(rollers, cx.Surface(data.facet_tags, tag), **options)
            for tag in (INNER_TAG, OUTER_TAG)
        ]
        F = elasticity(self.u, YOUNG, POISSON)
        bcs = [at(RIM_TAG, still), at(BORE_TAG, self._down)]
        self.problem = make_problem(F, self.u, self.contacts, bcs)

    def push(self, depth: float) -> None:
        """Set how far the inner ring is down."""
        self._down.value[1] = -depth

    def loads(self) -> list[float]:
        """Force on each roller, from the mean stress in it: one body's forces alone."""
        strain = ufl.sym(ufl.grad(self.u))
        mu = YOUNG / (2 * (1 + POISSON))
        lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
        stress = 2 * mu * strain + lame * ufl.tr(strain) * ufl.Identity(2)
        found = []
        for number, angle in enumerate(ANGLES):
            out = ufl.as_vector((np.sin(angle), -np.cos(angle)))
            dx = ufl.Measure("dx", domain=self.u.function_space.mesh, subdomain_data=self._cells)
            form = fem.form(-ufl.dot(stress * out, out) / (2 * ROLLER) * dx(number + 3))
            comm = self.u.function_space.mesh.comm
            found.append(float(comm.allreduce(fem.assemble_scalar(form), op=MPI.SUM)))
        return found
