# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A bulk whose displacement is solved for together with other fields."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import dolfinx.fem.petsc
import ufl
from contactx._host.bulk import Bulk, by_rule, check_jacobian
from contactx._host.layout import Index, Rows
from contactx._host.parallel import reduce
from contactx._host.unknowns import Unknowns
from contactx.conductance import Conductance
from dolfinx import fem, la

type Array = npt.NDArray[np.float64]


class CoupledBulk(Bulk):
    """Residuals and Jacobian of several fields, one of which is the displacement.

    Each function is a block of rows and of columns; a function of a mixed space is the only one.
    What ``Bulk`` says of the displacement's rows is said of them here, too; ``Fields`` has the
    others. Between ranks a row is known by its place: displacements of a rank's nodes, its other
    fields, and multipliers.
    """

    def __init__(
        self,
        F: Sequence[ufl.Form],
        J: Sequence[Sequence[ufl.Form | None]] | None,
        unknowns: Unknowns,
        bcs: Sequence[fem.DirichletBC],
        form_compiler_options: dict[str, Any] | None,
        jit_options: dict[str, Any] | None,
    ):
        """Compile the forms.

        Args:
            F: Residual of each function.
            J: Derivative of each residual by each function; derived if None.
            unknowns: The functions.
            bcs: Dirichlet conditions.
            form_compiler_options: Options of FFCx.
            jit_options: Options of the compilation.
        """
        self.unknowns = unknowns
        self.u = unknowns.u
        self._functions = unknowns.functions
        self._maps = [w.function_space.dofmap for w in self._functions]
        self._counts = [m.index_map.size_local * m.index_map_bs for m in self._maps]
        self.residual_form = None
        self.has_own_jacobian = J is not None
        options = {"form_compiler_options": form_compiler_options, "jit_options": jit_options}
        self.form_options: dict[str, Any] = options
        derivatives = J if J is not None else _derivatives(F, self._functions)
        self.F_blocks = [[fem.form(part, **options) for part in by_rule(f)] for f in F]
        self.J_blocks = [
            [[] if j is None else [fem.form(part, **options) for part in by_rule(j)] for j in row]
            for row in derivatives
        ]
        parts = [part for row in self.J_blocks for block in row for part in block]
        self._coefficients = [c for part in parts for c in part._cpp_object.coefficients]
        self._parts = parts
        own = [w._cpp_object for w in self._functions]
        self.is_linear = not any(c is w for c in self._coefficients for w in own)
        V = self.u.function_space
        self.comm = V.mesh.comm
        self.num_dofs = V.dofmap.index_map.size_local * V.dofmap.index_map_bs
        self._blocks: list[list[PETSc.Mat]] = []
        self._A: PETSc.Mat = None
        self._assembled_with: list[Array] | None = None
        self.markers = np.zeros(len(self.u.x.array), dtype=np.int8)
        self.assemblies = self.skipped = 0
        self._own = unknowns.dofs()
        self._fields = unknowns.fields()
        self.set_conditions(bcs)
        self._b = [la.vector(m.index_map, m.index_map_bs) for m in self._maps]
        self.fields = Fields(self)
        self.conductances: list[Conductance] = []
        # Order of the entries of the Jacobian's blocks in rows, and these without values
        self._order: tuple[npt.NDArray[np.intp], Index, Index] | None = None
        self._columns: list[PETSc.Vec] | None = None

    def set_conditions(self, bcs: Sequence[fem.DirichletBC]) -> None:
        """See ``Bulk``."""
        self.bcs = list(bcs)
        self._of_block = [_conditions_of(w.function_space, self.bcs) for w in self._functions]
        self.all_markers = [np.zeros(len(w.x.array), dtype=np.int8) for w in self._functions]
        for markers, conditions in zip(self.all_markers, self._of_block, strict=True):
            for bc in conditions:
                markers[bc.dof_indices()[0]] = 1
        index = self.unknowns.index
        self.markers[:] = self._displacement_of(self.all_markers[index])
        self._assembled_with = None

    def follow(self, conductances: Sequence[Conductance]) -> None:
        """Take the conductances across contacts, whose flow is added to the residuals."""
        self.conductances = list(conductances)
        # Pairs, gaps and pressures decide on it
        self.is_linear = self.is_linear and not conductances

    def number_of(self, function: fem.Function) -> int:
        """Number of one of the functions that are solved for."""
        return next(k for k, w in enumerate(self._functions) if w is function)

    def _displacement_of[T: np.generic](self, values: npt.NDArray[T]) -> npt.NDArray[T]:
        """Values at the displacement's dofs, ghosts included, of those of its function."""
        dofs = self.unknowns.all_dofs
        return values if dofs is None else values[dofs]

    def read(self) -> None:
        """See ``Bulk``."""
        self.unknowns.read()

    def write(self) -> None:
        """See ``Bulk``."""
        self.unknowns.write()

    def residual(self) -> Array:
        """See ``Bulk``."""
        for b, parts in zip(self._b, self.F_blocks, strict=True):
            b.array[:] = 0
            for part in parts:
                fem.assemble_vector(b.array, part)
        return self._assembled("residual", self.conductances)

    def lifted(self) -> Array:
        """See ``Bulk``."""
        values = [w.x.array for w in self._functions]
        for b, row in zip(self._b, self.J_blocks, strict=True):
            b.array[:] = 0
            for block, bcs, x in zip(row, self._of_block, values, strict=True):
                for part in block:
                    fem.apply_lifting(b.array, [part], [bcs], [x], alpha=-1.0)
        return self._assembled("lifted")

    def _assembled(self, name: str, conductances: Sequence[Conductance] = ()) -> Array:
        for b in self._b:
            b.scatter_reverse(la.InsertMode.add)
        for conductance in conductances:
            flow = conductance.residual()
            self._b[self.number_of(conductance.field)].array[: len(flow)] += flow
        self.fields.keep(name, [b.array for b in self._b])
        forces: Array = self._b[self.unknowns.index].array[self._own]
        return forces

    def all_defects(self) -> list[Array]:
        """Values minus Dirichlet values of each function, zero elsewhere, ghosts included."""
        defects = []
        for w, conditions in zip(self._functions, self._of_block, strict=True):
            defect = np.zeros(len(w.x.array))
            for bc in conditions:
                bc.set(defect, w.x.array, alpha=-1.0)
            defects.append(defect)
        return defects

    def dirichlet_defect(self) -> Array:
        """See ``Bulk``."""
        return self._displacement_of(self.all_defects()[self.unknowns.index])

    def jacobian(self) -> PETSc.Mat:
        """See ``Bulk``."""
        self.update()
        return self._A

    def matrix(self) -> PETSc.Mat:
        """See ``Bulk``; a matrix of blocks."""
        self._assemble()
        return self._A

    def diagonal(self) -> Array:
        """See ``Bulk``."""
        self._assemble()
        index = self.unknowns.index
        diagonal: Array = self._blocks[index][index].getDiagonal().array
        return diagonal[self._own]

    def products(self, fields: Array) -> Array:
        """See ``Bulk``: of the displacement's own block."""
        self._assemble()
        index = self.unknowns.index
        K = self._blocks[index][index]
        x, y = K.createVecs()
        results = np.empty_like(fields)
        for field, result in zip(fields, results, strict=True):
            x.zeroEntries()
            x.array[self._own] = field
            K.mult(x, y)
            result[:] = y.array[self._own]
        return results

    def rows_in(self, own: Index) -> Rows:
        """Rows of the Jacobian: displacements, then other fields.

        All ranks must take part.

        Args:
            own: Places of this rank's rows, in that order, shape (num_rows,).

        Returns:
            Rows with places for columns.
        """
        blocks = [[K.getValuesCSR() for K in row] for row in self._blocks]
        values = np.concatenate([v for row in blocks for _, _, v in row])
        if self._order is None or len(self._order[0]) != len(values):
            self._order = self._ordered(blocks, own)
        order, offsets, columns = self._order
        return offsets, columns, values[order]

    def _ordered(
        self, blocks: list[list[Any]], own: Index
    ) -> tuple[npt.NDArray[np.intp], Index, Index]:
        """Order of the entries of blocks in rows, where rows begin, and the columns."""
        # Which of this rank's rows a dof of a function is
        numbers = [np.empty(count, dtype=np.int64) for count in self._counts]
        at = len(self._own)
        numbers[self.unknowns.index][self._own] = np.arange(at)
        for k, dofs in self._fields:
            numbers[k][dofs] = np.arange(at, at + len(dofs))
            at += len(dofs)
        rows: list[Index] = []
        columns: list[Index] = []
        for mine, row in zip(numbers, blocks, strict=True):
            for j, (indptr, indices, _) in enumerate(row):
                rows.append(np.repeat(mine, np.diff(indptr)))
                columns.append(self._places(j, own[numbers[j]], indices.astype(np.int64)))
        every, column = np.concatenate(rows), np.concatenate(columns)
        order = np.lexsort((column, every))
        offsets = np.zeros(at + 1, dtype=np.int64)
        np.cumsum(np.bincount(every, minlength=at), out=offsets[1:])
        return order, offsets, column[order]

    def _places(self, k: int, own: Index, columns: Index) -> Index:
        """Places of a function's dofs of any rank, of which this rank's own are given."""
        index_map, size = self._maps[k].index_map, self._maps[k].index_map_bs
        first = index_map.local_range[0] * size
        if self.comm.size == 1:
            mine: Index = own[columns - first]
            return mine
        # Numbers up to 2^53 are exact
        every = PETSc.Vec().createMPI((len(own), None), comm=self.comm)
        every.array[:] = own
        wanted, back = np.unique(columns, return_inverse=True)
        found = PETSc.Vec().createSeq(len(wanted))
        from_all = PETSc.IS().createGeneral(wanted.astype(PETSc.IntType), comm=PETSc.COMM_SELF)
        scatter = PETSc.Scatter().create(every, from_all, found, None)
        scatter.scatter(every, found)
        places: Index = found.array.astype(np.int64)[back]
        return places

    def absolute_products(self, sizes: Array) -> Array:
        """Products of the Jacobian with sizes, all entries by their size.

        All ranks must take part.

        Args:
            sizes: Sizes of this rank's unknowns: displacements, then other fields.

        Returns:
            Sums in each of these rows.
        """
        self._assemble()
        parts = [np.zeros(count) for count in self._counts]
        places = [(self.unknowns.index, self._own), *self._fields]
        ends = np.cumsum([len(dofs) for _, dofs in places])
        for (k, dofs), some in zip(places, np.split(sizes, ends[:-1]), strict=True):
            parts[k][dofs] = some
        sums = [np.zeros(count) for count in self._counts]
        for row, total in zip(self._blocks, sums, strict=True):
            for K, size in zip(row, parts, strict=True):
                x, y = K.createVecs()
                x.array[:] = size
                absolute = K.copy()
                indptr, indices, values = K.getValuesCSR()
                absolute.zeroEntries()
                absolute.setValuesCSR(indptr, indices, np.abs(values))
                absolute.assemble()
                absolute.mult(x, y)
                total += y.array
        return np.concatenate([sums[k][dofs] for k, dofs in places])

    @property
    def is_symmetric(self) -> bool:
        """See ``Bulk``; it is not asked for."""
        return False

    def _assemble(self) -> bool:
        constants = (fem.pack_constants(part) for part in self._parts)
        parameters = [*constants, *(c.x.array for c in self._coefficients)]
        same = self._assembled_with is not None and all(
            map(np.array_equal, parameters, self._assembled_with)
        )
        if reduce.everywhere(self.comm, same):
            return False
        if not self._blocks:
            self._blocks = [
                [self._create(i, j, block) for j, block in enumerate(row)]
                for i, row in enumerate(self.J_blocks)
            ]
            self._A = PETSc.Mat().createNest(self._blocks, comm=self.comm)
        self._assembled_with = None
        for i, (matrices, row) in enumerate(zip(self._blocks, self.J_blocks, strict=True)):
            for j, (K, block) in enumerate(zip(matrices, row, strict=True)):
                K.zeroEntries()
                for part in block:
                    K.assemble(PETSc.Mat.AssemblyType.FLUSH)
                    dolfinx.fem.petsc.assemble_matrix(K, part, bcs=self.bcs)
                if not block and i == j:
                    own = np.flatnonzero(self.all_markers[i][: self._counts[i]])
                    for row_number in own + K.getOwnershipRange()[0]:
                        K.setValue(row_number, row_number, 1.0)
                K.assemble()
                check_jacobian(K)
        self._A.assemble()
        self._assembled_with = [values.copy() for values in parameters]
        self.assemblies += 1
        return True

    def _create(self, i: int, j: int, block: list[fem.Form]) -> PETSc.Mat:
        if block:
            return dolfinx.fem.petsc.create_matrix(block[0])
        sizes = (self._counts[i], None), (self._counts[j], None)
        K = PETSc.Mat().createAIJ(sizes, nnz=(1 if i == j else 0, 0), comm=self.comm)
        if i == j:
            for row in range(*K.getOwnershipRange()):
                K.setValue(row, row, 0.0)
        K.assemble()
        return K


