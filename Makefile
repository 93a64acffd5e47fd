# tween: every command of the project. `make` alone lists them.

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PACKAGES := $(VENV)/.packages
STAMP := $(VENV)/.installed
UV := .cache/uv/bin/uv
NOTEBOOKS := $(wildcard notebooks/*.ipynb)

# Numba's cache does not notice a change in another file, so each state of the sources has a cache of its own.
SOURCES_SUM := $(shell find tween -name '*.py' -print0 2>/dev/null | LC_ALL=C sort -z | xargs -0 cat | cksum | cut -d' ' -f1)
export NUMBA_CACHE_DIR := $(CURDIR)/.cache/numba/$(SOURCES_SUM)
WARM := .cache/numba/$(SOURCES_SUM)/.warm
# Figures go to files, so no screen is needed; a notebook's go into the notebook, and with Agg they would silently be lost.
export MPLBACKEND := Agg
INLINE := MPLBACKEND=module://matplotlib_inline.backend_inline
NBVAL := $(INLINE) $(BIN)/python -m pytest --nbval-current-env
PLAYGROUND := notebooks/10_playground.ipynb
# A person's own settings of matplotlib and IPython would change the figures.
export MPLCONFIGDIR := $(CURDIR)/.cache/matplotlib
export IPYTHONDIR := $(CURDIR)/.cache/ipython
# Sets of strings have the same order in every run.
export PYTHONHASHSEED := 0
# Packages from outside the environment would escape the lock.
export PYTHONNOUSERSITE := 1
unexport PYTHONPATH

.PHONY: help check-python setup reproduce matching grid report article notebooks test lint coverage bench docs lock clean

help: ## List the commands (this)
	@grep -hE '^[a-z][a-z-]*:.*## ' $(firstword $(MAKEFILE_LIST)) | while IFS= read -r line; do \
	  printf '  make %-13s %s\n' "$${line%%:*}" "$${line##*## }"; done

check-python: ## Say whether PYTHON (python3 unless given) is new enough
	@command -v "$(PYTHON)" >/dev/null || { \
	  echo "tween needs Python 3.11 or newer, but '$(PYTHON)' was not found; say where it is: make PYTHON=/path/to/python3 ..." >&2; exit 1; }
	@found=$$("$(PYTHON)" -c 'import sys; print("%d.%d.%d" % sys.version_info[:3])' 2>/dev/null) || { \
	  echo "tween needs Python 3.11 or newer, but '$(PYTHON)' does not run; say where one is: make PYTHON=/path/to/python3 ..." >&2; exit 1; }; \
	"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "tween needs Python 3.11 or newer, but '$(PYTHON)' is Python $$found; say where a newer one is: make PYTHON=/path/to/python3 ..." >&2; exit 1; }

$(PACKAGES): requirements.lock | check-python
	@echo "setup: making $(VENV) with $$("$(PYTHON)" --version)"
	@"$(PYTHON)" -m venv --clear $(VENV)
	@echo "setup: installing the packages of requirements.lock (some minutes the first time)"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile -r requirements.lock
	@touch $@

$(STAMP): pyproject.toml $(PACKAGES)
	@echo "setup: installing tween itself, editable"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@echo "setup: listing the fonts once, as matplotlib would warn about it in the middle of a notebook"
	@$(BIN)/python -c "import matplotlib.font_manager"
	@touch $@

# Once for all, on all cores: otherwise every process compiles what it needs for itself, at the same time as the others.
$(WARM): $(STAMP)
	@$(BIN)/tween warmup
	@touch $@

setup: $(STAMP) $(WARM) ## Make the environment .venv with the packages of requirements.lock, and compile
	@echo "setup: $(VENV) is ready"

reproduce: $(STAMP) $(WARM) ## Recompute the studies, the figures, the notebooks and the report
	@$(BIN)/python -m experiments.reproduce

matching: $(STAMP) $(WARM) ## Recompute the study of matching on all pairs (long; an interrupted one goes on)
	@echo "matching: all pairs, every method; reproduce recomputes a sample of them"
	@$(BIN)/python -m experiments.studies.matching

grid: $(STAMP) $(WARM) ## Recompute the grid of Table 1 (long; an interrupted one goes on)
	@echo "grid: every curve and pair, every setting; reproduce recomputes a sample of them"
	@$(BIN)/python -m experiments.studies.grid

report: $(STAMP) ## Write results/report.html anew from what results/ holds
	@$(BIN)/python -m experiments.report

article: $(STAMP) ## Set results/article.pdf, a replication report, from what results/ holds
	@$(BIN)/python -m experiments.article

notebooks: $(STAMP) $(WARM) ## Run every notebook in place
	@echo "notebooks: running every notebook in place"
	@$(INLINE) $(BIN)/python -m experiments.notebooks

test: $(STAMP) $(WARM) ## Check style and types, then run the tests, doctests and notebooks
	@$(MAKE) lint
	@echo "test: tests and doctests"
	@$(BIN)/python -m pytest -n auto --dist worksteal --doctest-modules tween tests
	@echo "test: running the notebooks anew and comparing their outputs with the committed ones"
	@$(NBVAL) -n auto --dist loadfile --nbval --nbval-sanitize-with tests/nbval_sanitize.cfg $(filter-out $(PLAYGROUND),$(NOTEBOOKS))
	@echo "test: running the playground, which people change, without comparing its outputs"
	@$(NBVAL) --nbval-lax $(PLAYGROUND)

lint: $(STAMP) ## Check style, format, imports and types, changing nothing
	@echo "lint: style (mend with $(BIN)/ruff check --fix)"
	@$(BIN)/ruff check .
	@echo "lint: format (mend with $(BIN)/ruff format)"
	@$(BIN)/ruff format --check .
	@echo "lint: imports (the contracts are in pyproject.toml)"
	@$(BIN)/lint-imports --no-cache --no-logo
	@echo "lint: types"
	@$(BIN)/python -m mypy $(wildcard tween experiments)

coverage: $(STAMP) ## Report the lines that the quick tests miss, with the kernels run as plain Python
	@echo "coverage: quick tests without compilation, which would hide the kernels' lines"
	@mkdir -p .cache
	@NUMBA_DISABLE_JIT=1 $(BIN)/python -m coverage run -m pytest -q --doctest-modules -m "not slow" tween tests
	@$(BIN)/python -m coverage report

bench: $(STAMP) $(WARM) ## Time tween beside its peers in one process
	@echo "bench: timing"
	@$(BIN)/python -m experiments.benchmarks.tasks
	@$(BIN)/python -m experiments.benchmarks.scaling
	@$(BIN)/python -m experiments.benchmarks.hard_curves

docs: $(STAMP) ## Build the documentation into .cache/docs
	@echo "docs: building"
	@$(BIN)/python -m sphinx -q -W -b html docs .cache/docs
	@echo "docs: open .cache/docs/index.html"

lock: check-python ## Choose the package versions anew and write requirements.lock
	@echo "lock: getting uv"
	@"$(PYTHON)" -m venv --clear .cache/uv
	@.cache/uv/bin/python -m pip install --quiet --disable-pip-version-check uv==0.13.9
	@echo "lock: choosing one version of each package for Python 3.11 and newer"
	@$(UV) pip compile --quiet --upgrade --universal --fork-strategy fewest --python-version 3.11 --extra all \
	  --no-emit-index-url --no-emit-find-links --no-annotate --custom-compile-command "make lock" \
	  --output-file requirements.lock pyproject.toml

clean: ## Remove the environment, caches and reports; results and notebooks stay
	@echo "clean: removing $(VENV), caches and reports"
	@rm -rf $(VENV) .cache .pytest_cache .mypy_cache .ruff_cache .hypothesis .coverage htmlcov build dist
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
