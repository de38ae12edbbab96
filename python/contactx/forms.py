# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact in a system that is assembled from forms, by the user's own loop."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host import contact_mesh
from contactx._host.forms import ContactForms, form_of
from contactx._host.parallel.reduce import agreed
from contactx.assembler import ContactAssembler
from dolfinx import cpp, fem, la

_NONE = np.zeros(0, dtype=np.int8)
# Of the messages in which index maps find out who has their ghosts
_TAG = 7092


class Forms:
    """Adds contact, from forms, to a matrix and a vector that have the bulk already.

    The loop, the assembly of the bulk and its Dirichlet conditions are the user's, in SNES for
    example. Contact is one call in each place::

        assembler = cx.ContactAssembler(F, u, contacts=[contact], bcs=bcs)
        forms = cx.Forms(assembler, J)
        assembler.begin_step()
        x = assembler.x
        while not forms.settle(x).converged:   # pairs, active set and law, at an accepted iterate
            ...                                # b = residual of the bulk
            forms.assemble_vector(b)
            A = forms.matrix()
            ...                                # add the Jacobian of the bulk to A
            forms.assemble_matrix(A)
            ...                                # solve and update x
        assembler.accept()

    The unknowns are those of the assembler: a rank's displacements, then its multipliers over the
    factor c. The matrix is made from one sparsity pattern. Its local numbers are those of the
    displacement, with the nodes of other ranks that contact needs behind those of the bulk, then
    those of the multipliers of each contact.
    """

    def __init__(self, assembler: ContactAssembler, J: fem.Form):
        """Make the forms of all contacts; all ranks must take part.

        Args:
            assembler: Bulk and contacts; the displacement is all that it solves for.
            J: Bilinear form of the displacement, for whose entries the matrix has places.

        Raises:
            ValueError: If the assembler has other fields, or J is no bilinear form of the
                displacement's space.
        """
        V = assembler.u.function_space
        with agreed(V.mesh.comm):
            if assembler.bulk.fields:
                raise ValueError(
                    "Forms is for a displacement alone, but the assembler solves for other fields, "
                    "too: take the forms of each contact, contact.forms()"
                )
            spaces = J.function_spaces if isinstance(J, fem.Form) else []
            if len(spaces) != 2 or any(space != V._cpp_object for space in spaces):
                raise ValueError(
                    "J must be a compiled bilinear form of the displacement's space: "
                    "give fem.form(ufl.derivative(F, u))"
                )
        self._assembler, self._J = assembler, J
        self._system = assembler.system
        # Versions of the forms, and of those that the matrix is for
        self._versions: list[int] = []
        self._A: PETSc.Mat | None = None
        self._made_for: list[int] = []
        self._refresh()

    def matrix(self) -> PETSc.Mat:
        """Matrix for bulk and contacts; all ranks must take part.

        The Jacobian of the bulk is assembled into it by
        ``dolfinx.fem.petsc.assemble_matrix(A, [[J]], bcs=bcs)``.

        Returns:
            The matrix, zero: another object where pairs have become others, for which the old one
            has no places.
        """
        if self._A is None or self._made_for != self._versions:
            self._A, self._made_for = self._create_matrix(), self._versions
        self._A.zeroEntries()
        return self._A

    def _create_matrix(self) -> PETSc.Mat:
        """Make the matrix from one sparsity pattern; all ranks must take part.

        DOLFINx 0.11 cannot put patterns of several index maps together in Python. So there is one
        index map of all unknowns, and a space on it whose cells are those of the bulk, the pairs
        and the slave nodes.
        """
        comm, size = self._system.halo.comm, self._system.x.getLocalSize()
        at, end, places = 0, size, self._places()
        ghosts: list[Any] = []
        owners: list[Any] = []
        numbers: list[Any] = []
        for (index_map, width), of_block in zip(self._maps(), places, strict=True):
            own, others = width * index_map.size_local, width * index_map.num_ghosts
            ghosts.append(of_block[own:])
            owners.append(np.repeat(index_map.owners, width))
            number = np.r_[at : at + own, end : end + others]
            numbers.append(number.astype(np.int32).reshape(-1, width))
            at, end = at + own, end + others
        owner = np.concatenate(owners).astype(np.int32)
        every = cpp.common.IndexMap(comm, size, np.concatenate(ghosts), owner, _TAG)
        pattern = cpp.la.SparsityPattern(comm, [every, every], [1, 1])
        for dofs in self._coupled(numbers):
            mesh = contact_mesh.carrier(MPI.COMM_SELF, len(dofs))
            V = contact_mesh.borrow(mesh, every, dofs, 1)
            cells = np.arange(len(dofs), dtype=np.int32)
            form = form_of(mesh, cells, [V, V], core.nodal_kernel(1), [], [])
            cpp.fem.build_sparsity_pattern(pattern, form._cpp_object)
        pattern.finalize()
        A = cpp.la.petsc.create_matrix(comm, pattern)
        local = np.concatenate(places).astype(PETSc.IntType)
        numbering = PETSc.LGMap().create(local, comm=MPI.COMM_SELF)
        A.setLGMap(numbering, numbering)
        return A

    def _coupled(self, numbers: list[Any]) -> Iterator[Any]:
        """Unknowns that couple with one another, by cell, pair and slave node.

        Args:
            numbers: Numbers of the unknowns of each block of the displacement, and of the
                multipliers of each contact.
        """

        def unknowns(k: int, space: Any) -> Any:
            blocks = space.dofmap.map()
            width = blocks.shape[1] * numbers[k].shape[1]
            return numbers[k][blocks].reshape(len(blocks), width)

        yield unknowns(0, self._J.function_spaces[0])
        for k, forms in enumerate(self._forms(), 1):
            for form in forms.C:
                S, U = form.function_spaces
                yield np.hstack([unknowns(0, U), unknowns(k, S)])
            for form in forms.D:
                yield unknowns(k, form.function_spaces[0])

    def settle(
        self, x: PETSc.Vec, rtol: float = 1e-11, atol: float = 0.0, max_it: int = 50
    ) -> core.Settled:
        """Update pairs, active set and law at an accepted iterate, once an iteration.

        See ``ContactAssembler.settle``, which this calls. Steps are taken by the caller, not by
        ``ContactAssembler.update``.

        Args:
            x: The iterate: the state becomes this. It may change a little.
            rtol: Tolerance relative to the forces of the problem.
            atol: Absolute tolerance, a force.
            max_it: Most linear solves of the step.

        Returns:
            The iterate: its residual, its changes, and whether it is a solution.

        Raises:
            ConvergenceError: If no solution is to be expected any more.
            RuntimeError: If no step has begun.
            ValueError: If friction, offset or an obstacle has a value out of its range.
        """
        self._system.unpack(x)
        if self._assembler.report.history:
            self._assembler.core.moved()
        found = self._assembler.settle(rtol, atol, max_it)
        self._assembler.x.copy(x)
        self._evaluate()
        return found

    def update(self, x: PETSc.Vec) -> None:
        """Evaluate gaps and law at some x, as in a line search; pairs and active set stay.

        Args:
            x: Unknowns: the state becomes this.
        """
        self._system.unpack(x)
        self._evaluate()

    def assemble_vector(self, b: PETSc.Vec) -> None:
        """Add the contacts' residual, but for rows with a Dirichlet condition.

        Args:
            b: Residual of the bulk, with zero for the multipliers.
        """
        self._assembler.enter("residual", b)
        at = self._system.num_displacements
        maps = self._maps()
        force = la.vector(*maps[0])
        for forms, (index_map, width) in zip(self._forms(), maps[1:], strict=True):
            for form in forms.F_u:
                fem.assemble_vector(force.array, form)
            values = la.vector(index_map, width)
            for form in forms.F_lambda:
                fem.assemble_vector(values.array, form)
            n = index_map.size_local * width
            b.array[at : at + n] += values.array[:n]
            at += n
        force.scatter_reverse(la.InsertMode.add)
        n = self._system.num_displacements
        b.array[:n] += np.where(self._system.core.markers()[:n] == 0, force.array[:n], 0)

    def assemble_matrix(self, A: PETSc.Mat) -> None:
        """Add the contacts' Jacobian, but for rows with a Dirichlet condition, and finish A.

        The columns of these dofs stay: what is prescribed need not be lifted for contact.

        Args:
            A: The matrix, with the Jacobian of the bulk.

        Raises:
            ValueError: If pairs have become others since ``matrix`` returned it.
        """
        self._assembler.enter("jacobian", A)
        is_old = self._A is None or A.handle != self._A.handle or self._made_for != self._versions
        if is_old:
            raise ValueError("A is not the matrix of the pairs of now: take matrix() again")
        A.assemble(PETSc.Mat.AssemblyType.FLUSH)
        sets = cpp.la.petsc.create_index_sets(self._maps())
        markers = self._system.core.markers()
        for form, i, j in self._blocks():
            part = A.getLocalSubMatrix(sets[i], sets[j])
            cpp.fem.petsc.assemble_matrix(
                part,
                form._cpp_object,
                fem.pack_constants(form),
                fem.pack_coefficients(form),
                markers if i == 0 else _NONE,
                _NONE,
                True,
            )
            A.restoreLocalSubMatrix(sets[i], sets[j], part)
        A.assemble()
        self._system.finish(A, self._assembler.loop.free_bodies.springs)

    def blocks(self, A: PETSc.Mat) -> dict[str, PETSc.Mat]:
        """Split an assembled matrix into its blocks [[K, B], [C, D]].

        Args:
            A: The matrix.

        Returns:
            The four blocks by their names, see ``ContactAssembler.blocks``.
        """
        return self._system.blocks(A)

    def _evaluate(self) -> None:
        self._system.core.evaluate()
        self._refresh()

    def _refresh(self) -> None:
        """Let the forms follow the state."""
        self._versions = [contact.forms().version for contact in self._assembler.contacts]

    def _forms(self) -> list[ContactForms]:
        return [discrete.current_forms for discrete in self._system.discrete_contacts]

    def _blocks(self) -> Iterator[tuple[fem.Form, int, int]]:
        """Forms of the contacts, with the rows and columns that they are of."""
        for k, forms in enumerate(self._forms(), 1):
            for part, i, j in (
                (forms.K, 0, 0), (forms.B, 0, k), (forms.C, k, 0), (forms.D, k, k)
            ):  # fmt: skip
                for form in part:
                    yield form, i, j

    def _maps(self) -> list[tuple[Any, int]]:
        """Index maps of the displacement and of the multipliers, with the sizes of blocks."""
        forms = self._forms()
        first = forms[0].displacement_map, self._system.block
        return [first, *((f.multiplier_map, f.multiplier_size) for f in forms)]

    def _places(self) -> list[Any]:
        """Places of the unknowns of each index map, ghosts last; all ranks must take part."""
        places, at = self._system.places(), self._system.num_local
        parts = [places[:at]]
        for index_map, width in self._maps()[1:]:
            vector = la.vector(index_map, width, np.int64)
            n = index_map.size_local * width
            vector.array[:n] = places[at : at + n]
            vector.scatter_forward()
            parts.append(vector.array)
            at += n
        return parts
