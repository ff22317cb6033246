#!/usr/bin/env python3
"""plot.py - plots of time against error, as SVG, from the CSV and JSON files of hair-bench

plot.py accuracy OUT.svg TITLE=FILE:CASE:VERTICES[:stretch]...   every solver at every setting, beside other libraries
plot.py render CASE OUT.svg TITLE=FILE...                        every way to draw, with the best of them labelled
plot.py followers OUT.svg TITLE=FILE:MOTION...                   interpolated strands of every haircut

Each TITLE makes one panel, and a row has two panels. All axes are logarithmic. `stretch` plots the greatest stretch instead of the error.
"""
import csv
import json
import math
import sys

PANELS_PER_ROW = 2
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 500, 380, 74, 24, 34, 48
FONT, SMALL = 11, 9
SOLVERS = {"redblack": "#c0392b", "direct": "#2471a3", "accurate": "#1e8449", "follow": "#9a7d0a"}
HAIRCUTS = {"straight": "#2471a3", "wavy": "#1e8449", "curly": "#9a7d0a", "coily": "#c0392b"}
SAMPLES = {"1": "#c0392b", "4": "#9a7d0a", "8": "#7d3c98", "16": "#2471a3", "32": "#1e8449", "64": "#1e8449"}
PEER = "#555555"
TIME_OF_A_STRAND = "time of a frame, microseconds per strand"


class Series:
    """Points of one color. `points` has tuples (across, down, label, is_labelled, has_ring)."""

    def __init__(self, name, color, points, is_joined=True, is_hollow=False):
        self.name, self.color, self.points, self.is_joined, self.is_hollow = name, color, points, is_joined, is_hollow


class Panel:
    """Axes with their titles, series, the line of the front, and levels whose time is unknown."""

    def __init__(self, title, across, down, series, mark, steps, front=(), levels=()):
        self.title, self.across, self.down, self.series = title, across, down, series
        self.mark, self.steps, self.front, self.levels = mark, steps, front, levels


def number(value):
    return float(value) if value not in (None, "") else None


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        yield from json.load(file)["rows"] if path.endswith(".json") else csv.DictReader(file)


# Return marks from below the minimum value to above the maximum.
def marks(values, steps):
    at = [s * 10.0**e for e in range(-9, 9) for s in steps]
    low = max(m for m in at if m <= min(values))
    high = min(m for m in at if m >= max(values))
    return [m for m in at if low <= m <= high]


# Return "20" or "20 to 80" and the unit.
def span(counts, unit):
    low, high = min(counts), max(counts)
    return f"{low:g}" + (f" to {high:g}" if high > low else "") + f" {unit}"


# Return other libraries, one series for each, and the levels of those whose time is unknown. The
# name of a library is the part of its method before the first comma.
def peers(data, column):
    found, levels = {}, []
    for row in data:
        value = number(row[column])
        if row["measured_by"] != "elsewhere" or value is None:
            continue
        if number(row["us_per_strand"]) is None:
            levels.append((value, row["method"]))
        else:
            found.setdefault(row["method"].partition(",")[0], []).append(row)
    series = []
    for name, group in found.items():
        group.sort(key=lambda row: (number(row["us_per_strand"]), number(row[column])))
        substeps, iterations = ({number(row[key]) for row in group} for key in ("substeps", "iterations"))
        text = f"{name}, " + (span(substeps, "substeps") if len(substeps) > 1 or len(iterations) == 1 else span(iterations, "iterations"))
        points = [(number(row["us_per_strand"]), number(row[column]), text, True, False) for row in group]
        series.append(Series(name, PEER, points, is_hollow=True))
    return series, levels


