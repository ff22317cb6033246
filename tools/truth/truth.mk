# truth.mk - hairtruth, a Python program in a virtual environment of its own, which compares drawn
# hair with path tracing by Mitsuba 3. Nothing else needs the program or its packages.

TRUTH := build/truth
$(TRUTH)/installed: tools/truth/requirements.txt
	@python3 -m venv $(TRUTH)
	@$(TRUTH)/bin/pip install -q --disable-pip-version-check -r tools/truth/requirements.txt || \
	  { echo "pip could not install mitsuba, numpy and flip-evaluator, which the comparison needs (above)."; exit 1; }
	@touch $@

# Half an hour on two cores. The variable `match` selects cases by their names.
truth: $(TRUTH)/installed $(B)/hair-capture ## The light on drawn hair, against path tracing by Mitsuba 3
	@PYTHONPATH=tools/truth:tools/convert $(TRUTH)/bin/python -B -m hairtruth --capture $(B)/hair-capture --match '$(match)' --csv $(TRUTH)/truth.csv

.PHONY: truth
