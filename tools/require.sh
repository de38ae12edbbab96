#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# See to it that the system has what contactx needs of it: install what is
# missing where that is allowed, else say in one line how to.
# Usage: require.sh PYTHON NEED...   (as in missing.sh)
set -eu

python=$1
shift
tools=$(dirname "$0")

missing=$("$tools/missing.sh" "$python" "$@")
[ -n "$missing" ] || exit 0

# Say what is missing, and how to get it where that is known, and give up.
give_up() {
    echo "contactx: missing on this system: $(echo $missing)${1:+; install with: $1}" >&2
    exit 1
}

if command -v apt-get >/dev/null; then
    manager=apt-get
elif command -v dnf >/dev/null; then
    manager=dnf
else
    give_up
fi

version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
packages=
for need in $missing; do
    case $manager:$need in
        apt-get:compiler) new="g++" ;;
        apt-get:googletest) new="libgtest-dev" ;;
        apt-get:headers) new="python$version-dev" ;;
        apt-get:venv) new="python$version-venv" ;;
        apt-get:graphics) new="libegl1 libgl1 libglu1-mesa libgomp1 libxcursor1 libxft2 libxinerama1 libxrender1" ;;
        dnf:compiler) new="gcc-c++" ;;
        dnf:googletest) new="gtest-devel" ;;
        dnf:headers) new="python$version-devel" ;;
        dnf:venv) new="python$version-libs" ;;
        dnf:graphics) new="mesa-libEGL mesa-libGL mesa-libGLU mesa-dri-drivers libgomp libXcursor libXft libXinerama libXrender" ;;
    esac
    packages="$packages $new"
done

how="sudo $manager install -y$packages"
if [ "$(id -u)" = 0 ]; then
    as_root=
elif sudo -n true 2>/dev/null; then
    as_root="sudo -n"
else
    give_up "$how"
fi

echo "contactx: installing$packages"
if [ $manager = apt-get ]; then
    # The list of packages may be stale, or absent in a container.
    $as_root apt-get -qq update || true
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $packages >/dev/null || give_up "$how"
else
    $as_root dnf -q install -y $packages || give_up "$how"
fi

missing=$("$tools/missing.sh" "$python" "$@")
[ -z "$missing" ] || give_up "$how"
