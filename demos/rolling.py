# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the demos of large rolling and sliding share: a material that turns, a march in steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import contactx as cx  # isort: skip

import numpy as np

import ufl
from dolfinx import fem, mesh

import story


def neo_hookean(u: fem.Function, young: Any, nu: float) -> ufl.Form:
    """Residual of compressible neo-Hookean bodies in plane strain, for any rotation."""
    shear, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    F = ufl.Identity(len(u)) + ufl.grad(u)
    J = ufl.det(F)
    density = shear / 2 * (ufl.tr(F.T * F) - len(u) - 2 * ufl.ln(J)) + lmbda / 2 * ufl.ln(J) ** 2
    degree = 2 * u.function_space.element.basix_element.degree
    return ufl.derivative(density * ufl.dx(metadata={"quadrature_degree": degree}), u)


def of_bodies(domain: mesh.Mesh, tags: mesh.MeshTags, values: dict[int, float]) -> fem.Function:
    """A number of each body, by the tag of its cells."""
    number = fem.Function(fem.functionspace(domain, ("DG", 0)))
    for body, value in values.items():
        number.x.array[tags.find(body)] = value
    return number


def reaction(form: fem.Form, dofs: np.ndarray) -> np.ndarray:
    """Forces that hold nodes: the bodies' residual in some dofs."""
    return np.asarray(fem.assemble_vector(form).array[dofs])


@dataclass
class March:
    """Load steps of a problem, and what is to be watched in them.

    Attributes:
        problem: The problem.
        iterations: Of each step.
        cuts: Attempts that failed.
        frozen: Steps in which pairs were frozen.
        hidden: Deepest penetration that a frozen pair hides after a step, a length.
        excess: Largest depth of a master between slave nodes, over what the mesh explains.
        faults: Faults and warnings of the audit, in all steps, but for those of chords.
    """

    problem: cx.ContactProblem
    iterations: list[int] = field(default_factory=list)
    cuts: int = 0
    frozen: int = 0
    hidden: float = 0.0
    excess: float = 0.0
    faults: int = 0

    def steps(self, number: Any, update: Callable[[float], None]) -> Iterator[Any]:
        """Go through load steps, as ``LoadSteps`` does."""
        for step in cx.LoadSteps(self.problem, number, update=update, progress=False):
            report = self.problem.report
            self.iterations.append(step.iterations)
            self.cuts += report.discarded > 0
            self.frozen += report.frozen_pairs > 0
            self.hidden = max(self.hidden, -report.frozen_gap)
            self.excess = max(self.excess, report.audit.excess)
            warnings = [w for w in report.audit.warnings if "errors/chords" not in w]
            self.faults += len(report.audit.faults) + len(warnings)
            yield step

    def tell(self, name: str, edge: float) -> None:
        """Print what happened.

        Args:
            name: Of the run.
            edge: Length of an edge, to relate penetrations to.
        """
        story.console.print(
            f"{name}: converged after {sum(self.iterations)} iterations in {len(self.iterations)} "
            f"steps, at most {max(self.iterations)} in one; {self.cuts} steps tried again; pairs "
            f"frozen in {self.frozen} steps, hiding at most {self.hidden / edge:.2%} of an edge; "
            f"audit: {self.faults} faults, master between nodes at {self.excess:.2g} of what the "
            "mesh explains",
            highlight=False,
        )


def equivalent_stress(u: fem.Function, young: Any, nu: float) -> fem.Function:
    """Mises stress of neo-Hookean bodies in plane strain at the vertices, means of their cells."""
    domain = u.function_space.mesh
    shear, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    F = ufl.Identity(2) + ufl.grad(u)
    J = ufl.det(F)
    plane = shear / J * (F * F.T - ufl.Identity(2)) + lmbda / J * ufl.ln(J) * ufl.Identity(2)
    across = lmbda / J * ufl.ln(J)
    mean = (ufl.tr(plane) + across) / 3
    deviator = plane - mean * ufl.Identity(2)
    mises = ufl.sqrt(1.5 * (ufl.inner(deviator, deviator) + (across - mean) ** 2))
    v = ufl.TestFunction(fem.functionspace(domain, ("Lagrange", 1)))
    dx = ufl.dx(metadata={"quadrature_degree": 2})
    sums, areas = (
        fem.assemble_vector(fem.form(integrand * v * dx))
        for integrand in (mises, fem.Constant(domain, 1.0))
    )
    stress = fem.Function(v.ufl_function_space(), name="equivalent stress")
    stress.x.array[:] = sums.array / areas.array
    return stress


def at_vertices(u: fem.Function) -> fem.Function:
    """Displacement of degree 1, to be drawn."""
    domain = u.function_space.mesh
    linear = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (domain.geometry.dim,))))
    linear.interpolate(u)
    return linear
