# The front door. `make` alone says what there is.

BUILD ?= build
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
SOAK ?= 100000
FUZZ ?= 5000
SEED ?= 2010
KILLS ?= 200
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
	@echo "Variables: BUILD=$(BUILD) PREFIX=$(PREFIX) JOBS=$(JOBS) SOAK=$(SOAK) FUZZ=$(FUZZ) SEED=$(SEED) KILLS=$(KILLS)"

deps:  ## Install the Debian packages that are missing
	@scripts/install-deps.sh

$(BUILD)/CMakeCache.txt:
	cmake -S . -B $(BUILD) -G Ninja -DFOOTFALL_BUILD_TESTS=OFF -DFOOTFALL_BUILD_BENCHMARKS=OFF

build: $(BUILD)/CMakeCache.txt  ## Build the library and build/footfall
	@cmake --build $(BUILD) -j $(JOBS) --target footfall_cli

.PHONY: demo-deps
demo-deps:
	@scripts/install-deps.sh --demo

# The figures are drawn from the run's file by the Python package as it lies here: nothing more is compiled for them.
DRAW = PYTHONPATH=python $(BUILD)/demo-venv/bin/python -B -m footfall.figures
demo: demo-deps build  ## Run the paper's rolling sphere and draw it
	@mkdir -p $(DEMO)
	$(BUILD)/footfall run scenarios/rolling-sphere.toml -o $(DEMO)/rolling-sphere.nc --csv $(DEMO)/csv
	@echo
	@echo "The whole run, every sample labelled with its unit:  $(DEMO)/rolling-sphere.nc  (xarray, ncdump -h)"
	@echo "The same as tables:                                  $(DEMO)/csv/samples.csv, events.csv, impacts.csv"
	@echo "The scenario, to copy and change:                    scenarios/rolling-sphere.toml"
	@echo
	@scripts/venv.sh $(BUILD)/demo-venv python/figures-requirements.txt
	@$(BUILD)/footfall run scenarios/rolling-sphere-first-bounce.toml -o $(DEMO)/first-bounce.nc --quiet
	@echo "Figures of the run, and of its first bounce:"
	@$(DRAW) $(DEMO)/rolling-sphere.nc $(DEMO)/figures
	@$(DRAW) $(DEMO)/first-bounce.nc $(DEMO)/figures --impact

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

.PHONY: fuzz
fuzz: build  ## Feed the command line FUZZ broken and odd inputs (5000), drawn by SEED
	@scripts/fuzz.py --footfall $(BUILD)/footfall --inputs $(FUZZ) --seed $(SEED) --jobs $(JOBS) --keep $(BUILD)/fuzz

fit-coverage: build-all  ## How often a fit's intervals hold the truth (about a minute)
	$(BUILD)/bench/fit_coverage

.PHONY: kill-test
kill-test: build  ## Kill what writes files KILLS times (200), with EVERY=1 also at each call
	@scripts/kill-test.py --footfall $(BUILD)/footfall --kills $(KILLS) $(if $(EVERY),--every)

format:  ## Format every C++ file
	@$(CLANG_FORMAT) -i $(FORMATTED)

format-check:  ## Say which C++ files are not formatted
	@$(CLANG_FORMAT) --dry-run -Werror $(FORMATTED)

layers:  ## Check that includes go one way
	@scripts/check-layers.sh

.PHONY: law-check
law-check:  ## Add the example laws to a clean clone, by a file and a line each, and try them there
	@scripts/install-deps.sh --test
	@scripts/check-laws.py --jobs $(JOBS)

lint: $(BUILD)/CMakeCache.txt  ## Run clang-tidy on the library and the command line
	@CLANG_TIDY=$(CLANG_TIDY) scripts/lint.sh $(BUILD) $(JOBS)

docs-check: build $(BUILD)/python-venv/made  ## Run every example in README.md and docs/
	@scripts/check-docs.py --build $(BUILD)

.PHONY: friction-page
friction-page: build  ## Draw the figures and measure the tables of docs/friction.md
	@scripts/venv.sh $(BUILD)/friction-venv docs/friction/requirements.txt
	$(BUILD)/friction-venv/bin/python docs/friction/make.py --footfall $(BUILD)/footfall

# What `pip install .` builds, made again where something that goes into it has changed.
WHEELS := $(BUILD)/wheels
WHEEL := $(WHEELS)/made
WHEEL_SOURCES = CMakeLists.txt LICENSE pyproject.toml $(addprefix python/,CMakeLists.txt README.md) $(filter-out \
    %.pyc %/__pycache__,$(shell find apps cmake include python/footfall python/src scenarios src))
PYTHON ?= python3
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

$(WHEEL): $(WHEEL_SOURCES)
	@scripts/install-deps.sh --python
	@rm -rf $(WHEELS) && mkdir -p $(WHEELS)
	$(PYTHON) -m pip wheel --quiet --no-deps --wheel-dir $(WHEELS) -C build-dir=$(BUILD)/python .
	@touch $@

.PHONY: python python-test
python: $(WHEEL)  ## Build the Python package as a wheel
	@ls $(WHEELS)/*.whl

# The wheel in a clean environment, as a user has it.
PYTHON_VENV := $(BUILD)/python-venv
$(PYTHON_VENV)/made: $(WHEEL)
	@rm -rf $(PYTHON_VENV) && $(PYTHON) -m venv $(PYTHON_VENV)
	$(PYTHON_VENV)/bin/pip install --quiet "$$(ls $(WHEELS)/footfall-*.whl)[test]"
	@touch $@

python-test: $(PYTHON_VENV)/made  ## Install the wheel in a clean environment and run its tests there
	@scripts/test-wheel.sh $(PYTHON_VENV)/bin

# The notebooks run with the package, which a new wheel of the same version replaces.
DOCS_VENV := $(BUILD)/docs-venv
$(DOCS_VENV)/made: docs/requirements.txt $(WHEEL)
	@scripts/venv.sh $(DOCS_VENV) docs/requirements.txt
	$(DOCS_VENV)/bin/pip install --quiet "$$(ls $(WHEELS)/footfall-*.whl)[plot]"
	$(DOCS_VENV)/bin/pip install --quiet --no-deps --force-reinstall $(WHEELS)/footfall-*.whl
	@touch $@

.PHONY: docs
docs: $(DOCS_VENV)/made  ## Build the documentation as a site and run its notebooks; warnings are errors
	$(DOCS_VENV)/bin/python -m sphinx --quiet --nitpicky --fail-on-warning --keep-going \
	    -d $(BUILD)/docs/doctrees docs $(BUILD)/docs/html
	@echo "The site:  $(BUILD)/docs/html/index.html"

.PHONY: figures
figures: $(PYTHON_VENV)/made  ## Draw the paper's figures beside what its text says: build/figures/index.html
	$(PYTHON_VENV)/bin/python -m footfall.paper $(BUILD)/figures

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
