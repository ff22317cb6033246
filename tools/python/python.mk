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

# Engines for Python draw hair by the package, in contexts of their own. The versions are those that were tested.
HOSTS := build/python/hosts
$(HOSTS)/installed: $(PY)/made
	@rm -rf $(HOSTS) && $(PYTHON) -m venv $(HOSTS)
	@$(HOSTS)/bin/pip install -q --disable-pip-version-check $(WHEEL) raylib==6.2.0.0 panda3d==1.10.16 || \
	  { echo "pip could not install raylib and panda3d, which test-hosts-python needs (above)."; exit 1; }
	@touch $@
test-hosts-python: $(HOSTS)/installed ## Programs of raylib and Panda3D keep their pixels beside hair
	@command -v xvfb-run >/dev/null || { echo "test-hosts-python needs xvfb-run; make hosts installs it."; exit 1; }
	@for host in "raylib_test.py" "panda3d_test.py core" "panda3d_test.py compatibility"; do \
	  xvfb-run -a $(HOSTS)/bin/python -B tests/hosts/python/$$host || exit 1; done
	@for host in "raylib_test.py" "panda3d_test.py compatibility"; do \
	  MESA_GL_VERSION_OVERRIDE=3.3 xvfb-run -a $(HOSTS)/bin/python -B tests/hosts/python/$$host || exit 1; done

.PHONY: wheel test-python test-hosts-python
