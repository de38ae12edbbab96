# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""PETSc options of the solver."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from petsc4py import PETSc

import numpy as np

from contactx._host import compat

# Dofs of the displacement from which on multigrid is faster than a direct solver, by the
# dimension: without friction, and with it, where systems are not symmetric (bench_solvers)
_MIN_CONDENSED_DOFS = {2: (4_000, 300_000), 3: (2_500, 2_500)}
# The same where other fields are solved for, too (bench_solvers)
_MIN_CONDENSED_DOFS_OF_MIXED = {2: (300_000, 300_000), 3: (12_000, 12_000)}


# PETSc's numbers of errors for a type, and for a package, that it does not have
_NO_SUCH_KIND = (86, 92)

_TOLERANCES = ("snes_rtol", "snes_atol", "snes_stol", "ksp_rtol", "ksp_atol")
_COUNTS = ("snes_max_it", "ksp_max_it")


class SolverOptions:
    """Options that a user gives, and defaults for the others."""

    def __init__(self, prefix: str, given: Mapping[str, Any], defaults: Mapping[str, Any]):
        """Take the options.

        Args:
            prefix: Prefix of the options in PETSc's database.
            given: Options of the user, without the prefix.
            defaults: Options where the user gives none.
        """
        self._prefix = prefix
        self._given = set(given)
        self._options = {**defaults, **given}

    @contextmanager
    def in_database(self) -> Iterator[None]:
        """Hold the options in PETSc's database while its objects set themselves up."""
        database = PETSc.Options(self._prefix)
        before = {
            name: database.getString(name) if database.hasName(name) else None
            for name in self._options
        }
        for name, value in self._options.items():
            # The user's own values, such as those of the command line, go before a default
            if name in self._given or before[name] is None:
                database[name] = value
        try:
            yield
        except PETSc.Error as error:
            if error.ierr in _NO_SUCH_KIND:
                raise self._refusal(error) from error
            raise
        finally:
            for name, value in before.items():
                if value is None:
                    database.delValue(name)
                else:
                    database[name] = value

    def hand_to(self, snes: PETSc.SNES) -> None:
        """Set a solver up by the options in the database.

        Args:
            snes: The solver.

        Raises:
            ValueError: If PETSc refuses one of them.
        """
        try:
            snes.setFromOptions()
        except PETSc.Error as error:
            raise self._refusal(error) from error

    def unread(self) -> list[str]:
        """Options of the user in the database that nothing has read."""
        database = PETSc.Options()
        return sorted(name for name in self._given if not database.used(self._prefix + name))

    def _refusal(self, error: PETSc.Error) -> ValueError:
        lines = (line.partition("] ")[2] for line in str(error).splitlines()[1:])
        said = " ".join(line for line in lines if " at /" not in line)
        return ValueError(
            f"PETSc refuses an option of the solver: {said}. Correct petsc_options, or what the "
            f"command line says of {self._prefix!r}"
        )


def multigrid_options(prefix: str) -> SolverOptions:
    """Options of the condensed solver's multigrid.

    One smoothing step measured fastest, on the finest level with the condensed matrix as it is.

    Args:
        prefix: Prefix of the options in PETSc's database.
    """
    return SolverOptions(prefix, {}, {"mg_levels_ksp_max_it": 1, "pc_use_amat": True})


def aggregation_options(prefix: str, num_unknowns: int) -> SolverOptions:
    """Options of PETSc's multigrid where its first coarser level is wanted, and nothing else.

    Args:
        prefix: Prefix of the options in PETSc's database.
        num_unknowns: Number of unknowns of the finest level.
    """
    options = {
        "pc_type": "gamg",
        "pc_gamg_coarse_eq_limit": max(1, num_unknowns - 1),
        "mg_levels_ksp_type": "richardson",
        "mg_levels_pc_type": "jacobi",
        "mg_coarse_pc_type": "jacobi",
    }
    return SolverOptions(prefix, {}, options)


def product_options() -> SolverOptions:
    """Options of the products of three matrices that a hierarchy of one rank is made of.

    Two products in turn take half the time of PETSc's choice for all three. What they leave in
    between is dropped: it would be the largest part of the memory.
    """
    return SolverOptions("", {}, {"matptap_via": "rap", "mat_product_clear": True})


def reproducible_options() -> SolverOptions:
    """Options that make solves the same to the last bit.

    PETSc sums several products of vectors in another order where the vectors happen to lie evenly
    spaced in memory.
    """
    return SolverOptions("", {}, {"vec_mdot_use_gemv": False})


def newton_options(prefix: str, given: Mapping[str, Any], *, condensed: bool) -> SolverOptions:
    """Options of the Newton loop.

    Args:
        prefix: Prefix of the options in PETSc's database.
        given: Options of the user, without the prefix.
        condensed: Whether the preconditioner is the condensed solver.
    """
    given = dict(given)
    if condensed:
        given.pop("pc_type", None)
        return SolverOptions(prefix, given, {**_newton(), "pc_type": "python"})
    return SolverOptions(prefix, given, {**_newton(), **_direct()})


