# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact forms against the blocks of the core."""

from petsc4py import PETSc

import numpy as np
import pytest

from contactx import cpp as core
from dolfinx import cpp, fem

from scenes import CELLS, Blocks


def assembled(form, shape):
    A = cpp.fem.petsc.create_matrix(form._cpp_object, None)
    none = np.array([], dtype=np.int8)
    cpp.fem.petsc.assemble_matrix(
        A, form._cpp_object, fem.pack_constants(form), fem.pack_coefficients(form), none, none
    )
    A.assemble()
    dense = A.convert("dense").getDenseArray()
    assert dense.shape == shape
    return dense


def close(computed, reference):
    return np.abs(computed - reference).max() <= 1e-13 * max(1, np.abs(reference).max())


def test_petsc_is_real_double():
    assert np.dtype(PETSc.ScalarType) == np.float64


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
def test_forms_are_the_blocks_of_the_core(cell, friction):
    """What DOLFINx assembles from the forms is what the core assembles from the same pairs."""
    scene = Blocks(cell, gap=0.02)
    contact = scene.contact(friction=friction)
    scene.problem(contact)
    discrete, rng = contact.discrete, np.random.default_rng(7)
    nodes, n = discrete.nodes, len(scene.u.x.array)
    scene.u.x.array[:] = 0.01 * rng.standard_normal(n)
    discrete.search()
    discrete.update_gap()
    nodes.multiplier[:] = rng.uniform(0.5, 1, len(nodes.multiplier))
    nodes.c[:] = rng.uniform(1, 2, len(nodes.c))
    nodes.status[:] = np.arange(len(nodes.status)) % 3
    discrete.law.evaluate(nodes)
    m = len(nodes.multiplier)
    forms, dense = contact.forms(), np.zeros((n + m, n + m))
    u, w = slice(n), slice(n, n + m)
    for part, row, column in (("K", u, u), ("B", u, w), ("C", w, u), ("D", w, w)):
        block = dense[row, column]
        for form in getattr(forms, part):
            block += assembled(form, block.shape)
        assert np.abs(block).max() > 0
    block = core.ContactBlock([discrete])
    found = np.stack([block.multiply(unit) for unit in np.eye(n + m)], axis=1)
    assert close(found, dense)
    b, forces = np.zeros(n), np.zeros(n)
    discrete.add_residual(b)
    for form in forms.F_u:
        fem.assemble_vector(forces, form)
    assert close(forces, b)
    values = np.zeros(m)
    for form in forms.F_lambda:
        fem.assemble_vector(values, form)
    assert close(values, nodes.value)
