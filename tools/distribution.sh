#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Install contactx beside the DOLFINx of a distribution, Debian sid, as a user
# of it would, and run the quick start, the C++ programs and the Python tests
# there, on one rank and on two.
#
# It needs root, debootstrap, 5 GB of disk and half an hour. Packages come from
# where this machine's own come from. What it mounts it mounts in a namespace of
# its own, where it may, and the folder is removed at the end: KEEP=1 keeps it for
# the next run.
#
# Usage: tools/distribution.sh FOLDER
set -eu

cd "$(dirname "$0")/.."
folder=$1
wanted=0.11

say() {
	echo "distribution: $*"
}

fail() {
	say "$*" >&2
	exit 1
}

test "$(id -u)" = 0 || fail "needs root, for chroot and mount"
command -v debootstrap > /dev/null || fail "needs debootstrap: apt-get install debootstrap"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
root=$folder/sid

# Nothing of this machine may be below the folder when that is removed
remove() {
	if [ -n "${KEEP:-}" ]; then return; fi
	if grep -q " $root/" /proc/mounts; then
		say "mounts below $root stay: it is not removed" >&2
		return
	fi
	rm -rf --one-file-system "$root"
}

# Outside: processes and mounts are those of namespaces, which end with the first
# process in them, however this one ends
if [ -z "${CONTACTX_NAMESPACE:-}" ] \
	&& unshare --mount --propagation private --mount-proc --pid --fork --kill-child=KILL true 2> /dev/null; then
	CONTACTX_NAMESPACE=1 unshare --mount --propagation private --mount-proc --pid --fork --kill-child=KILL \
		"$0" "$folder" &
	inner=$!
	end() {
		trap - EXIT
		kill -KILL $inner 2> /dev/null || true
		wait $inner 2> /dev/null || true
		remove
		say "ended by a signal" >&2
		exit 1
	}
	trap end INT TERM HUP
	status=0
	wait $inner || status=$?
	remove
	exit $status
fi

# Where no namespace may be made mounts are this machine's: they go, and with them
# what runs there, on every way out
clean() {
	for process in /proc/[0-9]*; do
		if [ "$(readlink "$process/root" 2> /dev/null)" = "$root" ]; then
			kill -KILL "${process#/proc/}" 2> /dev/null || true
		fi
	done
	for at in dev/shm dev/pts dev sys proc; do
		if mountpoint -q "$root/$at"; then umount -l "$root/$at"; fi
	done
	remove
}
if [ -z "${CONTACTX_NAMESPACE:-}" ]; then
	say "no namespace of its own: mounts are this machine's until the end"
	trap clean EXIT
	trap 'exit 1' INT TERM HUP
fi

# In the background, as a signal then ends the waiting
wait_for() {
	"$@" &
	wait $!
}

inside() {
	wait_for chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 \
		DEBIAN_FRONTEND=noninteractive OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 \
		OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 PRTE_MCA_mapby=:oversubscribe NO_COLOR=1 \
		"$@"
}

if [ ! -e "$root/etc/debian_version" ]; then
	mirror=$(tools/debian.sh) || fail "$mirror"
	say "sid into $root"
	rm -rf --one-file-system "$root"
	wait_for debootstrap --variant=minbase sid "$root" "$mirror" > "$folder/debootstrap.log" 2>&1 \
		|| fail "debootstrap failed, see $folder/debootstrap.log"
	# The archive may be a copy that is past its date
	echo 'Acquire::Check-Valid-Until "false";' > "$root/etc/apt/apt.conf.d/99valid"
fi
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
for at in sys dev dev/pts; do
	mountpoint -q "$root/$at" || mount --bind "/$at" "$root/$at"
done
mountpoint -q "$root/dev/shm" || mount -t tmpfs tmpfs "$root/dev/shm"
cp /etc/resolv.conf "$root/etc/resolv.conf"

inside apt-get update -qq
version=$(inside apt-cache policy python3-dolfinx-real | awk '/Candidate:/ { print $2 }')
case $version in
*:$wanted.*) say "DOLFINx $version" ;;
*) fail "sid has DOLFINx $version, and contactx is for $wanted: nothing to test here" ;;
esac
say "packages"
inside apt-get install -y -qq --no-install-recommends python3-dolfinx-real libdolfinx-real-dev g++ \
	libeigen3-dev cmake ninja-build python3-venv python3-pip python3-dev pybind11-dev python3-pybind11 \
	python3-scikit-build-core python3-rich python3-pytest python3-pytest-xdist \
	python3-scipy python3-gmsh python3-jinja2 python3-yaml python3-pyvista \
	python3-matplotlib python3-dolfinx-mpc > "$folder/apt.log" 2>&1 || fail "apt-get failed, see $folder/apt.log"

