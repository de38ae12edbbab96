# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Free bodies: those that have not enough supports of their own."""

from __future__ import annotations

from collections.abc import Sequence

from contactx import cpp as core
from contactx.bodies.adapter import BulkSide, ContactSide
from contactx.bodies.bodies import Bodies
from contactx.bulk import Bulk
from contactx.interface import Interface


class FreeBodies(core.FreeBodies):
    """Keeps the Newton step of bodies without enough supports solvable."""

    def __init__(self, bulk: Bulk, interfaces: Sequence[Interface], bodies: Bodies):
        """Take the bodies.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            bodies: Bodies of the mesh.
        """
        # The halo tells this object, not the core's, when it has changed
        self._bodies, halo = bodies, bodies.halo
        super().__init__(
            bodies,
            BulkSide(bulk, halo),
            [ContactSide(interface) for interface in interfaces],
            halo.original[: halo.num_owned],
        )
