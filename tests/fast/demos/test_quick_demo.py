# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One demo runs as a user would run it; all of them: tests/verify."""

import subprocess
import sys

import hertz_cylinder
import patch_test
import pytest

from tether import environment, tethered


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
