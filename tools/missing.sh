#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Print, one word a line, what contactx needs of the system and does not find.
# Each thing is tried, not looked up by its name.
# Usage: missing.sh PYTHON NEED...   (compiler, headers, venv, googletest, graphics)
set -eu

python=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A C++20 compiler with its standard library, and the C compiler that Python
# names: DOLFINx compiles forms with it.
compiler() {
    cat >"$work/cxx20.cpp" <<'EOF'
#include <concepts>
#include <span>
template <std::floating_point T>
T first(std::span<const T> x) { return x.front(); }
int main() { const double x[] = {0.0}; return int(first<double>(x)); }
EOF
    echo 'int main(void) { return 0; }' >"$work/c.c"
    cc=${CC:-$("$python" -c 'import sysconfig; print(sysconfig.get_config_var("CC") or "cc")')}
    ${CXX:-c++} -std=c++20 "$work/cxx20.cpp" -o "$work/cxx20" && "$work/cxx20" &&
        $cc "$work/c.c" -o "$work/c" && "$work/c"
}

# GoogleTest, headers and library.
googletest() {
    cat >"$work/gtest.cpp" <<'EOF'
#include <gtest/gtest.h>
TEST(Require, links) { EXPECT_EQ(1, 1); }
EOF
    ${CXX:-c++} -std=c++20 "$work/gtest.cpp" -o "$work/gtest" \
        -lgtest_main -lgtest -pthread
}

# Python's C headers, for the extension and for the forms.
headers() {
    "$python" -c 'import os, sysconfig
open(os.path.join(sysconfig.get_path("include"), "Python.h"))'
}

# What `python -m venv` needs.
venv() {
    "$python" -c 'import ensurepip, venv'
}

# The libraries that the wheels of gmsh and VTK take from the system.
graphics() {
    "$python" - <<'EOF'
import ctypes
for name in (
    "libEGL.so.1",
    "libGL.so.1",
    "libGLU.so.1",
    "libX11.so.6",
    "libXcursor.so.1",
    "libXext.so.6",
    "libXfixes.so.3",
    "libXft.so.2",
    "libXinerama.so.1",
    "libXrender.so.1",
    "libfontconfig.so.1",
    "libgomp.so.1",
):
    ctypes.CDLL(name)
EOF
}

for need; do
    $need >/dev/null 2>&1 || echo $need
done
