#!/bin/sh
# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Compile the C++ layer, its demos and its tests against DOLFINx 0.11, link them
# and run them on one rank and on two, without a DOLFINx with headers on this
# machine. Packages of Debian sid are unpacked, not installed; their compiler and
# their programs are run by their own loader, as the C library of this machine
# may be older. No root is needed.
#
# 410 MB come from where this machine's own packages come from, and 1.8 GB stay in
# ~/.cache/contactx (XDG_CACHE_HOME) for the next time: also for when sid has moved
# on to another DOLFINx. Where nothing can be had nothing is checked, and the
# outcome, also in FOLDER/outcome, says so.
#
# Usage: tools/gate.sh FOLDER PYTHON CORE
#   PYTHON is of an environment with contactx, CORE where CMake has installed the
#   component development of the core
set -eu

cd "$(dirname "$0")/.."
mkdir -p "$1"
folder=$(cd "$1" && pwd)
python=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
core=$(cd "$3" && pwd)
source=$PWD
wanted=0.11
triplet=x86_64-linux-gnu
cache=${XDG_CACHE_HOME:-${HOME:-$folder}/.cache}/contactx/sid

say() {
	echo "C++ layer: $*"
}

finish() {
	printf 'C++ layer: %s\n' "$*" > "$folder/outcome"
	cat "$folder/outcome"
}

skip() {
	finish "NOT CHECKED, not even compiled: $*"
	exit 0
}

fail() {
	finish "FAILED: $*" >&2
	exit 1
}

rm -f "$folder/outcome"
test "$(uname -m)" = x86_64 || skip "the packages are for x86_64, and this is $(uname -m)"
for tool in apt-get apt-cache dpkg-deb; do
	command -v $tool > /dev/null || skip "$tool is needed, and not here"
done

# The packages that sid has now; apt keeps its lists and the packages here, and is
# told that nothing is installed, so that all that is needed comes
version= why=
if ! mirror=$("$source/tools/debian.sh"); then
	why=$mirror
elif [ ! -e /usr/share/keyrings/debian-archive-keyring.gpg ]; then
	why="the package debian-archive-keyring is needed, and not here"
else
	mkdir -p "$cache/lists/partial" "$cache/archives/partial"
	: > "$cache/status"
	echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror sid main" \
		> "$cache/sid.list"
	cat > "$cache/apt.conf" <<-END
		Dir::Etc::sourcelist "$cache/sid.list";
		Dir::Etc::sourceparts "/dev/null";
		Dir::State "$cache";
		Dir::State::Lists "$cache/lists";
		Dir::State::status "$cache/status";
		Dir::Cache "$cache";
		APT::Architecture "amd64";
		APT::Architectures "amd64";
		APT::Install-Recommends "false";
		APT::Get::List-Cleanup "false";
		Acquire::Check-Valid-Until "false";
		Acquire::Languages "none";
		Acquire::Retries "1";
	END
	export APT_CONFIG="$cache/apt.conf"
	if apt-get -qq update > "$folder/apt.log" 2>&1 && ! grep -q '^[WE]:.*Failed' "$folder/apt.log"; then
		version=$(apt-cache policy libdolfinx-real-dev | awk '/Candidate:/ { print $2 }')
		case $version in
		*:$wanted.*) ;;
		*) why="sid has DOLFINx $version, and this is for $wanted" version= ;;
		esac
	else
		why="no Debian archive answers"
	fi
fi

kept=$(cat "$cache/version" 2> /dev/null || true)
root=$cache/root
if [ -z "$version" ]; then
	test -n "$kept" || skip "$why"
	say "$why; DOLFINx $kept is what is kept of another time"
