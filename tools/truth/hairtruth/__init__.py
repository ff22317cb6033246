"""Compares the light on drawn hair with path tracing by programs of others."""
