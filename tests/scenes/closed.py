# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contacts whose nodes are all closed."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx


def close_all(contact: cx.Contact) -> Any:
    """Close all nodes that have a pair, evaluate the law, and return the slave nodes."""
    discrete = contact.discrete
    nodes = discrete.nodes
    discrete.begin_step()
    discrete.search()
    discrete.update_gap()
    nodes.status[:] = np.where(np.isnan(nodes.gap), 0, 1 if nodes.size > 1 else 2)
    nodes.c[:] = 1
    discrete.law.evaluate(nodes)
    return nodes