elif [ "$version" != "$kept" ]; then
	say "DOLFINx $version and its compiler, unpacked in $cache: a minute"
	rm -rf "$root" "$cache/version"
	apt-get install --download-only -y -qq libdolfinx-real-dev libdolfinx-dev python3-ffcx g++ \
		> "$folder/apt.log" 2>&1 || fail "apt-get cannot download, see $folder/apt.log"
	mkdir -p "$root"
	printf '%s\0' "$cache"/archives/*.deb \
		| xargs -0 -n 16 -P "$(nproc)" sh -c 'for deb; do dpkg-deb -x "$deb" "$0"; done' "$root"
	rm -rf "$cache/archives" "$root/usr/share/doc" "$root/usr/share/fonts"
	# What installing them would do
	for name in lib lib64; do [ -e "$root/$name" ] || ln -s usr/$name "$root/$name"; done
	for name in blas lapack; do
		ln -sf $name/lib$name.so.3 "$root/usr/lib/$triplet/lib$name.so.3"
	done
	echo "$version" > "$cache/version"
	kept=$version
fi

# Programs of sid by sid's loader
lib=$root/usr/lib/$triplet
loader=$root/lib64/ld-linux-x86-64.so.2
rm -rf "$folder/bin"
mkdir -p "$folder/bin"
program() {
	name=$1 of=$2
	shift 2
	printf '#!/bin/sh\nexec "%s" --library-path "%s" "%s"%s "$@"\n' "$loader" "$lib" "$of" "$*" \
		> "$folder/bin/$name"
	chmod +x "$folder/bin/$name"
}
compiler=$(dirname "$(ls "$root"/usr/libexec/gcc/$triplet/*/cc1plus)")
major=$(basename "$compiler")
for name in cc1 cc1plus collect2; do program $name "$compiler/$name"; done
for name in as ld; do program $name "$root/usr/bin/$triplet-$name"; done
for name in gcc g++; do
	program $name "$root/usr/bin/$triplet-$name-$major" \
		" \"--sysroot=$root\" \"-B$folder/bin\" -no-canonical-prefixes"
done
program launch "$root/usr/bin/prterun" " --allow-run-as-root --map-by :oversubscribe"
export OPAL_PREFIX="$root/usr" PRTE_PREFIX="$root/usr" PMIX_PREFIX="$root/usr"

say "compiling library, headers, demos and tests with g++ $major against DOLFINx $kept"
PATH=$(dirname "$python"):$PATH
export PATH
[ "$(cat "$folder/of" 2> /dev/null)" = "$kept $root $source" ] || rm -rf "$folder/build"
echo "$kept $root $source" > "$folder/of"
cmake -S tests/dolfinx_cpp/gate -B "$folder/build" -G Ninja \
	-DCMAKE_C_COMPILER="$folder/bin/gcc" -DCMAKE_CXX_COMPILER="$folder/bin/g++" \
	-DDOLFINX_ROOT="$root" -DDOLFINX_TRIPLET=$triplet \
	-DCMAKE_PREFIX_PATH="$core" -DDOLFINX_DIR="$source/tests/dolfinx_cpp/gate/cmake" \
	-DCMAKE_EXE_LINKER_FLAGS="-Wl,--dynamic-linker=$loader -Wl,--disable-new-dtags,-rpath,$lib" \
	> "$folder/configure.log" 2>&1 || {
	tail -n 20 "$folder/configure.log"
	fail "CMake cannot configure it, see $folder/configure.log"
}
cmake --build "$folder/build" > "$folder/build.log" 2>&1 || {
	grep -E -A 3 'error:|undefined reference' "$folder/build.log" | head -40
	fail "it does not build, see $folder/build.log"
}

# The same lines as Python's, on the same mesh files
say "running them on one rank and on two"
rm -rf "$folder/run"
mkdir "$folder/run"
cd "$folder/run"
for demo in hertz sliding_block; do
	"$python" "$source/demos/cpp/$demo/mesh.py"
done
for demo in hertz sliding_block pressed_block own_forms; do
	"$python" "$source/tests/dolfinx_cpp/demos.py" $demo > $demo.log
done
for test in variants dynamics fields; do
	"$python" "$source/tests/dolfinx_cpp/$test.py" > $test.log
done
built=$folder/build
for ranks in 1 2; do
	for name in hertz sliding_block pressed_block own_forms variants dynamics fields refusals \
		algebra; do
		case $name in
		hertz | sliding_block | pressed_block | own_forms) of=$built/demos/cpp/$name/$name ;;
		*) of=$built/tests/dolfinx_cpp/$name ;;
		esac
		OMP_NUM_THREADS=1 "$folder/bin/launch" -n $ranks "$of" > $name.$ranks 2> $name.$ranks.err || {
			tail -n 20 $name.$ranks $name.$ranks.err
			fail "$name fails on $ranks ranks, see $folder/run"
		}
		[ $name = refusals ] || [ $name = algebra ] \
			|| "$python" "$source/tests/dolfinx_cpp/compare.py" $name.$ranks $name.log \
			|| fail "$name prints other lines than Python on $ranks ranks, see $folder/run"
	done
	# Python goes on from what the programs have written
	"$python" "$source/tests/dolfinx_cpp/fields.py" $ranks > restarted.$ranks
	sed -n '0~3p' fields.log > restarted.log
	"$python" "$source/tests/dolfinx_cpp/compare.py" restarted.$ranks restarted.log \
		|| fail "Python goes on from a checkpoint of $ranks ranks to other lines, see $folder/run"
done
finish "compiled, and the same digits as in Python on one rank and on two (DOLFINx $kept)"
