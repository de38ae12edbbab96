# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""contactx comes first: it loads the wheels' MPI and PETSc before a test imports petsc4py."""

import pytest

import contactx as cx


@pytest.fixture(params=["node-to-surface", "surface-to-surface"], ids=["node", "surface"])
def method(request, monkeypatch):
    """Method of all contacts that name none; so scenes and demos need not know of it."""
    monkeypatch.setitem(cx.Contact.__init__.__kwdefaults__, "method", request.param)
    return request.param
