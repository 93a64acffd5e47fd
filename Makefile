# tween: every command of the project. `make` alone lists them.

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

# Numba's cache does not notice a change in a function that another file calls, so each state of the sources has its own folder.
SOURCES_SUM := $(shell cat tween/*.py 2>/dev/null | cksum | cut -d' ' -f1)
export NUMBA_CACHE_DIR := $(CURDIR)/.cache/numba/$(SOURCES_SUM)
# Figures go to files, never to a screen.
export MPLBACKEND := Agg
# The order of sets of strings is the same in every run.
export PYTHONHASHSEED := 0
# The pinned interpreter must not pick up packages from outside the environment.
export PYTHONNOUSERSITE := 1
unexport PYTHONPATH

.PHONY: help setup reproduce notebooks test lint coverage bench lock clean check-python

help: ## List the commands
	@grep -hE '^[a-z][a-z-]*:.*## ' $(firstword $(MAKEFILE_LIST)) | while IFS= read -r line; do \
	  printf '  make %-13s %s\n' "$${line%%:*}" "$${line##*## }"; done

check-python: ## Check that PYTHON (python3 unless given) is 3.11 or newer
	@command -v "$(PYTHON)" >/dev/null || { echo "tween needs Python 3.11 or newer, but '$(PYTHON)' was not found: install it, or say where it is with 'make PYTHON=/path/to/python3 ...'." >&2; exit 1; }
	@found=$$("$(PYTHON)" -c 'import sys; print("%d.%d.%d" % sys.version_info[:3])' 2>/dev/null) || { \
	  echo "tween needs Python 3.11 or newer, but '$(PYTHON)' does not run as Python: try 'make PYTHON=/path/to/python3 ...'." >&2; exit 1; }; \
	"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "tween needs Python 3.11 or newer, but '$(PYTHON)' is Python $$found: say where a newer one is with 'make PYTHON=/path/to/python3 ...'." >&2; exit 1; }

$(STAMP): pyproject.toml requirements.lock | check-python
	@echo "setup: making $(VENV) with $$("$(PYTHON)" --version)"
	@"$(PYTHON)" -m venv --clear $(VENV)
	@echo "setup: installing the packages pinned in requirements.lock (some minutes the first time)"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.lock
	@echo "setup: installing tween itself, editable"
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

setup: check-python $(STAMP) ## Make the environment .venv with the pinned packages
	@echo "setup: $(VENV) is ready"
