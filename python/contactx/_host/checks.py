# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of what a user gives: kinds of arguments, forms, spaces and Dirichlet conditions.

DOLFINx compiles and assembles forms of wrong spaces without a word, and writes beyond the arrays.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
import ffcx.options
import ufl
from contactx._host import compat
from contactx._host.parallel.reduce import agreed, anywhere
from dolfinx import fem, jit, la


def check_displacement(u: Any) -> None:
    """Check that a displacement is one that contact can act on.

    Args:
        u: Displacement.

    Raises:
        TypeError: If it is no function, or not of real double precision.
        ValueError: If its space is no Lagrange space of vectors of degree 1 or 2 on its mesh.
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
            "contact needs plane cells in the plane or solid ones in space: give gmsh's "
            "model_to_mesh gdim=2 for plane cells, and 3 for solid ones"
        )
    wanted = wanted_space(gdim)
    element = V.ufl_element()
    if len(V._cpp_object.component()) > 0 or isinstance(element, basix.ufl._MixedElement):
        raise ValueError(
            "u is in a mixed space or a part of one: give the function of the whole, and say which "
            "part is the displacement, as in displacement=0"
        )
    # Values of Nedelec's and Raviart's elements have the right shape, but no dofs at nodes
    if element.element_family != basix.ElementFamily.P or element.discontinuous:
        raise ValueError(f"u is not in a continuous Lagrange space; contact needs {wanted}")
    if element.reference_value_shape != (gdim,) or element.block_size != gdim:
        raise ValueError(
            f"u has values of shape {element.reference_value_shape}, but the displacement of this "
            f"mesh needs ({gdim},): {wanted}"
        )
    if element.degree not in (1, 2):
        raise ValueError(f"u is of degree {element.degree}; contact needs degree 1 or 2: {wanted}")
    if compat.has_other_constraints(V):
        raise ValueError(
            "u is in the function space of a MultiPointConstraint of dolfinx_mpc, which contactx "
            "would leave out: take the space that the constraint was made of. Surfaces are glued "
            "by cx.Contact(..., tied=True), symmetry planes constrained by fem.dirichletbc"
        )


def wanted_space(gdim: int) -> str:
    """A space of a displacement, as a user writes it."""
    return f'functionspace(mesh, ("Lagrange", 1, ({gdim},)))'


def check_finite(comm: MPI.Comm, **vectors: la.Vector) -> None:
    """Check that vectors have no NaN or infinity.

    Args:
        comm: Communicator.
        vectors: Vectors by what they are.

    Raises:
        ValueError: If one is not finite on any rank, on all ranks.
    """
    for name, vector in vectors.items():
        bad = np.flatnonzero(~np.isfinite(vector.array))
        with agreed(comm):
            if len(bad) > 0:
                raise ValueError(
                    f"{name.replace('_', ' ')} not finite at {len(bad)} dofs, first at node "
                    f"{bad[0] // vector.block_size}: repair the mesh or the initial guess "
                    "(manual: errors/values-not-finite)"
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
                "numbers; the function that sets them, as update of LoadSteps, may be wrong "
                "(manual: errors/values-not-finite)"
            )


def check_forms(F: Any, J: Any, u: fem.Function) -> None:
    """Check that a residual and its Jacobian are forms of the displacement's space.

    Args:
        F: Residual.
        J: Jacobian, or None.
        u: Displacement.

    Raises:
        TypeError: If one is no UFL form.
        ValueError: If one has the wrong number of arguments, or arguments of another space, is of
            another mesh, or F does not depend on u and there is no J.
    """
    _check_form(
        F,
        "F",
        1,
        u,
        "give the residual, linear in a TestFunction; of an energy ufl.derivative(energy, u)",
    )
    if J is not None:
        _check_form(
            J, "J", 2, u, "give the derivative of F, ufl.derivative(F, u), or None to have it made"
        )
    elif u not in ufl.algorithms.extract_coefficients(F):
        raise ValueError(
            "F does not depend on u, so that its derivative is zero: write F with the very "
            "Function that is passed as u, or give J"
        )


def check_coupled_forms(
    F: Any, J: Any, functions: Sequence[fem.Function], *, is_list: bool
) -> None:
    """Check residuals of several functions and their Jacobian.

    Args:
        F: Residual, or a list of them.
        J: Jacobian, or rows of them; None to have it made.
        functions: What is solved for.
        is_list: Whether the user gave a list of functions.

    Raises:
        TypeError: If one is no UFL form, or a list is none.
        ValueError: If there are not as many as functions, or as ``check_forms`` says.
    """
    if not is_list:
        check_forms(F, J, functions[0])
        return
    n = len(functions)
    _check_list(F, n, "F", "residual")
    for i, (f, w) in enumerate(zip(F, functions, strict=True)):
        _check_form(f, f"F[{i}]", 1, w, f"give the residual, linear in a TestFunction of u[{i}]")
    if J is None:
        used = {c for f in F for c in ufl.algorithms.extract_coefficients(f)}
        for i, w in enumerate(functions):
            if w not in used:
                raise ValueError(
                    f"no residual depends on u[{i}], so that nothing determines it: write F with "
                    "the very functions that are passed as u, or give J"
                )
        return
    _check_list(J, n, "J", "row")
    for i, row in enumerate(J):
        _check_list(row, n, f"J[{i}]", "form")
        for j, form in enumerate(row):
            if form is None:
                continue
            name, advice = f"J[{i}][{j}]", f"give the derivative of F[{i}] by u[{j}], or None"
            _check_form(form, name, 2, functions[i], advice, functions[j])


def as_blocks(F: Any, J: Any) -> tuple[list[Any], Any]:
    """Residual and Jacobian as lists, which those of one function are not."""
    if isinstance(F, ufl.Form):
        return [F], None if J is None else [[J]]
    return list(F), J


def _check_list(given: Any, n: int, name: str, what: str) -> None:
    if not isinstance(given, Sequence) or isinstance(given, str):
        raise TypeError(
            f"{name} must be a list with a {what} for each function of u, not "
            f"{type(given).__name__}"
        )
    if len(given) != n:
        raise ValueError(f"{name} has {len(given)} {what}s, but u has {n} functions: give {n}")


def _check_form(
    form: Any,
    name: str,
    count: int,
    u: fem.Function,
    advice: str,
    trial: fem.Function | None = None,
) -> None:
    if not isinstance(form, ufl.Form):
        raise TypeError(f"{name} must be a ufl.Form, not {type(form).__name__}: {advice}")
    if form.empty():
        raise ValueError(f"{name} is a form without integrals: {advice}")
    V = u.function_space
    arguments = form.arguments()
    if len(arguments) != count:
        raise ValueError(f"{name} has {len(arguments)} arguments, but must have {count}: {advice}")
    spaces = [V, V if trial is None else trial.function_space]
    for argument, space in zip(arguments, spaces, strict=False):
        if argument.ufl_function_space() != space:
            raise ValueError(
                f"{name} has an argument in {argument.ufl_function_space().ufl_element()} that is "
                "not of the function space of u: make test and trial functions with "
                "u.function_space itself"
            )
    domains = {integral.ufl_domain() for integral in form.integrals()}
    for coefficient in form.coefficients():
        domains |= {coefficient.ufl_function_space().ufl_domain()}
    if domains - {V.mesh.ufl_domain()}:
        raise ValueError(
            f"{name} has integrals or functions on another mesh than u: contact needs one mesh "
            "that holds all bodies"
        )


def check_conditions(bcs: Any, functions: Sequence[fem.Function]) -> None:
    """Check that Dirichlet conditions are those of what is solved for.

    Args:
        bcs: Dirichlet conditions, or None.
        functions: What is solved for.

    Raises:
        TypeError: If they are no list, or something else is in it.
        ValueError: If one is of another function space.
    """
    if bcs is None:
        return
    if isinstance(bcs, fem.DirichletBC):
        raise TypeError("bcs must be a list of conditions: write bcs=[bc]")
    if not isinstance(bcs, Sequence) or isinstance(bcs, str):
        raise TypeError(f"bcs must be a list of fem.dirichletbc, not {type(bcs).__name__}")
    for k, bc in enumerate(bcs):
        if not isinstance(bc, fem.DirichletBC):
            raise TypeError(f"bcs[{k}] is a {type(bc).__name__}: give a fem.dirichletbc")
        space = _Wrapped(bc.function_space)
        if not any(u.function_space.contains(space) for u in functions):
            raise ValueError(
                f"bcs[{k}] is a condition on another function space than that of u: make it with "
                "u.function_space, or with u.function_space.sub(i)"
            )


def have_changed(
    given: Sequence[fem.DirichletBC], taken: Sequence[fem.DirichletBC], comm: MPI.Comm
) -> bool:
    """True if the user's list of Dirichlet conditions has changed on any rank.

    Args:
        given: The list, as it is now.
        taken: The conditions of the problem.
        comm: Communicator.
    """
    return anywhere(comm, [id(bc) for bc in given] != [id(bc) for bc in taken])


class _Wrapped:
    """A space of DOLFINx's C++ layer in the form that ``FunctionSpace.contains`` takes."""

    def __init__(self, space: Any):
        self._cpp_object = space


