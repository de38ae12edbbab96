# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of contact problems, made with gmsh and returned as dolfinx ``MeshData``."""

from __future__ import annotations

from meshes.belt import belt
from meshes.bolt import BoltMeasures, BoltTag, bolt
from meshes.cap import hertz_cap
from meshes.cord import cord
from meshes.cylinder import hertz_cylinder
from meshes.dam_face import DamFace, dam_face
from meshes.face_slab import FACE_SLABS, FaceSlab, face_slab
from meshes.gears import Gear, contact_ratio, gears
from meshes.half_cylinders import half_cylinders
from meshes.half_spheres import half_spheres
from meshes.hoop import hoop
from meshes.rings import rings
from meshes.single import single
from meshes.snap_hook import SnapHook, nose_path, snap_hook
from meshes.sphere import hertz_sphere
from meshes.sphere_grid import hertz_grid
from meshes.stack import stack
from meshes.stacked import blocks
from meshes.tags import Tag, block_tag

__all__ = [
    "FACE_SLABS",
    "BoltMeasures",
    "BoltTag",
    "DamFace",
    "FaceSlab",
    "Gear",
    "SnapHook",
    "Tag",
    "belt",
    "block_tag",
    "blocks",
    "bolt",
    "contact_ratio",
    "cord",
    "dam_face",
    "face_slab",
    "gears",
    "half_cylinders",
    "half_spheres",
    "hertz_cap",
    "hertz_cylinder",
    "hertz_grid",
    "hertz_sphere",
    "hoop",
    "nose_path",
    "rings",
    "single",
    "snap_hook",
    "stack",
]
