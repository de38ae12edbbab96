# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the contact modulus."""

from __future__ import annotations

import math

import pytest

from reference import contact_modulus


def test_equal_bodies_are_half_as_stiff_as_one_on_a_rigid_body() -> None:
    """Two springs in series."""
    rigid = contact_modulus(200.0, 0.3, math.inf, 0.0)
    assert rigid == pytest.approx(200.0 / (1 - 0.3**2))
    assert contact_modulus(200.0, 0.3, 200.0, 0.3) == pytest.approx(rigid / 2)


def test_order_does_not_matter() -> None:
    """The modulus is symmetric in the bodies."""
    assert contact_modulus(1.0, 0.2, 5.0, 0.4) == contact_modulus(5.0, 0.4, 1.0, 0.2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 0.3, 1.0, 0.3), "young_1 is 0.0"),
        ((1.0, 0.3, -1.0, 0.3), "young_2 is -1.0"),
        ((1.0, 0.6, 1.0, 0.3), "nu_1 is 0.6"),
        ((1.0, 0.3, 1.0, -1.0), "nu_2 is -1.0"),
        ((math.nan, 0.3, 1.0, 0.3), "young_1 is nan"),
        ((math.inf, 0.3, math.inf, 0.3), "at most one body may be rigid"),
    ],
)
def test_bad_input(arguments: tuple[float, float, float, float], message: str) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=message):
        contact_modulus(*arguments)
