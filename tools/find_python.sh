#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Print the path of a Python >= 3.12 that runs.
# Usage: find_python.sh [PYTHON]    (with PYTHON, only that one is tried)
set -eu

# The absolute path of a Python, asked of that Python itself: a name on PATH
# may be a shim with nothing behind it.
path_of() {
    "$1" -c 'import sys
sys.version_info >= (3, 12) or sys.exit(1)
print(sys.executable)' 2>/dev/null
}

candidates() {
    printf '%s\n' python3 python3.14 python3.13 python3.12
    # Newest first.
    for version in 14 13 12; do
        ls -d "${PYENV_ROOT:-${HOME:-}/.pyenv}"/versions/3.$version.*/bin/python 2>/dev/null || true
    done
    uv python find --no-project '>=3.12' 2>/dev/null || true
}

if [ -n "${1:-}" ]; then
    path_of "$1" && exit 0
    echo "contactx: PYTHON=$1 is not a Python >= 3.12 that runs" >&2
    exit 1
fi

candidates | {
    while IFS= read -r candidate; do
        path_of "$candidate" </dev/null && exit 0
    done
    echo "contactx: no Python >= 3.12 found that runs: install one (package python3.12 or later, or 'uv python install 3.13') or name it with 'make PYTHON=/path/to/python'" >&2
    exit 1
}
