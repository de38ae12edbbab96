# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid modes of bodies, and those that supports leave free."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.bodies.bodies import Bodies
from contactx.bulk import Bulk
from contactx.parallel import reduce

type Array = npt.NDArray[np.float64]

# Stiffness against a rigid motion, relative to the diagonal's, that counts as a support: rounding
# leaves less than 1e-15
_SUPPORTED = 1e-13
# And one that lets a body move so far that it may meet others on the way
_WEAK = 1e-3


class RigidModes:
    """Rigid modes of the bodies.

    A mode is a field of displacements of all nodes of one body, its largest value about 1. It is
    kept as coefficients: translations, then rotations about the body's middle over its radius. All
    but displacements is the same on all ranks, and bodies are in the order of their names.

    Attributes:
        num_nodes: Number of nodes of each body, shape (num_bodies,).
        free: For each body the modes that neither Dirichlet conditions nor the bulk's stiffness
            (springs, elastic supports) resist, as columns of coefficients, shape (m, k).
        weak: For each body those that the bulk's stiffness resists by little, shape (m, j).
        stiffness: That stiffness, shape (j,).
    """

    def __init__(self, bulk: Bulk, bodies: Bodies, x: Array):
        """Find the free modes; all ranks must take part.

        Args:
            bulk: The bulk.
            bodies: Bodies of the mesh.
            x: Positions at the start, shape (num_nodes, gdim).
        """
        self._bodies = bodies
        self._comm = bodies.halo.comm
        self._owned = slice(bodies.halo.num_owned)
        self._gdim = x.shape[1]
        count = len(bodies.names)
        body, own = self.body[self._owned], x[self._owned]
        # Of no nodes at all NumPy's sums are integers
        sums = np.zeros((count, 1 + self._gdim))
        sums[:, 0] = np.bincount(body, minlength=count)
        for k in range(self._gdim):
            sums[:, 1 + k] = np.bincount(body, own[:, k], minlength=count)
        sums = reduce.total(self._comm, sums)
        self.num_nodes: Array = sums[:, 0]
        self._middle = sums[:, 1:] / np.maximum(sums[:, :1], 1)
        arm = np.linalg.norm(own - self._middle[body], axis=1)
        radius = np.zeros(count)
        np.maximum.at(radius, body, arm)
        self._radius: Array = reduce.largest(self._comm, radius)
        self._radius[self._radius == 0] = 1.0
        self._bulk = bulk
        self._sprung: list[bool] | None = None
        self.free: list[Array] = []
        self.weak: list[Array] = []
        self.stiffness: list[Array] = []
        self.update(x)

    @property
    def body(self) -> npt.NDArray[np.int64]:
        """Number of the body of each node, shape (num_nodes,)."""
        return self._bodies.number

    @property
    def count(self) -> int:
        """Number of bodies."""
        return len(self._radius)

    @property
    def size(self) -> float:
        """Radius of the largest body."""
        return float(self._radius.max())

    @property
    def any_free(self) -> bool:
        """Whether any body has a free mode, or one that little resists."""
        return any(basis.shape[1] > 0 for basis in (*self.free, *self.weak))

    def at(self, nodes: npt.NDArray[np.integer], x: Array) -> Array:
        """All rigid modes of the bodies of some nodes, at these nodes.

        Args:
            nodes: Nodes, shape (n,).
            x: Positions of all nodes, reference or current, shape (num_nodes, gdim).

        Returns:
            Displacements, shape (n, gdim, m) with m = 3 in 2D and 6 in 3D.
        """
        b = self.body[nodes]
        return rigid_modes((x[nodes] - self._middle[b]) / self._radius[b][:, None])

    def update(self, x: Array) -> None:
        """Find the free modes in another configuration; all ranks must take part.

        Args:
            x: Positions, shape (num_nodes, gdim).
        """
        first = self._sprung is None
        sprung = self._sprung or []
        grams, rows = self._prescribed(x)
        self.free, self.weak, self.stiffness = [], [], []
        for b in range(self.count):
            unconstrained = _null_space(grams[b], rows[b])
            basis = unconstrained
            if first:
                sprung.append(False)
            if unconstrained.shape[1] > 0 and not (first or sprung[b]):
                # Stresses resist rotations without being a support
                turns = unconstrained[self._gdim :]
                shifts = unconstrained @ _null_space(turns.T @ turns, len(turns))
                if shifts.shape[1] > 0:
                    values, _, scale = self._resistance(b, x, shifts)
                    sprung[b] = bool(np.abs(values).max() > _SUPPORTED * scale)
            weak, stiffness = np.zeros((len(unconstrained), 0)), np.zeros(0)
            if unconstrained.shape[1] > 0 and (first or sprung[b]):
                values, vectors, scale = self._resistance(b, x, unconstrained)
                size = np.abs(values)
                basis = unconstrained @ vectors[:, size <= _SUPPORTED * scale]
                yields = (size > _SUPPORTED * scale) & (size <= _WEAK * scale)
                weak, stiffness = unconstrained @ vectors[:, yields], size[yields]
                sprung[b] |= basis.shape[1] < unconstrained.shape[1]
            self.free.append(basis)
            self.weak.append(weak)
            self.stiffness.append(stiffness)
        self._sprung = sprung

    def _prescribed(self, x: Array) -> tuple[Array, Array]:
        """What prescribed displacements see of the modes of each body.

        Args:
            x: Positions, shape (num_nodes, gdim).

        Returns:
            Gram matrix of the modes at prescribed dofs, shape (num_bodies, m, m), and number of
            these dofs, shape (num_bodies,).
        """
        fixed = (self._bulk.markers.reshape(-1, self._gdim) == 1)[self._owned]
        nodes = np.flatnonzero(fixed.any(axis=1)).astype(np.int32)
        modes = self.at(nodes, x)
        m = modes.shape[2]
        # The last column is the number of rows
        grams = np.zeros((self.count, m * m + 1))
        for b in np.unique(self.body[nodes]):
            some = self.body[nodes] == b
            part = modes[some][fixed[nodes[some]]]
            grams[b, :-1] = (part.T @ part).ravel()
            grams[b, -1] = len(part)
        grams = reduce.total(self._comm, grams)
        return grams[:, :-1].reshape(-1, m, m), grams[:, -1]

    def _resistance(self, b: int, x: Array, basis: Array) -> tuple[Array, Array, float]:
        """Stiffness of the bulk against motions of a body.

        Args:
            b: Number of the body.
            x: Positions, shape (num_nodes, gdim).
            basis: Motions, as columns of coefficients, shape (m, k).

        Returns:
            Stiffness, shape (k,), the combinations that have it, shape (k, k), and the stiffness
            against motions that are not rigid.
        """
        body = self.body[self._owned]
        nodes = np.flatnonzero(body == b).astype(np.int32)
        motions = np.zeros((basis.shape[1], len(body), self._gdim))
        motions[:, nodes] = np.einsum("nim,mk->kni", self.at(nodes, x), basis)
        fields = motions.reshape(len(motions), len(body) * self._gdim)
        K = self._bulk.matrix()
        diagonal = np.abs(K.getDiagonal().array)
        product = np.stack([_multiply(K, field) for field in fields])
        scale = np.einsum("kn,n,kn->k", fields, diagonal, fields)
        sums = reduce.total(self._comm, np.column_stack([fields @ product.T, scale]))
        energy = sums[:, :-1]
        values, vectors = np.linalg.eigh((energy + energy.T) / 2)
        return values, vectors, float(sums[:, -1].max())


