# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contacts of a problem, and options of PETSc and of the compilation."""

import warnings

import numpy as np
import pytest

import contactx as cx

from inputs.rows import Row, problem, refused, scene, table, with_


def options(**given):
    return lambda: problem(petsc_options=given)


def used_twice():
    blocks = scene()
    contact = blocks.contact()
    problem(blocks, contacts=[contact])
    problem(blocks, contacts=[contact])


KIND = r"PETSc refuses an option of the solver: .*{}.* Correct petsc_options"
ROWS = [
    Row(
        "contacts: one alone",
        with_("contacts", lambda b: b.contact()),
        TypeError,
        r"contacts must be a list: write contacts=\[contact\]",
    ),
    Row(
        "contacts: None",
        lambda: problem(contacts=None),
        TypeError,
        "contacts must be a list of contactx.Contact, not None",
    ),
    Row(
        "contacts: a generator",
        with_("contacts", lambda b: (c for c in [b.contact()])),
        TypeError,
        "contacts must be a list of contactx.Contact, not generator",
    ),
    Row(
        "contacts: surfaces",
        with_("contacts", lambda b: [b.contact().slave]),
        TypeError,
        "contacts holds a Surface: pass a list of contactx.Contact",
    ),
    Row(
        "contacts: none",
        lambda: problem(contacts=[]),
        ValueError,
        "contacts is empty: pass at least one Contact",
    ),
    Row(
        "contacts: one twice",
        with_("contacts", lambda b: [b.contact()] * 2),
        ValueError,
        "contacts lists the same Contact twice",
    ),
    Row(
        "contacts: of another problem",
        used_twice,
        RuntimeError,
        "belongs to a ContactProblem already: create one",
    ),
    Row(
        "prefix: empty",
        lambda: problem(petsc_options_prefix=""),
        ValueError,
        "petsc_options_prefix is empty: give a unique one",
    ),
    Row(
        "prefix: a number",
        lambda: problem(petsc_options_prefix=3),
        TypeError,
        "petsc_options_prefix is 3: give a string",
    ),
    Row(
        "prefix: with a dash",
        lambda: problem(petsc_options_prefix="-a_"),
        ValueError,
        "petsc_options_prefix is '-a_': give one without dash and spaces",
    ),
    Row(
        "prefix: with a space",
        lambda: problem(petsc_options_prefix="a b_"),
        ValueError,
        "petsc_options_prefix is 'a b_': give one without dash and spaces",
    ),
    Row(
        "options: a text",
        lambda: problem(petsc_options="-snes_rtol 1"),
        TypeError,
        "petsc_options must be a dictionary, not str: write",
    ),
    Row(
        "options: a list",
        lambda: problem(petsc_options=["snes_rtol"]),
        TypeError,
        "petsc_options must be a dictionary, not list",
    ),
    Row(
        "options: a number as the name",
        lambda: problem(petsc_options={1: 2}),
        TypeError,
        "petsc_options holds the name 1: give strings",
    ),
    Row(
        "options: a dash",
        lambda: problem(petsc_options={"-snes_rtol": 1e-9}),
        ValueError,
        "petsc_options holds '-snes_rtol': leave out the dash",
    ),
    *(
        Row(
            f"options: {name} {value}",
            options(**{name: value}),
            ValueError,
            rf"petsc_options\['{name}'\] is .*: give a number of at least 0",
        )
        for name, value in (
            ("snes_rtol", -1e-8),
            ("snes_atol", "abc"),
            ("snes_rtol", float("nan")),
            ("snes_atol", float("inf")),
            ("snes_rtol", None),
        )
    ),
    Row(
        "options: iterations",
        options(snes_max_it=1.5),
        ValueError,
        r"petsc_options\['snes_max_it'\] is 1\.5: give an integer of at least 0",
    ),
    Row(
        "options: unknown SNES",
        options(snes_type="newton"),
        ValueError,
        KIND.format("SNES type newton"),
    ),
    Row("options: unknown KSP", options(ksp_type="nope"), ValueError, KIND.format("KSP type nope")),
    Row("options: unknown PC", options(pc_type=None), ValueError, KIND.format("PC type")),
    Row(
        "options: unknown line search",
        options(snes_linesearch_type="bad"),
        ValueError,
        KIND.format("Line Search type bad"),
    ),
    Row(
        "options: unknown package",
        options(pc_factor_mat_solver_type="nope"),
        ValueError,
        KIND.format("solver type nope"),
    ),
    Row(
        "options: out of range",
        options(snes_divergence_tolerance=-7),
        ValueError,
        KIND.format("Divergence tolerance"),
    ),
    Row(
        "compiler: a text",
        lambda: problem(form_compiler_options="-O3"),
        TypeError,
        "form_compiler_options must be a dictionary, not str",
    ),
    Row(
        "compiler: unknown",
        lambda: problem(form_compiler_options={"nonsense": 1}),
        ValueError,
        "form_compiler_options holds 'nonsense', which is none: give one of",
    ),
    Row(
        "compiler: single precision",
        lambda: problem(form_compiler_options={"scalar_type": np.float32}),
        ValueError,
        r"form_compiler_options\['scalar_type'\] .* needs real double precision",
    ),
    Row(
        "jit: a text",
        lambda: problem(jit_options="x"),
        TypeError,
        "jit_options must be a dictionary, not str",
    ),
    Row(
        "jit: unknown",
        lambda: problem(jit_options={"nonsense": 1}),
        ValueError,
        "jit_options holds 'nonsense', which is none: give one of",
    ),
]


@table(ROWS)
def test_refused(row):
    refused(row)


@pytest.mark.parametrize("name", ["snes_rtoll", "hostile_snes_rtol", "condensed_nonsense"])
def test_options_that_nothing_reads_are_warned_of(name):
    with pytest.warns(UserWarning, match=f"petsc_options has '{name}', which nothing has read"):
        problem(petsc_options={name: 1e-5, "snes_max_it": 40})


def test_options_that_are_read_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        problem(petsc_options={"pc_type": "condensed", "condensed_mg_levels_ksp_max_it": 2})
        problem(petsc_options={"mat_mumps_icntl_14": 80, "snes_linesearch_type": "bt"})
        problem(form_compiler_options={"scalar_type": np.float64})


def test_a_refused_problem_frees_its_contacts():
    blocks = scene()
    contact = blocks.contact()
    with pytest.raises(ValueError, match="Correct petsc_options"):
        problem(blocks, contacts=[contact], petsc_options={"ksp_type": "nope"})
    assert not blocks.u.x.array.any()
    other = blocks.contact()
    degenerate = cx.Contact(other.slave, cx.Plane((0, 0), (0, 0)))
    with pytest.raises(ValueError, match="zero vector"):
        problem(blocks, contacts=[other, degenerate])
    problem(blocks, contacts=[other])
    assert other.force[1] > 0
