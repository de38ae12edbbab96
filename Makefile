# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later

# The Python to make .venv with; found if not given.
PYTHON ?=

# Processes that share the tests, and the scenes of the stress map.
JOBS ?= $(shell nproc)

VENV := .venv
BIN := $(VENV)/bin

# Stamps. An edit during a step must not be lost, so that a stamp bears the time
# at which its step began.
CREATED := $(VENV)/created.stamp
# What builds contactx, what runs it and its demos, what tests and documents it
BUILDER := $(VENV)/builder.stamp
RUNNER := $(VENV)/runner.stamp
TESTER := $(VENV)/tester.stamp
WHEEL := build/wheelhouse/built.stamp
INSTALLED := $(VENV)/installed.stamp
TESTABLE := $(INSTALLED) $(TESTER)

# Folders too, so that a removed file counts as a change.
SOURCES := $(shell find cpp/contactx cpp/bindings python/contactx \
	-name __pycache__ -prune -o -print)
CPP_FILES = $(shell find cpp demos/cpp tests/dolfinx_cpp -name '*.h' -o -name '*.cpp')
PY_FOLDERS := python tests demos docs tools
# What `make sanitize` runs in Python: both methods, friction, ties, obstacles,
# finite and small sliding, the condensed solver.
SANITIZED := tests/fast/assembly/test_condensed.py tests/fast/assembly/test_forms.py \
	tests/fast/verification/test_rigid_obstacles.py tests/fast/verification/test_finite_strain.py
# Executions of each fuzz target, and the compiler that has libFuzzer
RUNS ?= 1000000
CLANG ?= clang++
BENCHES := audit checkpoint forming forms dynamics globalisation path hertz methods nafems recovery edges fits degrees rates locking solvers limit many spheres ironing friction scenes skips steps tuning growth scaling dam_face

# Threads: MPI and the tests' machine decide, not OpenMP. Without a display,
# VTK need not look for one.
RUN := env OMP_NUM_THREADS=1 PATH="$(CURDIR)/$(BIN):$$PATH"
ifeq ($(DISPLAY),)
RUN += VTK_DEFAULT_OPENGL_WINDOW=vtkEGLRenderWindow
endif
# In place of the shell, so that who ends make ends pytest.
PYTEST := exec $(RUN) $(BIN)/python -m pytest

.DELETE_ON_ERROR:
.PHONY: all demo test test-cpp test-fast gate verify gallery stress record figures leaks fuzz sanitize bench bench-core \
	wheel distribution docs demo-pages lint stubs format clean help

all: $(INSTALLED)

help:
	@echo "make          set up .venv, build contactx and install it there"
	@echo "make demo     solve the Hertz sphere and the face slabs of demos/"
	@echo "make test     lint, C++ tests, fast Python tests: less than five minutes"
	@echo "make verify   the C++ layer, and all other tests that are not long"
	@echo "make gate     compile and run the C++ layer, on DOLFINx's headers of Debian sid"
	@echo "make gallery  published benchmarks: docs/gallery.md and its pictures"
	@echo "make docs     the manual, in build/docs/index.html; needs no network once .venv is there"
	@echo "make demo-pages  run the demos and write their pages of the manual"
	@echo "make stress   thousands of hard scenes: a map of what comes of them; 16 ranks"
	@echo "make record   measure again what README and manual say, and write it there: hours"
	@echo "make figures  write docs/measured.json into README, manual and pictures"
	@echo "make leaks    memory over 1,000 steps and 1,000 problems"
	@echo "make bench    all benchmarks, up to a million displacements"
	@echo "make bench-core  time the kernels and the search"
	@echo "make fuzz     feed the C++ core a million random inputs a target (RUNS=...)"
	@echo "make sanitize C++ tests and some Python tests with ASan and UBSan"
	@echo "make wheel    an sdist and a wheel, which runs the quick start in an empty environment"
	@echo "make distribution  install contactx beside Debian sid's DOLFINx and test it there; root"
	@echo "make lint     check format, style and types"
	@echo "make stubs    write python/contactx/cpp.pyi, the types of the bindings"
	@echo "make format   format C++ and Python"
	@echo "make clean    remove everything that make made"
	@echo "make PYTHON=/path/to/python  use this Python (>= 3.12)"

# Those whose results README and manual have from docs/measured.json
RECORDED := methods hertz growth limit degrees edges nafems

SAY := @printf 'contactx: %s\n'
# Byte code is compiled for what is imported, when it is: all of it takes longer
# than the packages do
PIP := $(BIN)/python -m pip install --quiet --no-compile

# $(call packages,EXTRAS): what pyproject.toml lists there, and what it always needs
define packages
	@touch $@.began
	@$(BIN)/python tools/requirements.py $(1) > $@.txt
	@$(PIP) -r $@.txt
	@mv $@.began $@
endef

$(CREATED): tools/find_python.sh tools/missing.sh tools/require.sh
	$(SAY) "an environment in $(VENV)"
	@python=$$(tools/find_python.sh "$(PYTHON)") && \
		tools/require.sh "$$python" compiler headers venv graphics && \
		"$$python" -m venv $(VENV)
	@touch $@

