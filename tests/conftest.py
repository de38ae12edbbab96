# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""contactx comes first: it loads the wheels' MPI and PETSc before a test imports petsc4py."""

import os
from pathlib import Path

import pytest

import contactx as cx

HERE = Path(__file__).parent

# One process may wait for a form that another one compiles
os.environ["XDG_CONFIG_HOME"] = str(HERE / "settings")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Scripts on several ranks take all cores: one after the other, if tests run in parallel.

    First of all: xdist reads its groups in the same hook.
    """
    for item in items:
        if HERE / "parallel" in item.path.parents:
            item.add_marker(pytest.mark.xdist_group("ranks"))


@pytest.fixture(params=["node-to-surface", "surface-to-surface"], ids=["node", "surface"])
def method(request, monkeypatch):
    """Method of all contacts that name none; so scenes and demos need not know of it."""
    monkeypatch.setitem(cx.Contact.__init__.__kwdefaults__, "method", request.param)
    return request.param
