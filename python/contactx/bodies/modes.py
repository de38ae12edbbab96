# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid modes of bodies, and those that supports leave free."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.bodies.bodies import Bodies
from contactx.bulk import Bulk

type Array = npt.NDArray[np.float64]

# Stiffness against a rigid motion, relative to the diagonal's, that counts as a support: rounding
# leaves less than 1e-15
_SUPPORTED = 1e-13
# And one that lets a body move so far that it may meet others on the way
_WEAK = 1e-3


class RigidModes:
    """Rigid modes of the bodies.

    A mode is a field of displacements of all nodes of one body, its largest value about 1. It is
    kept as coefficients: translations, then rotations about the body's middle over its radius.

    Attributes:
        body: Number of the body of each node, shape (num_nodes,).
        free: For each body the modes that neither Dirichlet conditions nor the bulk's stiffness
            (springs, elastic supports) resist, as columns of coefficients, shape (m, k).
        weak: For each body those that the bulk's stiffness resists by little, shape (m, j).
        stiffness: That stiffness, shape (j,).
    """

    def __init__(self, bulk: Bulk, bodies: Bodies, x: Array):
        """Find the free modes.

        Args:
            bulk: The bulk.
            bodies: Bodies of the mesh.
            x: Positions at the start, shape (num_nodes, gdim).
        """
        self._gdim = x.shape[1]
        self.body = np.unique(bodies.of_node, return_inverse=True)[1]
        count = self.body.max(initial=-1) + 1
        sizes = np.maximum(np.bincount(self.body, minlength=count), 1)[:, None]
        self._middle = np.column_stack(
            [np.bincount(self.body, x[:, k], minlength=count) for k in range(self._gdim)]
        )
        self._middle /= sizes
        arm = np.linalg.norm(x - self._middle[self.body], axis=1)
        self._radius = np.zeros(count)
        np.maximum.at(self._radius, self.body, arm)
        self._radius[self._radius == 0] = 1.0
        self._bulk = bulk
        self._sprung: list[bool] | None = None
        self.free: list[Array] = []
        self.weak: list[Array] = []
        self.stiffness: list[Array] = []
        self.update(x)

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

    def at(self, nodes: npt.NDArray[np.int32], x: Array) -> Array:
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
        """Find the free modes in another configuration.

        Args:
            x: Positions, shape (num_nodes, gdim).
        """
        fixed = self._bulk.markers.reshape(-1, self._gdim) == 1
        first = self._sprung is None
        sprung = self._sprung or []
        self.free, self.weak, self.stiffness = [], [], []
        for b in range(self.count):
            nodes = np.flatnonzero(self.body == b).astype(np.int32)
            modes = self.at(nodes, x)
            held = _null_space(modes[fixed[nodes]], modes.shape[2])
            basis = held
            if first:
                sprung.append(False)
            if held.shape[1] > 0 and not (first or sprung[b]):
                # Stresses resist rotations without being a support
                shifts = held @ _null_space(held[self._gdim :], held.shape[1])
                if shifts.shape[1] > 0:
                    values, _, scale = self._resistance(nodes, modes, shifts)
                    sprung[b] = bool(np.abs(values).max() > _SUPPORTED * scale)
            weak, stiffness = np.zeros((len(held), 0)), np.zeros(0)
            if held.shape[1] > 0 and (first or sprung[b]):
                values, vectors, scale = self._resistance(nodes, modes, held)
                size = np.abs(values)
                basis = held @ vectors[:, size <= _SUPPORTED * scale]
                yields = (size > _SUPPORTED * scale) & (size <= _WEAK * scale)
                weak, stiffness = held @ vectors[:, yields], size[yields]
                sprung[b] |= basis.shape[1] < held.shape[1]
            self.free.append(basis)
            self.weak.append(weak)
            self.stiffness.append(stiffness)
        self._sprung = sprung

    def _resistance(
        self, nodes: npt.NDArray[np.int32], modes: Array, basis: Array
    ) -> tuple[Array, Array, float]:
        """Stiffness of the bulk against motions of a body.

        Args:
            nodes: Nodes of the body.
            modes: All of its rigid modes at these nodes.
            basis: Motions, as columns of coefficients, shape (m, k).

        Returns:
            Stiffness, shape (k,), the combinations that have it, shape (k, k), and the stiffness
            against motions that are not rigid.
        """
        fields = np.zeros((basis.shape[1], len(self.body), self._gdim))
        fields[:, nodes] = np.einsum("nim,mk->kni", modes, basis)
        return _resistance(self._bulk.matrix(), fields.reshape(basis.shape[1], -1))


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


def _null_space(rows: Array, size: int) -> Array:
    """Orthonormal basis of the null space of a matrix, shape (size, k)."""
    _, values, basis = np.linalg.svd(rows.T @ rows if len(rows) else np.zeros((size, size)))
    null: Array = basis[values <= 1e-12 * max(len(rows), 1)].T
    return null


def _resistance(K: PETSc.Mat, fields: Array) -> tuple[Array, Array, float]:
    """Stiffness of a matrix against fields, the combinations that have it, and its diagonal's."""
    diagonal = np.abs(K.getDiagonal().array)
    product = np.stack([_multiply(K, field) for field in fields])
    energy = fields @ product.T
    scale = np.einsum("kn,n,kn->k", fields, diagonal, fields).max()
    values, vectors = np.linalg.eigh((energy + energy.T) / 2)
    return values, vectors, float(scale)


def _multiply(K: PETSc.Mat, field: Array) -> Array:
    x, y = K.createVecs()
    x.array = field
    K.mult(x, y)
    result: Array = y.array.copy()
    return result
