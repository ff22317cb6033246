"""Tests of hair-convert. `make test-convert` runs them."""

import faulthandler

from tests import server

LONGEST_RUN = 900  # s

server.start()
# A test that hangs ends the run, with the places of all threads.
faulthandler.dump_traceback_later(LONGEST_RUN, exit=True)