$(BUILDER): pyproject.toml tools/requirements.py $(CREATED)
	$(call packages,build)

$(RUNNER): pyproject.toml tools/requirements.py $(CREATED)
	$(SAY) "DOLFINx, gmsh and PyVista from wheels"
	$(call packages,wheels demo)
	$(SAY) "... they are there"

$(TESTER): pyproject.toml tools/requirements.py $(CREATED)
	$(SAY) "what tests, checks and documents it"
	@tools/require.sh $(BIN)/python googletest
	$(call packages,wheels test demo docs lint)

# Without isolation the build folder, build/package, stays valid from one build
# to the next.
$(WHEEL): $(BUILDER) CMakeLists.txt README.md $(SOURCES)
	$(SAY) "compiling contactx, about a minute and a half on two cores"
	@mkdir -p $(@D)
	@touch $@.began
	@rm -f $(@D)/*.whl
	@$(RUN) $(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation \
		--wheel-dir $(@D) .
	@mv $@.began $@

# Packages come while the compiler works
$(INSTALLED): $(BUILDER) CMakeLists.txt README.md $(SOURCES)
	@touch $@.began
	@$(MAKE) --no-print-directory -j 2 $(RUNNER) $(WHEEL)
	@$(PIP) --no-deps --force-reinstall $(dir $(WHEEL))*.whl
	@mv $@.began $@

demo: $(INSTALLED)
	$(SAY) "an elastic sphere on a block, compared with Hertz"
	@$(RUN) $(BIN)/python demos/hertz_sphere.py
	$(SAY) "face slabs of a dam that press on each other as the support gives way, and as it is pushed"
	@$(RUN) $(BIN)/python demos/face_slab.py --scheme 2 > build/face_slab_2.log 2>&1 & soft=$$!; \
		$(RUN) $(BIN)/python demos/face_slab.py; status=$$?; \
		wait $$soft || status=1; cat build/face_slab_2.log; exit $$status

test: lint test-cpp test-fast

# The tests link the core that was built for the package.
test-cpp: $(TESTABLE)
	$(SAY) "C++ tests"
	@$(RUN) cmake -DCONTACTX_TESTS=ON build/package > build/configure.log
	@$(RUN) cmake --build build/package --target contactx_tests
	@for shard in 0 1; do \
		GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX=$$shard build/package/contactx_tests --gtest_brief=1 & \
		pids="$$pids $$!"; \
	done; for pid in $$pids; do wait $$pid || exit 1; done
	@rm -rf build/outside
	@$(RUN) cmake --install build/package --component development --prefix build/outside/package > build/install.log
	@$(RUN) cmake -S cpp/tests/outside -B build/outside/build -G Ninja \
		-DCMAKE_PREFIX_PATH="$(CURDIR)/build/outside/package" > build/outside.log
	@$(RUN) cmake --build build/outside/build
	build/outside/build/outside

# Scripts on several ranks take all cores: they come by themselves.
test-fast: $(TESTABLE)
	$(PYTEST) -n $(JOBS) tests/fast --ignore tests/fast/parallel
	$(PYTEST) tests/fast/parallel

# The C++ layer, which needs headers of DOLFINx that wheels do not have, against those
# of Debian sid: first, as most of what breaks it is found in its first minute.
gate: $(TESTABLE)
	@$(RUN) cmake --install build/package --component development --prefix build/gate/core > build/install.log
	@tools/gate.sh build/gate $(BIN)/python build/gate/core

verify: gate
	$(PYTEST) -n $(JOBS) tests/verify tests/published --ignore tests/verify/parallel
	@$(RUN) $(BIN)/python -m pytest tests/verify/parallel
	@cat build/gate/outcome

# Published benchmarks, those too that take more than 20 s: docs/gallery.md and pictures.
gallery: $(TESTABLE)
	$(RUN) $(BIN)/python tests/published/gallery.py --record

# Warnings are errors, and links within the manual must lead somewhere. Nothing is solved.
docs: $(TESTABLE)
	$(RUN) $(BIN)/python -m sphinx --fresh-env --fail-on-warning --keep-going --quiet \
		-d build/doctrees docs/manual build/docs
	$(BIN)/python tools/check_manual.py build/docs
	@echo "the manual is in build/docs/index.html"

# Pages of the demos with what they print and draw, but for those that take long, and animations.
demo-pages: $(TESTABLE)
	$(RUN) $(BIN)/python tools/demo_pages.py
	$(RUN) $(BIN)/python tools/animations.py

# Tables and a picture come to build/stress; fails where a scene is wrong.
stress: $(TESTABLE)
	$(RUN) $(BIN)/python tools/stress/stress_map.py --workers $(JOBS)
	$(PYTEST) tests/long

# What pages say on speed, on a machine with nothing else to do, on the gallery and the stress map
record: $(TESTABLE)
	status=0; for name in $(RECORDED); do \
		$(RUN) $(BIN)/python tools/bench/bench_$$name.py --record || status=1; \
	done; \
	$(RUN) $(BIN)/python tests/published/gallery.py --record || status=1; \
	$(RUN) $(BIN)/python tools/stress/stress_map.py --record --workers $(JOBS) || status=1; \
	$(RUN) $(BIN)/python tools/figures.py || status=1; exit $$status

# Nothing is solved
figures: $(TESTABLE)
	$(RUN) $(BIN)/python tools/figures.py

# In build/wheel; the environment there is made anew.
wheel: $(TESTER)
	tools/wheel.sh $(BIN)/python

# Debian sid in build/distribution: 5 GB, gone at the end (KEEP=1 keeps it)
distribution:
	tools/distribution.sh build/distribution

# Memory of a process per run, every fiftieth step; fails where it grows.
leaks: $(TESTABLE)
	$(RUN) $(BIN)/python tools/stress/leaks.py

# Kernels and search on one core: tables, and the same as CSV files.
bench-core: $(TESTER)
	$(RUN) cmake -S . -B build/bench -G Ninja -DCONTACTX_BENCHMARKS=ON -DCONTACTX_PYTHON=OFF \
		-DCONTACTX_DOLFINX=OFF
	$(RUN) cmake --build build/bench
	build/bench/bench_kernels build/bench
	build/bench/bench_search 1000000 build/bench

# Each script takes sizes, so that a part can be run alone. Tables, CSV files and
# pictures come to build/bench.
bench: bench-core $(TESTABLE)
	status=0; for name in $(BENCHES); do \
		$(RUN) $(BIN)/python tools/bench/bench_$$name.py || status=1; \
	done; \
	$(RUN) $(BIN)/python tools/bench/bench_face_slab.py paper || status=1; exit $$status

# The same inputs in each run, as long as build/fuzz/corpus is the same: what
# was new stays there, and what fails comes to build/fuzz.
fuzz: $(TESTER)
	@command -v $(CLANG) >/dev/null || { echo "contactx: make fuzz needs Clang with libFuzzer, and there is no $(CLANG): install it or name it with 'make fuzz CLANG=...'" >&2; exit 1; }
	$(RUN) cmake -S . -B build/fuzz -G Ninja -DCONTACTX_FUZZ=ON -DCONTACTX_PYTHON=OFF -DCONTACTX_DOLFINX=OFF \
		-DCMAKE_CXX_COMPILER=$(CLANG)
	$(RUN) cmake --build build/fuzz
	status=0; for target in build/fuzz/targets/*; do \
		name=$${target##*/}; echo "$$name"; mkdir -p build/fuzz/corpus/$$name; \
		UBSAN_OPTIONS=print_stacktrace=1 $$target -runs=$(RUNS) -seed=1 -max_len=512 \
			-len_control=0 -timeout=60 -verbosity=0 -print_final_stats=1 \
			-artifact_prefix=build/fuzz/$$name- build/fuzz/corpus/$$name || status=1; \
	done; exit $$status

