# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the way from a recipe to a mesh."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

import pytest

from meshes.build import build_mesh


def test_error_of_a_recipe_reaches_every_rank() -> None:
    """No rank waits for a mesh that will not come."""

    def recipe(gmsh: ModuleType) -> None:
        raise RuntimeError("no such shape")

    with pytest.raises(RuntimeError, match="no such shape"):
        build_mesh("test", 2, recipe, MPI.COMM_WORLD)
