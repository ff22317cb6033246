"""Run hair-convert as python -m hairconvert."""

import sys

from hairconvert.cli import main

sys.exit(main())
