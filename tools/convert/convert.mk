# convert.mk - hair-convert, a Python program in a virtual environment of its own. Nothing else
# needs the program or its packages.

VENV := build/convert
convert: $(VENV)/installed ## hair-convert with its packages from PyPI, in build/convert/bin
$(VENV)/installed: tools/convert/pyproject.toml
	@[ "$(SETUP)" = 0 ] || sh tools/setup.sh tools/convert/packages.txt
	@python3 -m venv $(VENV)
	@$(VENV)/bin/pip install -q --disable-pip-version-check -e tools/convert || \
	  { echo "pip could not install numpy, libigl, usd-core and alembic3d, which hair-convert needs (above)."; exit 1; }
	@touch $@

# The variable HAIR_CONVERT_DATA names a folder of haircuts for further round trips.
test-convert: convert $(B)/hair-groom $(B)/hair-capture ## Every test of hair-convert
	@cd tools/convert && HAIR_GROOM=$(abspath $(B))/hair-groom HAIR_CAPTURE=$(abspath $(B))/hair-capture $(abspath $(VENV))/bin/python -B -W error::DeprecationWarning \
	  -m unittest discover -t . -s tests $(if $(filter),-k $(filter))

# Blender 4.5 as a Python package, 350 MB, in an environment of its own.
BLENDER := build/blender
$(BLENDER)/installed:
	@python3 -m venv $(BLENDER)
	@$(BLENDER)/bin/pip install -q --disable-pip-version-check 'bpy==4.5.*' || \
	  { echo "pip could not install bpy, Blender 4.5 for Python 3.11, which the tests of the add-on need (above)."; exit 1; }
	@touch $@
test-blender: convert $(BLENDER)/installed $(B)/hair-groom $(B)/hair-capture ## The tests of the Blender add-on, in Blender without a window
	@HAIR_CONVERT=$(abspath $(VENV))/bin/hair-convert HAIR_GROOM=$(abspath $(B))/hair-groom \
	  HAIR_CAPTURE=$(abspath $(B))/hair-capture $(BLENDER)/bin/python -B tools/convert/blender_tests/test_addon.py

.PHONY: convert test-convert test-blender
