"""report.py - one page about run time and error, out of the JSON files of hair-bench

report.py OUT.html DIRECTORY... [--picture FILE=CAPTION]...

A directory holds what hair-bench wrote on one machine, SUITE.json each. They are copied beside the page.
"""
import base64
import io
import json
import pathlib
import shutil
import sys

import jinja2
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter
from suites import SUITES

# Colours of Okabe and Ito 2008, which all kinds of colour vision can distinguish. Markers serve
# readers who see no colours.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
SIGNIFICANT = 4


class Machine:
    def __init__(self, directory):
        self.directory, self.files = directory, {}
        for path in sorted(directory.glob("*.json")):
            with open(path, encoding="utf-8") as file:
                self.files[path.stem] = json.load(file)
        if not self.files:
            sys.exit(f"report.py: {directory} has no JSON file")
        first = next(iter(self.files.values()))
        self.name = short_name(first["renderer"])
        self.about = f'{first["renderer"]}; {first.get("processor", "")}, {first.get("cores", "?")} cores'
        self.version = first["version"]

    def rows(self, suite):
        return self.files.get(suite, {"rows": []})["rows"]


def short_name(renderer):
    return "llvmpipe" if "llvmpipe" in renderer else renderer.split("/")[0].split("(")[0].strip()


def number(value):
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.{SIGNIFICANT}g}"
    return str(value)


# Return whether a column has no column of its own. The minimum and maximum of a time are shown
# beside the time.
def is_of_another(column, columns):
    return column.endswith(("_min", "_max")) and column[:-4] in columns


def cell(row, column):
    text = number(row[column])
    if row.get(column + "_min") is not None and row.get(column + "_max") is not None:
        text += f' [{number(row[column + "_min"])}, {number(row[column + "_max"])}]'
    kind = "text" if isinstance(row[column], str) else ""
    if isinstance(row[column], bool) and column == "pass":
        kind, text = ("held", "held") if row[column] else ("missed", "missed")
    return {"text": text, "kind": kind}


def table(title, rows, folded, columns=None):
    columns = [c for c in columns or rows[0] if any(row.get(c) is not None for row in rows)]
    columns = [c for c in columns if not is_of_another(c, columns)]
    return {"title": title, "folded": folded,
            "columns": [{"title": c.replace("_", " "), "text": isinstance(rows[0][c], str)} for c in columns],
            "rows": [[cell(row, c) for c in columns] for row in rows]}