def check_compiler_options(options: Any, jit_options: Any) -> None:
    """Check options of the compilation, of which FFCx ignores those that it does not know.

    Args:
        options: Options of FFCx, or None.
        jit_options: Options of the compilation, or None.

    Raises:
        TypeError: If they are no dictionaries.
        ValueError: If there is no such option, or another scalar than real double is asked for.
    """
    for argument, given, known in (
        ("form_compiler_options", options, ffcx.options.FFCX_DEFAULT_OPTIONS),
        ("jit_options", jit_options, jit.DOLFINX_DEFAULT_JIT_OPTIONS),
    ):
        if given is not None and not isinstance(given, Mapping):
            raise TypeError(f"{argument} must be a dictionary, not {type(given).__name__}")
        for name in given or {}:
            if name not in known:
                raise ValueError(
                    f"{argument} holds {name!r}, which is none: give one of {', '.join(known)}"
                )
    scalar = (options or {}).get("scalar_type", np.float64)
    if np.dtype(scalar) != np.float64:
        raise ValueError(
            f"form_compiler_options['scalar_type'] is {scalar!r}, but contactx needs real double "
            "precision: leave it out"
        )


def is_number(value: Any) -> bool:
    """Return True for a real number of Python or NumPy; True and False are none."""
    array = value if isinstance(value, np.ndarray | np.generic) else None
    if array is not None:
        return array.ndim == 0 and array.dtype.kind in "iuf"
    return isinstance(value, int | float) and not isinstance(value, bool)


def described(value: Any) -> str:
    """Describe a value in a message: its type, and the value itself if it is short."""
    text = repr(value)
    return f"{type(value).__name__} {text}" if len(text) <= 40 else type(value).__name__


def check_switch(name: str, value: Any) -> None:
    """Check that an option is True or False: any other text or number would count as True.

    Args:
        name: Name of the argument.
        value: Its value.

    Raises:
        TypeError: If it is something else.
    """
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name} is {described(value)}: give True or False")
