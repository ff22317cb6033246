"""Draws the cases with hair-capture, traces them with Mitsuba 3, and prints how both differ."""

import argparse
import csv
import math
import os
import sys
import tempfile

import flip_evaluator
import numpy as np

from hairtruth import cases, ours, traced

FLIP_COLORS, FLIP_AZIMUTHS = ("blond", "brown"), (0, 90, 180)
FLIP_SIZE = 512
KEYS = ("case", "red", "green", "blue", "error", "flip", "halves")


def encode(linear):
    """Return linear colours as sRGB."""
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(np.float32)


def flip(a, b):
    return float(flip_evaluator.evaluate(encode(a), encode(b), "LDR")[1])


def compares_pictures(case):
    """Return whether FLIP is computed for a case, which takes a picture without noise."""
    return (case.color in FLIP_COLORS and case.light.name == "sun"
            and case.light.azimuth in FLIP_AZIMUTHS)


def standard_error(pictures):
    """Return the greatest relative standard error of a channel's mean over pictures, or None."""
    means = pictures.mean((1, 2), dtype=np.float64)
    if len(means) < 2:
        return None
    return float((means.std(0, ddof=1) / math.sqrt(len(means)) / means.mean(0)).max())


def measure(options, haircut, folder):
    """Yield a row for each case of a haircut."""
    curves = os.path.join(folder, f"{haircut}.txt")
    for case in cases.all_cases():
        if case.haircut != haircut or options.match not in case.name:
            continue
        pictured = compares_pictures(case) and options.flip_samples
        size = FLIP_SIZE if pictured else options.size
        picture, dump = ours.draw(options.capture, case, size, folder, not os.path.exists(curves))
        if dump:
            traced.write_strands(ours.read_strands(dump), cases.HAIRCUTS[haircut].radius, curves)
        drawn = traced.read_exr(picture)
        samples, parts = options.samples, options.parts
        if pictured:
            samples, parts = options.flip_samples // 2, 2
        traces = traced.pictures(options.variant, case, curves, size, samples, parts)
        truth = traces.mean(0)
        row = {"case": case.name, "error": standard_error(traces)}
        if pictured:
            row["halves"] = flip(traces[0], traces[1])
            row["flip"] = flip(truth, drawn)
            if options.pictures:
                np.save(os.path.join(options.pictures, case.name + ".npy"),
                        np.concatenate([drawn, truth], 1).astype(np.float16))
        bias = drawn.mean((0, 1)) / truth.mean((0, 1)) - 1
        row.update(zip(("red", "green", "blue"), bias.tolist()))
        yield row


def show(row):
    cells = [f"{row['case']:24}"]
    cells += [f"{100 * row[key]:+6.1f} %" for key in ("red", "green", "blue")]
    if row["error"] is not None:
        cells.append(f"standard error {100 * row['error']:.1f} %")
    if "flip" in row:
        cells.append(f"FLIP {row['flip']:.4f}, of two halves of the truth {row['halves']:.4f}")
    print("  ".join(cells), flush=True)


def parse(arguments):
    parser = argparse.ArgumentParser(prog="hairtruth", description=__doc__)
    parser.add_argument("--capture", default="build/release/hair-capture", help="the program")
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba; scalar_rgb")
    parser.add_argument("--haircut", choices=list(cases.HAIRCUTS), help="only this haircut")
    parser.add_argument("--match", default="", help="only cases whose name contains this")
    parser.add_argument("--size", type=int, default=192, help="of pictures, pixels; 192")
    parser.add_argument("--samples", type=int, default=16, help="a pixel of a part; 16")
    parser.add_argument("--parts", type=int, default=2,
                        help="of the truth, which differ by their random numbers; 2")
    parser.add_argument("--flip-samples", type=int, default=0,
                        help="a pixel of the truth where pictures are compared; 0: none are")
    parser.add_argument("--csv", help="write the rows to this file")
    parser.add_argument("--pictures", help="write compared pictures to this folder")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse(arguments)
    traced.use(options.variant)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for haircut in [options.haircut] if options.haircut else cases.HAIRCUTS:
            for row in measure(options, haircut, folder):
                show(row)
                rows.append(row)
    if not rows:
        print("hairtruth: no case has that name", file=sys.stderr)
        return 2
    bias = np.abs([[row[key] for key in ("red", "green", "blue")] for row in rows])
    print(f"means of {len(rows)} cases: median {100 * np.median(bias):.1f} %, "
          f"largest {100 * bias.max():.1f} %")
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, KEYS, lineterminator="\n")
            writer.writeheader()
            writer.writerows({key: f"{value:.4f}" if isinstance(value, float) else value
                              for key, value in row.items()} for row in rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