def accuracy_panel(argument):
    title, _, place = argument.partition("=")
    path, case, vertices, *column = place.split(":")
    column = "max_stretch" if column == ["stretch"] else "rms_error"
    data = [row for row in rows(path) if row["case"] == case and str(row["vertices"]) == vertices]
    if not data:
        sys.exit(f"plot.py: {path} has no rows of {case} with {vertices} vertices")
    series, levels = peers(data, column)
    for name, color in SOLVERS.items():
        points = []
        for row in data:
            if row["measured_by"] == "here" and row["method"] == name and number(row[column]) is not None:
                count = number(row["iterations"]) or number(row["substeps"])
                points.append((number(row["us_per_strand"]), number(row[column]), f"{count:g}", True, row.get("default") in ("true", True)))
        # Lines join settings in their order, because times vary from run to run.
        points.sort(key=lambda p: (float(p[2]), p[0]))
        series.append(Series(name, color, points))
    down = "greatest stretch, % of the length" if column == "max_stretch" else "RMS error, % of the length"
    return Panel(title, TIME_OF_A_STRAND, down, series, lambda m: f"{100 * m:.12g}", (1,), levels=levels)


def render_panel(argument, case):
    title, _, path = argument.partition("=")
    data = [row for row in rows(path) if row["case"] == case and number(row["flip"]) is not None]
    if not data:
        sys.exit(f"plot.py: {path} has no rows of {case}")
    series, front = [], []
    for samples, color in SAMPLES.items():
        points = []
        for row in data:
            if str(row["samples"]) == samples:
                is_front = row["front"] in ("true", True)
                strands = "per patch" if row["lod"] == "dynamic" else row["lod"]
                label = f'{strands}, {row["segments"]}' + (", lines" if row["primitive"] == "lines" else "")
                points.append((number(row["ms"]), number(row["flip"]), label, is_front, False))
                front += [points[-1][:2]] if is_front else []
        if points:
            series.append(Series(f"{samples} sample" + ("" if samples == "1" else "s"), color, points, is_joined=False))
    return Panel(title, "time of a picture, ms", "FLIP error, 0 for equal pictures", series, lambda m: f"{m:g}", (1, 2, 5), sorted(front))


def followers_panel(argument):
    title, _, place = argument.partition("=")
    path, motion = place.split(":")
    series = []
    for name, color in HAIRCUTS.items():
        data = [row for row in rows(path) if row["case"] == f"{motion} {name}"]
        points = [(number(row["ms"]), number(row["rms_error"]), row["guides"], True, False) for row in data]
        points.sort(key=lambda p: float(p[2]))
        if points:
            series.append(Series(name, color, points))
    if not series:
        sys.exit(f"plot.py: {path} has no rows of {motion}")
    return Panel(title, "time of a frame, ms", "RMS error, % of the length", series, lambda m: f"{100 * m:.12g}", (1, 2, 5))


def overlap(a, b):
    wide, high = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return wide * high if wide > 0 and high > 0 else 0


# Return boxes along a line from one point to another.
def boxes_along(a, b):
    count = max(1, int(math.hypot(b[0] - a[0], b[1] - a[1]) / 4))
    for i in range(count):
        x, y = a[0] + (b[0] - a[0]) * i / count, a[1] + (b[1] - a[1]) * i / count
        yield x - 1, y - 1, x + 1, y + 1


# Return the point of a box that is nearest to a point.
def nearest(point, box):
    return min(max(point[0], box[0]), box[2]), min(max(point[1], box[1]), box[3])


def text_width(text):
    return 0.56 * SMALL * len(text)


# Draw a label in a box, with a white halo so that lines behind it do not disturb.
def draw_label(out, box, text, color):
    out.append(f'<text x="{box[0]:.1f}" y="{box[3] - 1:.1f}" fill="{color}" font-size="{SMALL}" stroke="white" '
               f'stroke-width="2.5" paint-order="stroke">{text}</text>')


