# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compare what a C++ program and a script of Python have printed: python compare.py ONE OTHER.

Words and whole numbers must be the same, other numbers to 1e-10 of 1, or of themselves where they
are larger: 1e-9 where the solver is iterative. Iterations, the first whole number of a line, may
differ by a fifth where there are more than 12: an interior point is on its way then, and rounding
decides when it tries its active set.
"""

from __future__ import annotations

import sys
from pathlib import Path


def same(one: str, other: str) -> bool:
    """Whether two lines say the same."""
    ours, theirs = one.split(), other.split()
    if len(ours) != len(theirs):
        return False
    allowed = 1e-9 if "condensed" in ours else 1e-10
    counts = [k for k, word in enumerate(ours) if word.isdigit()][:1]
    for k, (a, b) in enumerate(zip(ours, theirs, strict=True)):
        if a == b:
            continue
        if k in counts and b.isdigit() and min(int(a), int(b)) > 12:
            if abs(int(a) - int(b)) > max(int(a), int(b)) / 5:
                return False
            continue
        if "." not in a or "." not in b:
            return False
        try:
            x, y = float(a), float(b)
        except ValueError:
            return False
        if not abs(x - y) <= allowed * max(1, abs(x)):
            return False
    return True


def main() -> int:
    """Print the lines that differ."""
    one, other = (Path(name).read_text().splitlines() for name in sys.argv[1:3])
    failures = 0
    for k in range(max(len(one), len(other))):
        ours, theirs = (lines[k] if k < len(lines) else "nothing" for lines in (one, other))
        if not same(ours, theirs):
            failures += 1
            print(f"< {ours}\n> {theirs}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
