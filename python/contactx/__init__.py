# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Node-to-surface and surface-to-surface contact with friction for FEniCSx.

A ``Contact`` couples a tagged ``Surface`` with another one or with a rigid obstacle: ``Plane``,
``Sphere``, ``Cylinder`` or ``LevelSet``. A ``ContactProblem`` solves the bodies with their
contacts, a ``ContactDynamics`` bodies with inertia; ``LoadSteps`` solves them in steps and cuts
back where one fails. ``VTKOutput`` writes the results. Import contactx before dolfinx.
"""

# First, because it loads the wheels' MPI and PETSc before DOLFINx
from contactx._host import compat as compat  # isort: skip

from contactx._host.parallel.partition import partitioner
from contactx._host.pictures import animate
from contactx._host.projection import Projection
from contactx.assembler import ContactAssembler
from contactx.conductance import Conductance
from contactx.contact import Contact
from contactx.dynamics import ContactDynamics
from contactx.errors import ConvergenceError
from contactx.forms import Forms
from contactx.laws import FrictionLaw
from contactx.obstacles import Cylinder, LevelSet, Plane, Sphere
from contactx.output import CSVOutput, VTKOutput
from contactx.penetration import FluidPenetration
from contactx.problem import ContactProblem
from contactx.report import Report
from contactx.steps import LoadSteps
from contactx.surface import Surface

__all__ = [
    "CSVOutput",
    "Conductance",
    "Contact",
    "ContactAssembler",
    "ContactDynamics",
    "ContactProblem",
    "ConvergenceError",
    "Cylinder",
    "FluidPenetration",
    "Forms",
    "FrictionLaw",
    "LevelSet",
    "LoadSteps",
    "Plane",
    "Projection",
    "Report",
    "Sphere",
    "Surface",
    "VTKOutput",
    "animate",
    "partitioner",
]

__version__ = "0.2.0"


def __dir__() -> list[str]:
    """List the public names; submodules are importable but not public."""
    return [*__all__, "__version__"]
