# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arrays of a checkpoint, read and changed without contactx: what ``storage/archive.h`` says."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np

# Mark, version, number of the format, bytes of the table and of the file, checksum
_START = struct.Struct("<24s24sqqqQ")
_MASK = (1 << 64) - 1


def _hash(data: bytes) -> int:
    """FNV-1a, and the last step of MurmurHash3."""
    h = 14695981039346656037
    for byte in data:
        h = ((h ^ byte) * 1099511628211) & _MASK
    h = ((h ^ (h >> 33)) * 0xFF51AFD7ED558CCD) & _MASK
    h = ((h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53) & _MASK
    return h ^ (h >> 33)


def _entries(data: bytes) -> list[list[str]]:
    """Lines of the table."""
    table = _START.unpack_from(data)[3]
    text = data[_START.size : _START.size + table].decode()
    return [line.split("\t") for line in text.splitlines()]


def read(path: Path) -> dict[str, Any]:
    """Arrays by their names, in the order of the file."""
    data = path.read_bytes()
    arrays = {}
    for name, kind, width, count, _, _, at, _ in _entries(data):
        shape = (int(count), int(width)) if int(width) else (int(count),)
        array = np.frombuffer(data, f"<{kind}", int(np.prod(shape)), int(at))
        arrays[name] = array.reshape(shape)
    return arrays


def change(path: Path, **values: float) -> Path:
    """Set all values of some arrays, by the last word of their names, and their checksums."""
    data = bytearray(path.read_bytes())
    mark, version, number, table, size, _ = _START.unpack_from(data)
    arrays, entries = read(path), _entries(data)
    for word, value in values.items():
        entry = next(e for e in entries if e[0].split()[-1] == word)
        array = np.full_like(arrays[entry[0]], value)
        at = int(entry[6])
        data[at : at + array.nbytes] = array.tobytes()
        rows = [row.tobytes() for row in array]
        total = sum((2 * k + 1) * _hash(row) for k, row in enumerate(rows)) & _MASK
        entry[7] = f"{total:20d}"
    text = "".join("\t".join(entry) + "\n" for entry in entries).encode()
    start = _START.pack(mark, version, number, table, size, 0)
    total = (_hash(start) + 3 * _hash(text)) & _MASK
    data[: _START.size] = _START.pack(mark, version, number, table, size, total)
    data[_START.size : _START.size + table] = text
    path.write_bytes(data)
    return path
