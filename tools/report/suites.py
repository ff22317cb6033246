"""suites.py - what the page says of each suite of hair-bench: its plots, and the rows that are shown unfolded"""


def grouped(rows, key, point):
    series = {}
    for row in rows:
        value = point(row)
        if value:
            series.setdefault(key(row), []).append(value)
    return {name: sorted(points, key=lambda p: p[0]) for name, points in series.items()}


def bounds(row, column, by=1.0):
    low, high = row.get(column + "_min"), row.get(column + "_max")
    return (low * by, high * by) if low and high else None


def accuracy(case, vertices):
    def point(row, vertices):
        if row["case"] != case or row["vertices"] != vertices or not row["us_per_strand"] or not row["rms_error"]:
            return None
        by = row["us_per_strand"] / row["ms"] if row["ms"] else 0
        return row["us_per_strand"], row["rms_error"], f'{row["iterations"] or row["substeps"]:g}', bounds(row, "ms", by)

    def name(row):
        return row["method"] if row["measured_by"] == "here" else f'{row["method"]} ({row["measured_by"]})'

    # Quick runs have fewer vertices.
    def series(rows):
        there = {row["vertices"] for row in rows if row["case"] == case}
        most = vertices if vertices in there else max(there, default=0)
        return grouped(rows, name, lambda row: point(row, most))

    return series


def peers(rows):
    def point(row):
        return (row["us_per_strand"], row["rms_mm"], f'{row["iterations"] or row["substeps"] or 0:g}') \
            if row["case"] == "swing" and row["us_per_strand"] and row["rms_mm"] else None

    return grouped(rows, lambda row: row["method"] if row["measured_by"] == "here" else f'{row["method"]} ({row["measured_by"]})', point)


def render(case):
    def point(row):
        if row["case"] != case or not row["flip"] or not row["ms"]:
            return None
        label = f'{row["lod"]}, {row["segments"]}' if row["front"] else ""
        return row["ms"], row["flip"], label, bounds(row, "ms")

    return lambda rows: grouped(rows, lambda row: f'{row["samples"]} samples' + (", lines" if row["primitive"] == "lines" else ""), point)


def against_limit(rows):
    def point(row):
        return (max(row["relative_error"], 1e-9) / row["limit"], row["case"].replace("_", " ")) if row["limit"] else None

    return by_case(grouped(rows, lambda row: row["method"], point))


def followers(motion):
    def point(row):
        is_ours = row["case"].startswith(motion) and row["ms"] and row["rms_error"]
        return (row["ms"], row["rms_error"], f'{row["guides"]}') if is_ours else None

    return lambda rows: grouped(rows, lambda row: row["case"].partition(" ")[2], point)


def stretch(rows):
    return by_case(grouped(rows, lambda row: row["method"],
                           lambda row: (max(row["max_stretch"], 1e-7), row["case"].replace("_", " ")) if row["max_stretch"] is not None else None))


def by_case(series):
    return {name: sorted(points, key=lambda p: p[1]) for name, points in series.items()}


def cost(case, column):
    def point(row):
        count = row["guides"] if case == "guides" else row["followers"]
        return (count, row[column], "", bounds(row, column)) if row["case"] == case and row[column] else None

    return lambda rows: grouped(rows, lambda row: "a step" if column == "ms_step" else "a picture", point)


def divergence(rows):
    # Join points of each relaxation setting, because a line per method alone would jump between
    # settings.
    return grouped(rows, lambda row: f'{row["method"]}, {row["relax"] or 0:g}',
                   lambda row: (row["ms"], row["divergence"], "", bounds(row, "ms")) if row["divergence"] and row["ms"] else None)


def through_a_ball(rows):
    def point(row):
        return (row["along"], row["speed"]) if row.get("along") is not None else None

    # Use one line for each side of the ball, because a single line would cross the ball.
    return grouped(rows, lambda row: f'{row["method"]}, {row["resolution"]} cells, {"behind" if (row.get("along") or 0) > 0 else "before"}', point)


def step_in_wind(rows):
    return grouped(rows, lambda row: row["method"], lambda row: (row["ms"], row["method"], "", bounds(row, "ms")) if row["case"] == "a step in wind" else None)


def with_and_without(rows):
    return grouped(rows, lambda row: row["scene"], lambda row: (row["ms_all"], row["ms"]) if row.get("ms_all") and row.get("ms") else None)


def over_floor(rows):
    return grouped(rows, lambda row: row["bound"], lambda row: (row["ms"], row["of_floor"], row["method"] if row["case"] == "demo" else "")
                   if row.get("of_floor") else None)


def missed(row):
    return row.get("pass") is False


