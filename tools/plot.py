#!/usr/bin/env python3
"""plot.py - run time against error, as SVG, from the CSV files of `hair-bench accuracy`.

plot.py CASE VERTICES OUT.svg TITLE=FILE.csv...   one panel a file; logarithmic both ways; Python's own library only
"""
import csv
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, BOTTOM, GAP = 420, 300, 62, 34, 46, 30
COLORS = {"redblack": "#c0392b", "direct": "#2471a3", "accurate": "#1e8449", "follow": "#9a7d0a"}


def points(path, case, vertices):
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["measured_by"] == "here" and row["case"] == case and row["vertices"] == vertices:
                count = row["iterations"] or row["substeps"]
                yield row["method"], float(row["us_per_strand"]), float(row["rms_error"]), count


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def panel(out, left, title, data):
    (x0, x1), (y0, y1) = decades([p[1] for p in data]), decades([p[2] for p in data])
    right, bottom = left + WIDTH - LEFT, TOP + HEIGHT - TOP - BOTTOM

    def place(x, y):
        return (left + (math.log10(x) - x0) / (x1 - x0) * (right - left),
                bottom - (math.log10(y) - y0) / (y1 - y0) * (bottom - TOP))

    out.append(f'<text x="{left}" y="{TOP - 14}" font-weight="bold">{title}</text>')
    for e in range(x0, x1 + 1):
        x = place(10.0**e, 10.0**y0)[0]
        out.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom}" stroke="#ddd"/>'
                   f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{10.0**e:g}</text>')
    for e in range(y0, y1 + 1):
        y = place(10.0**x0, 10.0**e)[1]
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{100 * 10.0**e:g} %</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{bottom + 34}" text-anchor="middle">microseconds a strand and frame</text>')
    for method, color in COLORS.items():
        own = sorted((p for p in data if p[0] == method), key=lambda p: p[1])
        path = " ".join("%.1f,%.1f" % place(p[1], p[2]) for p in own)
        out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.5"/>')
        for p in own:
            x, y = place(p[1], p[2])
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>'
                       f'<text x="{x + 5:.1f}" y="{y - 4:.1f}" fill="{color}" font-size="9">{p[3]}</text>')


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    case, vertices, path, files = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]
    width = len(files) * (WIDTH + GAP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT + 24}" font-family="sans-serif" font-size="11">',
           '<rect width="100%" height="100%" fill="white"/>']
    for i, named in enumerate(files):
        title, _, file = named.partition("=")
        panel(out, LEFT + i * (WIDTH + GAP), title, list(points(file, case, vertices)))
    for i, (method, color) in enumerate(COLORS.items()):
        x = LEFT + i * 100
        out.append(f'<circle cx="{x}" cy="{HEIGHT + 10}" r="4" fill="{color}"/><text x="{x + 9}" y="{HEIGHT + 14}">{method}</text>')
    out.append("</svg>\n")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


main()
