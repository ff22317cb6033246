"""Puts values of a curve primitive, of any interpolation, on strands and vertices."""

import numpy as np

from hairconvert.groom import GROOM, STRAND, VERTEX, Attribute


class Values:
    """Collects the attributes of one curve primitive with its counts and points."""

    def __init__(self, curve_count, point_count, sampler, report):
        self.curve_count, self.point_count = curve_count, point_count
        self.sampler, self.report = sampler, report  # sampler is None for polylines
        self.attributes = {}

    def add(self, name, table, interpolation, size=1, role=""):
        """Add values, or say why they are not kept. `size` is the length of flat elements."""
        where = f"the attribute {name}"
        if table is None:
            self.report.lose(where, "its type is neither numbers, vectors nor strings")
            return
        if size > 1 and table.ndim == 1 and len(table) % size == 0:
            table = table.reshape(-1, size)
        n = len(table)
        if interpolation == "unknown":
            interpolation = "constant" if n == 1 else \
                "uniform" if n == self.curve_count else "vertex"
        if interpolation == "constant":
            if n != 1:
                table = table.reshape(1, -1) if table.ndim == 1 and n else None
            scope = GROOM
        elif interpolation == "uniform":
            table, scope = (table if n == self.curve_count else None), STRAND
        else:
            table, scope = self._at_vertices(table, interpolation), VERTEX
        if table is None:
            self.report.lose(where, f"{n} values fit no {interpolation} interpolation of "
                             f"{self.curve_count} strands with {self.point_count} points")
            return
        if name == "width" and table.dtype.kind == "f":
            table = np.maximum(table, 0)  # Cubic interpolation can go below 0.
        self.attributes[name] = Attribute(scope, table, role)

    def _at_vertices(self, table, interpolation):
        n, sampler = len(table), self.sampler
        if sampler is None:
            return table if n == self.point_count else None
        if interpolation == "vertex" and n == self.point_count:
            return sampler.sample(table)
        if interpolation in ("varying", "faceVarying") and n == sampler.varying_sizes.sum():
            return sampler.sample_varying(table)
        return None