say "contactx, in a virtual environment with system packages"
rm -rf "$root/root/contactx" "$root/root/venv" "$root/root/cpp"
mkdir -p "$root/root/contactx"
git ls-files -z | xargs -0 tar c | tar x -C "$root/root/contactx"
inside python3 -m venv --system-site-packages /root/venv
inside sh -c 'cd /root/contactx && /root/venv/bin/pip install --quiet --no-deps \
	--no-build-isolation . \
	&& cmake --install build/package --component development --prefix /root/cpp/installed \
	&& rm -rf build' > "$folder/pip.log" 2>&1 || {
	tail -n 40 "$folder/pip.log"
	fail "contactx does not install, see $folder/pip.log"
}

say "quick start"
awk '/^## Quick start/ { here = 1 } here && /^```$/ { exit } inside { print }
	here && /^```python$/ { inside = 1 }' README.md > "$root/root/quick_start.py"
# Its lines: time, iterations, force
for ranks in 1 2; do
	inside sh -c "cd /root && mpiexec -n $ranks venv/bin/python quick_start.py > quick.log 2>&1" || {
		tail -n 20 "$root/root/quick.log"
		fail "the quick start fails on $ranks ranks"
	}
	grep -ao '[01][.][0-9] [0-9]* [[].*[]]' "$root/root/quick.log" | sort -u > "$folder/quick.$ranks"
done
[ "$(wc -l < "$folder/quick.1")" = 10 ] || fail "the quick start does not print ten steps"
diff "$folder/quick.1" "$folder/quick.2" || fail "the quick start is another one on two ranks"
tail -n 1 "$folder/quick.1"

say "loops of one's own, on one rank and on two"
for demo in own_newton own_snes arc_length; do
	inside sh -c "cd /root/contactx/demos && /root/venv/bin/python $demo.py > /root/1.log &&
		mpiexec -n 2 /root/venv/bin/python $demo.py > /root/2.log && tail -n 1 /root/1.log"
	inside diff /root/1.log /root/2.log || fail "$demo is another one on two ranks"
done

say "C++ on the distribution's DOLFINx"
inside sh -c 'set -e
	cd /root/contactx
	build() { cmake --build "$1" -j "$(nproc)"; }
	cmake -S cpp/contactx_dolfinx -B /root/cpp/library -G Ninja -DCMAKE_PREFIX_PATH=/root/cpp/installed
	build /root/cpp/library
	cmake --install /root/cpp/library
	for project in demos/cpp/hertz demos/cpp/sliding_block demos/cpp/pressed_block demos/cpp/own_forms \
		tests/dolfinx_cpp; do
		cmake -S $project -B /root/cpp/$project -G Ninja -DCMAKE_BUILD_TYPE=Release \
			-DCMAKE_PREFIX_PATH=/root/cpp/installed
		build /root/cpp/$project
	done' > "$folder/cpp.log" 2>&1 || {
	tail -n 40 "$folder/cpp.log"
	fail "the C++ layer does not build, see $folder/cpp.log"
}
# The same lines as Python's, on the same mesh files
inside sh -c 'set -e
	cd /root/cpp
	python=/root/venv/bin/python here=/root/contactx
	for demo in hertz sliding_block; do
		$python $here/demos/cpp/$demo/mesh.py
	done
	for demo in hertz sliding_block pressed_block own_forms; do
		$python $here/tests/dolfinx_cpp/demos.py $demo > $demo.log
	done
	for test in variants dynamics fields; do
		$python $here/tests/dolfinx_cpp/$test.py > $test.log
	done
	for ranks in 1 2; do
		for demo in hertz sliding_block pressed_block own_forms; do
			mpiexec -n $ranks demos/cpp/$demo/$demo > cpp.log
			$python $here/tests/dolfinx_cpp/compare.py cpp.log $demo.log
		done
		for test in variants dynamics fields; do
			mpiexec -n $ranks tests/dolfinx_cpp/$test > cpp.log
			$python $here/tests/dolfinx_cpp/compare.py cpp.log $test.log
		done
		mpiexec -n $ranks tests/dolfinx_cpp/refusals
	done' || fail "C++ and Python differ"

say "tests"
inside sh -c "cd /root/contactx && /root/venv/bin/python -m pytest -q -n $(nproc) tests/fast \
	--ignore tests/fast/parallel --ignore tests/fast/demos" > "$folder/tests.log" 2>&1 || {
	tail -n 60 "$folder/tests.log"
	fail "tests failed, see $folder/tests.log"
}
tail -n 1 "$folder/tests.log"
say "passed on DOLFINx $version"
