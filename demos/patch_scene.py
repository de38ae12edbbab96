# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks on each other whose exact stress is uniform, on meshes that do not match.

Both far ends carry the exact displacement, which is linear in each block. Poisson's ratio of the
softer block is chosen so that both are strained alike along the interface and do not slide.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

import basix
import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag

NU = 0.3
STRAIN = 0.01
_SIDES = ("X0", "X1", "Y0", "Y1")

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """Two blocks of height one; the interface goes through the origin.

    Attributes:
        cell_type: Triangle, quadrilateral, tetrahedron or hexahedron.
        upper: Number of cells of the upper block along each edge.
        lower: The same for the lower block.
        distortion: How far nodes move at random, in cells; those of a face stay in its plane.
        seed: Seed of these movements. Equal grids move alike on both sides of the interface.
        lean: Slope of the side faces against the interface's normal.
        turn: Rotation of the whole scene, shape (dim, dim); none if None.
        width_lower: Width of the lower block; the upper one is 1 wide.
        shift: Where the upper block begins along each edge of the lower one.
    """

    cell_type: CellType
    upper: int = 4
    lower: int = 3
    distortion: float = 0.15
    seed: int = 0
    lean: float = 0.0
    turn: Array | None = None
    width_lower: float = 1.0
    shift: float = 0.0

    @property
    def dim(self) -> int:
        """Dimension."""
        return 2 if self.cell_type in (CellType.triangle, CellType.quadrilateral) else 3

    @property
    def frame(self) -> Array:
        """Rotation, its last column the normal of the interface, shape (dim, dim)."""
        return np.eye(self.dim) if self.turn is None else self.turn

    def mesh(self) -> MeshData:
        """Mesh the blocks, move the nodes, lean and turn everything."""
        dim = self.dim
        data = meshes.blocks(
            self.cell_type,
            (self.upper,) * dim,
            (self.lower,) * dim,
            size_lower=(*(self.width_lower,) * (dim - 1), 1.0),
            shift=(self.shift,) * (dim - 1),
        )
        x = data.mesh.geometry.x
        for body, n in ((Tag.UPPER, self.upper), (Tag.LOWER, self.lower)):
            nodes = np.unique(data.mesh.geometry.dofmaps[0][data.cell_tags.find(body)])
            x[nodes, :dim] += self._movements(x[nodes, :dim], n, body == Tag.LOWER)
        x[:, 0] += self.lean * x[:, dim - 1]
        x[:, :dim] = x[:, :dim] @ self.frame.T
        return data

    def _movements(self, x: Array, n: int, below: bool) -> Array:
        """Movements of the nodes x of a block of n cells along each edge."""
        low, high = x.min(axis=0), x.max(axis=0)
        place = np.rint(n * (x - low) / (high - low)).astype(int)
        if below:
            # Height counts from the interface on both sides
            place[:, -1] = n - place[:, -1]
        draw = np.random.default_rng(self.seed).uniform(-1, 1, (*(n + 1,) * self.dim, self.dim))
        moved = self.distortion * (high - low) / n * draw[tuple(place.T)]
        return np.where((place == 0) | (place == n), 0.0, moved)


def poisson(dim: int, ratio: float, lateral: float) -> float:
    """Poisson's ratio of a softer block that is strained along the interface as one of NU.

    Args:
        dim: Dimension; in 2D plane strain.
        ratio: Its Young's modulus over that of the other block, at most 1.
        lateral: Pressure on the side faces over that on the interface.
    """
    if dim == 3:
        return (lateral - ratio * (lateral - NU * (1 + lateral))) / (1 + lateral)
    rest = lateral - ratio * (1 + NU) * (lateral - NU * (1 + lateral))
    return float((np.sqrt(1 + 4 * (1 + lateral) * rest) - 1) / (2 * (1 + lateral)))


