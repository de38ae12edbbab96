# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact's Jacobian and residual: rows of the core beside DOLFINx's assembly of forms.

Both call the same kernels over the same pairs, at a state of the common Hertz problem with
friction: the core as the driver of a step does, DOLFINx into one matrix a form that has the places
already. Forms are made anew where pairs have changed, which the last column has.

python tools/bench/bench_forms.py 0.05 0.02
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from typing import Any

import hertz_case
import numpy as np
import runner
import tables

from contactx import cpp as core
from contactx._host.forms import ContactForms
from dolfinx import fem
from dolfinx.cpp.fem.petsc import assemble_matrix, create_matrix

import scenes
import story

SIZES = (0.2, 0.05, 0.02, 0.01)
COLUMNS: list[tables.Column] = [
    ("h", "h", "g"),
    ("method", "method", "s"),
    ("dofs", "dofs", "d"),
    ("slave nodes", "slaves", "d"),
    ("rows ms", "rows", ".2f"),
    ("forms ms", "forms", ".2f"),
    ("forms / rows", "ratio", ".1f"),
    ("making forms ms", "made", ".2f"),
]
_TIMES = 50


def fastest(work: Callable[[], object]) -> float:
    """Least time of the processor in some runs, in milliseconds."""
    times = []
    for _ in range(_TIMES):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return 1e3 * min(times)


def measure(h: float, method: str) -> dict[str, Any]:
    """Solve, and assemble contact at the solution in both ways.

    Args:
        h: Cell size in the contact.
        method: Method of the contact.
    """
    data = hertz_case.read_mesh(hertz_case.mesh_file(h))
    scene = scenes.HertzSphere(data, "finite", friction=0.3, method=method)
    scene.problem.solve()
    assembler = scene.problem.assembler
    (discrete,) = assembler.discrete_contacts
    system = assembler.system
    markers = system.core.markers()
    forms, none = discrete.forms(), np.zeros(0, dtype=np.int8)
    matrices = [
        (create_matrix(form._cpp_object, None), form)
        for form in forms.K + forms.B + forms.C + forms.D
    ]
    force, values = np.zeros(system.num_local), np.zeros(discrete.nodes.multiplier.size)

    def rows() -> None:
        core.ContactBlock([discrete], markers, keeps_zeros=True)
        discrete.add_residual(force)

    def of_forms() -> None:
        discrete.forms()
        for A, form in matrices:
            A.zeroEntries()
            constants, coefficients = fem.pack_constants(form), fem.pack_coefficients(form)
            assemble_matrix(A, form._cpp_object, constants, coefficients, none, none)
            A.assemble()
        for b, part in ((force, forms.F_u), (values, forms.F_lambda)):
            for form in part:
                fem.assemble_vector(b, form)

    def anew() -> None:
        ContactForms(discrete).update()

    found = {"rows": fastest(rows), "forms": fastest(of_forms)}
    return {
        "h": h,
        "method": method,
        "dofs": hertz_case.counts(scene.problem)["dofs"],
        "slaves": len(discrete.slaves),
        **found,
        "ratio": found["forms"] / found["rows"],
        "made": fastest(anew),
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    rows = [
        runner.alone("bench_forms:measure", h=h, method=method)
        for h in [float(h) for h in argv] or SIZES
        for method in story.METHODS
    ]
    tables.show("Contact by rows and by forms", COLUMNS, rows, runner.OUTPUT / "forms.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