# Python's own allocations are never all given back: leaks are looked for in
# the C++ tests alone.
sanitize: $(TESTER)
	$(RUN) cmake -S . -B build/sanitize -G Ninja -DCONTACTX_SANITIZE=ON -DCONTACTX_TESTS=ON -DCONTACTX_UNITY=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCONTACTX_DOLFINX=OFF \
		-DPython_EXECUTABLE="$(CURDIR)/$(BIN)/python" \
		-Dpybind11_DIR="$$($(BIN)/python -m pybind11 --cmakedir)"
	$(RUN) cmake --build build/sanitize --target all contactx_tests
	build/sanitize/contactx_tests --gtest_brief=1
	rm -rf build/sanitize/site
	mkdir -p build/sanitize/site
	cp -R python/contactx build/sanitize/site/
	rm -f build/sanitize/site/contactx/*.so
	$(RUN) cmake --install build/sanitize --component python --prefix build/sanitize/site
	$(RUN) LD_PRELOAD="$$($${CXX:-c++} -print-file-name=libasan.so) $$($${CXX:-c++} -print-file-name=libstdc++.so)" \
		ASAN_OPTIONS=detect_leaks=0 PYTHONPATH="$(CURDIR)/build/sanitize/site" \
		$(BIN)/python -m pytest -q $(SANITIZED)

lint: $(TESTER)
	@$(BIN)/clang-format --dry-run --Werror $(CPP_FILES)
	$(BIN)/ruff check $(PY_FOLDERS)
	$(BIN)/ruff format --check $(PY_FOLDERS)
	$(BIN)/python -m mypy

# Types of the bindings, as the installed extension has them
stubs: $(TESTABLE)
	$(RUN) $(BIN)/python tools/stubs.py

format: $(TESTER)
	$(BIN)/clang-format -i $(CPP_FILES)
	$(BIN)/ruff check --fix-only $(PY_FOLDERS)
	$(BIN)/ruff format $(PY_FOLDERS)

# Nothing is removed across a mount: below one are things of the machine
clean:
	@! grep " $(CURDIR)/build/" /proc/mounts || { echo "contactx: these are mounted below build: umount them first" >&2; exit 1; }
	rm -rf --one-file-system build $(VENV) .mypy_cache .pytest_cache .ruff_cache
