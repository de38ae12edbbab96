# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms with several quadrature rules, taken apart."""

from __future__ import annotations

from typing import Any

import ufl
from ufl.utils.sorting import canonicalize_metadata


def by_rule(form: ufl.Form) -> list[ufl.Form]:
    """Forms that sum up to a form, none with two quadrature rules in the same place.

    FFCx 0.11 makes one kernel of the integrals over a subdomain. Where these have different rules,
    what depends on the first one's points, such as the Jacobian of a quadrilateral or the value of
    a coefficient, has the same name in all of them and is mistaken for the others'. Kernels of
    forms of their own are right, and so are those of different subdomains.

    Args:
        form: Any form.

    Returns:
        The forms; most often there is one, with the integrals as they were. The first one has an
        integral over each subdomain.
    """
    parts: list[list[ufl.Integral]] = []
    rules: list[dict[Any, Any]] = []
    for integral in form.integrals():
        place = (integral.ufl_domain(), integral.integral_type(), integral.subdomain_id())
        # No rule given means that of the degree which UFL estimates for all such integrals together
        rule = canonicalize_metadata(integral.metadata())
        for part, taken in zip(parts, rules, strict=True):
            if taken.setdefault(place, rule) == rule:
                part.append(integral)
                break
        else:
            parts.append([integral])
            rules.append({place: rule})
    return [ufl.Form(part) for part in parts]