SUITES = [
    {
        "name": "accuracy", "title": "Motion",
        "text": "A frame of <code>hair_step</code> against how far strands are from the same rod in double precision, converged. "
                "The numbers are substeps a frame, of <code>redblack</code> (the whitepaper's relaxation) iterations.",
        "plots": [
            {"series": accuracy("shake", 32), "joined": True, "across": "microseconds a strand and frame", "down": "rms error, lengths of a strand",
             "caption": "A head shaken for a second."},
            {"series": accuracy("contact", 32), "joined": True, "across": "microseconds a strand and frame", "down": "rms error, lengths of a strand",
             "caption": "The same among colliders."},
            {"series": peers, "across": "microseconds a strand and frame", "down": "rms error, mm",
             "caption": "The swing of other systems beside this one's; who measured what is in brackets."},
        ],
        "shown": lambda row: row.get("front") is True, "shown_title": "what nothing beats",
        "columns": ["case", "vertices", "method", "substeps", "iterations", "us_per_strand", "rms_error", "max_stretch", "ms", "runs"],
    },
    {
        "name": "physics", "title": "Known rods and chains",
        "text": "What is known in closed form or to many digits: the heavy elastica, chains, pendulums, the catenary, buckling, energy.",
        "plots": [{"series": against_limit, "across": "error, as a fraction of its limit", "limit": 1,
                   "caption": "Left of the line the limit is held."}],
        "shown": missed, "shown_title": "limits that are missed",
    },
    {
        "name": "stability", "title": "What no scene should ask",
        "text": "Stresses: frames of a second, teleports, masses of 1,000 to 1, coincident vertices, random scenes. Nothing may be infinite, "
                "nothing stretched by more than 2 %, and everything at rest again three seconds later.",
        "plots": [{"series": stretch, "across": "greatest stretch", "limit": 0.02, "caption": "The line: what is allowed."}],
        "shown": missed, "shown_title": "what did not pass",
    },
    {
        "name": "render", "title": "Pictures",
        "text": "Milliseconds of a picture against its FLIP (Andersson et al. 2020) from the same hair at 1,024 samples a pixel, over what hair "
                "covers and 8 pixels around.",
        "plots": [{"series": render("long"), "across": "milliseconds a picture", "down": "FLIP",
                   "caption": "What nothing beats is labelled by its fraction of the strands and its segments."}],
        "shown": lambda row: row.get("front") is True, "shown_title": "what nothing beats",
        "columns": ["case", "method", "primitive", "lod", "segments", "samples", "ms", "flip", "psnr", "coverage_error", "runs"],
    },
    {"name": "shadow", "title": "Light through hair", "text": "Ways to tell how much light hair leaves to itself, against strands counted ray by ray."},
    {
        "name": "table", "title": "The whitepaper's table",
        "text": "Frames a second of the eight cells of Tariq 2010, on its GeForce GTX 480 and here.",
        "shown": lambda row: True, "shown_title": "its cells, and how this library is set by default",
        "columns": ["case", "method", "fps", "paper_fps", "ms", "to_near", "paper_to_near", "flip", "runs"],
    },
    {"name": "paths", "title": "Paths of drawing", "text": "A frame, moved and drawn, by each path; <code>auto</code> is what the library takes.",
     "shown": lambda row: True, "shown_title": "each path"},
    {
        "name": "scale", "title": "How cost grows",
        "text": "A step by the number of guides, a picture by the number of followers.",
        "plots": [{"series": cost("guides", "ms_step"), "joined": True, "spread": "down", "across": "guides", "down": "milliseconds", "caption": "A step."},
                  {"series": cost("followers", "ms_draw"), "joined": True, "spread": "down", "across": "followers", "down": "milliseconds", "caption": "A picture."}],
    },
    {
        "name": "bounds", "title": "What holds it up",
        "text": "Kinds of work of a frame on a GPU: their time, and how many times that is of what it cannot be less than: what launching their "
                "passes takes, or moving all of the memory that is theirs once. What is neither is held up by latency, where four times as much "
                "work takes less than twice as long, or else by arithmetic; draws by vertices, where a quarter of the pixels takes nearly as long, or by pixels.",
        "plots": [{"series": over_floor, "across": "milliseconds", "down": "times its floor", "caption": "Kinds of work by what holds them up."}],
        "shown": lambda row: True, "shown_title": "each kind of work",
        "columns": ["case", "method", "pass", "ms", "floor_ms", "of_floor", "bound", "ms_more", "ms_small", "bytes", "runs"],
    },
    {"name": "lod", "title": "Level of detail", "text": "Fewer, wider strands against all of them: coverage, calm of a walk away, the picture far off."},
    {
        "name": "followers", "title": "Interpolated strands",
        "text": "Strands that are interpolated between guides, against every strand simulated. The numbers are guides.",
        "plots": [{"series": followers(motion), "joined": True, "across": "milliseconds a frame", "down": "rms error, lengths of a strand",
                   "caption": f"The motion {motion}."} for motion in ("shake", "contact", "wind")],
    },
    {"name": "collision", "title": "Colliders", "text": "Followers inside a body though no guide is; finding them; worlds of many objects.",
     "shown": missed, "shown_title": "limits that are missed"},
    {"name": "field", "title": "The field", "text": "Colliders as a texture of signed distance, against their exact distances; errors in voxels.",
     "shown": missed, "shown_title": "limits that are missed"},
    {
        "name": "wind", "title": "Wind",
        "text": "The fluid around the head: what a projection takes and what divergence it leaves; flows whose shape is known.",
        "plots": [{"series": divergence, "joined": True, "across": "milliseconds", "down": "divergence left, as a fraction",
                   "caption": "Projections, each with as much relaxation as its number says, by more and more cycles or iterations."},
                  {"series": through_a_ball, "joined": True, "across": "radii down the wind from a ball's middle", "down": "speed, by the wind's", "linear": True,
                   "caption": "Air by formulas, and the mean of the fluid."},
                  {"series": step_in_wind, "across": "milliseconds", "caption": "A step of 64 strands around a ball."}],
        "shown": missed, "shown_title": "limits that are missed",
    },
    {
        "name": "heads", "title": "Many heads in one view",
        "text": "Heads that all shake, stepped and drawn by single calls and by lists. Far heads are about 30 pixels large.",
        "plots": [], "shown": lambda row: True, "shown_title": "the heads",
    },
    {
        "name": "skip", "title": "What a scene does not need",
        "text": "Scenes in pairs, with the thing and without: what is not there is not paid for.",
        "plots": [{"series": with_and_without, "across": "milliseconds with it", "down": "milliseconds without", "caption": "Each pair of scenes."}],
        "shown": lambda row: True, "shown_title": "the pairs",
    },
]
