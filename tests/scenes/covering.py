# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which combinations of parameters a test runs: each two values meet at least once."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations, product
from typing import Any

import pytest

from story import METHODS

SLIDINGS = ("finite", "small")
# An axis "sliding,method", for what has code of its own for each
BOTH = list(product(SLIDINGS, METHODS))


def covering(**axes: Iterable[Any]) -> pytest.MarkDecorator:
    """Parametrise a test so that each value meets each value of every other axis.

    Not all with all: where three values must come together, two of them belong to one axis.

    Args:
        axes: Values of each parameter, or rows of several, "like,this". Those of ``method`` go to
            the fixture of that name.
    """
    values = {name: list(given) for name, given in axes.items()}
    names = ",".join(values).split(",")
    rows = []
    for row in _rows([len(given) for given in values.values()]):
        parts = [
            given[i] if "," in name else (given[i],)
            for (name, given), i in zip(values.items(), row, strict=True)
        ]
        rows.append([value for part in parts for value in part])
    ids = ["-".join(map(_id, row)) for row in rows]
    indirect = ["method"] if "method" in names else False
    return pytest.mark.parametrize(names, rows, ids=ids, indirect=indirect)


def _rows(sizes: list[int]) -> list[tuple[int, ...]]:
    """Numbers of values: each next row has as many new pairs as can be."""
    every = list(product(*map(range, sizes)))
    pairs = [set(combinations(enumerate(row), 2)) for row in every]
    left, chosen = set().union(*pairs), []
    while left:
        best = max(range(len(every)), key=lambda i: len(pairs[i] & left))
        left -= pairs[best]
        chosen.append(best)
    return [every[i] for i in sorted(chosen)]


def _id(value: Any) -> str:
    if isinstance(value, dict):
        return "-".join(value) or "none"
    return str(getattr(value, "name", getattr(value, "__name__", value)))


__all__ = ["BOTH", "METHODS", "SLIDINGS", "covering"]
