# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later

# The Python to make .venv with; found if not given.
PYTHON ?=

# Processes that share the tests, and the scenes of the stress map.
JOBS ?= $(shell nproc)

EXTRAS := wheels test demo lint
VENV := .venv
BIN := $(VENV)/bin

# Stamps. An edit during a step must not be lost, so that a stamp bears the time
# at which its step began.
SYSTEM := build/system.stamp
CREATED := $(VENV)/created.stamp
DEPENDENCIES := $(VENV)/dependencies.stamp
INSTALLED := $(VENV)/installed.stamp

# Folders too, so that a removed file counts as a change.
SOURCES := $(shell find cpp/contactx cpp/bindings python/contactx \
	-name __pycache__ -prune -o -print)
CPP_FILES = $(shell find cpp -name '*.h' -o -name '*.cpp')
PY_FOLDERS := python tests demos tools
BENCHES := hertz methods rates spheres ironing friction scenes parts skips steps growth scaling

# Threads: MPI and the tests' machine decide, not OpenMP. Without a display,
# VTK need not look for one.
RUN := OMP_NUM_THREADS=1 PATH="$(CURDIR)/$(BIN):$$PATH"
ifeq ($(DISPLAY),)
RUN += VTK_DEFAULT_OPENGL_WINDOW=vtkEGLRenderWindow
endif

.DELETE_ON_ERROR:
.PHONY: all demo test test-cpp test-python leaks bench bench-core lint format clean help

all: $(INSTALLED)

help:
	@echo "make          set up .venv, build contactx and install it there"
	@echo "make demo     solve the Hertz sphere and the face slabs of demos/"
	@echo "make test     lint, C++ tests, Python tests"
	@echo "make leaks    memory over 1,000 steps and 1,000 problems"
	@echo "make bench    all benchmarks, up to a million displacements"
	@echo "make bench-core  time the kernels and the search"
	@echo "make lint     check format, style and types"
	@echo "make format   format C++ and Python"
	@echo "make clean    remove everything that make made"
	@echo "make PYTHON=/path/to/python  use this Python (>= 3.12)"

$(SYSTEM): tools/find_python.sh tools/missing.sh tools/require.sh
	@mkdir -p $(@D)
	@python=$$(tools/find_python.sh "$(PYTHON)") && tools/require.sh "$$python"
	@touch $@

$(CREATED): | $(SYSTEM)
	python=$$(tools/find_python.sh "$(PYTHON)") && "$$python" -m venv $(VENV)
	@touch $@

$(DEPENDENCIES): pyproject.toml tools/requirements.py $(CREATED)
	@touch $@.began
	$(BIN)/python tools/requirements.py $(EXTRAS) > $(VENV)/requirements.txt
	$(BIN)/python -m pip install --quiet -r $(VENV)/requirements.txt
	@mv $@.began $@

# Without isolation the build folder stays valid from one build to the next.
$(INSTALLED): $(DEPENDENCIES) CMakeLists.txt README.md $(SOURCES)
	@touch $@.began
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --force-reinstall .
	@mv $@.began $@

demo: $(INSTALLED)
	$(RUN) $(BIN)/python demos/hertz_sphere.py
	$(RUN) $(BIN)/python demos/face_slab.py
	$(RUN) $(BIN)/python demos/face_slab.py --scheme 2

test: lint test-cpp test-python

test-cpp: $(DEPENDENCIES)
	$(RUN) cmake -S . -B build/cpp -G Ninja -DCONTACTX_TESTS=ON -DCONTACTX_PYTHON=OFF
	$(RUN) cmake --build build/cpp
	$(RUN) ctest --test-dir build/cpp --output-on-failure

test-python: $(INSTALLED)
	$(RUN) $(BIN)/python -m pytest -n $(JOBS) --dist loadgroup

# Memory of a process per run, every fiftieth step; fails where it grows.
leaks: $(INSTALLED)
	$(RUN) $(BIN)/python tests/stress/leaks.py

# Kernels and search on one core: tables, and the same as CSV files.
bench-core: $(DEPENDENCIES)
	$(RUN) cmake -S . -B build/bench -G Ninja -DCONTACTX_BENCHMARKS=ON -DCONTACTX_PYTHON=OFF
	$(RUN) cmake --build build/bench
	build/bench/bench_kernels build/bench
	build/bench/bench_search 1000000 build/bench

# Each script takes sizes, so that a part can be run alone. Tables, CSV files and
# pictures come to build/bench.
bench: bench-core $(INSTALLED)
	status=0; for name in $(BENCHES); do \
		$(RUN) $(BIN)/python tests/benchmarks/bench_$$name.py || status=1; \
	done; \
	$(RUN) $(BIN)/python tests/benchmarks/bench_face_slab.py paper || status=1; exit $$status

lint: $(DEPENDENCIES)
	$(BIN)/clang-format --dry-run --Werror $(CPP_FILES)
	$(BIN)/ruff check $(PY_FOLDERS)
	$(BIN)/ruff format --check $(PY_FOLDERS)
	$(BIN)/python -m mypy

format: $(DEPENDENCIES)
	$(BIN)/clang-format -i $(CPP_FILES)
	$(BIN)/ruff check --fix-only $(PY_FOLDERS)
	$(BIN)/ruff format $(PY_FOLDERS)

clean:
	rm -rf build $(VENV) .hypothesis .mypy_cache .pytest_cache .ruff_cache
