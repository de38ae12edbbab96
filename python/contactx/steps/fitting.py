# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether saved arrays are those of a problem."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

type Arrays = Mapping[str, npt.NDArray[Any]]

# Starts of the names of arrays that stay the same as long as a problem is the same
_SAME = ("mesh: ", "surface ")


def check_fit(saved: Arrays, present: Arrays) -> None:
    """Check that saved arrays are those of a problem.

    Args:
        saved: Arrays of a file.
        present: The same of the problem as it is.

    Raises:
        ValueError: If they are of another problem or not finite.
    """
    for kind, what in (("contact", "contacts"), ("history", "functions of history")):
        there, here = (
            len({name.split(":")[0] for name in arrays if name.startswith(f"{kind} ")})
            for arrays in (saved, present)
        )
        if there != here:
            raise ValueError(f"it holds {there} {what}, but there are {here} here")
    for name in sorted(saved.keys() ^ present.keys()):
        side = "only in the file" if name in saved else "missing in the file"
        raise ValueError(f"{name!r} is {side}: were the options of the contacts others?")
    for name, array in present.items():
        other = saved[name]
        if other.shape != array.shape or other.dtype.kind != array.dtype.kind:
            raise ValueError(
                f"{name!r} is {other.dtype} of shape {other.shape} in the file, but {array.dtype} "
                f"of shape {array.shape} here: is it of another mesh or other surfaces?"
            )
    for name, array in present.items():
        if name == "mesh: coordinates":
            # Another machine may round them in another way
            same = np.allclose(saved[name], array, rtol=0, atol=1e-12 * np.ptp(array))
        elif name.startswith(_SAME) or name.endswith(": rows"):
            same = np.array_equal(saved[name], array)
        else:
            continue
        if not same:
            raise ValueError(f"{name!r} is another one here: restart the same problem")
    for name, array in saved.items():
        if name == "u" or name.endswith(": multiplier"):
            bad = np.count_nonzero(~np.isfinite(array))
            if bad:
                raise ValueError(f"{name!r} is not finite at {bad} dofs")
