# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact where a displacement is solved for together with other fields, as fields.cpp has it.

On the mesh of demos/cpp/sliding_block. Before its last step it writes the checkpoints that
fields.cpp takes for those of four ranks; python fields.py RANKS takes that step from fields.cpp's.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np
import several_fields as forms
from shared import LU, read, show, texts

import ufl
from basix.ufl import mixed_element
from dolfinx import fem

WAYS = (0.0, 0.01, -0.01)


def norm(f: fem.Function) -> float:
    """Norm of a function's values."""
    dofs = f.function_space.dofmap
    own = f.x.array[: dofs.bs * dofs.index_map.size_local]
    return float(np.sqrt(MPI.COMM_WORLD.allreduce(float((np.nan_to_num(own) ** 2).sum()))))


def fix(V: fem.FunctionSpace, tags: Any, face: int, value: float) -> fem.DirichletBC:
    """Prescribe a value on a face."""
    facets = tags.find(face)
    dofs = fem.locate_dofs_topological(V, 1, facets)
    return fem.dirichletbc(fem.Constant(V.mesh, value), dofs, V)


def supports(V: fem.FunctionSpace, tags: Any) -> list[fem.DirichletBC]:
    """The base held, and the top, last, which is pushed along."""
    return [
        fix(V.sub(0), tags, 22, 0.0),
        fix(V.sub(1), tags, 22, 0.0),
        fix(V.sub(0), tags, 12, 0.0),
    ]


def steps(
    name: str,
    problem: cx.ContactProblem,
    contact: cx.Contact,
    push: fem.DirichletBC,
    functions: Sequence[fem.Function],
    conductance: cx.Conductance | None = None,
) -> None:
    """Take three steps, or the last one alone, and print their figures."""
    history = fem.Function(fem.functionspace(problem.displacement.function_space.mesh, ("DG", 0)))
    kept = fem.Function(history.function_space)
    kept.interpolate(lambda x: x[0] + 10 * x[1])
    restart = f"{name}.{sys.argv[1]}.state" if len(sys.argv) > 1 else None
    if restart is None:
        history.x.array[:] = kept.x.array
    plan = cx.LoadSteps(
        problem, [0.5, 0.75, 1.0], lambda t: None, history=[history], restart=restart
    )
    assert np.abs(history.x.array - kept.x.array).max() < 1e-14
    assert plan.t == (0.0 if restart is None else 0.75)
    for way in WAYS if restart is None else WAYS[-1:]:
        if way < 0 and restart is None:
            plan.save(f"{name}.4.state")
        push.g.value[...] = way
        problem.solve()
        # The steps are not those of LoadSteps, which extrapolates
        plan._plan.accept(problem.report.iterations)
        size = float(np.sqrt(MPI.COMM_WORLD.allreduce(float((contact.multiplier**2).sum()))))
        figures = [*contact.force, *(norm(f) for f in functions), size, norm(contact.pressure)]
        figures += [norm(contact.gap), 0.0 if conductance is None else conductance.flow]
        show(name, problem.report.iterations, *texts(figures))


def main() -> None:
    """Take the steps of all scenes."""
    domain, tags = read("sliding_block")
    base, slave = cx.Surface(tags, 21), cx.Surface(tags, 11)
    plane = cx.Plane((0.0, 0.0), (0.0, 1.0))
    mortar = {"method": "surface-to-surface"}
    load = fem.Constant(domain, (0.0, -0.01))
    top = ufl.Measure("ds", domain=domain, subdomain_data=tags)(12)
    P1, Q2 = forms.linear, forms.quadratic_vector
    options = {"petsc_options_prefix": "fields_", "petsc_options": LU}

    W = fem.functionspace(domain, mixed_element([Q2, P1]))
    V, Q = fem.functionspace(domain, Q2), fem.functionspace(domain, P1)
    for name, more in {"n2s": {"friction": 0.2}, "s2s": mortar}.items():
        w = fem.Function(W)
        v, q = ufl.TestFunctions(W)
        F = forms.momentum(*ufl.split(w), v) + forms.volume(*ufl.split(w), q)
        contact = cx.Contact(slave, base, offset=1e-8, **more)
        bcs = supports(W.sub(0), tags)
        problem = cx.ContactProblem(
            F - ufl.inner(load, v) * top,
            w,
            contacts=[contact],
            bcs=bcs,
            displacement=0,
            **options,
        )
        steps(f"mixed {name}", problem, contact, bcs[-1], [w])

        u, p = fem.Function(V), fem.Function(Q)
        v, q = ufl.TestFunction(V), ufl.TestFunction(Q)
        F = forms.momentum(u, p, v) - ufl.inner(load, v) * top
        contact = cx.Contact(slave, base, offset=1e-8, **more)
        bcs = supports(V, tags)
        problem = cx.ContactProblem(
            [forms.volume(u, p, q), F],
            [p, u],
            contacts=[contact],
            bcs=bcs,
            displacement=1,
            **options,
        )
        steps(f"blocks {name}", problem, contact, bcs[-1], [u, p])

    V = fem.functionspace(domain, forms.linear_vector)
    for name, master in {"base": base, "plane": plane}.items():
        for method, more in {"n2s": {"friction": 0.2}, "s2s": mortar}.items():
            u, T = fem.Function(V), fem.Function(Q)
            v, q = ufl.TestFunction(V), ufl.TestFunction(Q)
            contact = cx.Contact(slave, master, offset=1e-8, **more)
            conductance = cx.Conductance(
                contact,
                T,
                lambda p, g: 2 + 40 * p / (1 + g),
                obstacle_value=-0.3 if master is plane else None,
            )
            bcs = [fix(Q, tags, 12, 1.0), fix(Q, tags, 22, 0.0), *supports(V, tags)]
            problem = cx.ContactProblem(
                [
                    forms.expanded(u, T, v) - ufl.inner(load, v) * top,
                    ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx,
                ],
                [u, T],
                contacts=[contact],
                bcs=bcs,
                displacement=0,
                conductances=[conductance],
                **options,
            )
            steps(f"warm {name} {method}", problem, contact, bcs[-1], [u, T], conductance)


if __name__ == "__main__":
    main()
