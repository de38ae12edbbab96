# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of what a user passes, before any work starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx.contact import Contact
from contactx.parallel.agreement import agreed
from dolfinx import fem, la

_TOLERANCES = ("snes_rtol", "snes_atol", "snes_stol", "ksp_rtol", "ksp_atol")
_COUNTS = ("snes_max_it", "ksp_max_it")


def check_displacement(u: Any) -> None:
    """Check that a displacement is one that contact can act on.

    Args:
        u: Displacement.

    Raises:
        TypeError: If it is no function, or not of real double precision.
        ValueError: If its space is not the linear Lagrange space of vectors on its mesh.
    """
    if not isinstance(u, fem.Function):
        raise TypeError(f"u must be a dolfinx.fem.Function, not {type(u).__name__}")
    if u.dtype != np.float64:
        raise TypeError(f"u holds {np.dtype(u.dtype).name} values, but contactx needs float64")
    V = u.function_space
    gdim = V.mesh.geometry.dim
    if V.mesh.topology.dim != gdim or gdim not in (2, 3):
        raise ValueError(
            f"u is on a mesh of cells of dimension {V.mesh.topology.dim} in {gdim} dimensions; "
            "contact needs plane cells in the plane or solid ones in space"
        )
    wanted = f'functionspace(mesh, ("Lagrange", 1, ({gdim},)))'
    element = V.ufl_element()
    if len(V._cpp_object.component()) > 0 or isinstance(element, basix.ufl._MixedElement):
        raise ValueError(
            f"u is in a mixed space or a part of one; contact needs a displacement of its own: "
            f"{wanted}"
        )
    if element.reference_value_shape != (gdim,) or element.block_size != gdim:
        raise ValueError(
            f"u has values of shape {element.reference_value_shape}, but the displacement of this "
            f"mesh needs ({gdim},): {wanted}"
        )
    if element.degree != 1:
        raise ValueError(f"u is of degree {element.degree}; contact needs degree 1: {wanted}")
    if element.element_family != basix.ElementFamily.P or element.discontinuous:
        raise ValueError(f"u is not in a continuous Lagrange space; contact needs {wanted}")


def check_finite(comm: MPI.Comm, **vectors: la.Vector) -> None:
    """Check that vectors hold no NaN or infinity.

    Args:
        comm: Communicator.
        vectors: Vectors by what they hold.

    Raises:
        ValueError: If one is not finite on any rank, on all ranks.
    """
    for name, vector in vectors.items():
        bad = np.flatnonzero(~np.isfinite(vector.array))
        with agreed(comm):
            if len(bad) > 0:
                raise ValueError(
                    f"{name.replace('_', ' ')} not finite at {len(bad)} dofs, first at node "
                    f"{bad[0] // vector.block_size}: repair the mesh or the initial guess"
                )


def check_prescribed(
    u: npt.NDArray[np.float64], markers: npt.NDArray[np.int8], comm: MPI.Comm
) -> None:
    """Check that Dirichlet conditions prescribe no NaN or infinity.

    Args:
        u: Displacement with their values, shape (num_dofs,).
        markers: 1 at dofs with a Dirichlet condition, shape (num_dofs,).
        comm: Communicator.

    Raises:
        ValueError: If they do on any rank, on all ranks.
    """
    bad = np.count_nonzero(~np.isfinite(u[markers == 1]))
    with agreed(comm):
        if bad > 0:
            raise ValueError(
                f"bcs prescribe displacements that are not finite, at {bad} dofs: give finite "
                "numbers; the function that sets them, as update of LoadSteps, may be wrong"
            )


def check_options(options: Any, prefix: Any) -> None:
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


def check_contacts(contacts: Any) -> None:
    """Check that there are contacts and each is listed once.

    Args:
        contacts: Contacts of a problem.

    Raises:
        TypeError: If they are no list, or something else is among them.
        ValueError: If there is none, or one appears twice.
    """
    if isinstance(contacts, Contact):
        raise TypeError("contacts must be a list: write contacts=[contact]")
    if not isinstance(contacts, Sequence):
        raise TypeError(f"contacts must be a list of contactx.Contact, not {_kind(contacts)}")
    for contact in contacts:
        if not isinstance(contact, Contact):
            raise TypeError(
                f"contacts holds a {type(contact).__name__}: pass a list of contactx.Contact"
            )
    if len(contacts) == 0:
        raise ValueError("contacts is empty: pass at least one Contact")
    if len(set(map(id, contacts))) < len(contacts):
        raise ValueError("contacts lists the same Contact twice")


def _kind(value: Any) -> str:
    return "None" if value is None else type(value).__name__
