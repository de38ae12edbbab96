#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Compile the C++ layer, its demos and its tests against DOLFINx 0.11, link and
# run them on one rank and on two, without an installation of DOLFINx with
# headers: packages of Debian sid are unpacked, not installed, and their own
# compiler and programs are run by their own loader, as the C library of this
# machine may be older.
#
# 450 MB come from where this machine's own packages come from, and 1.8 GB are
# kept in ~/.cache/contactx (XDG_CACHE_HOME) for the next time. Where there is
# no Debian archive, or sid has moved on and nothing is kept, nothing is
# checked: the last line says so.
#
# Usage: tools/gate.sh compile|run FOLDER PYTHON
#   PYTHON is of an environment that has contactx; the core is in
#   build/outside/package (make test-cpp).
set -eu