# Draw one panel per machine. `panels` is a list of (title, series). `series` maps a name to points
# (across, down, label, (minimum, maximum)). The range applies to `across`, or to `down` if
# style["spread"] is "down".
def plot(panels, style):
    panels = [p for p in panels if any(p[1].values())]
    if not panels:
        return None
    names = sorted({name for _, series in panels for name in series})
    columns = 1 if max(map(len, names)) > 24 else 2
    key = 0.2 * -(-len(names) // columns) + 0.2
    # Panels are stacked so that they are readable on a telephone. The legend is at the bottom.
    named = {p[1] for _, series in panels for points in series.values() for p in points if isinstance(p[1], str)}
    tall = max(3.6, 0.21 * len(named) + 1)
    figure, axes = plt.subplots(len(panels) + 1, 1, figsize=(4.8, tall * len(panels) + key), squeeze=False,
                                gridspec_kw={"height_ratios": [tall] * len(panels) + [key]})
    marks = {}
    for ax, (title, series) in zip(axes[:, 0], panels):
        for i, name in enumerate(names):
            points = series.get(name, [])
            if not points:
                continue
            look = {"color": COLORS[i % len(COLORS)], "marker": MARKERS[(i + i // len(COLORS)) % len(MARKERS)]}
            across, down = [p[0] for p in points], [p[1] for p in points]
            for p in points:
                if len(p) > 3 and p[3]:
                    spread = ([p[0]] * 2, p[3]) if style.get("spread") == "down" else (p[3], [p[1]] * 2)
                    ax.plot(*spread, color=look["color"], linewidth=1, alpha=0.5)
            marks[name], = ax.plot(across, down, linestyle="-" if style.get("joined") else "none", markersize=5, linewidth=1.2, **look)
            for p in points:
                if len(p) > 2 and p[2]:
                    ax.annotate(p[2], p[:2], xytext=(4, 4), textcoords="offset points", fontsize=7, color=look["color"])
        if "limit" in style:
            ax.axvline(style["limit"], color="black", linewidth=1, linestyle="--")
        scale = "linear" if style.get("linear") else "log"
        ax.set_xscale(scale)
        ax.xaxis.set_minor_formatter(NullFormatter())
        if named:
            ax.invert_yaxis()
            ax.tick_params(axis="y", labelsize=8)
        else:
            ax.set_yscale(scale)
            ax.yaxis.set_minor_formatter(NullFormatter())
        for axis, (low, high) in ((ax.xaxis, ax.get_xlim()), (ax.yaxis, ax.get_ylim())):
            # Powers of ten alone would give one mark or none.
            if axis.get_scale() == "log" and high < 30 * low:
                axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
                axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        ax.set(title=title, xlabel=style["across"], ylabel=style.get("down", ""))
        ax.grid(True, which="major", color="#ddd", linewidth=0.6)
    axes[-1, 0].axis("off")
    axes[-1, 0].legend([marks[n] for n in names if n in marks], [n for n in names if n in marks], fontsize=8, frameon=False,
                       loc="center", ncols=columns)
    figure.tight_layout()
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None})
    plt.close(figure)
    return out.getvalue()[out.getvalue().index("<svg"):]


def suite_of(entry, machines, out):
    files = []
    for machine in machines:
        if entry["name"] in machine.files:
            name = f'{machine.directory.name}-{entry["name"]}.json'
            shutil.copyfile(machine.directory / f'{entry["name"]}.json', out.parent / name)
            files.append(name)
    if not files:
        return None
    plots, tables = [], []
    for style in entry.get("plots", []):
        svg = plot([(m.name, style["series"](m.rows(entry["name"]))) for m in machines], style)
        if svg:
            plots.append({"svg": svg, "caption": style["caption"]})
    for machine in machines:
        rows = machine.rows(entry["name"])
        chosen = [row for row in rows if entry["shown"](row)] if "shown" in entry else []
        if chosen:
            tables.append(table(f'{machine.name}: {entry["shown_title"]}', chosen, False, entry.get("columns")))
        if rows:
            tables.append(table(f"{machine.name}: all {len(rows)} rows", rows, True))
    return {**entry, "plots": plots, "tables": tables, "files": files}


def picture(argument):
    path, _, caption = argument.partition("=")
    data = base64.b64encode(pathlib.Path(path).read_bytes()).decode()
    kind = "video/mp4" if path.endswith(".mp4") else "image/jpeg" if path.endswith((".jpg", ".jpeg")) else "image/png"
    return {"type": kind, "data": data, "caption": caption}


def main():
    arguments, pictures = sys.argv[1:], []
    while "--picture" in arguments:
        at = arguments.index("--picture")
        pictures.append(picture(arguments[at + 1]))
        del arguments[at:at + 2]
    if len(arguments) < 2:
        sys.exit(__doc__)
    out = pathlib.Path(arguments[0])
    out.parent.mkdir(parents=True, exist_ok=True)
    machines = [Machine(pathlib.Path(d)) for d in arguments[1:]]
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "hair", "font.size": 10, "font.family": "sans-serif"})
    suites = [s for s in (suite_of(entry, machines, out) for entry in SUITES) if s]
    page = jinja2.Environment(autoescape=True, trim_blocks=True).from_string(
        (pathlib.Path(__file__).parent / "page.html").read_text(encoding="utf-8"))
    out.write_text(page.render(version=machines[0].version, machines=machines, suites=suites, pictures=pictures), encoding="utf-8")


main()
