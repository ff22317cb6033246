"""A second opinion: the cases traced by Cycles, against Mitsuba and what is drawn."""

import csv
import os
import subprocess

import numpy as np

from hairtruth import traced

CHANNELS = ("red", "green", "blue")
SOURCES = ("mitsuba", "cycles", "drawn")
KEYS = ("cycles_error", "cycles_flip") + tuple(
    f"{source}_{channel}" for source in SOURCES for channel in CHANNELS)
RATIOS = (("cycles", "mitsuba"), ("drawn", "mitsuba"), ("drawn", "cycles"))


def pictures(python, case, strands, size, samples, parts):
    """Return linear colours of pictures that differ by their random numbers. `python` is that of
    Blender, `strands` a NumPy file."""
    prefix = f"{strands}.{case.name}."
    command = [python, "-B", "-m", "hairtruth.cycles", case.name, strands, prefix]
    command += [str(size), str(samples), str(parts)]
    # Blender's Python finds this package, but none of those that Mitsuba needs.
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    environment = dict(os.environ, PYTHONPATH=package)
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{case.name}: Cycles failed: {done.stdout.strip()[-2000:]}")
    return np.array([traced.read_exr(f"{prefix}{part}.exr") for part in range(parts)])


def read_means(path):
    """Return the means of Mitsuba's pictures in a file of rows, and their standard errors."""
    with open(path, newline="", encoding="utf-8") as file:
        return {row["case"]: (np.array([float(row[f"mitsuba_{c}"]) for c in CHANNELS]),
                              float(row["error"]) if row["error"] else None)
                for row in csv.DictReader(file)}


def cells(means):
    """Return the cells of a row for the means of each source."""
    return {f"{source}_{channel}": float(value) for source, mean in means.items()
            for channel, value in zip(CHANNELS, mean)}


def difference(row, source, other):
    """Return how far the means of a source are from those of another, a fraction a channel."""
    return np.array([row[f"{source}_{c}"] / row[f"{other}_{c}"] - 1 for c in CHANNELS])


def show(row):
    """Print the second line of a case."""
    parts = [f"{source} / {other} " + " ".join(f"{100 * x:+.1f}"
                                               for x in difference(row, source, other)) + " %"
             for source, other in RATIOS]
    if row["cycles_error"] is not None:
        parts.append(f"standard error of cycles {100 * row['cycles_error']:.1f} %")
    print("  " + "  ".join(parts), flush=True)


def summarize(rows):
    """Print the medians and the largest of all differences."""
    for source, other in RATIOS:
        off = np.abs([difference(row, source, other) for row in rows])
        print(f"{source} / {other}: median {100 * np.median(off):.1f} %, "
              f"largest {100 * off.max():.1f} %")
