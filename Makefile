# make demo   plan a real entry: the table on the screen, the picture in demo.png
# make check  format, lint, types, import contracts and the quick tests, in two minutes: for every day
# make test   the same with all tests, and the page in a browser: some twenty minutes on two cores
# make bench  times of the answers and of other methods: table and plot in benchmarks/results; ROWS=0 skips the tables
# make verify all independent methods, the search over 100,000 random scenes in still air and 1,000 in wind
# make prove  the lemmas of the proof on the kernel's own formulas, in exact algebra and ball arithmetic (evidence/docs/proof.md)
# make prove-formal  the theorem on the circle of the turn radius, by Coq (evidence/coq, evidence/docs/formal.md)
# make docs   the documentation site, in build/docs, with the page in try/: every warning and every broken link is an error
# make site   the page as static files for any address, in build/site; ADDRESS=https://... for the pictures of links
# make firefox  the same in Firefox, if it is installed: widths, appearances, axe, without a network
# make notebooks  run the notebooks of docs/notebooks and write their outputs
# make generate  translate the kernel and the law from Python to C, JavaScript and Lua, and build the page
# make pins   rewrite the requirement files from pyproject.toml
PYTHON ?= $(or $(shell command -v python3.11),python3)
BIN := .venv/bin
ROWS ?= 1e8

# On Debian venv of the standard library is a separate package.
$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	  echo "Python 3.11 or newer is needed, and $(PYTHON) is $$($(PYTHON) --version 2>/dev/null || echo missing):" \
	    "make PYTHON=FILE uses another" >&2; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || requirements/apt-install python3-venv
	$(PYTHON) -m venv .venv

# A C compiler and Python's headers, with which the package is built; on Debian they are separate packages.
.venv/compiler.stamp: $(BIN)/python
	@command -v cc >/dev/null || requirements/apt-install gcc libc6-dev
	@$(BIN)/python -c 'import pathlib, sys, sysconfig; \
	  sys.exit(not pathlib.Path(sysconfig.get_path("include"), "Python.h").exists())' || requirements/apt-install python3-dev
	@touch $@

.venv/base.stamp: .venv/compiler.stamp requirements/base.txt pyproject.toml hatch_build.py $(wildcard src/loiter/native/*)
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements/base.txt
	$(BIN)/python -m pip install -q --disable-pip-version-check --no-deps -e .
	@touch $@

.venv/dev.stamp: .venv/base.stamp requirements/dev.txt
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements/dev.txt
	@touch $@

# What the documentation needs.
.venv/docs.stamp: .venv/base.stamp requirements/docs.txt
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements/docs.txt
	@touch $@

# Tools that check the page: TypeScript and axe. No lock file is needed: the versions are exact.
.venv/node.stamp: .venv/dev.stamp tests/page/package.json
	@mkdir -p .venv/node && cp tests/page/package.json .venv/node/
	PATH="$(CURDIR)/$(BIN):$$PATH" $(BIN)/npm install --prefix .venv/node --no-package-lock --no-audit --no-fund --loglevel=error
	@touch $@

# The browser in which the page is tested.
/usr/bin/chromium-headless-shell:
	@requirements/apt-install chromium-headless-shell

.PHONY: demo check test all-tests bench verify prove prove-formal docs site firefox notebooks generate pins lint
demo: .venv/base.stamp
	$(BIN)/loiter plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 --plot demo.png

lint: .venv/dev.stamp .venv/node.stamp
	$(BIN)/ruff format --check .
	$(BIN)/ruff check --no-cache .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache
	$(BIN)/node .venv/node/node_modules/typescript/bin/tsc -p tests/page/tsconfig.json

check: lint
	$(BIN)/pytest -n 2 --quick

# Types are checked while the tests run: mypy has one core, and would leave the other idle.
test: .venv/dev.stamp .venv/node.stamp /usr/bin/chromium-headless-shell
	@$(MAKE) --no-print-directory -j2 lint all-tests

# Twice as many processes as cores: half the tests wait, for a browser, a server or a flight in real time.
# Hypothesis draws the same examples each time, so that a release does not fail by chance; make check draws new ones.
all-tests:
	$(BIN)/pytest -n 4 --hypothesis-profile=ci

bench: .venv/dev.stamp
	$(BIN)/python -m benchmarks --rows $(ROWS)

verify: .venv/dev.stamp
	$(BIN)/python -m evidence verify --states 100000
	$(BIN)/python -m evidence verify --witness wind --states 1000

prove: .venv/dev.stamp
	$(BIN)/python -m evidence prove

prove-formal:
	@command -v coq_makefile >/dev/null || { \
	  echo "Coq 8.16 with Coquelicot and Interval is needed; Debian: coq libcoq-coquelicot libcoq-interval" >&2; exit 2; }
	rm -rf build/formal && mkdir -p build/formal && cp evidence/coq/* build/formal
	cd build/formal && coq_makefile -f _CoqProject -o Makefile && $(MAKE) --no-print-directory

docs: .venv/docs.stamp site
	rm -rf build/docs docs/pictures
	$(BIN)/sphinx-build -q -W --keep-going -b html -d build/doctrees docs build/docs
	cp -r build/site build/docs/try
	@echo "open build/docs/index.html"

site: .venv/base.stamp
	rm -rf build/site
	$(BIN)/python -m codegen.site build/site $(ADDRESS)
	@echo "open build/site/index.html"

firefox: .venv/node.stamp
	$(BIN)/python -m page.firefox

notebooks: .venv/dev.stamp
	$(BIN)/python -m documents.notebooks

generate: .venv/dev.stamp .venv/node.stamp
	$(BIN)/python -m codegen

pins: .venv/dev.stamp
	$(BIN)/python -m pip install -q uv
	$(BIN)/uv pip compile -q --universal --python-version 3.11 --no-header --no-annotate --no-emit-index-url --no-emit-find-links pyproject.toml -o requirements/base.txt
	$(BIN)/uv pip compile -q --universal --python-version 3.11 --no-header --no-annotate --no-emit-index-url --no-emit-find-links --group dev -c requirements/base.txt pyproject.toml -o requirements/dev.txt
	$(BIN)/uv pip compile -q --universal --python-version 3.11 --no-header --no-annotate --no-emit-index-url --no-emit-find-links --all-extras --group docs -c requirements/dev.txt pyproject.toml -o requirements/docs.txt
