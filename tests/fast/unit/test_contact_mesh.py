# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
from mpi4py import MPI

import numpy as np
import pytest

from contactx._host import contact_mesh
from dolfinx import cpp


@pytest.mark.parametrize(("width", "block_size"), [(1, 1), (3, 6), (4, 1), (5, 3), (7, 2), (9, 3)])
def test_widths_of_borrowed_spaces(width, block_size):
    comm = MPI.COMM_WORLD
    dofs = np.arange(4 * width, dtype=np.int32).reshape(4, width)
    mesh = contact_mesh.carrier(comm, 4)
    index_map = cpp.common.IndexMap(comm, 4 * width)
    V = contact_mesh.borrow(mesh, index_map, dofs, block_size)
    assert np.array_equal(V.dofmap.map(), dofs)
    assert V.element.space_dimension == width * block_size
    assert V.dofmap.index_map_bs == block_size


def test_a_carrier_without_pairs():
    mesh = contact_mesh.carrier(MPI.COMM_WORLD, 0)
    assert mesh.topology.index_map(3).size_local == 0


def test_a_dofmap_that_disagrees_is_refused(monkeypatch):
    """A DOLFINx whose dofmap ignored its width would compute wrong numbers."""
    dofs = np.zeros((2, 5), dtype=np.int32)
    mesh = contact_mesh.carrier(MPI.COMM_WORLD, 2)
    element = contact_mesh._element(3, 1)
    monkeypatch.setattr(contact_mesh, "_element", lambda width, block_size: element)
    with pytest.raises(RuntimeError, match="came out with widths"):
        contact_mesh.borrow(mesh, cpp.common.IndexMap(MPI.COMM_WORLD, 5), dofs, 1)
