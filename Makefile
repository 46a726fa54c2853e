# A thin front of CMake; CMakePresets.json has the builds.
PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
SECONDS ?= 3600
PYTHON_FOLDER ?= build/python
PYTHON ?= $(firstword $(wildcard /usr/bin/python3) python3)
BUILD := build/release

.PHONY: all help demo check check-all test abi coverage python cluster bits ports wasm page mutate bench soak soak-world soak-solid soak-robot soak-fcl planned-proofs trust fuzz docs site install deb deb-root format lint clean

all: ## the libraries and the tool, in build/release, with the page of --html where Node.js is here
	@scripts/setup.sh build
	@cmake --preset release >/dev/null
	@cmake --build $(BUILD) -j$(JOBS) --target libraries ovoid_cli
	@JOBS=$(JOBS) scripts/template.sh $(BUILD)

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | while IFS="$$(printf '\t')" read -r a b; do printf 'make %-12s %s\n' $$a "$$b"; done

# $(call build,WHAT,TARGETS): installs what WHAT needs, then builds only these targets.
build = scripts/setup.sh $(1) && JOBS=$(JOBS) scripts/build.sh $(BUILD) $(2)

demo: ## fit real meshes, pose them, prove every pair, draw the picture
	@$(call build,demo,ovoid_cli)
	@scripts/demo.sh

check: ## lint, then build and run the tests, in about 12 minutes on two cores
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/check.sh check

check-all: check ## all that CI runs: check; then sanitizers, other processors, pages, static analysis, the manual
	@JOBS=$(JOBS) scripts/check.sh rest

test: ## the tests of one floor, or more, after a change: make test FLOOR=solid
	@scripts/setup.sh build
	@JOBS=$(JOBS) scripts/test-floor.sh $(FLOOR)

abi: ## whether programs linked with the last release work with these libraries
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/abi.sh

coverage: ## which lines and branches the tests run, by folder; half an hour; build/coverage/html has each line
	@scripts/setup.sh coverage
	@JOBS=$(JOBS) scripts/coverage.sh

python: ## the Python package, its tests and gallery, installed into PYTHON_FOLDER=build/python
	@$(call build,python,ovoid_python)
	@ctest --test-dir $(BUILD) -R '^test_python' --output-on-failure --no-tests=error
	@cmake --install $(BUILD) --component python --prefix $(PYTHON_FOLDER) >/dev/null
	@cd /tmp && PYTHONPATH=$(abspath $(PYTHON_FOLDER)) OVOID_SOURCE_DIR=$(CURDIR) $(PYTHON) $(CURDIR)/python/tests/test_pair.py
	@echo "installed: PYTHONPATH=$(abspath $(PYTHON_FOLDER)) python3 -c 'import ovoid'"

cluster: ## the examples for clusters: GNU parallel, Slurm on one node, Dask, MPI
	@$(call build,cluster,ovoid_cli ovoid_python)
	@ctest --test-dir $(BUILD) -R '^test_cluster' --output-on-failure --no-tests=error --verbose

bits: ## the same bits from 14 builds by gcc and clang, some minutes
	@scripts/setup.sh check
	@scripts/bits.sh

ports: ## the same bits and tests on musl, 64-bit ARM, 32-bit x86, Windows and WebAssembly, some minutes
	@scripts/setup.sh ports
	@scripts/ports.sh

wasm: ## the package for JavaScript in build/wasm, and its tests under Node.js
	@$(call build,wasm,ovoid_cli)
	@JOBS=$(JOBS) scripts/wasm.sh

page: ## the template of the page that --html writes, and its tests in Chromium and Firefox
	@$(call build,page,ovoid_cli)
	@JOBS=$(JOBS) scripts/page.sh

mutate: ## small faults in a copy of the sources: which test notices each, two to three hours
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/mutate.sh

bench: ## nanoseconds per query and time of frames beside other libraries: tables, CSV and plots in build/
	@$(call build,bench,bench)
	@$(BUILD)/bench/bench --csv build/bench.csv --svg build/bench.svg
	@$(BUILD)/bench/bench --many --csv build/many.csv --svg build/many.svg

