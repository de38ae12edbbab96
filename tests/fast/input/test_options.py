# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contacts of a problem, and options of PETSc and of the compilation."""

import warnings

import numpy as np
import pytest

import contactx as cx

from inputs.rows import problem, refused, scene, table, with_


def options(**given):
    return lambda: problem(petsc_options=given)


def used_twice():
    blocks = scene()
    contact = blocks.contact()
    problem(blocks, contacts=[contact])
    problem(blocks, contacts=[contact])


KIND = r"PETSc refuses an option of the solver: .*{}.* Correct petsc_options"
ROWS = {
    TypeError: [
        (
            with_("contacts", lambda b: b.contact()),
            r"contacts must be a list: write contacts=\[contact\]",
        ),
        (lambda: problem(contacts=None), "contacts must be a list of contactx.Contact, not None"),
        (
            with_("contacts", lambda b: (c for c in [b.contact()])),
            "contacts must be a list of contactx.Contact, not generator",
        ),
        (
            with_("contacts", lambda b: [b.contact().slave]),
            "contacts holds a Surface: pass a list of contactx.Contact",
        ),
        (lambda: problem(petsc_options_prefix=3), "petsc_options_prefix is 3: give a string"),
        (
            lambda: problem(petsc_options="-snes_rtol 1"),
            "petsc_options must be a dictionary, not str: write",
        ),
        (
            lambda: problem(petsc_options=["snes_rtol"]),
            "petsc_options must be a dictionary, not list",
        ),
        (lambda: problem(petsc_options={1: 2}), "petsc_options holds the name 1: give strings"),
        (
            lambda: problem(form_compiler_options="-O3"),
            "form_compiler_options must be a dictionary, not str",
        ),
        (lambda: problem(jit_options="x"), "jit_options must be a dictionary, not str"),
    ],
    ValueError: [
        *(
            (
                options(**{name: value}),
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
        (lambda: problem(contacts=[]), "contacts is empty: pass at least one Contact"),
        (with_("contacts", lambda b: [b.contact()] * 2), "contacts lists the same Contact twice"),
        (
            lambda: problem(petsc_options_prefix=""),
            "petsc_options_prefix is empty: give a unique one",
        ),
        (
            lambda: problem(petsc_options_prefix="-a_"),
            "petsc_options_prefix is '-a_': give one without dash and spaces",
        ),
        (
            lambda: problem(petsc_options_prefix="a b_"),
            "petsc_options_prefix is 'a b_': give one without dash and spaces",
        ),
        (
            lambda: problem(petsc_options={"-snes_rtol": 1e-9}),
            "petsc_options holds '-snes_rtol': leave out the dash",
        ),
        (
            options(snes_max_it=1.5),
            r"petsc_options\['snes_max_it'\] is 1\.5: give an integer of at least 0",
        ),
        (options(snes_type="newton"), KIND.format("SNES type newton")),
        (options(ksp_type="nope"), KIND.format("KSP type nope")),
        (options(pc_type=None), KIND.format("PC type")),
        (options(snes_linesearch_type="bad"), KIND.format("Line Search type bad")),
        (options(pc_factor_mat_solver_type="nope"), KIND.format("solver type nope")),
        (options(snes_divergence_tolerance=-7), KIND.format("Divergence tolerance")),
        (
            lambda: problem(form_compiler_options={"nonsense": 1}),
            "form_compiler_options holds 'nonsense', which is none: give one of",
        ),
        (
            lambda: problem(form_compiler_options={"scalar_type": np.float32}),
            r"form_compiler_options\['scalar_type'\] .* needs real double precision",
        ),
        (
            lambda: problem(jit_options={"nonsense": 1}),
            "jit_options holds 'nonsense', which is none: give one of",
        ),
    ],
    RuntimeError: [
        (used_twice, "belongs to a ContactProblem already: create one"),
    ],
}


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
