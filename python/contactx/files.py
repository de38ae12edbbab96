# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Paths of files to write."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any


def check_path(name: str, path: Any) -> Path:
    """Check that a path is one.

    Args:
        name: Name of the argument.
        path: The path.

    Raises:
        TypeError: If it is none.
    """
    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"{name} is {path!r}: give the path of a file")
    return Path(path)


def make_folder(name: str, path: Path) -> None:
    """Make the folder of a file.

    Args:
        name: Name of the argument.
        path: The file.

    Raises:
        OSError: If it cannot be made.
        ValueError: If there is something else than a file at the path.
    """
    if path.is_dir():
        raise ValueError(f"{name} is the folder {path}: give the name of a file")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        there = path.exists()
    except OSError as error:
        text = f"cannot make the folder of {name} {path}: {error.strerror}"
        raise OSError(error.errno, text) from error
    if there and not path.is_file():
        raise ValueError(f"{name} {path} is no regular file: give another name")
