# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes in other units, turned and renumbered, and their answers in the first scene's terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from dolfinx import fem, mesh

from scenes.blocks import NU
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity


@dataclass(frozen=True)
class Support:
    """Displacement along some axes of the first scene, on tagged faces."""

    faces: tuple[int, ...]
    axes: tuple[int, ...]
    value: tuple[float, ...]


@dataclass
class Numbered:
    """A mesh with its facet tags.

    Attributes:
        domain: Mesh; its coordinates may be overwritten.
        nodes: Number that each node of the geometry has in the first mesh.
    """

    domain: mesh.Mesh
    tags: mesh.MeshTags
    nodes: npt.NDArray[np.int64]
    x: npt.NDArray[np.float64] = field(init=False)

    def __post_init__(self):
        self.x = self.domain.geometry.x.copy()


@dataclass(frozen=True)
class Frame:
    """Where x of the first scene goes: length * (Q x + shift); moduli are times modulus."""

    Q: npt.NDArray[np.float64]
    shift: npt.NDArray[np.float64]
    length: float = 1.0
    modulus: float = 1.0


@dataclass(frozen=True)
class Answer:
    """Answer without units, in the first scene's axes and numbers.

    Attributes:
        closed: Nodes in contact in each iteration.
        status: Status of each node, -1 off the slave surface.
        u: Displacement / length, shape (num_nodes, gdim).
        pressure: Pressure / modulus at each node, zero off the slave surface.
        gap: Gap / length at each node, NaN where there is none.
        force: Force / (modulus length^(gdim - 1)).
        traction: Traction / modulus, zero off the slave surface, shape (num_nodes, gdim).
        slip: Slip of the last step / length, zero without friction, shape (num_nodes, gdim).
    """

    iterations: int
    closed: list[int]
    status: npt.NDArray[np.int8]
    u: npt.NDArray[np.float64]
    pressure: npt.NDArray[np.float64]
    gap: npt.NDArray[np.float64]
    force: npt.NDArray[np.float64]
    traction: npt.NDArray[np.float64]
    slip: npt.NDArray[np.float64]


def numbered(data: mesh.MeshData) -> Numbered:
    """The first mesh."""
    return Numbered(
        data.mesh, data.facet_tags, np.arange(len(data.mesh.geometry.x), dtype=np.int64)
    )


def _turned_cells(
    kind: mesh.CellType, cells: npt.NDArray[np.int64], rng: np.random.Generator
) -> npt.NDArray[np.int64]:
    """Give the nodes of each cell another local order that describes the same cell."""
    if kind in (mesh.CellType.triangle, mesh.CellType.tetrahedron):
        return rng.permuted(cells, axis=1)
    tdim = 2 if kind == mesh.CellType.quadrilateral else 3
    # dolfinx numbers tensor cells lexicographically
    corners = np.arange(2**tdim).reshape((2,) * tdim)
    result = np.empty_like(cells)
    for i, cell in enumerate(cells):
        order = np.flip(corners, np.flatnonzero(rng.integers(2, size=tdim)))
        result[i] = cell[order.transpose(rng.permutation(tdim)).ravel()]
    return result


def renumbered(first: Numbered, seed: int) -> Numbered:
    """The same mesh from cells, nodes and local orders that are shuffled."""
    rng = np.random.default_rng(seed)
    old = rng.permutation(len(first.x))  # number in the first mesh of each shuffled node
    new = np.argsort(old)
    cells = new[rng.permutation(first.domain.geometry.dofmaps[0])]
    return _rebuilt(first, _turned_cells(first.domain.topology.cell_type, cells, rng), old)


def jacobians(scene: Numbered) -> npt.NDArray[np.float64]:
    """Sign of each cell's Jacobian, by the local order of its nodes."""
    tdim = scene.domain.topology.dim
    cells = scene.domain.geometry.dofmaps[0]
    is_simplex = cells.shape[1] == tdim + 1
    axes = cells[:, 1 : tdim + 1] if is_simplex else cells[:, [1 << i for i in range(tdim)]]
    return np.sign(np.linalg.det((scene.x[axes] - scene.x[cells[:, :1]])[:, :, :tdim]))


def oriented(first: Numbered, sign: float) -> Numbered:
    """The same mesh with the Jacobians of all cells of a sign."""
    cells = first.domain.geometry.dofmaps[0].astype(np.int64)
    is_simplex = cells.shape[1] == first.domain.topology.dim + 1
    swapped = [1, 0, *range(2, cells.shape[1])]
    if not is_simplex:
        swapped = [i ^ 1 for i in range(cells.shape[1])]
    wrong = jacobians(first) != sign
    cells[wrong] = cells[wrong][:, swapped]
    return _rebuilt(first, cells, np.arange(len(first.x)))


