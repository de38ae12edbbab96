#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Print the Debian archive that this machine's own packages come from, or say
# why there is none and fail.
set -eu

mirror=$(awk '/^URIs:/ { print $2; exit } $1 == "deb" { print $2; exit }' \
	/etc/apt/sources.list.d/debian.sources /etc/apt/sources.list 2> /dev/null || true)
test -n "$mirror" || {
	echo "this machine's apt sources name no Debian archive"
	exit 1
}
echo "$mirror"
