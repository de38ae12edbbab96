#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Make an sdist and, from it, a wheel in build/wheel; install the wheel with
# DOLFINx's wheels into an empty environment, and run the README's quick start
# there without a C++ compiler. FFCx compiles forms in C: cc must be there.
#
# Usage: tools/wheel.sh PYTHON, one with the requirements of the build
set -eu

cd "$(dirname "$0")/.."
python=$1
out=build/wheel
rm -rf "$out"
mkdir -p "$out/path"

"$python" -c "
import sys
from scikit_build_core.build import build_sdist
build_sdist(sys.argv[1])" "$out"
"$python" -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$out" \
	"$out"/contactx-*.tar.gz

"$python" -m venv "$out/env"
wheel=$(ls "$out"/contactx-*.whl)
"$out/env/bin/python" -m pip install --quiet "$wheel[wheels]"

# What the quick start may call, and nothing that compiles C++
for tool in cc gcc ld as ar sh env uname; do
	found=$(command -v "$tool") && ln -s "$found" "$out/path/$tool"
done
awk '/^## Quick start/ { here = 1 } here && /^```$/ { exit } inside { print }
	here && /^```python$/ { inside = 1 }' README.md > "$out/quick_start.py"
test -s "$out/quick_start.py"
wheel=$PWD/$wheel
cd "$out"
env -i HOME="$PWD" XDG_CACHE_HOME="$PWD/cache" PATH="$PWD/path" CC=cc CXX=none OMP_NUM_THREADS=1 \
	env/bin/python quick_start.py
test -s block.pvd
echo "the quick start ran from $(basename "$wheel") without a C++ compiler"
