# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a file for ParaView is made of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import basix
from contactx.contact import Contact
from dolfinx import fem


def check_output(u: Any, contacts: Any, fields: Any) -> None:
    """Check what is to be written.

    Args:
        u: Displacement.
        contacts: Contacts.
        fields: Other functions.

    Raises:
        TypeError: If one is of another kind.
        ValueError: If a function is of another mesh, or not of a linear Lagrange space.
    """
    if not isinstance(u, fem.Function):
        raise TypeError(f"u must be a dolfinx.fem.Function, not {type(u).__name__}")
    for name, items, kind in (("contacts", contacts, Contact), ("fields", fields, fem.Function)):
        what = f"a list of {'contactx.Contact' if kind is Contact else 'fem.Function'}"
        if isinstance(items, kind) or not isinstance(items, Sequence):
            raise TypeError(f"{name} must be {what}, not {type(items).__name__}")
        for item in items:
            if not isinstance(item, kind):
                raise TypeError(f"{name} holds a {type(item).__name__}: pass {what}")
    functions = {f"fields[{k}]": f for k, f in enumerate(fields)}
    functions |= {f"contacts[{k}]": contact.pressure for k, contact in enumerate(contacts)}
    for name, function in functions.items():
        V = function.function_space
        if V.mesh is not u.function_space.mesh:
            raise ValueError(f"{name} is on another mesh than u: give one of the same mesh")
        element = V.ufl_element()
        if (element.element_family, element.degree) != (basix.ElementFamily.P, 1) or (
            element.discontinuous
        ):
            raise ValueError(
                f"{name} is of {element}: interpolate it into a linear Lagrange space, "
                'functionspace(mesh, ("Lagrange", 1))'
            )
