# The front door. `make` alone says what there is.

BUILD ?= build
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
SOAK ?= 100000
CLANG_FORMAT ?= clang-format-16
CLANG_TIDY ?= clang-tidy-16

SOURCE_FOLDERS := $(wildcard include src apps tests bench examples python)
FORMATTED = $(shell find $(SOURCE_FOLDERS) -name '*.hpp' -o -name '*.cpp')
BENCHES = $(filter-out soak fit_coverage,$(basename $(notdir $(wildcard bench/*.cpp))))
DEMO := $(BUILD)/demo

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help deps build demo test bench soak fit-coverage format format-check lint layers docs-check sanitize install clean

help:  ## This list
	@echo "footfall: compliant contact between spheres and the ground, with every joule accounted for"
	@echo
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-14s%s\n", $$1, $$2}' Makefile
	@echo
	@echo "Variables: BUILD=$(BUILD) PREFIX=$(PREFIX) JOBS=$(JOBS) SOAK=$(SOAK)"

deps:  ## Install the Debian packages that are missing
	@scripts/install-deps.sh

$(BUILD)/CMakeCache.txt:
	cmake -S . -B $(BUILD) -G Ninja -DFOOTFALL_BUILD_TESTS=OFF -DFOOTFALL_BUILD_BENCHMARKS=OFF

build: $(BUILD)/CMakeCache.txt  ## Build the library and build/footfall
	@cmake --build $(BUILD) -j $(JOBS) --target footfall_cli

demo: deps build  ## Run the paper's rolling sphere
	@mkdir -p $(DEMO)
	$(BUILD)/footfall run scenarios/rolling-sphere.toml -o $(DEMO)/rolling-sphere.nc --csv $(DEMO)/csv
	@echo
	@echo "The whole run, every sample labelled with its unit:  $(DEMO)/rolling-sphere.nc  (xarray, ncdump -h)"
	@echo "The same as tables:                                  $(DEMO)/csv/samples.csv, events.csv, impacts.csv"
	@echo "The scenario, to copy and change:                    scenarios/rolling-sphere.toml"

# Tests and benchmarks need more packages than the library, so they are configured only when asked for.
.PHONY: build-all
build-all:
	@scripts/install-deps.sh --test
	cmake -S . -B $(BUILD) -G Ninja -DFOOTFALL_BUILD_TESTS=ON -DFOOTFALL_BUILD_BENCHMARKS=ON
	@cmake --build $(BUILD) -j $(JOBS)

test: build-all  ## Build everything and run the tests
	ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

bench: build-all  ## Measure against ARKODE and plain loops; prints a table of ratios
	@for bench in $(BENCHES); do $(BUILD)/bench/$$bench || exit 1; done

soak: build-all  ## Run SOAK random scenarios (100000) and check each
	$(BUILD)/bench/soak --scenarios $(SOAK)

fit-coverage: build-all  ## How often a fit's intervals hold the truth (about a minute)
	$(BUILD)/bench/fit_coverage

format:  ## Format every C++ file
	@$(CLANG_FORMAT) -i $(FORMATTED)

format-check:  ## Say which C++ files are not formatted
	@$(CLANG_FORMAT) --dry-run -Werror $(FORMATTED)

layers:  ## Check that includes go one way
	@scripts/check-layers.sh

lint: $(BUILD)/CMakeCache.txt  ## Run clang-tidy on the library and the command line
	@CLANG_TIDY=$(CLANG_TIDY) scripts/lint.sh $(BUILD) $(JOBS)

docs-check: build  ## Run every example in README.md and docs/
	@scripts/check-docs.py --build $(BUILD)

.PHONY: docs
docs:  ## Build the documentation as a site; warnings are errors
	@scripts/venv.sh $(BUILD)/docs-venv docs/requirements.txt
	$(BUILD)/docs-venv/bin/python -m sphinx --quiet --nitpicky --fail-on-warning --keep-going \
	    -d $(BUILD)/docs/doctrees docs $(BUILD)/docs/html
	@echo "The site:  $(BUILD)/docs/html/index.html"

.PHONY: friction-page
friction-page: build  ## Draw the figures and measure the tables of docs/friction.md
	@scripts/venv.sh $(BUILD)/friction-venv docs/friction/requirements.txt
	$(BUILD)/friction-venv/bin/python docs/friction/make.py --footfall $(BUILD)/footfall

# What `pip install .` builds, and its tests as a user's environment has them.
WHEELS := $(BUILD)/wheels
PYTHON ?= python3
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

.PHONY: python python-test
python:  ## Build the Python package as a wheel
	@scripts/install-deps.sh --python
	@rm -rf $(WHEELS) && mkdir -p $(WHEELS)
	$(PYTHON) -m pip wheel --quiet --no-deps --wheel-dir $(WHEELS) -C build-dir=$(BUILD)/python .
	@ls $(WHEELS)/*.whl

python-test: python  ## Install the wheel in a clean environment and run its tests there
	@rm -rf $(BUILD)/python-venv && $(PYTHON) -m venv $(BUILD)/python-venv
	$(BUILD)/python-venv/bin/pip install --quiet "$$(ls $(WHEELS)/footfall-*.whl)[test]"
	@scripts/test-wheel.sh $(BUILD)/python-venv/bin

.PHONY: figures
figures: python  ## Draw the paper's figures beside what its text says: build/figures/index.html
	@rm -rf $(BUILD)/figures-venv && $(PYTHON) -m venv $(BUILD)/figures-venv
	$(BUILD)/figures-venv/bin/pip install --quiet "$$(ls $(WHEELS)/footfall-*.whl)[plot]"
	$(BUILD)/figures-venv/bin/python -m footfall.paper $(BUILD)/figures

.PHONY: validation
validation: build  ## Compare with published curves: docs/validation.md and its figures
	@scripts/venv.sh $(BUILD)/validation-venv docs/validation/requirements.txt
	@$(BUILD)/validation-venv/bin/python docs/validation/make.py --footfall $(BUILD)/footfall

# Assertions are on here: no NDEBUG.
sanitize:  ## Build and test with the address and undefined-behaviour sanitizers
	@scripts/install-deps.sh --test
	cmake -S . -B $(BUILD)-sanitize -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
	    -DFOOTFALL_SANITIZE=address,undefined -DFOOTFALL_BUILD_TESTS=ON -DFOOTFALL_BUILD_BENCHMARKS=OFF
	@cmake --build $(BUILD)-sanitize -j $(JOBS)
	ctest --test-dir $(BUILD)-sanitize --output-on-failure -j $(JOBS)

install: build  ## Install below PREFIX
	cmake --install $(BUILD) --prefix $(PREFIX)

clean:  ## Remove what was built
	rm -rf $(BUILD) $(BUILD)-sanitize
