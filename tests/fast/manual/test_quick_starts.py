# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The quick starts of README and of the manual run as they stand."""

import numpy as np
import pytest

import pages


@pytest.mark.parametrize("path", [pages.ROOT / "README.md", pages.MANUAL / "index.md"])
def test_quick_start(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = pages.run(path)
    contact = names["contact"]
    tangential, normal = np.abs(contact.force)
    # The block slides at the end: full friction
    assert normal > 0 and np.isclose(tangential, 0.3 * normal, rtol=1e-6)
    assert (contact.status.x.array == 2).any()