soak: ## random and hostile pairs before the exact judge, SECONDS=3600; goes on where it stopped
	@$(call build,build,test_query_trials)
	@$(BUILD)/tests/test_query_trials --seconds $(SECONDS) --state build/soak.state

soak-world: ## worlds of bodies that come, move and go, beside all pairs one by one, SECONDS=3600
	@$(call build,build,test_world_soak)
	@$(BUILD)/tests/test_world_soak --seconds $(SECONDS) --seed $$(date +%s)

soak-solid: ## solids before the exact judge and beside brute force, a million answers, half an hour
	@$(call build,build,test_judge_solid)
	@$(BUILD)/tests/test_judge_solid --answers 1e6 --seed $$(date +%s)

soak-robot: ## states and edges of robots before a judge in long double, 10^7 and 10^5 of each kind, half an hour
	@$(call build,build,test_robot_judge)
	@$(BUILD)/tests/test_robot_judge --states 1e7 --edges 1e5 --seed $$(date +%s)

soak-fcl: ## a million calls by FCL and by <ovoid/fcl.hpp>: which differ, and which of both a proof refutes; minutes
	@$(call build,bench,bench_fcl_calls)
	@$(BUILD)/bench/bench_fcl_calls --calls 7500 --rounds 0

planned-proofs: ## proofs of the motions of PROBLEMS=7 planning problems a robot, made by the tool and verified
	@$(call build,planned-proofs,ovoid_cli bench_planner)
	@BUILD=$(BUILD) scripts/planned_proofs.sh $(PROBLEMS)

LIARS := test_query_altered test_compound_altered test_judge_solid_altered test_solid_impact_altered test_impact_altered \
    test_compound_impact_altered test_robot_path_altered
trust: ## 10^9 queries checked by proof, 10^6 by the judge, then lies told to each check; an hour; goes on where it stopped
	@$(call build,build,long_run $(LIARS))
	@$(BUILD)/tests/long_run --queries 1e9 --threads $(JOBS) --state build/long_run.state
	@for liar in $(LIARS); do echo "$$liar"; case $$liar in \
	test_query_altered | test_compound_altered) $(BUILD)/tests/$$liar --seconds 300 --seed $$(date +%s) ;; \
	*) $(BUILD)/tests/$$liar --cases 1000 --seed $$(date +%s) ;; esac || exit 1; done

fuzz: ## each fuzz target for SECONDS=60; goes on from what it found before
	@scripts/setup.sh fuzz
	@cmake --preset fuzz >/dev/null && cmake --build build/fuzz -j$(JOBS) --target fuzz_targets >/dev/null
	@scripts/fuzz.sh $(if $(filter command,$(firstword $(origin SECONDS))),$(SECONDS),60)

docs: ## the manual, in build/docs/html
	@scripts/setup.sh docs
	@scripts/docs.sh

site: ## the documentation as a site, in build/site, with the demo's scene live where Node.js and npm can build its page
	@$(call build,site,ovoid_cli)
	@scripts/demo.sh >build/demo.log 2>&1 && JOBS=$(JOBS) scripts/page.sh --template || echo "site: the live page is left out"
	@scripts/site.sh

install: all ## PREFIX=/usr/local DESTDIR=
	@DESTDIR=$(DESTDIR) cmake --install $(BUILD) --prefix $(PREFIX)

deb: all ## Debian packages in build/deb, looked through by lintian
	@scripts/setup.sh deb
	@JOBS=$(JOBS) scripts/deb.sh

deb-root: deb ## these packages in a fresh Debian 12: installed, linked against, removed; as root
	@scripts/setup.sh deb-root
	@scripts/deb-root.sh

format: ## clang-format over all sources
	@scripts/lint.sh format-in-place

lint: ## floors, format, shell scripts, static analysis
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/lint.sh

clean: ## remove build/
	@rm -rf build
