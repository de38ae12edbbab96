# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Problems 1 and 2 of the contact benchmarks of NAFEMS R0094, by quadratic displacements.

The value for the punch is that of a quarter with quadratic cells. On its section, where the mesh
can be fine, the displacement comes to rest 1.1 % beyond it.
"""

import pytest

from scenes import nafems

MORTAR = {"method": "surface-to-surface"}


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_roller(method):
    benchmark = nafems.roller(0.5, order=2, method=method)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.ROLLER, rel=3e-3)
    assert benchmark.contact.force[1] == pytest.approx(-35e3 / 2, rel=1e-4)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_punch(friction):
    benchmark = nafems.punch(2.0, order=2, friction=friction, **MORTAR)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.PUNCH[friction], rel=7e-3)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_punch_by_its_section(friction):
    benchmark = nafems.punch(0.5, dim=2, friction=friction, **MORTAR)
    benchmark.problem.solve()
    assert benchmark.depth() == pytest.approx(nafems.PUNCH[friction], rel=0.015)
    assert benchmark.contact.force[1] == pytest.approx(-100 * 3.14159265 * 50**2, rel=1e-6)
