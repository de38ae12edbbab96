# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Totals of an accepted step for its report, and warnings of a contact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contactx.contact import Contact
from contactx.interface import Interface
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, least, total
from contactx.report import Report


def complete(report: Report, contacts: Sequence[Contact], halo: Halo) -> None:
    """Write the totals of an accepted step into its report; all ranks must take part.

    Args:
        report: The report.
        contacts: Contacts of the problem.
        halo: Nodes of this rank.
    """
    comm, interfaces = halo.comm, [contact.interface for contact in contacts]
    report.slaves, report.pairs, report.immobile, report.frozen_pairs = total(
        comm,
        np.array(
            [
                sum(len(i.slaves) for i in interfaces),
                sum(i.master.paired.sum() for i in interfaces),
                sum(i.nodes.immobile.sum() for i in interfaces),
                sum(len(i.master.frozen_pairs) for i in interfaces),
            ]
        ),
    ).tolist()
    histories = [i.history for i in interfaces if i.history is not None]
    report.slip, report.dissipation = total(
        comm,
        np.array(
            [
                sum(np.linalg.norm(h.slip, axis=1).sum() for h in histories),
                sum(h.dissipation.sum() for h in histories),
            ],
            dtype=np.float64,
        ),
    ).tolist()
    report.force = [contact.force for contact in contacts]
    report.recovery = [contact.fields.recovery_change for contact in contacts]
    report.imbalance = np.sum([contact.fields.imbalance for contact in contacts], axis=0)


def warning_of(
    name: str, interface: Interface, hidden: float, halo: Halo, *, may_fly: bool = False
) -> str:
    """Warning of a contact of a converged solution, such as a hidden gap; empty if there is none.

    All ranks must take part.

    Args:
        name: Name of the contact.
        interface: Its discrete side.
        hidden: Smallest gap that frozen pairs hide.
        halo: Nodes of this rank.
        may_fly: Whether it is nothing unusual that no slave node is in reach of the master.
    """
    comm, master = halo.comm, interface.master
    # A surface need not meet itself
    expected = interface.active and not may_fly and not interface.is_self
    if expected and not anywhere(comm, master.paired.any()):
        # Where its nodes were paired, or should have been
        small = interface.sliding == "small"
        x = halo.x if small else interface.positions()
        distance = least(comm, master.distance(x))
        text = f"{name} transmits no force: it has no slave node "
        if distance > master.reach:
            text += (
                f"within reach of its master; the nearest is {distance:.3g} away"
                f"{' in the reference configuration' if small else ''}, and the "
                f"search reaches {master.reach:.3g}"
            )
        else:
            text += (
                f"that faces its master, although the nearest is {distance:.3g} away: check that "
                "the tags are those of surfaces that face each other"
            )
        if small and not master.is_rigid:
            text += (
                '. sliding="small" pairs nodes in the reference configuration, once: give a '
                'larger search_distance, or take sliding="finite"'
            )
        return f"{text} (manual: errors/no-force)"
    if hidden < 0:
        frozen = total(comm, len(master.frozen_pairs))
        return (
            f"{name}: {frozen} pairs went back and forth between facets and "
            f"were frozen; they hide a penetration of {-hidden:.3g}. Refine the coarser "
            "surface there or take smaller steps (manual: errors/frozen-pairs)"
        )
    return ""