def rigid_modes(d: Array) -> Array:
    """Translations, then rotations about the origin.

    Args:
        d: Positions, shape (n, gdim).

    Returns:
        Displacements, shape (n, gdim, m) with m = 3 in 2D and 6 in 3D.
    """
    n, gdim = d.shape
    if gdim == 2:
        turn = np.stack([-d[:, 1], d[:, 0]], axis=1)[:, :, None]
    else:
        zero = np.zeros(n)
        turn = np.stack(
            [
                np.stack([zero, -d[:, 2], d[:, 1]], axis=1),
                np.stack([d[:, 2], zero, -d[:, 0]], axis=1),
                np.stack([-d[:, 1], d[:, 0], zero], axis=1),
            ],
            axis=2,
        )
    shift = np.tile(np.eye(gdim), (n, 1, 1))
    return np.concatenate([shift, turn], axis=2)


def by_body(bases: list[Array]) -> Array:
    """Modes of single bodies as modes of all, in columns."""
    first = np.cumsum([0, *(basis.shape[1] for basis in bases)])
    Z = np.zeros((sum(len(basis) for basis in bases), first[-1]))
    for b, basis in enumerate(bases):
        Z[b * len(basis) : (b + 1) * len(basis), first[b] : first[b + 1]] = basis
    return Z


def _null_space(gram: Array, rows: float) -> Array:
    """Orthonormal basis of the null space of a matrix, shape (m, k).

    Args:
        gram: The matrix times its transpose from the left, shape (m, m).
        rows: Number of its rows.
    """
    _, values, basis = np.linalg.svd(gram)
    null: Array = basis[values <= 1e-12 * max(rows, 1)].T
    return null


def _multiply(K: PETSc.Mat, field: Array) -> Array:
    x, y = K.createVecs()
    x.array = field
    K.mult(x, y)
    result: Array = y.array.copy()
    return result