# Return the cost and the box of a text in the least covered place around a point, within bounds. `taken` has
# boxes of everything drawn so far, `texts` those of labels, which no leader may cross.
def place_label(point, text, bounds, taken, texts):
    wide, high = text_width(text), SMALL
    best, least = (point[0] + 5, point[1] - high, point[0] + 5 + wide, point[1]), math.inf
    for ring, radius in enumerate((6, 12, 20, 30, 42, 56, 72, 90, 110)):
        for k in range(16):
            angle = math.pi * (k / 8 - 0.25)
            x, y = point[0] + radius * math.cos(angle), point[1] + radius * math.sin(angle)
            # The nearest side or corner of the box touches the circle.
            left = x - wide * (1 - math.cos(angle)) / 2
            top = y - high * (1 - math.sin(angle)) / 2
            box = (left, top, left + wide, top + high)
            if box[0] < bounds[0] or box[1] < bounds[1] or box[2] > bounds[2] or box[3] > bounds[3]:
                continue
            cost = sum(overlap(box, other) for other in taken) + 0.5 * ring
            cost += 10 * sum(overlap(dot, other) for dot in boxes_along(point, nearest(point, box)) for other in texts)
            if cost < least:
                best, least = box, cost
    return least, best


def draw_panel(out, left, head, panel):
    top, right, bottom, left = head + TOP, left + WIDTH - RIGHT, head + HEIGHT - BOTTOM, left + LEFT
    points = [p for s in panel.series for p in s.points]
    across = marks([p[0] for p in points], panel.steps)
    down = marks([p[1] for p in points if p[1] > 0] + [level for level, _ in panel.levels], panel.steps)

    # Values that are 0 are drawn on the lower edge.
    def place(x, y):
        part = lambda v, m: math.log(max(v, m[0]) / m[0]) / math.log(m[-1] / m[0])
        return left + part(x, across) * (right - left), bottom - part(y, down) * (bottom - top)

    out.append(f'<text x="{left}" y="{top - 14}" font-weight="bold">{panel.title}</text>')
    for mark in across:
        x = place(mark, down[0])[0]
        out.append(f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{bottom}" stroke="#ddd"/>'
                   f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{mark:g}</text>')
    for mark in down:
        y = place(across[0], mark)[1]
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="#ddd"/>'
                   f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{panel.mark(mark)}</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{bottom + 36}" text-anchor="middle">{panel.across}</text>')
    x, y = left - 56, (top + bottom) / 2
    out.append(f'<text x="{x}" y="{y}" text-anchor="middle" transform="rotate(-90 {x} {y})">{panel.down}</text>')

    taken, texts, shown = [], [], []
    for level, _ in panel.levels:
        y = place(across[0], level)[1]
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="{PEER}" stroke-dasharray="5 3"/>')
        taken.append((left, y - 1, right, y + 1))
    lines = [([place(*p[:2]) for p in s.points], s.color, s.is_hollow) for s in panel.series if s.is_joined]
    if panel.front:
        lines.append(([place(*p) for p in panel.front], "#555", False))
    for line, color, is_dashed in lines:
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in line)
        dash = ' stroke-dasharray="2 3"' if is_dashed else ""
        out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.5"{dash}/>')
        for a, b in zip(line, line[1:]):
            taken += boxes_along(a, b)
    for s in panel.series:
        for p in s.points:
            x, y = place(*p[:2])
            is_strong = s.is_joined or p[3]
            size = 'r="3.2"' if is_strong else 'r="1.8" fill-opacity="0.3"'
            paint = f'fill="white" stroke="{s.color}" stroke-width="1.5"' if s.is_hollow else f'fill="{s.color}"'
            ring = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6.5" fill="none" stroke="{s.color}"/>' if p[4] else ""
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" {size} {paint}/>{ring}')
            reach = 6.5 if p[4] else 4 if is_strong else 1
            taken.append((x - reach, y - reach, x + reach, y + reach))
            # Two settings at one place are labelled once, and so is a library, at any of its points.
            same = [at for name, text, at in shown if (name, text) == (s.name, p[2]) and (s.is_hollow or math.dist(at[0], (x, y)) < 16)]
            if same:
                same[0].append((x, y))
            elif p[3]:
                shown.append((s.name, p[2], [(x, y)]))
    for level, text in panel.levels:
        y, wide = place(across[0], level)[1], text_width(text)
        places = [(x, at, x + wide, at + SMALL) for x in range(int(right - wide - 4), left + 4, -4) for at in (y - SMALL - 3, y + 3)]
        box = min(places, key=lambda box: sum(overlap(box, other) for other in taken))
        taken.append(box)
        texts.append(box)
        draw_label(out, box, text, PEER)
    colors = {s.name: s.color for s in panel.series}
    for name, text, at in sorted(shown, key=lambda label: -len(label[1])):
        places = [(place_label(point, text, (left + 2, top + 2, right - 2, bottom - 2), taken, texts), point) for point in at]
        (_, box), point = min(places)
        end = nearest(point, box)
        taken.append(box)
        texts.append(box)
        if math.hypot(end[0] - point[0], end[1] - point[1]) > 9:
            taken += boxes_along(point, end)
            out.append(f'<line x1="{point[0]:.1f}" y1="{point[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}" stroke="{colors[name]}" stroke-width="0.5"/>')
        draw_label(out, box, text, colors[name])


