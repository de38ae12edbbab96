# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Differences between builds of DOLFINx."""

import contextlib
import gc
import sys

with contextlib.suppress(ModuleNotFoundError):
    # The PyPI wheels of DOLFINx must load their MPI and PETSc before DOLFINx;
    # other builds do not have this package
    import dolfinx_solver  # noqa: F401

try:
    from petsc4py import PETSc
except ModuleNotFoundError as error:
    raise ImportError(
        "contactx needs DOLFINx 0.11 with PETSc: pip install 'contactx[wheels]', or take it from "
        "conda or a distribution"
    ) from error

import numpy as np

import dolfinx
import dolfinx.fem.petsc  # registers the PETSc type casters
from dolfinx import fem
from ufl.corealg.dag_traverser import DAGTraverser

# Others have other names and layouts of what contactx builds on
_SUPPORTED = (0, 11)
if tuple(map(int, dolfinx.__version__.split(".")[:2])) != _SUPPORTED:
    raise ImportError(
        f"this contactx is for DOLFINx 0.11, but here is {dolfinx.__version__}: "
        "pip install 'contactx[wheels]', or take DOLFINx 0.11 from conda or a distribution"
    )


def require_real_double() -> None:
    """Check that PETSc was built with real double precision.

    Raises:
        TypeError: If PETSc's scalar is complex or single precision.
    """
    if np.dtype(PETSc.ScalarType) != np.float64:
        raise TypeError(
            f"PETSc was built with {np.dtype(PETSc.ScalarType).name} scalars, but contactx needs "
            "real double precision (float64): use a DOLFINx with such a PETSc"
        )


def has_other_constraints(V: fem.FunctionSpace) -> bool:
    """True if a function space belongs to a constraint of dolfinx_mpc.

    Nothing in the space tells, but who has made one keeps the constraint.

    Args:
        V: Function space.
    """
    kind = getattr(sys.modules.get("dolfinx_mpc"), "MultiPointConstraint", None)
    return kind is not None and any(
        type(thing) is kind and thing.finalized and thing.function_space == V
        for thing in gc.get_objects()
    )


def direct_solver() -> str | None:
    """Name of a direct solver for saddle-point matrices, the best that PETSc has.

    Returns:
        ``"mumps"``, ``"superlu_dist"``, or None where PETSc's own LU must do.
    """
    for name in ("mumps", "superlu_dist"):
        if PETSc.Sys.hasExternalPackage(name):
            return name
    return None


def forget_derivatives() -> None:
    """Clear UFL's cache of expanded derivatives, which keeps forms and their meshes alive.

    Methods of its traversers are dispatched by functools.singledispatchmethod, which in Python 3.12
    and 3.13 keeps each object that it has served for ever.
    """
    kinds = [DAGTraverser]
    while kinds:
        kind = kinds.pop()
        kinds += kind.__subclasses__()
        for method in vars(kind).values():
            served = getattr(method, "_method_cache", None)
            if served is not None:
                served.clear()
