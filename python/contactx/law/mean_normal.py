# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Normals that are means over facets, and the slip across them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

type Array = npt.NDArray[np.float64]


class MeanNormal:
    """Unit normals n = M m / |M m| of means m, and the slip s = M (I - n n^T) w of a movement w.

    The laws are written for n and s, forms assemble m and w. M drops directions that cannot move:
    across a plane of symmetry, whose other half would lean the other way.
    """

    def __init__(self, n: int, gdim: int):
        """Create them for so many slave nodes.

        Args:
            n: Number of slave nodes.
            gdim: Geometric dimension.
        """
        self._length = np.ones(n)
        self._kept = np.ones((n, gdim))
        self._movement = np.zeros((n, gdim))
        self._mobile = np.ones((n, gdim))

    def normalise(self, normal: Array, mobile: Array) -> None:
        """Scale means to unit length; zero stays zero.

        Args:
            normal: Means, overwritten, shape (n, gdim).
            mobile: 1 in directions that can move, else 0, shape (n, gdim).
        """
        length = np.linalg.norm(normal * mobile, axis=1)
        # What has all of its normal in such directions has nothing that moves
        leans = length > 0.5 * np.linalg.norm(normal, axis=1)
        self._kept = np.where(leans[:, None], mobile, 1.0)
        normal *= self._kept
        length = np.linalg.norm(normal, axis=1)
        self._length = np.where(length > 0, length, 1.0)
        normal /= self._length[:, None]

    def project(self, normal: Array, slip: Array, mobile: Array) -> None:
        """Take the part of movements along the surface.

        Args:
            normal: Unit normals, shape (n, gdim).
            slip: Movements, overwritten, shape (n, gdim).
            mobile: 1 in directions that can move, else 0, shape (n, gdim).
        """
        self._movement, self._mobile = slip.copy(), mobile
        slip -= np.einsum("ij,ij->i", normal, slip)[:, None] * normal
        slip *= mobile

    def chain(self, normal: Array, by_slip: Array, by_normal: Array) -> None:
        """Turn derivatives by slip and normal into those by movement and mean.

        Args:
            normal: Unit normals, shape (n, gdim).
            by_slip: Derivatives by the slip, overwritten, shape (n * gdim**2,).
            by_normal: Derivatives by the normal, overwritten, shape (n * gdim**2,).
        """
        n, gdim = normal.shape
        S, N = (by.reshape(n, gdim, gdim) for by in (by_slip, by_normal))
        w = self._movement
        S *= self._mobile[:, None, :]
        height = np.einsum("ij,ij->i", normal, w)
        along = np.einsum("nij,nj->ni", S, normal)
        N -= height[:, None, None] * S + along[:, :, None] * w[:, None, :]
        S -= along[:, :, None] * normal[:, None, :]
        N -= np.einsum("nij,nj->ni", N, normal)[:, :, None] * normal[:, None, :]
        N *= (self._kept / self._length[:, None])[:, None, :]
