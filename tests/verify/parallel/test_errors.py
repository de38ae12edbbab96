# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Errors of one rank are errors of all, and nothing hangs."""

import json

import numpy as np
import pytest

from ranks.launch import SCRIPTS, launch_together
from scenes.refilled import LARGEST

SCRIPT = SCRIPTS / "scenes_errors.py"
# What each function of scenes_errors.py must say
RAISED = {
    "update_throws": "Wrong: in update",
    "level_set_throws": "Wrong: in a level set",
    "material_fails": "ConvergenceError: contact did not converge: the residual is not finite",
    "friction_is_negative": "ValueError: friction is -0.3",
    "law_of_friction_is_wrong": "ValueError: the law of friction gives the bound -0.00",
    "argument_is_no_number": "TypeError: settle() was given max_it='many': give a number",
    "displacement_is_infinite": "ValueError: the displacement u is not finite",
    "tag_is_missing": "ValueError: tag 99 is not in the facet tags; there are: 11, 12, 13, 14, 15, "
    "16, 21, 22, 23, 24, 25, 26",
    "surfaces_share_nodes": "ValueError: slave and master overlap",
    "node_is_constrained_inside": "constrain 3 slave nodes inside the rigid obstacle",
    "load_is_not_balanced": "ConvergenceError: contact did not converge: the loads on a body",
    "slave_is_too_coarse": "the master reaches 0.02 deep through a slave facet of size 0.5",
    "ball_is_between_nodes": "the rigid Sphere reaches 0.02 deep through a slave facet of size",
    "tips_pass_each_other": "nodes went through the other surface within the step",
    "tool_goes_through": "7 slave nodes and facets went through the rigid Sphere within the step",
    "cells_are_turned_inside_out": "6 cells are turned inside out, the worst with det F = -1.1",
    "checkpoint_is_damaged": "is truncated, or no checkpoint at all",
    "checkpoint_cannot_be_written": "Error: ",
    "column_fails_on_one_rank": "ValueError: no slave node here",
}


@pytest.fixture(scope="module", params=[1, 3], ids=lambda n: f"{n} ranks")
def found(request, tmp_path_factory):
    """What came of each function on some ranks."""
    folder, ranks = tmp_path_factory.mktemp("errors"), request.param

    def file(name):
        return folder / f"{name}-{ranks}.json"

    names = [*RAISED, "factors_fail", "nothing_in_reach", "calls_differ", "arguments_differ"]
    wrong = launch_together(SCRIPT, ranks, folder, names, file)
    for text in wrong.values():
        print(text)
    return ranks, {n: json.loads(file(n).read_text()) for n in names if n not in wrong}


@pytest.mark.parametrize("name", RAISED)
def test_all_ranks_raise(found, name):
    ranks, outcomes = found
    errors = outcomes[name]["errors"]
    assert len(errors) == ranks
    assert len(set(errors)) == 1
    assert RAISED[name] in errors[0]


def test_a_matrix_without_factors(found):
    ranks, outcomes = found
    of_ranks = outcomes["factors_fail"]["sizes"]
    assert len(of_ranks) == ranks
    for sizes in of_ranks:
        assert sizes == pytest.approx([LARGEST, np.inf, np.inf, LARGEST])


def test_ranks_that_call_different_methods(found):
    ranks, outcomes = found
    errors = outcomes["calls_differ"]["errors"]
    said = "RuntimeError: "
    if ranks == 1:
        said += "accept() of an iterate that is no solution"
    else:
        said += "all ranks must call the same method of a ContactAssembler: accept() on rank 0, "
    assert len(errors) == ranks
    assert all(error.startswith(said) for error in errors)


def test_ranks_that_give_different_arguments(found):
    ranks, outcomes = found
    # One alone does not differ from others
    said = "ValueError: rtol of settle() differs between ranks, 1e-11" if ranks > 1 else ""
    assert len(outcomes["arguments_differ"]["errors"]) == ranks
    assert all(error.startswith(said) for error in outcomes["arguments_differ"]["errors"])


def test_what_is_left_is_as_it_was(found):
    ranks, outcomes = found
    assert outcomes["update_throws"]["t"] == [0.5] * ranks
    assert outcomes["update_throws"]["left"] == [0.75, 1.0]
    assert outcomes["level_set_throws"]["clean"] == [True] * ranks
    assert outcomes["load_is_not_balanced"]["clean"] == [True] * ranks
    for name in ("level_set_throws", "material_fails"):
        assert outcomes[name]["converged"]


def test_a_search_that_finds_nothing(found):
    ranks, outcomes = found
    outcome = outcomes["nothing_in_reach"]
    assert outcome["errors"] == [""] * ranks
    assert outcome["force"] == [0.0, 0.0]
    # One of them may tell the user, or all
    told = [text for text in outcome["warnings"] if text]
    assert told and told[0] == outcome["warnings"][0]
    assert all("the nearest is 0.95 away, and the search reaches 0.1" in text for text in told)
