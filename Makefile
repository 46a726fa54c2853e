# A thin front of CMake; CMakePresets.json has the builds.
PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
BUILD := build/release

.PHONY: all help demo check bench soak docs install format lint clean

all: ## the libraries and the tool, in build/release
	@scripts/setup.sh build
	@cmake --preset release >/dev/null
	@cmake --build $(BUILD) -j$(JOBS)

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' Makefile | while IFS="$$(printf '\t')" read -r a b; do printf 'make %-8s %s\n' $$a "$$b"; done

demo: ## fit real meshes, pose them, prove every pair, draw the picture
	@scripts/setup.sh demo
	@$(MAKE) --no-print-directory all >/dev/null
	@scripts/demo.sh

check: ## lint, then build and test: gcc, clang, sanitizers
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/check.sh

bench: ## nanoseconds per query, beside libccd
	@scripts/setup.sh bench
	@$(MAKE) --no-print-directory all >/dev/null
	@$(BUILD)/bench/bench

soak: all ## an hour of random and hostile pairs before the exact judge
	@$(BUILD)/tests/test_query_trials --seconds 3600

docs: ## the manual, in build/docs/html
	@scripts/setup.sh docs
	@scripts/docs.sh

install: all ## PREFIX=/usr/local DESTDIR=
	@DESTDIR=$(DESTDIR) cmake --install $(BUILD) --prefix $(PREFIX)

format: ## clang-format over all sources
	@scripts/lint.sh format-in-place

lint: ## floors, format, shell scripts, static analysis
	@scripts/setup.sh check
	@JOBS=$(JOBS) scripts/lint.sh

clean: ## remove build/
	@rm -rf build