class Patch:
    """Blocks under uniform pressure.

    Attributes:
        shape: Shape of the blocks.
        u: Displacement.
        tags: Facet tags.
        pressure: Exact pressure on the interface.
        contact: The contact.
        problem: The problem.
    """

    def __init__(
        self,
        shape: Shape,
        *,
        slave: str = "upper",
        young: tuple[float, float] = (1.0, 1.0),
        lateral: float = 0.0,
        petsc_options: dict[str, Any] | None = None,
        degree: int = 1,
        **options: Any,
    ):
        """Set the problem up.

        Args:
            shape: Shape of the blocks.
            slave: Which block is the slave, "upper" or "lower".
            young: Young's moduli of the upper and the lower block.
            lateral: Pressure on the side faces over that on the interface. Faces that lean need 1.
            petsc_options: Options of the solver.
            degree: Degree of the displacement.
            options: Options of the contact.
        """
        self.shape, self._slave = shape, slave
        data = shape.mesh()
        self.tags = data.facet_tags
        self.u = story.displacement(data.mesh, degree)
        self.pressure = STRAIN * min(young)
        n = shape.frame[:, -1]
        along = np.eye(shape.dim) - np.outer(n, n)
        self._stress = -self.pressure * (np.outer(n, n) + lateral * along)
        self._lateral = lateral * self.pressure

        exact = self._material(data, young, lateral)
        ends = np.concatenate([self.tags.find(t) for t in (Tag.UPPER_TOP, Tag.LOWER_BOTTOM)])
        dofs = fem.locate_dofs_topological(self.u.function_space, self.tags.dim, ends)

        upper, lower = (cx.Surface(self.tags, t) for t in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT))
        pair = (upper, lower) if slave == "upper" else (lower, upper)
        self.contact = cx.Contact(*pair, **options)
        self.problem = cx.ContactProblem(
            story.elasticity(self.u, self._E, self._nu) + self.load(),
            self.u,
            contacts=[self.contact],
            bcs=[fem.dirichletbc(exact, dofs)],
            petsc_options_prefix="patch_",
            petsc_options=petsc_options,
        )

    def _material(self, data: MeshData, young: tuple[float, float], lateral: float) -> fem.Function:
        """Set the moduli of both blocks; the exact displacement that they lead to."""
        Q = fem.functionspace(data.mesh, ("DG", 0))
        self._E, self._nu = fem.Function(Q), fem.Function(Q)
        exact, dim = fem.Function(self.u.function_space), self.shape.dim
        for body, E in zip((Tag.UPPER, Tag.LOWER), young, strict=True):
            cells = data.cell_tags.find(body)
            nu = NU if max(young) == E else poisson(dim, E / max(young), lateral)
            self._E.x.array[cells], self._nu.x.array[cells] = E, nu
            # In plane strain the third stress is nu times the trace of the others
            trace = np.trace(self._stress) * (1 + nu if dim == 2 else 1)
            strain = ((1 + nu) * self._stress - nu * trace * np.eye(dim)) / E
            exact.interpolate(lambda x, H=strain: H @ x[: len(H)], cells0=cells)
        return exact

    def load(self) -> ufl.Form:
        """Residual of the pressure on the side faces."""
        domain = self.u.function_space.mesh
        ds = ufl.Measure("ds", domain=domain, subdomain_data=self.tags)
        bodies = ("UPPER", "LOWER")
        names = [f"{body}_{side}" for body in bodies for side in _SIDES[: 2 * self.shape.dim - 2]]
        push = fem.Constant(domain, self._lateral) * ufl.FacetNormal(domain)
        return ufl.inner(push, ufl.TestFunction(self.u.function_space)) * ds(
            tuple(int(Tag[name]) for name in names)
        )

    def stress(self) -> Array:
        """Stress at points within each cell, shape (num_cells, m, dim, dim)."""
        domain, dim = self.u.function_space.mesh, self.shape.dim
        mu, lmbda = self._E / (2 * (1 + self._nu)), self._E * self._nu
        lmbda /= (1 + self._nu) * (1 - 2 * self._nu)
        strain = ufl.sym(ufl.grad(self.u))
        stress = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(dim)
        points, _ = basix.make_quadrature(basix.CellType[self.shape.cell_type.name], 2)
        cells = np.arange(domain.topology.index_map(dim).size_local, dtype=np.int32)
        values = fem.Expression(stress, points).eval(domain, cells)
        return np.asarray(values.reshape(len(cells), len(points), dim, dim))

    def stress_errors(self) -> Array:
        """Largest deviation of each cell's stress from the exact one over the pressure."""
        off = np.linalg.norm(self.stress() - self._stress, axis=(2, 3))
        return np.asarray(off.max(axis=1) / self.pressure)

    def pressure_errors(self) -> Array:
        """Deviation of each slave node's multiplier from the exact one over the pressure."""
        normal = self.shape.frame[:, -1]
        towards = normal if self._slave == "upper" else -normal
        exact = 1.0 if self.contact.multiplier.ndim == 1 else towards
        off = self.contact.multiplier / self.pressure - exact
        return np.abs(off) if off.ndim == 1 else np.linalg.norm(off, axis=1)
