# Every target sets up what it needs, in .venv; nothing else has to be installed first but
# Python 3.11 or newer with its venv module.

PYTHON ?= python3
VENV ?= .venv
WORKERS ?= 2

BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
# What is imported is compiled then: compiling all that is installed takes a third of the time.
INSTALL := $(PIP) install --no-compile

.PHONY: demo test test-fast lint format docs figures schemas bench bench-paper bench-random calibrate check-tasks check-random check-reading check-execute check-reconstruct soak clean

demo: $(VENV)/.run  ## plan a task and show the plan
	$(BIN)/etot plan tasks/task5.yaml

test: $(VENV)/.dev  ## all tests
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal

test-fast: $(VENV)/.dev  ## a cross-section of the tests, in a minute
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal -m "not slow"

lint: $(VENV)/.dev  ## style and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: $(VENV)/.dev  ## put the style right
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

docs: $(VENV)/.dev  ## build the documentation as a site in site/, strictly
	$(BIN)/python -m tests.docs.formats docs/formats.md
	$(BIN)/mkdocs build --strict --quiet

figures: $(VENV)/.dev  ## render the documentation's pictures
	$(BIN)/python -m tests.measure.figures docs/images

schemas: $(VENV)/.run  ## write docs/schemas anew from the report models
	$(BIN)/python -m tests.docs.schemas docs/schemas

bench: $(VENV)/.dev  ## measure speed and success rates
	$(BIN)/python -m tests.measure.bench

bench-paper: $(VENV)/.dev  ## eight methods on the paper's eight tasks, ten trials each; may be interrupted
	$(BIN)/python -m tests.measure.bench_tables paper

bench-random: $(VENV)/.dev  ## the same methods on forty random problems
	$(BIN)/python -m tests.measure.bench_tables random

check-tasks: $(VENV)/.dev  ## check that every shipped task is physically what it is meant to be
	$(BIN)/python -m tests.measure.check_tasks

calibrate: $(VENV)/.dev  ## compare the odds that --worlds tells with what then happens
	$(BIN)/python -m tests.measure.calibrate

check-random: $(VENV)/.dev  ## simulate and plan 160 random problems
	$(BIN)/python -m tests.measure.check_random

check-reading: $(VENV)/.dev  ## read every sentence of the corpus; the tests read one in eight
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal --whole-corpus tests/reasoning

check-execute: $(VENV)/.dev  ## carry all tasks out in closed loop, 20 times each
	$(BIN)/python -m tests.measure.check_execute

check-reconstruct: $(VENV)/.dev  ## measure reconstruction against known scenes
	$(BIN)/python -m tests.measure.check_reconstruct

soak: $(VENV)/.dev  ## kill 200 runs at random moments and look at what is left
	$(BIN)/python -m tests.measure.soak

clean:  ## remove the environment and caches, keep results
	rm -rf $(VENV) build dist .mypy_cache .pytest_cache .ruff_cache .hypothesis

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "etot needs Python 3.11 or newer; try: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.run: pyproject.toml | $(BIN)/python
	$(INSTALL) --editable .
	@touch $@

$(VENV)/.dev: pyproject.toml | $(BIN)/python
	$(INSTALL) --editable ".[dev]"
	@touch $@ $(VENV)/.run