def is_condensed(
    given: Mapping[str, Any],
    num_dofs: int,
    gdim: int,
    *,
    has_friction: bool,
    has_fields: bool,
) -> bool:
    """True if the condensed solver is taken: by the options, or by the size of the problem.

    Args:
        given: Options of the user, without the prefix.
        num_dofs: Number of displacements.
        gdim: Geometric dimension.
        has_friction: Whether a contact has friction.
        has_fields: Whether other fields are solved for with the displacement.
    """
    if "pc_type" in given:
        return bool(given["pc_type"] == "condensed")
    least = _MIN_CONDENSED_DOFS_OF_MIXED if has_fields else _MIN_CONDENSED_DOFS
    return num_dofs >= least[gdim][has_friction] and "ksp_type" not in given


def _newton() -> dict[str, Any]:
    """Options of the Newton loop where the user gives none."""
    return {
        "snes_type": "newtonls",
        "snes_linesearch_type": "basic",
        "snes_rtol": 1e-11,
        "snes_atol": 0.0,
        "snes_max_it": 50,
        "ksp_type": "preonly",
    }


def _direct() -> dict[str, Any]:
    """Options of a direct solver of the saddle point."""
    options: dict[str, Any] = {"ksp_type": "preonly", "pc_type": "lu"}
    # Where SuperLU_DIST is taken: it moves no pivots while it factorises, and stops at zero ones
    options["mat_superlu_dist_replacetinypivot"] = True
    solver = compat.direct_solver()
    if solver is not None:
        options["pc_factor_mat_solver_type"] = solver
    else:
        # PETSc's own LU does not pivot: the multipliers, whose diagonal is zero, must come last
        options["pc_factor_mat_ordering_type"] = "natural"
    if solver == "mumps":
        # Room for pivoting on the zero diagonal of the multipliers
        options["mat_mumps_icntl_14"] = 200
    return options


def direct_options(prefix: str) -> SolverOptions:
    """Options of a direct solver whose factors serve several matrices.

    Args:
        prefix: Prefix of the options in PETSc's database.
    """
    krylov = {"ksp_type": "gmres", "ksp_pc_side": "right", "ksp_gmres_restart": 60}
    return SolverOptions(prefix, {}, {**_direct(), **krylov})


def block_options(prefix: str, *, is_symmetric: bool, group: int = 1) -> SolverOptions:
    """Options of a direct solver of a block, in single precision where the solver has it.

    Args:
        prefix: Prefix of the options in PETSc's database.
        is_symmetric: Whether the block is symmetric.
        group: Number of successive unknowns that are coupled to the same others, those of a node.
            The solver orders groups.
    """
    options = {"ksp_type": "preonly", **_direct()}
    if compat.direct_solver() == "mumps":
        # Iterations correct the round-off
        options["pc_precision"] = "single"
        options["mat_mumps_icntl_14"] = 30
        if group > 1:
            options["mat_mumps_icntl_15"] = -group
        if is_symmetric:
            options["pc_type"] = "cholesky"
    return SolverOptions(prefix, {}, options)


def check_petsc_options(options: Any, prefix: Any) -> None:
    """Check the options of a problem.

    Args:
        options: PETSc options.
        prefix: Their prefix.

    Raises:
        TypeError: If the prefix or the name of an option is no string, or the options are no
            dictionary.
        ValueError: If the prefix is empty or not one for PETSc, a name begins with a dash, or a
            tolerance or number of iterations is not a finite non-negative number.
    """
    if prefix is not None and not isinstance(prefix, str):
        raise TypeError(f'petsc_options_prefix is {prefix!r}: give a string, such as "contact_"')
    if not prefix:
        raise ValueError('petsc_options_prefix is empty: give a unique one, such as "contact_"')
    if prefix.startswith("-") or len(prefix.split()) != 1 or prefix != prefix.strip():
        raise ValueError(
            f"petsc_options_prefix is {prefix!r}: give one without dash and spaces, such as "
            '"contact_"'
        )
    if options is not None and not isinstance(options, Mapping):
        raise TypeError(
            f"petsc_options must be a dictionary, not {type(options).__name__}: write "
            'petsc_options={"snes_rtol": 1e-9}'
        )
    for name in options or {}:
        if not isinstance(name, str):
            raise TypeError(f"petsc_options holds the name {name!r}: give strings")
        if name.startswith("-"):
            raise ValueError(f"petsc_options holds {name!r}: leave out the dash")
    for name in (*_TOLERANCES, *_COUNTS):
        value = (options or {}).get(name, 0)
        what = "an integer" if name in _COUNTS else "a number"
        try:
            valid = 0 <= float(value) < np.inf and (name in _TOLERANCES or int(value) == value)
        except (TypeError, ValueError):
            valid = False
        if not valid:
            raise ValueError(f"petsc_options[{name!r}] is {value!r}: give {what} of at least 0")
