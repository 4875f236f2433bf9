# Each target sets up .venv first where it needs it. `make CORES=8 figures` uses more cores, PYTHON=... another Python.
PYTHON ?= python3
CORES ?= 2
VENV := .venv/bin
SNAKEMAKE := $(VENV)/snakemake --cores $(CORES)
PYTEST := SLURM_CONF=/dev/null MPLBACKEND=Agg $(VENV)/python -m pytest -n $(CORES) --dist loadfile

.PHONY: help figures preview report test test-full test-pages browser test-slurm batch-system coverage mutation bench docs gallery prune lint lock clean

help:
	@echo 'make figures    all figures at full size, into results/'
	@echo 'make preview    the same figures, small and in minutes, into results/preview/'
	@echo 'make report     all of it on one page to read and pass on, results/report.html'
	@echo 'make test       all tests but the long ones'
	@echo 'make test-full  all tests'
	@echo 'make test-pages open the explorer in Chromium and datasets with ncdump (packages chromium and netcdf-bin)'
	@echo 'make test-slurm run the workflow through a SLURM of its own (packages slurmctld, slurmd, slurm-client and munge)'
	@echo 'make coverage   lines that tests run, kernels included (20 minutes)'
	@echo 'make mutation   how many mistakes in collision and prediction the tests notice (20 minutes)'
	@echo 'make bench      speed of the engine, into results/bench.csv'
	@echo 'make docs       the documentation, into docs/_build/html'
	@echo 'make gallery    copy final figures and tables into results/gallery/'
	@echo 'make prune      remove runs that no study names any more, after a question (OVERLAYS=mine.yaml for more studies)'
	@echo 'make lint       style, types and spelling of the code, and the configurations'
	@echo 'make lock       pin what pyproject.toml asks for (without the lock files: in its newest version)'
	@echo 'make clean      remove caches; results and .venv stay'

figures: .venv/.installed
	$(SNAKEMAKE)

preview: .venv/.installed
	$(SNAKEMAKE) --configfile config/config.yaml config/reduced.yaml -- all check

report: .venv/.installed
	$(SNAKEMAKE) -- pages
	DOCUTILSCONFIG=workflow/report/docutils.conf $(SNAKEMAKE) --report results/report.html -- pages

test: .venv/.installed
	$(PYTEST)

test-full: .venv/.docs
	$(PYTEST) -m "not pages and not slurm"

test-pages: browser .venv/.pages
	$(PYTEST) -m pages -n 0 tests/pages

PLAIN := cells collisions flight predict vectors walls gravity vibrated_floor growth rough collision_models contacts soft_contact softspheres lrv dsmc plate

coverage: .venv/.installed
	rm -f .coverage .coverage.*
	$(PYTEST) --cov --cov-report= tests/unit tests/docs tests/workflow/test_wrong_input.py
	NUMBA_DISABLE_JIT=1 $(PYTEST) -m 'not full and not compiled' --cov --cov-append --cov-report= \
		$(PLAIN:%=tests/unit/dynamics/test_%.py) tests/unit/analysis
	$(VENV)/coverage report --fail-under 95

mutation: .venv/.installed
	$(VENV)/python tests/mutation/check.py --cores $(CORES)

browser:
	@missing=; for need in chromium:chromium ncdump:netcdf-bin; do \
		command -v $${need%%:*} > /dev/null || missing="$$missing $${need##*:}"; done; \
		test -z "$$missing" || { echo "make test-pages needs packages of the distribution: apt-get install$$missing"; exit 1; }

test-slurm: batch-system .venv/.slurm
	$(PYTEST) -m slurm -n 0 tests/slurm

batch-system:
	@missing=; for need in slurmctld:slurmctld slurmd:slurmd sbatch:slurm-client munged:munge; do \
		PATH="$$PATH:/usr/sbin" command -v $${need%%:*} > /dev/null || missing="$$missing $${need##*:}"; done; \
		test -z "$$missing" || { echo "make test-slurm needs packages of the distribution: apt-get install$$missing"; exit 1; }

bench: .venv/.installed
	$(VENV)/python benchmarks/speed.py

docs: .venv/.docs
	$(VENV)/sphinx-build -W --keep-going -q docs docs/_build/html
	@echo 'The documentation: docs/_build/html/index.html'

gallery: .venv/.installed
	$(VENV)/python -m granugas.storage.gallery results

prune: .venv/.installed
	$(VENV)/python -m granugas prune $(OVERLAYS)

lint: .venv/.installed
	$(VENV)/ruff check .
	$(VENV)/ruff format --check .
	$(VENV)/mypy
	$(VENV)/codespell $$(git ls-files | grep -v -e '^results/' -e '\.lock$$')
	$(VENV)/python tests/check_config.py

LOCK := .lock/bin/uv pip compile --quiet --universal --generate-hashes --no-emit-index-url --python-version 3.11 pyproject.toml

lock:
	@$(PYTHON) -m venv .lock
	@.lock/bin/python -m pip install --quiet uv
	$(LOCK) --extra workflow --extra export --extra test --extra develop -o requirements.lock
	$(LOCK) --extra docs -c requirements.lock -o requirements-docs.lock
	$(LOCK) --group pages -c requirements.lock -o requirements-pages.lock
	$(LOCK) --group slurm -c requirements.lock -o requirements-slurm.lock
	@rm -rf .lock

clean:
	rm -rf .lock .pytest_cache .ruff_cache .mypy_cache .hypothesis .coverage .coverage.* htmlcov build dist docs/_build
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +

.venv/.installed: requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo 'Python 3.11 or newer is needed, and $(PYTHON) is not: make PYTHON=python3.12 ...'; exit 1; }
	@echo 'Setting up .venv: about a minute.'
	@$(PYTHON) -m venv .venv
	@$(VENV)/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps -r requirements.lock
	@$(VENV)/python -m pip install --quiet --disable-pip-version-check --no-deps -e .
	@touch $@

.venv/.docs: .venv/.installed requirements-docs.lock
	@$(VENV)/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps -r requirements-docs.lock
	@touch $@

.venv/.slurm: .venv/.installed requirements-slurm.lock
	@$(VENV)/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps -r requirements-slurm.lock
	@touch $@

.venv/.pages: .venv/.installed requirements-pages.lock
	@$(VENV)/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps -r requirements-pages.lock
	@touch $@
