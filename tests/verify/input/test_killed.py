# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results of runs that are killed."""

import numpy as np
import pytest
import pyvista

from ranks.launch import SCRIPTS, Failure, launch

POINTS = 61**2


@pytest.mark.parametrize(
    "ranks, killed, seconds",
    [(1, 0, 0.0), (1, 0, 0.09), (1, 0, 0.25), (2, 1, 0.04), (2, 0, 0.11), (2, 1, 0.31)],
)
def test_the_collection_lists_what_is_whole(tmp_path, ranks, killed, seconds):
    """SIGKILL comes at any moment; the steps before the last one are listed, and whole."""
    (tmp_path / "run.pvd").write_text("of an older run")
    with pytest.raises(Failure):
        launch(SCRIPTS / "killed_output.py", ranks, str(tmp_path), str(seconds), str(killed))
    reader = pyvista.get_reader(str(tmp_path / "run.pvd"))
    count = len(reader.time_values)
    assert reader.time_values == list(range(count))
    for t in reader.time_values:
        reader.set_active_time_value(t)
        values = reader.read()[0].point_data["u"]
        assert len(values) >= POINTS and np.all(values[:, :2] == t)
    begun = {path.stem[-6:] for path in tmp_path.glob("run_p*.vtu")}
    assert count <= len(begun) <= count + 1
