# Everything happens in .venv, made with $(PYTHON), redone when pyproject.toml changes.

PYTHON ?= python3
BIN := .venv/bin
INSTALLED := .venv/.installed
SENSES := .venv/.senses
DOCS := .venv/.docs

# Who runs on each core waits for nobody's threads on another.
SINGLE := OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1

export PIP_DISABLE_PIP_VERSION_CHECK := 1

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo talk serve page test types imports deep docs docs-serve playground bench mutants oracles clean

help: ## show these lines
	@sed -n 's/^\([a-z-]*\):[^#]*## /\1\t/p' Makefile | expand -t 12

demo: $(INSTALLED) ## a tutor teaches the robot ten objects and where things are, and tests it
	@$(BIN)/kille demo

talk: $(INSTALLED) ## teach the robot yourself
	@$(BIN)/kille talk

serve: $(INSTALLED) ## teach the robot in a browser
	@$(BIN)/kille serve --open
page: serve

# Programs that tests start by the hundred need not compile what they import.
test deep: export PYTHONDONTWRITEBYTECODE :=

ifdef ROOM
test: $(SENSES)
	@$(SINGLE) $(BIN)/python tools/rooms.py $(ROOM)
else
test: $(SENSES) ## format, lint, types, import directions, then all tests; make test ROOM=memory: one room's, quickly
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	@$(MAKE) --no-print-directory --output-sync -j 2 types imports
	$(SINGLE) $(BIN)/pytest -n auto --dist worksteal
endif

types: $(SENSES)
	$(BIN)/mypy

imports: $(SENSES)
	$(BIN)/lint-imports

deep: $(SENSES) ## the tests that take too long for every day; not a part of test
	HYPOTHESIS_PROFILE=$${HYPOTHESIS_PROFILE:-deep} $(SINGLE) \
	    $(BIN)/pytest -n auto --dist worksteal -m deep -o faulthandler_timeout=0

docs: $(DOCS) ## build the site of the documentation, in site/, with the playground
	@$(BIN)/python -m tools.website

docs-serve: docs ## build it, and show it in a browser at http://127.0.0.1:8000/
	@$(BIN)/python -m tools.website serve

# Hours of hostile inputs and of kills are for whoever asks for them by name.
BENCHMARKS := $(filter-out %/fuzz.py %kills.py,$(wildcard benchmarks/[!_]*.py))

bench: $(SENSES) ## measure how fast things are, on one thread
	@for script in $(BENCHMARKS); do \
	    echo "== $$script"; $(SINGLE) $(BIN)/python "$$script" || exit 1; \
	done

playground: $(INSTALLED) ## build the page that runs theories in a browser by itself, and serve it
	@$(BIN)/python -m tools.playground --serve

mutants: $(SENSES) ## see which small mistakes in a room its tests miss: make mutants ROOM=memory
	@$(BIN)/python -m pip install -q -e '.[mutants]'
	@$(BIN)/python tools/mutants.py $(ROOM)

# Some tests compare with other people's programs: libfreenect's tools with the Kinect
# driver and the recorder, flite as a tutor's voice, ROS with the nodes; the page is tried
# in a real browser. Without them these tests are skipped, and the run says so.
ORACLES := libfreenect-bin gcc libc6-dev \
    flite espeak-ng chromium \
    ros-core python3-rospy python3-sensor-msgs python3-std-srvs python3-message-filters \
    python3-rosbag python3-roslaunch python3-rosservice python3-rostopic rosbash
APT := DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120

oracles: ## install the Debian packages that optional tests need
	@if ! command -v apt-get >/dev/null || [ "$$(id -u)" != 0 ]; then \
	    echo "oracles: not installed, for that takes apt-get and its rights; their tests are skipped"; \
	elif { $(APT) update; $(APT) install -y --no-install-recommends $(ORACLES); } >/dev/null 2>&1; then \
	    echo "oracles: installed are $(ORACLES)"; \
	else \
	    echo "oracles: apt-get could not install them all; their tests are skipped"; \
	fi

clean: ## remove all that was made here, .venv too
	rm -rf .venv build dist site jupyter_execute *.egg-info .*_cache .hypothesis kille-demo*
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(INSTALLED): pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	    echo "kille needs Python 3.11 or newer, which $(PYTHON) is not: try make PYTHON=python3.12"; \
	    exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
	    echo "$(PYTHON) cannot make environments: install its venv module (Debian: apt install python3-venv)"; \
	    exit 1; }
	@echo "Setting up .venv, once; this takes a minute or two ..."
	@$(PYTHON) -m venv .venv
	@$(BIN)/python -m pip install -q -e '.[dev]'
	@touch $@

# What only some use is asked for by the tests alone: it must not keep a robot from talking.
$(SENSES): $(INSTALLED)
	@$(BIN)/python -m pip install -q -e '.[dev,senses]' || \
	    echo "not all of kille[senses] can be installed here; its tests are skipped"
	@touch $@

$(DOCS): $(INSTALLED)
	@$(BIN)/python -m pip install -q -e '.[docs]'
	@touch $@
