"""The text of hair-convert info."""

import numpy as np

from hairconvert.groom import lengths
from hairconvert.report import escape


def describe(groom):
    """Return lines that describe a groom."""
    length = lengths(groom)
    lower, upper = groom.points.min(axis=0), groom.points.max(axis=0)
    lines = [
        f"format      {groom.format}",
        f"strands     {len(groom.counts)}",
        f"vertices    {len(groom.points)}, {groom.counts.min()} to {groom.counts.max()} of each "
        "strand",
        f"length      {length.min():.6g} to {length.max():.6g} m, mean {length.mean():.6g} m",
        "bounds      " + _vector(lower) + " to " + _vector(upper) + " m",
    ]
    for name, a in sorted(groom.attributes.items()):
        lines.append(f"attribute   {escape(name)}: {_type(a.values)} per {a.scope}{_range(a)}")
    if groom.motion:
        times = groom.motion.times
        lines.append(f"motion      {len(times)} frames from {times[0]:.6g} to {times[-1]:.6g} s")
    return lines


def _vector(v):
    return "(" + ", ".join(f"{x:.6g}" for x in v) + ")"


def _type(values):
    name = "string" if values.dtype.kind in "US" else values.dtype.name
    return name if values.ndim == 1 else f"{name} x {values.shape[1]}"


def _range(attribute):
    values = attribute.values
    if values.dtype.kind in "US" or values.size == 0:
        return ""
    return f", {np.min(values):.6g} to {np.max(values):.6g}"
