# Every target brings the set-up it needs; `make` alone prints what there is.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

BUILD ?= build
OUT ?= out
PYTHON := .venv/bin/python
LACUNA := .venv/bin/lacuna
# Two workers share the cores: linear algebra that had threads of its own beside them would but wait for them.
PYTEST := LACUNA_CACHE=$(abspath $(BUILD))/cache OPENBLAS_NUM_THREADS=1 $(PYTHON) -m pytest -q -n 2 --dist loadgroup
# Silent but for ctest's closing lines; where a test fails, everything it printed. $(2): options besides.
run_ctest = ctest --test-dir $(1) $(2) --output-on-failure -j 2 > $(1)/ctest.log && tail -n 3 $(1)/ctest.log \
  || { cat $(1)/ctest.log; exit 1; }
# Findings of clang-tidy. Its analyzer follows paths from function to function: nine tenths of the time, so that
# continuous integration has it follow them less deeply than `make analyze` does.
SHALLOW := --extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow
clang_tidy = printf '%s\n' $(filter runtime/%.c analysis/%.cpp bench/%.c,$(C_SOURCES)) \
  | xargs -P 2 -n 4 clang-tidy -p $(BUILD) --quiet $(1) 2>&1 | { grep -vE '^[0-9]+ warnings? (generated|treated)' || true; }
THREADED := test_analysis test_transform_fftw test_transform_eigen run_models
FUZZ_SECONDS ?= 180
COVERED ?= tests
FUZZ_TARGETS := stream table inputs
C_SOURCES = $(shell git ls-files '*.c' '*.h' '*.cpp' '*.hpp' ':!:*/golden/*' ':!:fmi/standard/*')

.PHONY: help setup build test maps compare explain assess bench speed check fuzz prove degrade robustness combined prognosis tolerance-study \
        prove-machines prove-experiments figures docs wheel vsix examples belts hybrid automata swings units msl unchanged compliance format style lint analyze sanitize sanitize-models threads coverage sundials7 ctest pytest lock clean

help: ## Print this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-17s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

## --- Set-up: stamps make a second call immediate -------------------------------------------------------------------

$(BUILD)/.debian: debian-packages.txt bootstrap.sh
	@./bootstrap.sh debian
	@mkdir -p $(BUILD) && touch $@

.venv/.installed: requirements.lock pyproject.toml bootstrap.sh | $(BUILD)/.debian
	@./bootstrap.sh python

$(BUILD)/build.ninja: | $(BUILD)/.debian
	@cmake -S . -B $(BUILD) -G Ninja --log-level=WARNING > $(BUILD)/configure.log || { cat $(BUILD)/configure.log; exit 1; }

setup: .venv/.installed build ## Bring the whole environment; afterwards .venv/bin/lacuna is the command line

build: $(BUILD)/build.ninja ## Compile runtime, analysis and their tests into build/
	@ninja -C $(BUILD) --quiet | sed '/no work to do/d'

## --- What users run -------------------------------------------------------------------------------------------------

maps: setup ## Operating maps of the paper's actuator, into out/maps/paper/
	@$(LACUNA) maps --out $(OUT)/maps/paper

compare: setup ## Variable-step against fixed-step on all scenarios, into out/compare/
	@$(LACUNA) compare --out $(OUT)/compare

explain: setup ## CASE=folder: what a recording knows and the model does not, into out/explain/
	@[[ -n "$(CASE)" ]] || { echo "usage: make explain CASE=path/to/case" >&2; exit 2; }
	@$(LACUNA) explain "$(CASE)" --out "$(OUT)/explain/$(notdir $(CASE:/=))"

assess: setup ## RECORDING=file [MAP=folder]: severity of a recorded pre-flight test, into out/assess/
	@[[ -n "$(RECORDING)" ]] || { echo "usage: make assess RECORDING=file.csv [MAP=out/maps/paper]" >&2; exit 2; }
	@[[ -n "$(MAP)" || -f $(OUT)/maps/paper/severity.table ]] || $(LACUNA) maps --out $(OUT)/maps/paper --prepare
	@$(LACUNA) assess "$(RECORDING)" --map "$(or $(MAP),$(OUT)/maps/paper)" \
	  --out "$(OUT)/assess/$(basename $(notdir $(RECORDING)))"

