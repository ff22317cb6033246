# truth.mk - hairtruth, a Python program in a virtual environment of its own, which compares drawn
# hair with path tracing by Mitsuba 3. Nothing else needs the program or its packages.

TRUTH := build/truth
$(TRUTH)/installed: tools/truth/requirements.txt
	@python3 -m venv $(TRUTH)
	@$(TRUTH)/bin/pip install -q --disable-pip-version-check -r tools/truth/requirements.txt || \
	  { echo "pip could not install mitsuba, numpy and flip-evaluator, which the comparison needs (above)."; exit 1; }
	@touch $@

# Half an hour on two cores. The variable `match` selects cases by their names. `second=cycles` lets
# Cycles trace the cases too, and `means` names a file of rows with means of Mitsuba to take.
truth: $(TRUTH)/installed $(B)/hair-capture $(if $(filter cycles,$(second)),$(BLENDER)/installed) ## The light on drawn hair, against path tracing by Mitsuba 3
	@PYTHONPATH=tools/truth:tools/convert $(TRUTH)/bin/python -B -m hairtruth --capture $(B)/hair-capture --match '$(match)' $(if $(filter cycles,$(second)),--second $(BLENDER)/bin/python) $(if $(means),--means '$(means)') --csv $(TRUTH)/truth.csv

test-truth: $(TRUTH)/installed $(BLENDER)/installed ## The tests of hairtruth, in the Python of Mitsuba and in that of Blender
	@PYTHONPATH=tools/truth:tools/convert $(TRUTH)/bin/python -B tools/truth/tests/test_second.py
	@PYTHONPATH=tools/truth $(BLENDER)/bin/python -B tools/truth/tests/test_cycles.py

.PHONY: truth test-truth
