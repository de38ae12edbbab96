# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton loops of one's own give what ContactProblem gives; one demo runs as a user would run it.

All of the demos: tests/verify.
"""

import inspect
import subprocess
import sys

import arc_length
import hertz_cylinder
import numpy as np
import own_forms
import own_newton
import own_snes
import patch_test
import pytest

import story
from ranks import forms_on_ranks
from scenes.problems import make_problem
from story import METHODS
from tether import environment, tethered


def assert_same(scene, other, tolerance=1e-10):
    """Status is the same; displacements and multipliers are, relative to the largest."""
    np.testing.assert_array_equal(scene.contact.status.x.array, other.contact.status.x.array)
    for a, b in (
        (scene.u.x.array, other.u.x.array),
        (scene.contact.multiplier, other.contact.multiplier),
    ):
        assert np.abs(b).max() > 0
        np.testing.assert_allclose(a, b, rtol=0, atol=tolerance * np.abs(b).max())


@pytest.mark.parametrize(("condensed", "tolerance"), [(False, 1e-10), (True, 1e-8)])
def test_a_loop_that_is_written_out(condensed, tolerance):
    scene, other = own_newton.Scene(), own_newton.Scene()
    counts = own_newton.solve(scene, condensed=condensed)
    problem = make_problem(
        other.F,
        other.u,
        [other.contact],
        other.bcs,
        petsc_options={"pc_type": "condensed"} if condensed else None,
    )
    for step, count in enumerate(counts):
        other.load((step + 1) / own_newton.STEPS)
        problem.solve()
        assert problem.report.iterations == count > 1
    assert_same(scene, other, tolerance)


def test_the_snes_of_a_nonlinear_problem():
    scene, other = own_snes.Scene(), own_snes.Scene()
    report = own_snes.solve(scene)
    problem = make_problem(other.F, other.u, [other.contact], other.bcs)
    problem.solve()
    assert report.converged
    assert report.iterations == problem.report.iterations
    assert report.reason == problem.report.reason
    assert_same(scene, other)


@pytest.mark.parametrize("method", METHODS)
def test_a_snes_on_forms(method):
    assert forms_on_ranks.difference(method) <= 1e-10


def test_contact_on_forms_is_fifteen_lines():
    lines = inspect.getsource(own_forms.solve).splitlines()
    assert 10 <= sum("# contact" in line for line in lines) <= 15


def test_an_arc_length_method():
    arch, other = arc_length.Arch(), arc_length.Arch()
    path = np.array(arc_length.follow(arch))
    load, deflection, force = path.T
    # Up to a limit, down again, and up on the floor
    assert 3 <= load[:10].argmax() + 1 <= 8
    assert load[10:14].min() < 0.5 * load[:10].max()
    assert force[-1] > 0 == force[0]
    assert (np.diff(deflection)[:-2] < 0).all()
    # The end of the way is a solution under the load that it was found with
    other.factor.value = arch.factor.value
    other.u.x.array[:] = 0.99 * arch.u.x.array
    problem = make_problem(other.F, other.u, [other.contact], other.bcs)
    problem.solve()
    assert problem.report.iterations > 0
    assert_same(arch, other)


def test_patch_test(tmp_path):
    command = [sys.executable, patch_test.__file__, "--dim", "2", "--output", str(tmp_path)]
    done = subprocess.run(
        tethered(command), env=environment(), capture_output=True, text=True, check=True
    )
    for text in ("expected", "computed", "converged after", "surface-to-surface"):
        assert text in done.stdout
    assert (tmp_path / "patch_test_pressure.png").stat().st_size > 5000


def test_an_argument_that_is_not_there():
    with pytest.raises(SystemExit):
        patch_test.main(["--no-such-argument"])


def test_results_come_before_pictures(tmp_path, monkeypatch, capsys):
    """Without the package that draws them they are not lost."""
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pyvista"):
        hertz_cylinder.main(["--h", "0.1", "--output", str(tmp_path)])
    assert "peak pressure" in capsys.readouterr().out


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