robustness: setup ## Thousands of simulated pre-flight tests over nuisances (long), writes docs/robustness.md
	@$(PYTHON) -m bench.robustness --out $(OUT)/robustness

prognosis: setup ## Forecasts on a simulated fleet, scored beside rivals (long), writes docs/prognosis.md
	@$(PYTHON) -m pip install --quiet 'progpy>=1.9' || echo 'progpy cannot be installed: it is not compared' >&2
	@$(PYTHON) -m bench.prognosis --out $(OUT)/prognosis

combined: setup ## Maps over two faults at once and how well both are read (minutes), writes docs/combined.md
	@$(PYTHON) -m bench.combined --out $(OUT)/combined

prove: setup ## The blind proof of the diagnosis (long, resumes), writes docs/proof.md
	@$(PYTHON) -m tests.proof --out $(OUT)/prove

prove-machines: setup ## The proof on machines of others (SMALL=1: two cases of each; resumes), writes docs/proof-machines.md
	@$(PYTHON) -m tests.proof.machines --out $(OUT)/prove-machines $(if $(SMALL),--small)

prove-experiments: setup ## Proposed experiments made on the truth of undetermined cases (long, resumes)
	@$(PYTHON) -m tests.proof.experiments --out $(OUT)/prove-experiments

degrade: setup ## The diagnosis with more noise, shorter recordings and no current, writes docs/degradation.md
	@$(PYTHON) -m tests.proof.degrade --out $(OUT)/degrade

bench: setup ## Times and errors against hand-written programs, into out/bench/
	@$(PYTHON) -m bench --out $(OUT)/bench

speed: setup ## What README says of speed, measured (some minutes), writes docs/speed.md
	@$(PYTHON) -m bench.speed

real-machines: setup ## Explain the recordings of real machines, writes docs/real-machines.md and its figures
	@$(PYTHON) -m bench.real_machines

tolerance-study: setup ## Justify the map's tolerance, writes docs/tolerance.md
	@$(PYTHON) -m bench.tolerance

msl: setup ## Every example of the Modelica Standard Library, translated, simulated, compared (long), writes docs/msl.md
	@$(PYTHON) -m bench.msl --page

unchanged: setup ## The C of our own models beside that of an earlier commit, writes docs/unchanged.md
	@$(PYTHON) -m bench.unchanged --page

docs: setup ## The documentation site, into out/docs/ (a warning or an older number is an error)
	@NO_MKDOCS_2_WARNING=1 LACUNA_CACHE=$(abspath $(BUILD))/cache $(PYTHON) -m mkdocs --quiet build --site-dir $(abspath $(OUT))/docs
	@echo "written: $(OUT)/docs/index.html; searchable by: python3 -m http.server -d $(OUT)/docs --bind 127.0.0.1"

wheel: setup ## A wheel and an sdist, into out/dist/
	@$(PYTHON) -m build --no-isolation --outdir $(OUT)/dist . > $(BUILD)/wheel.log || { cat $(BUILD)/wheel.log; exit 1; }
	@ls $(OUT)/dist

vsix: ## The extension for VS Code, packed by npm into out/lacuna.vsix (downloads npm packages)
	@mkdir -p $(OUT)
	@cd editors/vscode && npm install --silent --no-audit --no-fund && npm run --silent vsix -- $(abspath $(OUT))/lacuna.vsix

examples: setup ## Write the recordings of lacuna/examples anew
	@$(PYTHON) -m bench.examples

compliance: setup ## Every case of the Modelica Association's compliance library, writes docs/compliance.md
	@$(PYTHON) -m bench.compliance --page

