# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces of cells before their sum."""

import gc
import weakref

from mpi4py import MPI

from contactx._host.bulk_host import CellForces
from dolfinx import mesh

from scenes.materials import neo_hookean
from story import displacement, elasticity


def test_bodies_are_let_go():
    """A mesh that stayed would keep nine communicators, of which MPI has 2,000."""
    for material in (elasticity, neo_hookean):
        domain = mesh.create_unit_square(MPI.COMM_SELF, 2, 2)
        u = displacement(domain)
        forces = CellForces(material(u, 1.0, 0.3), u, None, {})
        assert forces._compiled()
        alive = weakref.ref(u)
        del forces, u, domain
        gc.collect()
        assert alive() is None
