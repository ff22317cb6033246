"""Measure the error of each solver against its time on this machine.

    error_against_time.py [--quick] [--out PLOT.png] [--json ROWS.json]

Strands hang from a head that swings for a second. The error is the RMS distance of their vertices from the
solver "accurate" with short substeps, in percent of the length of a strand. The time is that of one frame of
1/60 s, with the wait for the GPU. Needs libhair. matplotlib, if it is there, draws a finer plot.
"""

import argparse
import json
import math
import time

import numpy as np

import libhair

LENGTH, VERTICES = 0.25, 16
COLORS = {"direct": "#1f77b4", "accurate": "#2ca02c", "follow": "#d62728", "redblack": "#ff7f0e"}


def make_groom(strands):
    """Return straight strands that hang from a row."""
    positions = np.zeros((strands, VERTICES, 3))
    positions[:, :, 0] = 0.002 * np.arange(strands)[:, None]
    positions[:, :, 1] = -LENGTH * np.linspace(0, 1, VERTICES)
    return libhair.Groom(positions=positions, strand_vertices=[VERTICES] * strands, strand_set="guides",
                         guide_vertices=VERTICES, follower_count=0)  # fmt: skip


def swing(hair, frames):
    """Step a head that swings. Return the positions after each frame, and the seconds of a frame."""
    out, start = [], 0.0
    for frame in range(frames + 1):
        if frame == 1:
            start = time.perf_counter()  # The first frame compiles programs.
        transform = np.eye(4)
        transform[0, 3] = 0.1 * (1 - math.cos(2 * math.pi * frame / 60)) / 2
        hair.transform = transform
        hair.step(1 / 60)
        out.append(hair.read("guides"))
    return np.array(out, dtype=float), (time.perf_counter() - start) / frames


def run(context, groom, solver, substeps, frames):
    """Return the positions and the time of a frame of a solver."""
    with libhair.Hair(context, groom, solver=solver, substep=1 / 60 / substeps) as hair:
        return swing(hair, frames)


def measure(context, quick):
    """Return a row for each solver and number of substeps."""
    groom, frames = make_groom(16 if quick else 256), 20 if quick else 60
    truth, _ = run(context, groom, "accurate", 64, frames)
    rows = []
    for solver in ("direct", "accurate", "follow", "redblack"):
        # The many sweeps of redblack take seconds with short substeps.
        counts = (1, 2, 4, 8) if solver == "redblack" else (1, 2, 4, 8, 16, 32)
        for substeps in (2, 8) if quick else counts:
            positions, seconds = run(context, groom, solver, substeps, frames)
            error = math.sqrt(np.mean(np.sum((positions - truth) ** 2, axis=2))) / LENGTH
            rows.append({"solver": solver, "substeps": substeps, "milliseconds": 1000 * seconds, "error": error})
            print(f"{solver:9} {substeps:3} substeps a frame: {1000 * seconds:8.3f} ms, error {100 * error:8.4f} %")
    return rows


def plot_by_matplotlib(rows, path):
    """Draw the plot with axes and a legend. Return False without matplotlib."""
    try:
        import matplotlib
    except ImportError:
        return False
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6, 4.5))
    for solver, color in COLORS.items():
        own = [row for row in rows if row["solver"] == solver]
        axes.loglog([r["milliseconds"] for r in own], [100 * r["error"] for r in own], "o-", color=color, label=solver)
    axes.set(xlabel="time of a frame, ms", ylabel="RMS error, % of the length", title="Error against time")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=120)
    return True


def plot_plainly(rows, path, width=480, height=360, border=30):
    """Draw the points and lines of each solver on logarithmic axes, without text."""
    pixels = np.full((height, width, 3), 255, dtype=np.uint8)
    pixels[border : height - border, border : width - border] = 244
    points = np.log10([[row["milliseconds"], max(row["error"], 1e-9)] for row in rows])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = (np.array([width, height]) - 2 * border - 20) / np.maximum(high - low, 1e-9)
    places = border + 10 + (points - low) * scale
    for solver, color in COLORS.items():
        own = [place for place, row in zip(places, rows) if row["solver"] == solver]
        rgb = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
        for a, b in zip(own, own[1:] or own):
            for t in np.linspace(0, 1, 600):
                x, y = (a + t * (b - a)).astype(int)
                size = 3 if t in (0, 1) else 1
                pixels[height - 1 - y - size : height - y + size, x - size : x + 1 + size] = rgb
    libhair.write_png(path, pixels)


def main():
    """Measure, print and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="few strands and substeps")
    parser.add_argument("--out", default="error_against_time.png", help="PNG file of the plot")
    parser.add_argument("--json", help="file of the rows")
    options = parser.parse_args()
    with libhair.Context() as context:
        rows = measure(context, options.quick)
    if not plot_by_matplotlib(rows, options.out):
        plot_plainly(rows, options.out)
    print(f"wrote {options.out}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