figures: maps ## Copy the map's figures that the documentation shows into docs/figures/
	@cp $(OUT)/maps/paper/fig5_mean_rms.svg docs/figures/mean_rms.svg

## --- Tests and checks -----------------------------------------------------------------------------------------------

test: ctest pytest ## Pass the tests: C, C++ and Python

ctest: setup
	@$(call run_ctest,$(BUILD))

pytest: setup
	@$(PYTEST) -m "not slow" --durations=0 --durations-min=10

check: style analyze sanitize ctest ## All checks: format, lint, warnings as errors, sanitizers, every test
	@$(PYTEST)

style: setup
	@$(PYTHON) -m ruff format --quiet --check .
	@$(PYTHON) -m ruff check --quiet .
	@clang-format --dry-run -Werror $(C_SOURCES)

lint: style
	@$(call clang_tidy,$(SHALLOW))

analyze: setup ## What the linters find along deep paths through C and C++ (minutes)
	@$(call clang_tidy)

sanitize: $(BUILD)/.debian
	@cmake -S . -B $(BUILD)/sanitize -G Ninja -DCMAKE_BUILD_TYPE=Debug -DLACUNA_SANITIZE=address,undefined > $(BUILD)/sanitize.log
	@ninja -C $(BUILD)/sanitize --quiet | sed '/no work to do/d'
	@$(call run_ctest,$(BUILD)/sanitize)

sanitize-models: sanitize threads ## Generated models in four threads under the address, undefined and thread sanitizers (minutes)
	@$(PYTHON) -m tests.sanitize $(BUILD)/sanitize
	@$(PYTHON) -m tests.sanitize $(BUILD)/thread

coverage: setup ## [COVERED="tests"] lines and branches of C, C++ and Python that tests reach (long), into out/coverage/
	@$(PYTHON) -m pip install --quiet --disable-pip-version-check 'coverage>=7.10' 'gcovr>=8'
	@cmake -S . -B $(BUILD)/coverage -G Ninja -DCMAKE_BUILD_TYPE=Debug -DLACUNA_COVERAGE=ON > $(BUILD)/coverage.log
	@ninja -C $(BUILD)/coverage --quiet | sed '/no work to do/d'
	@mkdir -p $(OUT)/coverage && rm -f $(OUT)/coverage/data* && find $(BUILD)/coverage -name '*.gcda' -delete
	@$(call run_ctest,$(BUILD)/coverage)
	@export COVERAGE_FILE=$(abspath $(OUT))/coverage/data LACUNA_BUILD=$(abspath $(BUILD))/coverage; \
	  LACUNA_CACHE=$(abspath $(BUILD))/cache $(PYTHON) -m coverage run -m pytest -q -m "not slow" -n 2 --dist loadgroup $(COVERED) \
	  || echo 'some tests failed: what is counted is what they reached'; \
	  $(PYTHON) -m coverage combine --quiet; $(PYTHON) -m coverage html --quiet --directory $(OUT)/coverage/python; \
	  $(PYTHON) -m coverage report --format=total | sed 's/^/Python, lines and branches together, per cent: /'
	@mkdir -p $(OUT)/coverage/c
	@$(PYTHON) -m gcovr --root . --filter runtime/src --filter analysis/native --filter fmi --exclude-throw-branches \
	  --html-details $(OUT)/coverage/c/index.html --txt-summary $(BUILD)/coverage

threads: $(BUILD)/.debian ## The C and C++ tests that start threads, under the thread sanitizer
	@cmake -S . -B $(BUILD)/thread -G Ninja -DCMAKE_BUILD_TYPE=Debug -DLACUNA_SANITIZE=thread > $(BUILD)/thread.log
	@ninja -C $(BUILD)/thread --quiet $(THREADED) | sed '/no work to do/d'
	@$(call run_ctest,$(BUILD)/thread,--exclude-regex '^fuzz|NOT_BUILT')

