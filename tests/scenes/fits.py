# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Round things that exactly fill their holes, meshed by chords that do not match.

- ``PinInHole``: a steel pin in the hole of a plate, in plane strain, pulled along by its own
  weight; lengths in mm, stresses in MPa.
- ``Taper``: a quarter of a tapered stem, 1:10, that is pushed into a socket and pulled out of it.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from scenes.problems import make_problem
from story import displacement, elasticity, fix

type Array = npt.NDArray[np.float64]

# The pin; the plate is a square that is held at its left side
RADIUS, HALF, STEEL, NU = 10.0, 40.0, 210e3, 0.3
# Mean bearing pressure
BEARING = 50.0
PIN, PLATE = 1, 2
PIN_ROUND, HOLE, HELD, SIDES = 11, 12, 13, 14
# By 360 nodes on 360 that match: largest pressure, and half of the angle of contact in degrees
PIN_PEAK, PIN_ANGLE = 55.4, 85.0

# The taper: slope of its sides, its length and radii at its lower end
SLOPE, LENGTH, BORE, OUTER = 0.05, 20.0, 6.0, 14.0
STEM, SOCKET = 1, 2
STEM_CONE, STEM_TOP, SOCKET_CONE, SOCKET_BOTTOM = 10, 11, 20, 22
X0, Y0 = 1, 2
STEM_YOUNG, SOCKET_YOUNG, FRICTION = 110e3, 17e3, 0.2
# Pushed in until time 1, back by a fifth of it until 3
PUSH, BACK = 0.3, 0.03
TIMES = (0.2, 0.4, 0.6, 0.8, 1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0)


def pin_mesh(n_pin: int, n_hole: int) -> MeshData:
    """Mesh pin and plate."""

    def recipe(gmsh: ModuleType) -> None:
        model, occ = gmsh.model, gmsh.model.occ
        pin = occ.addDisk(0, 0, 0, RADIUS, RADIUS)
        square = occ.addRectangle(-HALF, -HALF, 0, 2 * HALF, 2 * HALF)
        hole = occ.addDisk(0, 0, 0, RADIUS, RADIUS)
        plate = occ.cut([(2, square)], [(2, hole)])[0][0][1]
        occ.synchronize()
        groups: dict[int, list[int]] = {}
        for body, number in ((pin, PIN), (plate, PLATE)):
            model.addPhysicalGroup(2, [body], number)
            for _, curve in model.getBoundary([(2, body)], oriented=False):
                low, high = np.array(model.getBoundingBox(1, curve)).reshape(2, 3)
                is_round = max(np.abs(low).max(), np.abs(high).max()) < RADIUS + 1
                if is_round:
                    tag, n = (PIN_ROUND, n_pin) if number == PIN else (HOLE, n_hole)
                else:
                    tag, n = HELD if high[0] < 1 - HALF else SIDES, 12
                groups.setdefault(tag, []).append(curve)
                model.mesh.setTransfiniteCurve(curve, n + 1)
        for tag, curves in groups.items():
            model.addPhysicalGroup(1, curves, tag)
        model.mesh.generate(2)

    grow = {"Mesh.MeshSizeExtendFromBoundary": 1}
    return build_mesh("pin_in_hole", 2, recipe, MPI.COMM_WORLD, grow)


class PinInHole:
    """A weight within the pin pulls it to the right; two of its inner nodes keep their height.

    So it does not turn: without friction nothing else would hold a round pin from that.

    Attributes:
        contact: The pin is the slave.
    """

    def __init__(self, n_pin: int, n_hole: int, bearing: float = BEARING, **options: Any):
        """Create the bodies.

        Args:
            bearing: Mean pressure, by the pin's diameter.
        """
        data = pin_mesh(n_pin, n_hole)
        tags = data.facet_tags
        self.u = u = displacement(data.mesh)
        V = u.function_space
        dx = ufl.Measure("dx", domain=data.mesh, subdomain_data=data.cell_tags)
        pull = bearing * 2 * RADIUS / (np.pi * RADIUS**2)
        F = elasticity(u, STEEL, NU) - pull * ufl.TestFunction(V)[0] * dx(PIN)
        inside = fem.locate_dofs_topological(V, 2, data.cell_tags.find(PIN))
        x = V.tabulate_dof_coordinates()[inside, :2]
        at = [np.linalg.norm(x - [side * RADIUS / 2, 0], axis=1).argmin() for side in (-1, 1)]
        # In the space of both components, which the second one's is a part of
        heights = (2 * inside[at] + 1).astype(np.int32)
        bcs = [fix(u, tags, axis, 0.0, HELD) for axis in range(2)]
        bcs.append(fem.dirichletbc(np.float64(0.0), heights, V.sub(1)))
        pin, hole = cx.Surface(tags, PIN_ROUND), cx.Surface(tags, HOLE)
        self.contact = cx.Contact(pin, hole, **options)
        self.problem = make_problem(F, u, [self.contact], bcs)

    @property
    def stress(self) -> float:
        """Largest norm of the stress, where plane strain's own component does not count."""
        u = self.u
        mu, lmbda = STEEL / (2 * (1 + NU)), STEEL * NU / ((1 + NU) * (1 - 2 * NU))
        strain = ufl.sym(ufl.grad(u))
        stress = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(2)
        W = fem.functionspace(u.function_space.mesh, ("DG", 0))
        norm = fem.Function(W)
        root = ufl.sqrt(ufl.inner(stress, stress))
        norm.interpolate(fem.Expression(root, W.element.interpolation_points))
        return float(norm.x.array.max())

    @property
    def half_angle(self) -> float:
        """Largest angle from the pull at which the pressure is a hundredth of its peak; degrees."""
        nodes = self.contact.slave_nodes
        x = self.u.function_space.tabulate_dof_coordinates()[nodes]
        p = self.contact.pressure.x.array[nodes]
        angle = np.degrees(np.abs(np.arctan2(x[:, 1], x[:, 0])))
        return float(angle[p > 0.01 * p.max()].max())


