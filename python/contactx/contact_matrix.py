# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The contacts' part of the Jacobian as a matrix."""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface
from contactx.layout import Layout
from contactx.parallel.halo import Halo
from dolfinx import cpp, fem

_NONE = np.array([], dtype=np.int8)


def new_matrix(layout: Layout, interfaces: Sequence[Interface]) -> PETSc.Mat:
    """Matrix without entries that takes those of the contacts by this rank's own numbers.

    These are the displacements of all nodes, then the multipliers of each contact, with those of
    slave nodes of other ranks, which it drops: they are theirs. All ranks must take part.

    Args:
        layout: Places of the unknowns.
        interfaces: Discrete sides of the contacts.
    """
    A = layout.matrix()
    sizes = [len(interface.nodes.multiplier) for interface in interfaces]
    places = layout.places()
    nodes, *multipliers = np.split(places, len(places) - np.cumsum([0, *sizes[::-1]])[::-1])[:-1]
    rows = [nodes]
    for interface, own in zip(interfaces, multipliers, strict=True):
        rows += [own, np.full(interface.num_others * interface.nodes.size, -1)]
    local = PETSc.LGMap().create(np.concatenate(rows).astype(PETSc.IntType), 1, comm=A.comm)
    A.setLGMap(local, local)
    return A


def add_contacts(
    A: PETSc.Mat,
    interfaces: Sequence[Interface],
    halo: Halo,
    markers: npt.NDArray[np.int8],
) -> None:
    """Assemble the forms of the contacts into a matrix of ``new_matrix``.

    Args:
        A: The matrix.
        interfaces: Discrete sides of the contacts.
        halo: Nodes of this rank.
        markers: 1 at displacements of all nodes whose rows and columns are left out.
    """
    serial = PETSc.COMM_SELF
    first = halo.num_nodes * halo.gdim
    # PETSc takes blocks of places for places where the map has none
    bulk = PETSc.IS().createStride(first, comm=serial)
    for interface in interfaces:
        size, n = interface.nodes.size, len(interface.slaves)
        every = (n + interface.num_others) * size
        slave = PETSc.IS().createStride(every, first, 1, comm=serial)
        for form in interface.forms:
            if form.stiffness is not None:
                _assemble(A, form.stiffness, (bulk, bulk), (markers, markers))
            if form.traction is not None:
                _assemble(A, form.traction, (bulk, slave), (markers, _NONE))
            if form.constraint is not None:
                _assemble(A, form.constraint, (slave, bulk), (_NONE, markers))
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