# Left out is what SUNDIALS 7.1 does itself: its logger reads a file's name from the environment, and writes through the
# null pointer where its own first allocation fails.
sundials7: setup ## The C, C++ and runtime tests over SUNDIALS 7, built from Debian's sources (minutes, downloads 19 MB)
	@./bootstrap.sh sundials7 $(abspath $(BUILD))/sundials7
	@cmake -S . -B $(BUILD)/sundials7/lacuna -G Ninja -DCMAKE_PREFIX_PATH=$(abspath $(BUILD))/sundials7/installed > $(BUILD)/sundials7.log
	@ninja -C $(BUILD)/sundials7/lacuna --quiet | sed '/no work to do/d'
	@$(call run_ctest,$(BUILD)/sundials7/lacuna,--exclude-regex 'Allocations.*ida')
	@LACUNA_BUILD=$(abspath $(BUILD))/sundials7/lacuna LACUNA_CACHE=$(abspath $(BUILD))/sundials7/cache \
	  $(PYTHON) -m pytest -q -n 2 --dist loadgroup -m "not slow" tests/runtime tests/events \
	  --deselect 'tests/runtime/test_system_calls.py::test_no_library_reaches_for_files_processes_or_the_network[lacuna_runtime]'

fuzz: setup ## [FUZZ_SECONDS=180] each of: models through the parser, systems by solvers, the oracle, files, editor, libFuzzer
	@$(PYTHON) -m tests.codegen.fuzz --seconds $(FUZZ_SECONDS)
	@$(PYTHON) -m tests.fuzz --seconds $(FUZZ_SECONDS)
	@$(PYTHON) -m tests.fuzz.oracle --seconds $(FUZZ_SECONDS)
	@$(PYTHON) -m tests.fuzz.files --seconds $(FUZZ_SECONDS)
	@$(PYTHON) -m tests.fuzz.editor --seconds $(FUZZ_SECONDS)
	@cmake -S . -B $(BUILD)/fuzz -G Ninja -C tests/fuzz/clang.cmake > $(BUILD)/fuzz.log 2>&1 || { cat $(BUILD)/fuzz.log; exit 1; }
	@ninja -C $(BUILD)/fuzz --quiet $(FUZZ_TARGETS:%=fuzz_%)
	@for target in $(FUZZ_TARGETS); do mkdir -p $(OUT)/fuzz/$$target; (cd $(OUT)/fuzz/$$target && mkdir -p found && \
	  $(abspath $(BUILD))/fuzz/bin/fuzz_$$target -max_total_time=$(FUZZ_SECONDS) -timeout=10 -max_len=4096 found \
	  $(abspath tests/fuzz/corpus)/$$target > log 2>&1 && grep Done log || { tail -40 log; exit 1; }); done

belts: setup ## Stick and slip against closed forms: 200 machines, rtol 1e-4 to 1e-10, all adaptive solvers
	@$(PYTHON) -m tests.events belts

units: setup ## T1, T2, FlightControlEma and ten circuits in other units: events and relative errors (some minutes)
	@$(PYTHON) -m tests.events units

hybrid: setup ## 20 000 runs of random hybrid systems against closed-form switching times (a quarter of an hour)
	@$(PYTHON) -m tests.events systems

automata: setup ## 6000 runs of random automata against a program that plays them on closed forms (a quarter of an hour)
	@$(PYTHON) -m tests.events automata

swings: setup ## 3600 runs of small swings beside large states against closed forms (some minutes)
	@$(PYTHON) -m tests.events swings

format: setup ## Format all sources
	@$(PYTHON) -m ruff format .
	@$(PYTHON) -m ruff check --fix --quiet .
	@clang-format -i $(C_SOURCES)

lock: ## Write the versions now in .venv to requirements.lock
	@{ echo "# Exact versions of every Python package in .venv, written by 'make lock'; Python 3.11 and later."; \
	   $(PYTHON) -m pip freeze --all --exclude-editable --exclude pip | LC_ALL=C sort -f; } > requirements.lock

clean: ## Remove what was built (keeps .venv and out/)
	@rm -rf $(BUILD)