def taper_mesh(h: float, order: int = 1) -> MeshData:
    """Mesh a quarter of stem and socket."""

    def recipe(gmsh: ModuleType) -> None:
        model, occ = gmsh.model, gmsh.model.occ

        def quarter(body: tuple[int, int]) -> int:
            box = occ.addBox(0, 0, -50, 60, 60, 100)
            return int(occ.intersect([body], [(3, box)])[0][0][1])

        def cone(low: float, high: float) -> tuple[int, int]:
            radii = BORE + SLOPE * low, BORE + SLOPE * high
            return 3, occ.addCone(0, 0, low, 0, 0, high - low, *radii)

        stem = quarter(cone(-4, LENGTH + 4))
        block = (3, occ.addCylinder(0, 0, 0, 0, 0, LENGTH, OUTER))
        socket = quarter(occ.cut([block], [cone(0, LENGTH)])[0][0])
        occ.synchronize()
        for number, body in ((STEM, stem), (SOCKET, socket)):
            model.addPhysicalGroup(3, [body], number)
            groups: dict[int, list[int]] = {}
            for _, face in model.getBoundary([(3, body)], oriented=False):
                groups.setdefault(_side(gmsh, face, number), []).append(face)
            for tag, faces in groups.items():
                model.addPhysicalGroup(2, faces, tag)
        model.mesh.generate(3)
        model.mesh.setOrder(order)

    return build_mesh("taper", 3, recipe, MPI.COMM_WORLD, {"Mesh.MeshSizeMax": h})


def _side(gmsh: ModuleType, face: int, body: int) -> int:
    """Tag of a face of the taper; planes of symmetry have a hundred a body added."""
    low, high = np.array(gmsh.model.getBoundingBox(2, face)).reshape(2, 3)
    for axis, tag in ((0, X0), (1, Y0)):
        if high[axis] < 1e-3:
            return tag + 100 * body
    if high[2] - low[2] < 1e-3:
        return 10 * body + (1 if low[2] > LENGTH / 4 else 2)
    return 10 * body + (0 if body == STEM or high[0] < BORE + 2 else 3)


class Taper:
    """The stem's upper end is driven, the socket stands on its lower one.

    Attributes:
        contact: The socket is the slave, with friction.
        largest: Of the forces on the whole stem: what it is pushed in with.
        least: What it is pulled out with, negative.
    """

    def __init__(self, h: float, order: int = 1, **options: Any):
        data = taper_mesh(h, order)
        tags, u = data.facet_tags, displacement(data.mesh, order)
        young = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
        for tag, value in ((STEM, STEM_YOUNG), (SOCKET, SOCKET_YOUNG)):
            young.x.array[data.cell_tags.find(tag)] = value
        self._top = fix(u, tags, 2, 0.0, STEM_TOP)
        bcs = [
            fix(u, tags, 0, 0.0, X0 + 100 * STEM, X0 + 100 * SOCKET),
            fix(u, tags, 1, 0.0, Y0 + 100 * STEM, Y0 + 100 * SOCKET),
            fix(u, tags, 2, 0.0, SOCKET_BOTTOM),
            self._top,
        ]
        socket, stem = cx.Surface(tags, SOCKET_CONE), cx.Surface(tags, STEM_CONE)
        self.contact = cx.Contact(socket, stem, friction=FRICTION, **options)
        self.problem = make_problem(elasticity(u, young, 0.3), u, [self.contact], bcs)
        self.largest = self.least = 0.0

    def push(self) -> dict[str, float]:
        """Push the stem in, let it go and pull it out.

        Returns:
            Where it is all the way in the number of open nodes, the peak pressure over the mean
            one, and the number of all iterations.
        """

        def update(t: float) -> None:
            self._top.g.value[...] = -PUSH * t if t <= 1 else BACK * (t - 1) - PUSH

        found: dict[str, float] = {"iterations": 0}
        steps = cx.LoadSteps(
            self.problem, list(TIMES), update=update, t_end=TIMES[-1], progress=False
        )
        for step in steps:
            found["iterations"] += step.iterations
            force = -4 * float(self.contact.force[2])
            self.largest, self.least = max(self.largest, force), min(self.least, force)
            if np.isclose(step.t, 1.0):
                nodes = self.contact.slave_nodes
                p = self.contact.pressure.x.array[nodes]
                found["open"] = int(np.sum(self.contact.status.x.array[nodes] == 0))
                found["peak"] = float(p.max() / np.average(p, weights=self.contact.area))
        return found
