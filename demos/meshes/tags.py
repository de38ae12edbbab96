# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Names of the tags that all meshes of this package share."""

from __future__ import annotations

from enum import IntEnum


class Tag(IntEnum):
    """Tags of the bodies (cells) and of their faces (facets); those of a stack: `block_tag`.

    The upper body rests on the lower one. The last coordinate (z in 3D, y in 2D) points up, so
    a 2D mesh has no ``Y`` faces. Of two rings the inner one is the upper body, with the bore as its
    top, and the outer one the lower body, with the rim as its bottom; ``X0`` and ``Y0`` are their
    planes of symmetry. A model tags only the faces that its docstring lists.
    """

    UPPER = 1
    LOWER = 2

    UPPER_CONTACT = 11
    UPPER_TOP = 12
    UPPER_X0 = 13
    UPPER_Y0 = 14
    UPPER_X1 = 15
    UPPER_Y1 = 16

    LOWER_CONTACT = 21
    LOWER_BOTTOM = 22
    LOWER_X0 = 23
    LOWER_Y0 = 24
    LOWER_X1 = 25
    LOWER_Y1 = 26


# Faces of quarters of two bodies on top of each other, but for those in contact
UPPER_QUARTER = {"z1": Tag.UPPER_TOP, "x0": Tag.UPPER_X0, "y0": Tag.UPPER_Y0}
LOWER_QUARTER = {"z0": Tag.LOWER_BOTTOM, "x0": Tag.LOWER_X0, "y0": Tag.LOWER_Y0}

_SIDES = ("bottom", "top", "x0", "y0", "x1", "y1")


def block_tag(index: int, side: str | None = None) -> int:
    """Tag of a block of a stack, or of one of its faces.

    The tags of a stack are apart from those of ``Tag``, so that one cannot pass for the other.

    Args:
        index: Number of the block, 0 for the lowest.
        side: "bottom", "top", "x0" or "x1", in 3D also "y0" or "y1"; None for the block itself.

    Returns:
        The tag.

    Raises:
        ValueError: If the index is negative, or there is no such side.
    """
    if index != int(index) or index < 0:
        raise ValueError(f"index is {index}; give the number of a block, 0 for the lowest.")
    if side is not None and side not in _SIDES:
        raise ValueError(f"side is {side!r}; give one of {', '.join(_SIDES)}, or None.")
    return 100 + 10 * int(index) + (0 if side is None else 1 + _SIDES.index(side))
