# python.mk - the Python package libhair: a wheel with the shared libraries, tested in a new virtual
# environment. Nothing else needs Python.

PYTHON    ?= python3
PY        := build/python
WHEEL      = $(PY)/dist/libhair-$(VERSION)-py3-none-*.whl
PY_SOURCE := $(wildcard tools/python/libhair/*.py) tools/python/pyproject.toml tools/python/setup.py

wheel: $(PY)/made ## build/python/dist: libhair as a wheel for Python 3, which needs no compiler
$(PY)/made: $(PY_SOURCE) tools/python/make_cdef.py $(wildcard include/hair/*.h) $(B)/libhair.so $(B)/libhair_egl.so LICENSE
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh tools/convert/packages.txt
	@rm -rf $(PY)/dist $(PY)/stage && mkdir -p $(PY)/stage/libhair
	@cp tools/python/libhair/*.py $(PY)/stage/libhair
	@cp tools/python/pyproject.toml tools/python/setup.py tools/python/README.md LICENSE $(PY)/stage
	@echo $(VERSION) >$(PY)/stage/VERSION
	@for n in libhair libhair_egl; do strip -S -o $(PY)/stage/libhair/$$n.so $(B)/$$n.so || exit 1; done
	@$(PYTHON) tools/python/make_cdef.py include $(PY)/stage/libhair/libhair.cdef $(CC)
	@$(PYTHON) -m venv $(PY)/build
	@$(PY)/build/bin/pip install -q --disable-pip-version-check setuptools wheel
	@$(PY)/build/bin/pip wheel -q --disable-pip-version-check --no-deps --no-build-isolation -w $(PY)/dist $(PY)/stage
	@touch $@ && echo "  $$(ls $(PY)/dist/*.whl)"

test-python: wheel ## Install the wheel in a new virtual environment and test the package there
	@rm -rf $(PY)/test && $(PYTHON) -m venv $(PY)/test
	@$(PY)/test/bin/pip install -q --disable-pip-version-check $(WHEEL)
	@cd $(PY)/test && HAIR_ROOT=$(CURDIR) bin/python -B -m unittest discover -t $(CURDIR)/tools/python/tests \
	  -s $(CURDIR)/tools/python/tests $(if $(filter),-k $(filter))

.PHONY: wheel test-python
