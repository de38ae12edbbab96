# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The contacts' part of the Jacobian as a matrix."""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface
from contactx.layout import Where
from contactx.parallel.halo import Halo
from dolfinx import cpp, fem

_NONE = np.array([], dtype=np.int8)


def new_matrix(where: Where, interfaces: Sequence[Interface]) -> PETSc.Mat:
    """Matrix without entries that takes those of the contacts by this rank's own numbers.

    These are the displacements of all nodes, then the multipliers of each contact, with those of
    slave nodes of other ranks, which it drops: they are theirs.

    Args:
        where: Places of the unknowns in the matrix.
        interfaces: Discrete sides of the contacts.
    """
    A = PETSc.Mat().createAIJ(((where.size, None), (where.size, None)), comm=where.comm)
    A.setUp()
    places, first = [where.nodes], where.multipliers
    for interface in interfaces:
        n, size = len(interface.nodes.multiplier), interface.nodes.size
        places.append(first + np.arange(n))
        places.append(np.full(interface.num_others * size, -1))
        first += n
    rows = np.concatenate(places).astype(PETSc.IntType)
    local = PETSc.LGMap().create(rows, 1, comm=where.comm)
    A.setLGMap(local, local)
    return A


def add_contacts(
    A: PETSc.Mat,
    interfaces: Sequence[Interface],
    halo: Halo,
    which: Sequence[npt.NDArray[np.bool_]] | None,
    markers: npt.NDArray[np.int8],
) -> None:
    """Assemble the contacts into a matrix of ``new_matrix``.

    Args:
        A: The matrix.
        interfaces: Discrete sides of the contacts.
        halo: Nodes of this rank.
        which: Slave nodes of each contact whose pairs are assembled, all if None.
        markers: 1 at displacements of all nodes whose rows and columns are left out.
    """
    serial = PETSc.COMM_SELF
    first = halo.num_nodes * halo.gdim
    # PETSc takes blocks of places for places where the map has none
    bulk = PETSc.IS().createStride(first, comm=serial)
    for k, interface in enumerate(interfaces):
        size, n = interface.nodes.size, len(interface.slaves)
        every = (n + interface.num_others) * size
        slave = PETSc.IS().createStride(every, first, 1, comm=serial)
        some = np.ones(n, dtype=bool) if which is None else which[k]
        for form in interface.forms:
            stiffness, traction, constraint = form.blocks(some)
            if stiffness is not None:
                _assemble(A, stiffness, (bulk, bulk), (markers, markers))
            if traction is not None:
                _assemble(A, traction, (bulk, slave), (markers, _NONE))
            if constraint is not None:
                _assemble(A, constraint, (slave, bulk), (_NONE, markers))
        rows = first + np.arange(n * size, dtype=PETSc.IntType)
        A.setValuesLocalIJV(
            np.arange(0, size * len(rows) + 1, size, dtype=PETSc.IntType),
            np.repeat(rows.reshape(-1, size), size, axis=0).ravel(),
            interface.nodes.by_multiplier.ravel(),
            addv=PETSc.InsertMode.ADD,
            rowmap=rows,
        )
        first += every
    A.assemble()


def _assemble(
    A: PETSc.Mat,
    form: fem.Form,
    index_sets: tuple[PETSc.IS, PETSc.IS],
    markers: tuple[npt.NDArray[np.int8], npt.NDArray[np.int8]],
) -> None:
    """Add a contact form to a block of the matrix.

    DOLFINx finds no Dirichlet conditions for a borrowed space: rows and columns to leave out are
    passed as markers.
    """
    block = A.getLocalSubMatrix(*index_sets)
    cpp.fem.petsc.assemble_matrix(
        block,
        form._cpp_object,
        fem.pack_constants(form),
        fem.pack_coefficients(form),
        *markers,
        True,
    )
    A.restoreLocalSubMatrix(*index_sets, block)
