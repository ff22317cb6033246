"""Draws the cases with hair-capture, traces them with Mitsuba 3, and prints how both differ."""

import argparse
import csv
import math
import os
import sys
import tempfile

import flip_evaluator
import numpy as np

from hairtruth import cases, ours, second, traced

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
    curves, points = (os.path.join(folder, haircut + end) for end in (".txt", ".npy"))
    known = second.read_means(options.means) if options.means else {}
    for case in cases.all_cases():
        if case.haircut != haircut or options.match not in case.name:
            continue
        pictured = compares_pictures(case) and options.flip_samples
        size = FLIP_SIZE if pictured else options.size
        picture, dump = ours.draw(options.capture, case, size, folder, not os.path.exists(curves))
        if dump:
            strands = ours.read_strands(dump)
            np.save(points, strands)
            traced.write_strands(strands, cases.HAIRCUTS[haircut].radius, curves)
        drawn = traced.read_exr(picture)
        row = {"case": case.name}
        means = {"drawn": drawn.mean((0, 1))}
        samples, parts = (options.flip_samples // 2, 2) if pictured else (options.samples,
                                                                          options.parts)
        if case.name in known and not pictured:
            means["mitsuba"], row["error"] = known[case.name]
        else:
            traces = traced.pictures(options.variant, case, curves, size, samples, parts)
            means["mitsuba"], row["error"] = traces.mean((0, 1, 2)), standard_error(traces)
        if pictured:
            compare_pictures(row, options.pictures, drawn, traces)
        if options.second:
            others = second.pictures(options.second, case, points, size, samples, parts)
            means["cycles"], row["cycles_error"] = others.mean((0, 1, 2)), standard_error(others)
            if pictured:
                row["cycles_flip"] = flip(traces.mean(0), others.mean(0))
        bias = means["drawn"] / means["mitsuba"] - 1
        row.update(zip(second.CHANNELS, bias.tolist()), **second.cells(means))
        yield row


def compare_pictures(row, folder, drawn, traces):
    """Add FLIP errors to a row, and write the pictures to a folder unless that is None."""
    truth = traces.mean(0)
    row["halves"] = flip(traces[0], traces[1])
    row["flip"] = flip(truth, drawn)
    if folder:
        np.save(os.path.join(folder, row["case"] + ".npy"),
                np.concatenate([drawn, truth], 1).astype(np.float16))


def show(row):
    cells = [f"{row['case']:24}"]
    cells += [f"{100 * row[key]:+6.1f} %" for key in second.CHANNELS]
    if row["error"] is not None:
        cells.append(f"standard error {100 * row['error']:.1f} %")
    if "flip" in row:
        cells.append(f"FLIP {row['flip']:.4f}, of two halves of the truth {row['halves']:.4f}")
    print("  ".join(cells), flush=True)


def text(key, value):
    """Return a cell of a file: fractions have four decimals, and means six digits."""
    if not isinstance(value, float):
        return value
    return f"{value:.4f}" if key in KEYS else f"{value:.6g}"


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
    parser.add_argument("--second", metavar="PYTHON",
                        help="Python that has Blender's package bpy: trace with Cycles too")
    parser.add_argument("--means", metavar="CSV",
                        help="take Mitsuba's means from these rows of --second, if a case is there")
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
                if options.second:
                    second.show(row)
                rows.append(row)
    if not rows:
        print("hairtruth: no case has that name", file=sys.stderr)
        return 2
    bias = np.abs([[row[key] for key in second.CHANNELS] for row in rows])
    print(f"means of {len(rows)} cases: median {100 * np.median(bias):.1f} %, "
          f"largest {100 * bias.max():.1f} %")
    if options.second:
        second.summarize(rows)
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            keys = KEYS + (second.KEYS if options.second else ())
            writer = csv.DictWriter(file, keys, extrasaction="ignore", lineterminator="\n")
            writer.writeheader()
            writer.writerows({key: text(key, value) for key, value in row.items()} for row in rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
