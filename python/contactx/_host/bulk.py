# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The bulk: UFL residuals with their Jacobian and Dirichlet conditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import ufl
from contactx._host.blocks import Blocks
from contactx._host.parallel.reduce import everywhere
from contactx._host.unknowns import Unknowns
from contactx.conductance import Conductance
from dolfinx import fem

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int64]
type Entries = tuple[Index, Index, Array]


class Bulk:
    """Residual and Jacobian of the bodies without contact.

    The displacement is solved for alone or with other fields. Between ranks a row is known by its
    place: displacements of a rank's nodes, its other fields, and multipliers.

    Attributes:
        unknowns: Functions that are solved for.
        u: Displacement.
        fields: Other fields: for each the number of its function, and its owned dofs.
        blocks: Forms and matrices of the functions.
        residual_form: Residual as the user gave it; None where there are other fields.
        form_options: Options of the compilation of forms.
        has_own_jacobian: Whether the user gave the Jacobian.
        is_linear: Whether the Jacobian does not depend on what is solved for.
        conductances: Conductances across contacts, whose flow is added to the residuals.
        comm: Communicator; what assembles or asks for the matrix needs all ranks.
        num_dofs: Number of the displacement's dofs of this rank.
        markers: 1 at its dofs with a Dirichlet condition, those of other ranks last.
        assemblies: How often the Jacobian was assembled.
        skipped: How often an assembled Jacobian served again.
    """

    def __init__(
        self,
        F: Sequence[ufl.Form],
        J: Sequence[Sequence[ufl.Form | None]] | None,
        unknowns: Unknowns,
        bcs: Sequence[fem.DirichletBC],
        form_compiler_options: dict[str, Any] | None = None,
        jit_options: dict[str, Any] | None = None,
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
        self.fields = unknowns.fields()
        self.residual_form: ufl.Form | None = None if self.fields else F[0]
        self.has_own_jacobian = J is not None
        options = {"form_compiler_options": form_compiler_options, "jit_options": jit_options}
        self.form_options: dict[str, Any] = options
        self.blocks = Blocks(F, J, unknowns.functions, options)
        self.is_linear = self.blocks.is_linear
        self.conductances: list[Conductance] = []
        self.comm: MPI.Comm = self.blocks.comm
        self._own = unknowns.dofs()
        self.num_dofs = len(self._own)
        self._A: PETSc.Mat = None
        self._rows: PETSc.Mat | None = None
        self._symmetric: bool | None = None
        # Blocks of the displacement and of all other fields
        self._split: list[list[PETSc.Mat]] | None = None
        # Rows and columns of the entries of the blocks
        self._at: tuple[Index, Index] | None = None
        # Rows of other fields that were assembled last, by what they are
        self._of_fields: dict[str, Array] = {}
        self.markers = np.zeros(len(self.u.x.array), dtype=np.int8)
        self.set_conditions(bcs)
        self.assemblies = self.skipped = 0

    def follow(self, conductances: Sequence[Conductance]) -> None:
        """Take the conductances across contacts, whose flow is added to the residuals."""
        self.conductances = list(conductances)
        # Pairs, gaps and pressures decide on it
        self.is_linear = self.is_linear and not conductances

    def read(self) -> None:
        """Take the displacement of the user's function, where u is a copy."""
        self.unknowns.read()

    def write(self) -> None:
        """Give it to the user's function."""
        self.unknowns.write()

    @property
    def bcs(self) -> list[fem.DirichletBC]:
        """Dirichlet conditions."""
        return self.blocks.bcs

    def set_conditions(self, bcs: Sequence[fem.DirichletBC]) -> None:
        """Take other Dirichlet conditions from now on; all ranks must take part.

        Args:
            bcs: The conditions.
        """
        self.blocks.set_conditions(bcs)
        self.markers[:] = self._displacement_of(self.blocks.markers)

    def number_of(self, function: fem.Function) -> int:
        """Number of one of the functions that are solved for."""
        return next(k for k, w in enumerate(self.unknowns.functions) if w is function)

    def first_of(self, function: int) -> int:
        """Where the dofs of a function that is one field begin among all other fields.

        Args:
            function: Its number.
        """
        return sum(len(dofs) for k, dofs in self.fields if k < function)

    def of_fields[T: np.generic](self, arrays: list[npt.NDArray[T]]) -> npt.NDArray[T]:
        """Values at the dofs of other fields, one after the other, of values of all functions."""
        return np.concatenate([arrays[k][dofs] for k, dofs in self.fields])

    def rows_of_fields(self, name: str) -> Array:
        """Rows of other fields that ``residual`` or ``lifted`` has assembled last.

        Args:
            name: Which of both.
        """
        return self._of_fields[name]

    def _displacement_of[T: np.generic](self, arrays: list[npt.NDArray[T]]) -> npt.NDArray[T]:
        """Values at the displacement's dofs, ghosts included, of values of all functions."""
        values, dofs = arrays[self.unknowns.index], self.unknowns.all_dofs
        return values if dofs is None else values[dofs]

    def residual(self) -> Array:
        """Residual on this rank's dofs, without Dirichlet conditions; all ranks must take part."""
        arrays = self.blocks.residual()
        for conductance in self.conductances:
            flow = conductance.residual()
            arrays[self.number_of(conductance.field)][: len(flow)] += flow
        return self._taken("residual", arrays)

    def lifted(self) -> Array:
        """Residual of other rows from Dirichlet values that the displacement does not have yet.

        All ranks must take part.
        """
        return self._taken("lifted", self.blocks.lifted())

    def _taken(self, name: str, arrays: list[Array]) -> Array:
        if self.fields:
            self._of_fields[name] = self.of_fields(arrays)
        forces: Array = arrays[self.unknowns.index][self._own]
        return forces

    def dirichlet_defect(self) -> Array:
        """Displacement minus Dirichlet values, zero elsewhere, ghosts included."""
        return self._displacement_of(self.blocks.defects())

    def update(self) -> None:
        """Assemble the Jacobian where a coefficient or a constant of the form has changed.

        One that does not depend on the displacement is assembled once.
        """
        if not self._assemble():
            self.skipped += 1

    def _assemble(self) -> bool:
        if not self.blocks.assemble():
            return False
        self._A = self.blocks.matrices[0][0]
        self._symmetric = self._rows = self._split = None
        self.assemblies += 1
        return True

    def stiffness(self) -> PETSc.Mat:
        """Jacobian by displacements, for products, of whatever matrix type it is stored as."""
        self._assemble()
        return self._parts()[0][0] if self.fields else self._A

    def of_other_fields(self) -> tuple[PETSc.Mat, PETSc.Mat, PETSc.Mat]:
        """Blocks of displacements by other fields, of these by displacements, and by themselves."""
        self._assemble()
        (_, uf), (fu, ff) = self._parts()
        return uf, fu, ff

    def _parts(self) -> list[list[PETSc.Mat]]:
        """Blocks of the displacement and of all other fields; all ranks must take part."""
        if self._split is None:
            places = [(self.unknowns.index, self._own), *self.fields]
            blocks = [[self._part(row, column) for column in places] for row in places]
            ends = (slice(0, 1), slice(1, None))
            self._split = [[_joined([r[j] for r in blocks[i]]) for j in ends] for i in ends]
        return self._split

    def _part(self, row: tuple[int, Index], column: tuple[int, Index]) -> PETSc.Mat:
        """Derivative of some rows of a function by some dofs of another one, of owned numbers."""
        (i, rows), (j, columns) = row, column
        K = self.blocks.matrices[i][j]
        if len(rows) == K.getLocalSize()[0] and len(columns) == K.getLocalSize()[1]:
            # All of a block, unless there is another order of the nodes in it
            same = np.array_equal(rows, np.arange(len(rows)))
            same = same and np.array_equal(columns, np.arange(len(columns)))
            if everywhere(self.comm, same):
                return K
        first, last = K.getOwnershipRange()[0], K.getOwnershipRangeColumn()[0]
        sets = [
            PETSc.IS().createGeneral((start + dofs).astype(PETSc.IntType), comm=self.comm)
            for start, dofs in ((first, rows), (last, columns))
        ]
        return K.createSubMatrix(*sets)

    def lend(self) -> PETSc.Mat:
        """The Jacobian in rows, of which ``keep_half`` leaves half; a copy where it would not."""
        may_halve = self.is_linear and self._is_whole and self.is_symmetric
        return self.stiffness() if may_halve or self.fields else self.copy()

    def copy(self) -> PETSc.Mat:
        """Copy of the Jacobian in rows, with unit rows and columns at Dirichlet conditions."""
        A = self.stiffness()
        return A.copy() if self._is_whole else A.convert("aij", PETSc.Mat())

    @property
    def _is_whole(self) -> bool:
        """True if all entries are stored, not half of a symmetric matrix."""
        return self.stiffness().getType() not in ("seqsbaij", "mpisbaij")

    def keep_half(self) -> None:
        """Keep only half of a Jacobian that stays and is symmetric: half the memory to pass."""
        if not self.fields and self.is_linear and self._is_whole and self.is_symmetric:
            self._A.setOption(PETSc.Mat.Option.SYMMETRIC, True)
            # In place: others may have the matrix, too
            self._A.convert("sbaij")
            # Assembled anew it is whole again
            self.blocks.matrices = []

    @property
    def is_symmetric(self) -> bool:
        """True if the Jacobian by displacements is symmetric."""
        K = self.stiffness()
        if self._symmetric is None:
            self._symmetric = _is_symmetric(K)
        return self._symmetric

    def _stiffness(self) -> PETSc.Mat:
        """Block of the function that has the displacement."""
        self._assemble()
        index, blocks = self.unknowns.index, self.blocks.matrices
        return blocks[index][index] if blocks else self._A

    def diagonal(self) -> Array:
        """Diagonal of the Jacobian at the displacement's owned dofs; all ranks must take part."""
        diagonal: Array = self._stiffness().getDiagonal().array[self._own]
        return diagonal

    def products(self, fields: Array) -> Array:
        """Products of the displacement's block with fields; all ranks must take part.

        Args:
            fields: Displacements at owned dofs, shape (count, num_dofs).
        """
        K = self._stiffness()
        x, y = K.createVecs()
        results = np.empty_like(fields)
        for field, result in zip(fields, results, strict=True):
            x.zeroEntries()
            x.array[self._own] = field
            K.mult(x, y)
            result[:] = y.array[self._own]
        return results

    def rows(self, dofs: npt.NDArray[np.integer]) -> PETSc.Mat:
        """Some rows of the Jacobian by displacements, for nobody to change.

        Args:
            dofs: Which owned ones, in order; the same ones every time.
        """
        A = self.stiffness()
        if self._rows is None:
            if not self._is_whole:
                A = self.copy()
            first, last = A.getOwnershipRange()
            some = PETSc.IS().createGeneral((first + dofs).astype(PETSc.IntType), comm=self.comm)
            every = PETSc.IS().createStride(last - first, first, comm=self.comm)
            self._rows = A.createSubMatrix(some, every)
        return self._rows

    def entries(self, own: Index) -> Entries:
        """Entries of the Jacobian assembled last: rows, columns and values.

        All ranks must take part.

        Args:
            own: Numbers of this rank's rows, displacements, then other fields, shape (num_rows,).
        """
        matrices = self.blocks.matrices or [[self.copy()]]
        blocks = [[K.getValuesCSR() for K in row] for row in matrices]
        if self._at is None:
            # The forms, and with them the pattern, stay the same
            self._at = self._placed(blocks, own)
        return *self._at, np.concatenate([v for row in blocks for _, _, v in row])

    def _placed(self, blocks: list[list[Any]], own: Index) -> tuple[Index, Index]:
        """Rows and columns of the entries of blocks."""
        # Which of this rank's rows a dof of a function is
        places = [np.empty(count, dtype=np.int64) for count in self.blocks.counts]
        at = 0
        for k, dofs in [(self.unknowns.index, self._own), *self.fields]:
            places[k][dofs] = own[at : at + len(dofs)]
            at += len(dofs)
        rows, columns = [], []
        for mine, row in zip(places, blocks, strict=True):
            for j, (indptr, indices, _) in enumerate(row):
                rows.append(np.repeat(mine, np.diff(indptr)))
                columns.append(self._places(j, places[j], indices.astype(np.int64)))
        return np.concatenate(rows), np.concatenate(columns)

    def _places(self, k: int, own: Index, columns: Index) -> Index:
        """Places of a function's dofs of any rank, of which this rank's own are given."""
        index_map, size = self.blocks.maps[k].index_map, self.blocks.maps[k].index_map_bs
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
        parts = [np.zeros(count) for count in self.blocks.counts]
        places = [(self.unknowns.index, self._own), *self.fields]
        ends = np.cumsum([len(dofs) for _, dofs in places])
        for (k, dofs), some in zip(places, np.split(sizes, ends[:-1]), strict=True):
            parts[k][dofs] = some
        sums = [np.zeros(count) for count in self.blocks.counts]
        for row, total in zip(self.blocks.matrices, sums, strict=True):
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

    def cell_sizes(self) -> npt.NDArray[np.float64]:
        """Size of the largest cell of this rank around each owned node, shape (num_owned,)."""
        V = self.u.function_space
        cells = V.dofmap.list
        sizes = V.mesh.h(V.mesh.topology.dim, np.arange(len(cells), dtype=np.int32))
        result = np.zeros(len(self.markers) // V.dofmap.index_map_bs)
        np.maximum.at(result, cells, sizes[:, None])
        owned: npt.NDArray[np.float64] = result[: V.dofmap.index_map.size_local]
        return owned


def _joined(blocks: list[list[PETSc.Mat]]) -> PETSc.Mat:
    """Join blocks to one matrix."""
    if len(blocks) == len(blocks[0]) == 1:
        return blocks[0][0]
    return PETSc.Mat().createNest(blocks, comm=blocks[0][0].comm).convert("aij", PETSc.Mat())


def _is_symmetric(K: PETSc.Mat) -> bool:
    """True if x.Ky = y.Kx for two random vectors, which an asymmetric K fails but for chance."""
    x, y = K.createVecs()
    work = y.duplicate()
    rng = np.random.default_rng(K.comm.rank)
    for vector in (x, y):
        vector.array[:] = rng.standard_normal(vector.getLocalSize())
    K.mult(y, work)
    one, size = x.dot(work), work.norm() * x.norm()
    K.mult(x, work)
    return bool(abs(one - y.dot(work)) <= 1e-12 * size)
