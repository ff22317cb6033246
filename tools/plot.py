"""plot.py - run time against error, as SVG, from the CSV files of hair-bench; logarithmic both ways, a panel a file

plot.py accuracy NAME=CASE:VERTICES,... OUT.svg TITLE=FILE.csv...   every solver, at every setting; a row of panels a case
plot.py render CASE OUT.svg TITLE=FILE.csv...              every way to draw; what nothing beats joined and labelled
"""
import csv
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, BOTTOM, GAP = 420, 300, 62, 34, 46, 30
SOLVERS = {"redblack": "#c0392b", "direct": "#2471a3", "accurate": "#1e8449", "follow": "#9a7d0a"}
SAMPLES = {"1": "#c0392b", "4": "#9a7d0a", "8": "#7d3c98", "16": "#2471a3", "32": "#1e8449", "64": "#1e8449"}


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from csv.DictReader(file)


# Yield points as (series, across, down, label, whether on the front, whether the solver's own
# setting).
def accuracy_points(path, case, vertices):
    for row in rows(path):
        if row["measured_by"] == "here" and row["case"] == case and row["vertices"] == vertices and row["rms_error"]:
            count = row["iterations"] or row["substeps"]
            own = row.get("default") == "true"
            yield row["method"], float(row["us_per_strand"]), float(row["rms_error"]), count, False, own


def render_points(path, case):
    for row in rows(path):
        if row["case"] == case and row["flip"]:
            label = f'{row["lod"]}, {row["segments"]}' + (" lines" if row["primitive"] == "lines" else "")
            yield row["samples"], float(row["ms"]), float(row["flip"]), label, row["front"] == "true", False


# Return marks from below the minimum value to above the maximum.
def marks(values, steps):
    at = [s * 10.0**e for e in range(-9, 9) for s in steps]
    low = max(m for m in at if m <= min(values))
    high = min(m for m in at if m >= max(values))
    return [m for m in at if low <= m <= high]


def panel(out, left, head, title, data, colors, style):
    across, down = marks([p[1] for p in data], style["across"]), marks([p[2] for p in data], style["down"])
    top, right, bottom = head + TOP, left + WIDTH - LEFT, head + HEIGHT - BOTTOM

    def place(x, y):
        share = lambda v, m: math.log(v / m[0]) / math.log(m[-1] / m[0])
        return left + share(x, across) * (right - left), bottom - share(y, down) * (bottom - top)

    out.append(f'<text x="{left}" y="{top - 14}" font-weight="bold">{title}</text>')
    for mark in across:
        x = place(mark, down[0])[0]
        out.append(f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{bottom}" stroke="#ddd"/>'
                   f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{mark:g}</text>')
    for mark in down:
        y = place(across[0], mark)[1]
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{style["mark"](mark)}</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{bottom + 34}" text-anchor="middle">{style["label"]}</text>')
    front = " ".join("%.1f,%.1f" % place(p[1], p[2]) for p in sorted((p for p in data if p[4]), key=lambda p: p[1]))
    if front:
        out.append(f'<polyline points="{front}" fill="none" stroke="#555" stroke-width="1.5"/>')
    for series, color in colors.items():
        own = sorted((p for p in data if p[0] == series), key=lambda p: p[1])
        if style["joined"]:
            path = " ".join("%.1f,%.1f" % place(p[1], p[2]) for p in own)
            out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.5"/>')
        for p in own:
            x, y = place(p[1], p[2])
            shown = style["joined"] or p[4]
            size = 'r="3"' if shown else 'r="2" fill-opacity="0.35"'
            text = f'<text x="{x + 5:.1f}" y="{y - 4:.1f}" fill="{color}" font-size="9">{p[3]}</text>' if shown else ""
            ring = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="none" stroke="{color}"/>' if p[5] else ""
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" {size} fill="{color}"/>{ring}{text}')


# Write one row of panels for each case. `cases` is a list of (name, function from a file to its
# points).
def write(path, files, colors, style, cases, unit):
    width, height = len(files) * (WIDTH + GAP), len(cases) * HEIGHT
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height + 24}" font-family="sans-serif" font-size="11">',
           '<rect width="100%" height="100%" fill="white"/>']
    seen = set()
    for k, (name, points) in enumerate(cases):
        for i, named in enumerate(files):
            title, _, file = named.partition("=")
            data = list(points(file))
            if not data:
                sys.exit(f"plot.py: {file} has no rows of {name or path}")
            seen |= {p[0] for p in data}
            panel(out, LEFT + i * (WIDTH + GAP), k * HEIGHT, f"{name}, {title}" if name else title, data, colors, style)
    for i, series in enumerate(s for s in colors if s in seen):
        x = LEFT + i * 100
        out.append(f'<circle cx="{x}" cy="{height + 10}" r="4" fill="{colors[series]}"/>'
                   f'<text x="{x + 9}" y="{height + 14}">{series}{unit if series == "1" else unit + "s" if unit else ""}</text>')
    if "ring" in style:
        x = LEFT + len(seen) * 100
        out.append(f'<circle cx="{x}" cy="{height + 10}" r="6" fill="none" stroke="#555"/>'
                   f'<text x="{x + 11}" y="{height + 14}">{style["ring"]}</text>')
    out.append("</svg>\n")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


# Parse NAME=CASE:VERTICES,...
def accuracy_cases(text):
    for named in text.split(","):
        name, _, case = named.rpartition("=")
        case, _, vertices = case.partition(":")
        yield name, lambda file, case=case, vertices=vertices: accuracy_points(file, case, vertices)


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 3 and arguments[0] == "accuracy":
        _, cases, path, *files = arguments
        style = {"across": (1,), "down": (1,), "mark": lambda m: f"{100 * m:g} %", "joined": True,
                 "label": "microseconds a strand and frame", "ring": "own setting"}
        write(path, files, SOLVERS, style, list(accuracy_cases(cases)), "")
    elif len(arguments) > 3 and arguments[0] == "render":
        _, case, path, *files = arguments
        style = {"across": (1, 2, 5), "down": (1, 2, 5), "mark": lambda m: f"{m:g}", "joined": False,
                 "label": "milliseconds a picture"}
        write(path, files, SAMPLES, style, [("", lambda file: render_points(file, case))], " sample")
    else:
        sys.exit(__doc__)


main()
