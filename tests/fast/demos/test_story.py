# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows of the demos' tables: what is expected and computed is one quantity."""

import numpy as np
import pytest

import story


def test_error_is_relative_to_what_is_expected():
    assert story.Result("force", -2.0, -2.1).error == pytest.approx(0.05)


def test_where_nothing_is_expected_the_error_is_what_is_computed():
    assert story.Result("swing / force", 0.0, 0.03).error == 0.03


def test_curves_are_compared_relative_to_the_exact_one():
    weights, exact = np.array([1.0, 2.0, 1.0]), np.array([3.0, 0.0, 4.0])
    computed = np.array([3.0, 1.0, 4.0])
    result = story.Result.of_curves("difference / exact", weights, computed, exact)
    assert (result.expected, result.name) == (0.0, "difference / exact")
    assert result.computed == result.error == pytest.approx(np.sqrt(2) / 5)