def _rebuilt(first: Numbered, cells: npt.NDArray[np.int64], old: npt.NDArray[np.int64]) -> Numbered:
    """The same mesh from other cells.

    Args:
        cells: Its cells, shape (num_cells, num_nodes).
        old: Number in the first mesh of each of their nodes.
    """
    domain, tags = first.domain, first.tags
    gdim, tdim = domain.geometry.dim, domain.topology.dim
    # Not domain.ufl_domain(), which create_mesh would hand over to the new mesh
    element = domain.ufl_domain().ufl_coordinate_element()
    other = mesh.create_mesh(MPI.COMM_WORLD, cells, element, first.x[old, :gdim])
    nodes = old[other.geometry.input_global_indices]

    def facets_by_nodes(m, facets, number):
        m.topology.create_connectivity(tdim - 1, tdim)
        found = mesh.entities_to_geometry(m, tdim - 1, facets)
        return [tuple(row) for row in np.sort(number[found], axis=1)]

    values = dict(zip(facets_by_nodes(domain, tags.indices, first.nodes), tags.values, strict=True))
    other.topology.create_connectivity(tdim - 1, tdim)
    boundary = mesh.exterior_facet_indices(other.topology)
    keys = facets_by_nodes(other, boundary, nodes)
    tagged = np.array([key in values for key in keys])
    assert tagged.sum() == len(tags.indices)
    values_there = np.array([values[key] for key in keys if key in values], dtype=np.int32)
    return Numbered(other, mesh.meshtags(other, tdim - 1, boundary[tagged], values_there), nodes)


def solve(
    scene: Numbered,
    supports: Sequence[Support],
    frame: Frame | None = None,
    *,
    sliding: str = "finite",
    friction: float = 0.0,
    loads: Sequence[float] = (1.0,),
) -> Answer:
    """Solve a scene in a frame, in steps that bring shares of the supports' displacements.

    A support is given as a vector where it holds all axes, else along the axes that Q takes its
    own to: then Q must permute the axes.
    """
    domain, tags = scene.domain, scene.tags
    gdim = domain.geometry.dim
    if frame is None:
        frame = Frame(np.eye(gdim), np.zeros(gdim))
    Q, length = frame.Q, frame.length
    domain.geometry.x[:, :gdim] = length * (scene.x[:, :gdim] @ Q.T + frame.shift)

    u = displacement(domain)
    V = u.function_space
    bcs = []
    for support in supports:
        facets = np.concatenate([tags.find(face) for face in support.faces])
        if len(support.axes) == gdim:
            dofs = fem.locate_dofs_topological(V, tags.dim, facets)
            bcs.append(fem.dirichletbc(length * Q @ np.array(support.value), dofs, V))
            continue
        for axis, value in zip(support.axes, support.value, strict=True):
            (to,) = np.flatnonzero(Q[:, axis])
            W = V.sub(to)
            dofs = fem.locate_dofs_topological(W, tags.dim, facets)
            bcs.append(fem.dirichletbc(np.float64(length * Q[to, axis] * value), dofs, W))
    contact = pair_of(tags, friction=friction, sliding=sliding)
    # By a direct solver: each iterate is compared, and rough early steps depend on the numbering
    problem = make_problem(
        elasticity(u, fem.Constant(domain, frame.modulus), NU),
        u,
        [contact],
        bcs,
        petsc_options={"pc_type": "lu"},
    )
    full = [np.copy(bc.g.value) for bc in bcs]
    history = []
    for load in loads:
        for bc, value in zip(bcs, full, strict=True):
            bc.g.value[...] = load * value
        problem.solve()
        history += problem.report.history
        assert problem.report.frozen_pairs == 0
    # A node of the displacement is a node of the geometry
    geometry = np.empty(len(scene.x), dtype=np.int64)
    geometry[V.dofmap.list.ravel()] = domain.geometry.dofmaps[0].ravel()
    number = scene.nodes[geometry]

    def nodal(values, fill=0.0):
        result = np.full((len(number), *np.shape(values)[1:]), fill)
        result[number[contact.slave_nodes]] = values
        return result

    moved = np.empty((len(number), gdim))
    moved[number] = u.x.array.reshape(-1, gdim) @ Q / length
    nodes = contact.discrete.nodes
    traction = contact.traction.x.array.reshape(-1, gdim)[contact.slave_nodes]
    slip = np.zeros_like(traction) if friction == 0 else contact.discrete.history.slip
    return Answer(
        iterations=len(history) - len(loads),
        closed=[row.closed for row in history],
        status=nodal(nodes.status, -1).astype(np.int8),
        u=moved,
        pressure=nodal(nodes.pressure) / frame.modulus,
        gap=nodal(nodes.gap, np.nan) / length,
        force=Q.T @ contact.force / (frame.modulus * length ** (gdim - 1)),
        traction=nodal(traction) @ Q / frame.modulus,
        slip=nodal(slip) @ Q / length,
    )


def rotation(rng: np.random.Generator, gdim: int) -> npt.NDArray[np.float64]:
    """A random rotation."""
    Q, R = np.linalg.qr(rng.standard_normal((gdim, gdim)))
    Q = Q * np.sign(np.diag(R))
    if np.linalg.det(Q) < 0:
        Q[:, 0] *= -1
    return Q


def differences(answer: Answer, first: Answer) -> dict[str, float]:
    """Largest difference of each quantity, relative to the largest value of the first answer.

    Gaps and slip are relative to the largest displacement: where all are closed, or stick, they
    are rounding.
    """
    result = {}
    for name in ("u", "pressure", "force", "gap", "traction", "slip"):
        a, b = getattr(answer, name), getattr(first, name)
        np.testing.assert_array_equal(np.isnan(a), np.isnan(b))
        scale = first.u if name in ("gap", "slip") else b
        result[name] = float(np.nanmax(np.abs(a - b)) / np.abs(scale).max())
    return result
