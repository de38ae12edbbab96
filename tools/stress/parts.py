# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies on grids as one mesh, with a material and supports."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.materials import neo_hookean, st_venant_kirchhoff
from scenes.supports import DrivenFaces
from story import elasticity
from stress.grids import Array, Body, Numbers
from stress.scene import Case

_SIDES = ("x0", "x1", "y0", "y1", "z0", "z1")


class Parts:
    """Several bodies.

    Nodes keep the numbers of the grids, one body after the other: that is how whoever looks at the
    deformed bodies finds them.

    Attributes:
        bodies: The bodies, each with the numbers that its nodes have among all of them.
        mesh: Their mesh.
        tags: Tags of all faces.
        u: Displacement.
        F: Residual of the bodies.
        bcs: Conditions so far.
        cells: Nodes of all cells.
        x: Nodes before deformation.
        nu: Poisson's ratio.
        modulus: Largest of Young's moduli.
        nonlinear: Whether strains may be large.
        held: Numbers of the nodes of faces that are held or driven.
    """

    def __init__(
        self,
        *bodies: Body,
        material: str = "linear",
        young: Sequence[float] | None = None,
        nu: float = 0.3,
        halved: bool = False,
    ):
        """Mesh them.

        Args:
            bodies: The bodies.
            material: "linear", "neo-hooke" or "svk", which is St Venant's and Kirchhoff's.
            young: Young's moduli, 1 if None.
            nu: Poisson's ratio.
            halved: Whether the quadrilaterals of plane bodies are split into triangles.
        """
        begins = np.cumsum([0, *(len(b.x) for b in bodies)])
        self.bodies = [
            Body(b.x, b.cells + n, {k: f + n for k, f in b.faces.items()})
            for b, n in zip(bodies, begins, strict=False)
        ]
        self.x = np.concatenate([b.x for b in bodies])
        dim = self.x.shape[1]
        self.cells = cells = np.concatenate([b.cells for b in self.bodies])
        owner = np.repeat(np.arange(len(bodies)), [len(b.cells) for b in bodies])
        shape = "quadrilateral" if dim == 2 else "hexahedron"
        if halved:
            cells = cells[:, [0, 1, 3, 0, 3, 2]].reshape(-1, 3)
            owner, shape = np.repeat(owner, 2), "triangle"
            self.cells = cells
        element = basix.ufl.element("Lagrange", shape, 1, shape=(dim,))
        self.mesh = domain = mesh.create_mesh(MPI.COMM_SELF, cells, element, self.x)
        # From nodes of the geometry to those of the grids
        self._given = np.asarray(domain.geometry.input_global_indices)
        self.tags = self._tag()
        V = fem.functionspace(domain, ("Lagrange", 1, (dim,)))
        self.u = fem.Function(V)
        dof = np.empty(len(self._given), dtype=np.int64)
        dof[domain.geometry.dofmaps[0].ravel()] = V.dofmap.list.ravel()
        self._dof = np.empty_like(dof)
        self._dof[self._given] = dof
        self.F = _residual(self.u, self._moduli(young, owner, len(bodies)), nu, material)
        self.nu, self.modulus = nu, 1.0 if young is None else max(young)
        self.nonlinear = material != "linear"
        self.bcs: list[fem.DirichletBC] = []
        self.held = np.zeros(0, dtype=np.int64)

    def _moduli(self, young: Sequence[float] | None, owner: Numbers, n: int) -> Any:
        if young is None or n == 1:
            return fem.Constant(self.mesh, 1.0 if young is None else float(young[0]))
        values = fem.Function(fem.functionspace(self.mesh, ("DG", 0)))
        values.x.array[:] = np.asarray(young)[owner[self.mesh.topology.original_cell_index]]
        return values

    def _tag(self) -> mesh.MeshTags:
        domain, dim = self.mesh, self.mesh.topology.dim
        domain.topology.create_connectivity(dim - 1, dim)
        facets = mesh.exterior_facet_indices(domain.topology)
        nodes = np.sort(self._given[mesh.entities_to_geometry(domain, dim - 1, facets)], axis=1)
        tag = {
            tuple(sorted(facet)): self.tag(i, side)
            for i, body in enumerate(self.bodies)
            for side, own in body.faces.items()
            for facet in own.tolist()
        }
        values = np.array([tag[tuple(row)] for row in nodes.tolist()], dtype=np.int32)
        order = np.argsort(facets)
        return mesh.meshtags(domain, dim - 1, facets[order], values[order])

    @staticmethod
    def tag(body: int, side: str) -> int:
        """Tag of a face."""
        return 10 * (body + 1) + _SIDES.index(side)

    def surface(self, body: int, *sides: str) -> cx.Surface:
        """Surface of some faces of a body, of all if none is named."""
        names = sides or tuple(self.bodies[body].faces)
        return cx.Surface(self.tags, *(self.tag(body, side) for side in names))

    def facets(self, body: int, *sides: str) -> Numbers:
        """Nodes of the facets of some faces of a body, of all if none is named."""
        faces = self.bodies[body].faces
        return np.concatenate([faces[side] for side in sides or tuple(faces)])

    def hold(self, body: int, *sides: str) -> DrivenFaces:
        """Hold faces of a body; they can be moved."""
        faces = DrivenFaces(self.u, self.tags, *(self.tag(body, side) for side in sides))
        self.bcs.append(faces.bc)
        own = [self.bodies[body].faces[side].ravel() for side in sides]
        self.held = np.union1d(self.held, np.concatenate(own))
        return faces

    def fix(self, node: int, component: int, value: fem.Constant | None = None) -> None:
        """Prescribe one component of the displacement of a node, to be 0 if no value is given."""
        V = self.u.function_space
        dof = V.dofmap.index_map_bs * self._dof[node] + component
        at = np.array([dof], dtype=np.int32)
        given = np.float64(0.0) if value is None else value
        self.bcs.append(fem.dirichletbc(given, at, V.sub(component)))

    def problem(self, *contacts: cx.Contact, **options: Any) -> cx.ContactProblem:
        """The problem with its contacts."""
        return cx.ContactProblem(
            self.F,
            self.u,
            contacts=contacts,
            bcs=self.bcs,
            petsc_options_prefix="parts_",
            **options,
        )

    def case(self, contact: cx.Contact, update: Callable[[float], object], **known: Any) -> Case:
        """A case of one contact of these bodies; the rest is described in ``Case``."""
        return Case(self.problem(contact), [contact], self.F, self.bcs, update, **known)

    def displacements(self) -> Array:
        """Displacements of the nodes, shape (n, dim)."""
        values: Array = self.u.x.array.reshape(-1, self.x.shape[1])[self._dof]
        return values

    def positions(self) -> Array:
        """Positions of the nodes after deformation, shape (n, dim)."""
        return self.x + self.displacements()

    def forces(self) -> Array:
        """What acts on each node from outside, by the bodies' stresses alone, shape (n, dim)."""
        vector = fem.assemble_vector(fem.form(self.F))
        values: Array = vector.array.reshape(-1, self.x.shape[1])[self._dof]
        return values

    def lengths(self, facets: Numbers, x: Array) -> Array:
        """Longest edge or diagonal of facets, shape (m,)."""
        return np.asarray(np.max([_length(x, facets, a, b) for a, b in _pairs(facets)], axis=0))


def _pairs(facets: Numbers) -> Iterator[tuple[int, int]]:
    k = facets.shape[1]
    return ((a, b) for a in range(k) for b in range(a))


def _length(x: Array, facets: Numbers, a: int, b: int) -> Array:
    return np.asarray(np.linalg.norm(x[facets[:, a]] - x[facets[:, b]], axis=1))


def _residual(u: fem.Function, young: Any, nu: float, material: str) -> ufl.Form:
    ratio = fem.Constant(u.function_space.mesh, nu)
    if material == "svk":
        return st_venant_kirchhoff(u, young, ratio, degree=3)
    if material == "neo-hooke":
        return neo_hookean(u, young, ratio, degree=3)
    return elasticity(u, young, ratio)