# Write the panels, and below them a key of the series and lines of notes.
def write(path, panels, notes):
    across, count = min(PANELS_PER_ROW, len(panels)), -(-len(panels) // PANELS_PER_ROW)
    width, height = across * WIDTH, count * HEIGHT
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height + 26 + 16 * len(notes)}" font-family="sans-serif" font-size="{FONT}">',
           '<rect width="100%" height="100%" fill="white"/>']
    for i, panel in enumerate(panels):
        draw_panel(out, i % PANELS_PER_ROW * WIDTH, i // PANELS_PER_ROW * HEIGHT, panel)
    named = {s.name: s for panel in panels for s in panel.series if not s.is_hollow}
    keys = [(name, s.color, "none") for name, s in named.items()]
    keys += [("other libraries", "white", PEER)] if any(s.is_hollow for panel in panels for s in panel.series) else []
    keys += [("a solver's own setting", "none", "#555")] if any(p[4] for panel in panels for s in panel.series for p in s.points) else []
    x = LEFT
    for name, fill, stroke in keys:
        radius = 6.5 if fill == "none" else 4
        out.append(f'<circle cx="{x}" cy="{height + 10}" r="{radius}" fill="{fill}" stroke="{stroke}"/>'
                   f'<text x="{x + 11}" y="{height + 14}">{name}</text>')
        x += 40 + 6.5 * len(name)
    for i, note in enumerate(notes):
        out.append(f'<text x="{LEFT - 4}" y="{height + 34 + 16 * i}">{note}</text>')
    out.append("</svg>\n")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 2 and arguments[0] == "accuracy":
        panels = [accuracy_panel(argument) for argument in arguments[2:]]
        notes = ["Numbers at points: substeps per frame. For redblack: iterations."]
        if any(s.is_hollow for panel in panels for s in panel.series):
            notes.append("Other libraries: one thread of a CPU that is not recorded, each against its own converged chain.")
        if any(panel.levels for panel in panels):
            notes.append("Dashed lines: libraries whose time is unknown.")
        if any(p[1] == 0 for panel in panels for s in panel.series for p in s.points):
            notes.append("A point on the lower edge is 0.")
        write(arguments[1], panels, notes)
    elif len(arguments) > 3 and arguments[0] == "render":
        panels = [render_panel(argument, arguments[1]) for argument in arguments[3:]]
        write(arguments[2], panels,
              ["Labels: drawn fraction of the strands, segments per strand. The line joins the settings that no other beats in both time and error."])
    elif len(arguments) > 2 and arguments[0] == "followers":
        write(arguments[1], [followers_panel(argument) for argument in arguments[2:]],
              ["Numbers at points: guides.", "The last point of a line has every strand as a guide."])
    else:
        sys.exit(__doc__)


main()
