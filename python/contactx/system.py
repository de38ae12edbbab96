# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The coupled system of bulk and contacts: one vector, one matrix.

Each rank's unknowns are its displacements followed by the multipliers of each contact. All rows are
forces: the complementarity of a slave node is scaled by its area and the stiffness of its node.
"""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.bulk import Bulk
from contactx.forms import ContactForms
from contactx.interface import Interface
from contactx.parallel.halo import Halo
from dolfinx import cpp, fem

# Relative difference from a Dirichlet value that has no share in the other rows
_ROUNDING = 1e-15
_NONE = np.array([], dtype=np.int8)


class SaddlePointSystem:
    """Residual and Jacobian of the displacement and the multipliers.

    Attributes:
        x: Unknowns.
        b: Residual.
        interfaces: Discrete sides of the contacts.
        halo: Nodes on this rank.
        num_bulk: Number of displacements that this rank owns.
        block: Displacements a node.
    """

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface]):
        """Lay out the unknowns.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
        """
        self._bulk = bulk
        self.interfaces = list(interfaces)
        self._comm = bulk.u.function_space.mesh.comm
        self.block = bulk.u.function_space.dofmap.index_map_bs
        self.num_bulk = bulk.num_owned
        X = self.interfaces[0].state.position
        self.halo = Halo(bulk.u, X.array.reshape(-1, self.block))
        sizes = [self.num_bulk, *(len(i.nodes.multiplier) for i in self.interfaces)]
        self._offsets = np.cumsum([0, *sizes])
        self.renew()
        self._bulk_residual = np.zeros(self.num_bulk)
        self._bulk_at: npt.NDArray[np.float64] | None = None
        self._contact: PETSc.Mat | None = None
        self._contact_pairs: list[list[ContactForms]] | None = None

    def renew(self) -> None:
        """Make new vectors: an error inside PETSc leaves the old ones locked."""
        self.x = PETSc.Vec().createMPI((self._offsets[-1], None), comm=self._comm)
        self.b = self.x.duplicate()

    def blocks(self, array: npt.NDArray[np.float64]) -> list[npt.NDArray[np.float64]]:
        """Views of the displacement's part of a vector's values and of each contact's."""
        return [array[i:j] for i, j in zip(self._offsets, self._offsets[1:], strict=False)]

    def gather(self) -> None:
        """Copy the unknowns from the functions into ``x``."""
        displacement, *multipliers = self.blocks(self.x.array)
        displacement[:] = self._bulk.u.x.array
        for part, interface in zip(multipliers, self.interfaces, strict=True):
            part[:] = interface.state.multiplier.array

    def scatter(self, x: PETSc.Vec) -> None:
        """Copy the unknowns from a vector into the functions."""
        displacement, *multipliers = self.blocks(x.array_r)
        self._bulk.u.x.array[:] = displacement
        for part, interface in zip(multipliers, self.interfaces, strict=True):
            interface.state.multiplier.array[:] = part

    def bulk_residual(self) -> npt.NDArray[np.float64]:
        """Residual of the bulk alone, assembled anew only where the displacement has changed."""
        u = self._bulk.u.x.array
        if self._bulk_at is None or not np.array_equal(u, self._bulk_at):
            self._bulk_residual[:] = self._bulk.residual()
            self._bulk_at = u.copy()
        return self._bulk_residual

    def forget(self) -> None:
        """Drop what was assembled: loads, constants and coefficients may have changed."""
        self._bulk_at = None

    def residual(self, b: PETSc.Vec) -> None:
        """Assemble the residual at the functions' state; pairs and status are as they stand.

        Args:
            b: Vector that is overwritten.
        """
        force, *constraints = self.blocks(b.array)
        force[:] = self.bulk_residual()
        for interface, row in zip(self.interfaces, constraints, strict=True):
            interface.update_gap()
            interface.law.evaluate(interface.nodes)
            interface.add_residual(force)
            row[:] = interface.nodes.value
        defect = self._bulk.dirichlet_defect()
        size = np.abs(self._bulk.u.x.array).max(initial=0.0)
        if np.abs(defect).max(initial=0.0) > _ROUNDING * size:
            self._lift(force, constraints)
        prescribed = self._bulk.markers == 1
        force[prescribed] = defect[prescribed]

    def _lift(
        self, force: npt.NDArray[np.float64], constraints: list[npt.NDArray[np.float64]]
    ) -> None:
        """Take Dirichlet values that the displacement does not have yet to the other rows."""
        u, bcs = self._bulk.u.x.array, [self._bulk.bcs]
        fem.apply_lifting(force, [self._bulk.J], bcs, [u], alpha=-1.0)
        for interface, row in zip(self.interfaces, constraints, strict=True):
            for form in interface.forms:
                if form.stiffness is not None:
                    fem.apply_lifting(force, [form.stiffness], bcs, [u], alpha=-1.0)
                if form.constraint is not None:
                    fem.apply_lifting(row, [form.constraint], bcs, [u], alpha=-1.0)

    def fits(self) -> bool:
        """Whether the last Jacobian has the pattern of the current pairs."""
        return self._contact_pairs == [interface.forms for interface in self.interfaces]

    def displacement_residual(self) -> npt.NDArray[np.float64]:
        """Forces of bulk and contacts at the functions' state, without Dirichlet conditions."""
        force = self.bulk_residual().copy()
        for interface in self.interfaces:
            interface.add_residual(force)
        return force

    def jacobian(
        self, A: PETSc.Mat | None = None, springs: npt.NDArray[np.float64] | None = None
    ) -> PETSc.Mat:
        """Assemble the Jacobian at the functions' state.

        Args:
            springs: What is added to the diagonal of the displacements, shape (num_dofs,).
            A: Matrix that an earlier call returned and whose pattern still fits, to write into.

        Returns:
            The Jacobian.
        """
        contact = self.assemble_contact()
        bulk = self._embed(self._bulk.jacobian())
        if A is None:
            bulk.axpy(1.0, contact, PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
            A = bulk
        else:
            A.zeroEntries()
            for part in (bulk, contact):
                A.axpy(1.0, part, PETSc.Mat.Structure.SUBSET_NONZERO_PATTERN)
        if springs is not None:
            diagonal = self.x.duplicate()
            self.blocks(diagonal.array)[0][:] = springs
            A.setDiagonal(diagonal, addv=PETSc.InsertMode.ADD)
        return A

    @property
    def num_local(self) -> int:
        """Number of displacements of all nodes on this rank."""
        return self.halo.num_nodes * int(self.block)

    def multiply_contact(self, A: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the contacts' part of the Jacobian, y = A x; all ranks must take part.

        Args:
            A: What ``contact_entries`` has given.
            x: Vector of all unknowns.
            y: Product, overwritten.
        """
        n, gdim = self.num_bulk, self.block
        local, product = A.createVecs()
        u = self.halo.extend(x.array_r[:n].reshape(-1, gdim)).ravel()
        local.array[:] = np.concatenate([u, x.array_r[n:]])
        A.mult(local, product)
        forces, rows = np.split(product.array_r, [self.num_local])
        y.array[:n] = self.halo.add_up(forces.reshape(-1, gdim)).ravel()
        y.array[n:] = rows

    def contact_entries(self, b: PETSc.Vec | None = None) -> PETSc.Mat:
        """Assemble the contacts' part of the Jacobian with no place for what is zero.

        Args:
            b: Right-hand side; where it is zero the multipliers of open nodes are, and nothing is
                assembled for them. Any right-hand side if None.
        """
        which = []
        for k, interface in enumerate(self.interfaces, start=1):
            rows = slice(self._offsets[k], self._offsets[k + 1])
            known = np.ones(1) if b is None else b.array_r[rows].reshape(-1, interface.nodes.size)
            which.append(interface.nodes.closed | (known != 0).any(axis=-1))
        A = self._new_matrix()
        A.setOption(PETSc.Mat.Option.IGNORE_ZERO_ENTRIES, True)
        self._assemble_contact(A, which)
        return A

    def assemble_contact(self) -> PETSc.Mat:
        """Assemble the contacts' part of the Jacobian, in all unknowns."""
        if self._contact is None or not self.fits():
            self._contact = self._new_matrix()
            self._contact_pairs = [list(interface.forms) for interface in self.interfaces]
        self._contact.zeroEntries()
        every = [np.ones_like(i.nodes.closed) for i in self.interfaces]
        self._assemble_contact(self._contact, every)
        return self._contact

    def _new_matrix(self) -> PETSc.Mat:
        size = (self._offsets[-1], None)
        A = PETSc.Mat().createAIJ((size, size), comm=self._comm)
        A.setUp()
        local = PETSc.LGMap().create(
            np.arange(self._offsets[-1], dtype=PETSc.IntType), 1, comm=self._comm
        )
        A.setLGMap(local, local)
        return A

    def _assemble_contact(self, A: PETSc.Mat, which: Sequence[npt.NDArray[np.bool_]]) -> None:
        serial = PETSc.COMM_SELF
        nodes = np.arange(self.num_bulk // self.block, dtype=PETSc.IntType)
        bulk = PETSc.IS().createBlock(self.block, nodes, comm=serial)
        markers = self._bulk.markers
        for k, interface in enumerate(self.interfaces, start=1):
            first, last = self._offsets[k], self._offsets[k + 1]
            slave = PETSc.IS().createStride(last - first, first, 1, comm=serial)
            for form in interface.forms:
                stiffness, traction, constraint = form.blocks(which[k - 1])
                if stiffness is not None:
                    _assemble(A, stiffness, (bulk, bulk), (markers, markers))
                if traction is not None:
                    _assemble(A, traction, (bulk, slave), (markers, _NONE))
                if constraint is not None:
                    _assemble(A, constraint, (slave, bulk), (_NONE, markers))
            size = interface.nodes.size
            rows = np.arange(first, last, dtype=PETSc.IntType)
            A.setValuesLocalIJV(
                np.arange(0, size * len(rows) + 1, size, dtype=PETSc.IntType),
                np.repeat(rows.reshape(-1, size), size, axis=0).ravel(),
                interface.nodes.by_multiplier.ravel(),
                addv=PETSc.InsertMode.ADD,
                rowmap=rows,
            )
        A.assemble()

    def _embed(self, K: PETSc.Mat) -> PETSc.Mat:
        """The bulk's matrix with empty rows and columns for the multipliers."""
        indptr, indices, values = K.getValuesCSR()
        multipliers = self._offsets[-1] - self.num_bulk
        indptr = np.concatenate([indptr, np.full(multipliers, indptr[-1], dtype=indptr.dtype)])
        size = (self._offsets[-1], None)
        return PETSc.Mat().createAIJ((size, size), csr=(indptr, indices, values), comm=self._comm)


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
