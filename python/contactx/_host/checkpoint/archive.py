# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Named arrays in a file that is whole or not there."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

# Says what the file is, and the version of its format
_MARK = "contactx_checkpoint"
_VERSION = 5
# Advice where a file cannot be read
_INSTEAD = ". Give another file, or leave restart out (manual: errors/restart-refused)"


def write(path: Path, arrays: Mapping[str, npt.NDArray[Any]]) -> None:
    """Write arrays; a file of this name is replaced once the new one is whole.

    Args:
        path: The file, in NumPy's format .npz.
        arrays: Arrays by their names.

    Raises:
        OSError: If it cannot be written; the old file is still there.
    """
    temporary = path.with_name(f"{path.name}.tmp")
    try:
        with open(temporary, "wb") as file:
            np.savez(file, allow_pickle=False, **{_MARK: np.array(_VERSION)}, **arrays)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:
        _remove(temporary)
        raise OSError(
            error.errno,
            f"cannot write the checkpoint {path}: {error.strerror or error}; an older file of this "
            "name is as it was",
        ) from error
    except BaseException:
        _remove(temporary)
        raise


def _remove(temporary: Path) -> None:
    with suppress(OSError):
        temporary.unlink(missing_ok=True)


def read(path: Path) -> dict[str, npt.NDArray[Any]]:
    """Read arrays.

    Args:
        path: The file.

    Returns:
        Arrays by their names.

    Raises:
        FileNotFoundError: If there is no such file.
        OSError: If it cannot be read.
        ValueError: If it is damaged or something else.
    """
    if path.is_dir():
        raise ValueError(f"{path} is a folder, not a checkpoint: give the name of a file")
    if not path.is_file():
        raise FileNotFoundError(f"there is no checkpoint {path}{_INSTEAD}")
    try:
        with open(path, "rb") as file:
            is_archive = zipfile.is_zipfile(file)
    except OSError as error:
        text = f"cannot read the checkpoint {path}: {error.strerror}"
        raise OSError(error.errno, text) from error
    if not is_archive:
        raise ValueError(f"{path} is truncated, or no checkpoint at all{_INSTEAD}")
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
    except Exception as error:
        # Damage may look like anything: encryption, or a place before the file's start
        raise ValueError(
            f"{path} is damaged, or no checkpoint at all: {error}{_INSTEAD}"
        ) from error
    version = arrays.pop(_MARK, None)
    if version is None:
        raise ValueError(f"{path} holds arrays, but is no checkpoint of contactx{_INSTEAD}")
    if version != _VERSION:
        raise ValueError(
            f"{path} has format {version}, but this contactx reads {_VERSION}{_INSTEAD}"
        )
    return arrays
