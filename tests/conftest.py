# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""contactx comes first: it loads the wheels' MPI and PETSc before a test imports petsc4py."""

import os
import signal
from pathlib import Path

import pytest

import contactx as cx

from tether import tether

# One process may wait for a form that another one compiles
os.environ["XDG_CONFIG_HOME"] = str(Path(__file__).parent / "settings")
# Forms are compiled once and kept from one run to the next, until `make clean`
os.environ["XDG_CACHE_HOME"] = str(Path(__file__).parents[1] / "build" / "cache")


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
