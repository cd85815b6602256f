# Everything a newcomer types. The work is done by the scripts in .ci/, each of which runs by hand too.
.DEFAULT_GOAL := help
.PHONY: help demo test lint docs bench fuzz sanitize format codegen clean

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 16

demo: ## set up, run examples/organ.yaml, say where the result and the picture are
	@.ci/demo

test: ## set up, then the C++ and the Python tests
	@.ci/test

lint: ## formatting, types, clang-tidy, allowed edges between rooms
	@.ci/lint

docs: ## set up, build the site into build/site; a warning or a dead link is an error
	@.ci/docs

bench: ## build tissu-bench and run it
	@.ci/bench

fuzz: ## an hour of odd scenes, meshes and command lines (FUZZ_SECONDS=3600)
	@.ci/fuzz

sanitize: ## C++ tests under address, undefined-behaviour and thread sanitizers (long)
	@.ci/sanitize

format: ## rewrite C++ and Python sources in the project's format
	@.ci/format

codegen: ## write again what is made from formulae and from the list of public names
	@.ci/codegen

clean: ## remove what was built (the virtual environment stays)
	@rm -rf build results