class Fields:
    """The fields beside the displacement, as the core's ``newton::Fields`` describes them."""

    def __init__(self, bulk: CoupledBulk):
        """Take the bulk."""
        self._bulk = bulk
        self._fields = bulk.unknowns.fields()
        self.offsets = np.cumsum([0, *(len(dofs) for _, dofs in self._fields)]).tolist()
        self._kept: dict[str, Array] = {}

    def _taken[T: np.generic](self, arrays: list[npt.NDArray[T]]) -> npt.NDArray[T]:
        return np.concatenate([arrays[k][dofs] for k, dofs in self._fields])

    def keep(self, name: str, arrays: list[Array]) -> None:
        """Keep rows that were assembled."""
        self._kept[name] = self._taken(arrays)

    def values(self) -> Array:
        """Values of now."""
        return self._taken([w.x.array for w in self._bulk.unknowns.functions])

    def set(self, values: Array) -> None:
        """Set them, ghosts included."""
        functions = self._bulk.unknowns.functions
        parts = np.split(values, self.offsets[1:-1])
        for (k, dofs), part in zip(self._fields, parts, strict=True):
            functions[k].x.array[dofs] = part
        for k in sorted({k for k, _ in self._fields}):
            functions[k].x.scatter_forward()

    @property
    def follow_contacts(self) -> bool:
        """True if their residuals depend on contacts."""
        return bool(self._bulk.conductances)

    def first_of(self, function: int) -> int:
        """Where the dofs of a function that is one field begin among all fields."""
        return int(self.offsets[[k for k, _ in self._fields].index(function)])

    def residual(self) -> Array:
        """Their rows of the residual assembled last."""
        return self._kept["residual"]

    def lifted(self) -> Array:
        """Their rows of what was lifted last."""
        return self._kept["lifted"]

    def defect(self) -> Array:
        """Values minus Dirichlet values, zero elsewhere."""
        return self._taken(self._bulk.all_defects())

    def markers(self) -> npt.NDArray[np.int8]:
        """1 at prescribed values."""
        return self._taken(self._bulk.all_markers)

    def absolute_products(self, sizes: Array) -> Array:
        """Products of the Jacobian with sizes of all unknowns, all entries by their size."""
        return self._bulk.absolute_products(sizes)


def _derivatives(
    F: Sequence[ufl.Form], functions: Sequence[fem.Function]
) -> list[list[ufl.Form | None]]:
    """Derivative of each residual by each function; None where there is none."""
    rows: list[list[ufl.Form | None]] = []
    for f in F:
        row: list[ufl.Form | None] = []
        for w in functions:
            # Loads drop out, so that a constant of theirs that changes does not count as one of J
            terms = [
                i for i in f.integrals() if w in ufl.algorithms.extract_coefficients(i.integrand())
            ]
            du = ufl.TrialFunction(w.function_space)
            J = ufl.algorithms.expand_derivatives(ufl.derivative(ufl.Form(terms), w, du))
            row.append(None if J.empty() else ufl.derivative(ufl.Form(terms), w, du))
        rows.append(row)
    return rows


def _conditions_of(V: fem.FunctionSpace, bcs: Sequence[fem.DirichletBC]) -> list[Any]:
    """Conditions on a space or a part of it."""
    return [bc for bc in bcs if V._cpp_object.contains(bc.function_space)]
