"""Tests of hair-convert. `make test-convert` runs them."""
