# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Supports that prescribe all displacements of faces; those of one component: ``story.fix``."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from dolfinx import fem, mesh

type Array = npt.NDArray[np.float64]
type Nodes = npt.NDArray[np.int32]


def prescribe(value: fem.Function, tags: mesh.MeshTags, *faces: int) -> fem.DirichletBC:
    """Prescribe the displacements of tagged faces by a function's values there."""
    return fem.dirichletbc(value, _nodes(value.function_space, tags, faces))


class DrivenFaces:
    """All displacements of some faces."""

    def __init__(self, u: fem.Function, tags: mesh.MeshTags, *faces: int):
        V = u.function_space
        self._value = fem.Function(V)
        self._nodes = _nodes(V, tags, faces)
        self.bc = fem.dirichletbc(self._value, self._nodes)
        self.x: Array = V.tabulate_dof_coordinates()[self._nodes, : len(u)]

    def move(self, by: Sequence[float] | Array) -> None:
        """Set the displacement: one for all nodes, or one a node."""
        gdim = self.x.shape[1]
        self._value.x.array.reshape(-1, gdim)[self._nodes] = by


def _nodes(V: fem.FunctionSpace, tags: mesh.MeshTags, faces: Sequence[int]) -> Nodes:
    facets = np.concatenate([tags.find(face) for face in faces])
    return fem.locate_dofs_topological(V, tags.dim, facets)
