# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Many parts in one launch, as a start costs seconds; one that hangs does not hide the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ranks.launch import Failure, Hang, launch

# A few that hang are skipped, more are not waited for
_MOST = 3


def launch_together(
    script: Path, ranks: int, folder: Path, names: Sequence[str], file: Callable[[str], Path]
) -> dict[str, str]:
    """Run a script that takes a folder and names, and writes a file for each name in turn.

    Args:
        script: The script.
        ranks: Number of ranks.
        folder: Where the files go.
        names: What is to be run.
        file: File of a name.

    Returns:
        What went wrong with those that have no file.
    """
    left, wrong = list(names), {}
    for _ in range(_MOST):
        try:
            launch(script, ranks, str(folder), *left)
            break
        except (Hang, Failure) as error:
            left = [name for name in left if not file(name).exists()]
            if left:
                wrong[left.pop(0)] = str(error)
            if not left:
                break
    missing = [name for name in left if not file(name).exists()]
    return wrong | dict.fromkeys(missing, "not run, or it wrote nothing")
