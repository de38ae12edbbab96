# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""contactx comes first: it loads the wheels' MPI and PETSc before a test imports petsc4py."""

import os
import signal
from pathlib import Path

import pytest

# DOLFINx asks when it is imported. One process may wait for a form that another one compiles, and
# the compiler need not make the most of what runs on a few cells
os.environ["XDG_CONFIG_HOME"] = str(Path(__file__).parent / "settings")
# Forms are compiled once, for scripts that tests launch too, and kept until `make clean`
os.environ["XDG_CACHE_HOME"] = str(Path(__file__).parents[1] / "build" / "cache")

import contactx as cx

from tether import tether


def pytest_configure(config):
    """However a run is ended, it ends what it has started."""
    # In the background of a shell Ctrl-C is ignored, and some tests raise it
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    if hasattr(config, "workerinput"):
        tether()


@pytest.fixture(params=["node-to-surface", "surface-to-surface"], ids=["node", "surface"])
def method(request, monkeypatch):
    """Method of all contacts that name none; so scenes and demos need not know of it."""
    monkeypatch.setitem(cx.Contact.__init__.__kwdefaults__, "method", request.param)
    return request.param
