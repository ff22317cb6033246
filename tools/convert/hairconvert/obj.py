"""OBJ files: polylines as strands, faces as a scalp."""

import numpy as np

from hairconvert.groom import MAX_VERTICES, Groom, check_counts
from hairconvert.report import InputError

MAX_TEXT = 1 << 32


def join_lines(data):
    """Return the lines of a text. A backslash at the end of a line continues the line."""
    return data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").splitlines()


def read_vectors(lines, key, components):
    """Return the first `components` numbers of all lines that begin with `key`."""
    rows = [line for line in lines if line.startswith(key)]
    if len(rows) > MAX_VERTICES:
        raise InputError(f"the file has {len(rows)} vertices, more than {MAX_VERTICES}")
    if not rows:
        return np.zeros((0, components))
    each = len(rows[0].split()) - 1
    try:
        tokens = b" ".join(rows).split()
        if len(tokens) == len(rows) * (each + 1) and each >= components:
            table = np.array(tokens).reshape(len(rows), each + 1)
            return table[:, 1:components + 1].astype(np.float64)
        return np.array([[float(t) for t in row.split()[1:components + 1]] for row in rows],
                        np.float64).reshape(len(rows), components)
    except ValueError:
        raise InputError(f"a line {key.decode().strip()} is not {components} numbers") from None


def read(data, options, report):
    """Return the groom of the polylines of an OBJ file."""
    lines = join_lines(data)
    points = read_vectors(lines, b"v ", 3)
    polylines, before = [], 0
    for line in lines:
        if line.startswith(b"v "):
            before += 1
        elif line.startswith(b"l "):
            polylines.append(_indices(line, before, len(points)))
    if not polylines:
        raise InputError("the file has no polyline, which is a line that begins with l")
    return _to_groom(points, _join(polylines))


def _indices(line, before, count):
    """Return the vertices of a polyline. Negative numbers count from the vertices so far."""
    try:
        numbers = np.array([int(t.split(b"/")[0]) for t in line.split()[1:]], np.int64)
    except (ValueError, OverflowError):
        raise InputError("a polyline has a vertex that is not a whole number") from None
    numbers = np.where(numbers < 0, numbers + before, numbers - 1)
    if len(numbers) and (numbers.min() < 0 or numbers.max() >= count):
        raise InputError(f"a polyline has a vertex outside of the {count} vertices")
    return numbers


def _join(polylines):
    """Join polylines of which one begins where the one before ends."""
    joined = []
    for p in polylines:
        if len(p) == 0:
            continue
        if joined and joined[-1][-1][-1] == p[0] and len(p) > 1:
            joined[-1].append(p[1:])
        else:
            joined.append([p])
    return [np.concatenate(parts) for parts in joined]


def _to_groom(points, polylines):
    counts = np.array([len(p) for p in polylines], np.int64)
    check_counts(len(counts), int(counts.sum()))
    return Groom(counts, points[np.concatenate(polylines)], format="obj")


def write(groom, path, options, report):
    """Write the strands as polylines."""
    numbers = np.arange(1, len(groom.points) + 1)
    with open(path, "w", encoding="ascii") as file:
        file.write("# Strands of hair as polylines, from root to tip.\n")
        np.savetxt(file, groom.points, fmt="v %.9g %.9g %.9g")
        for start, count in zip(groom.starts().tolist(), groom.counts.tolist()):
            file.write("l " + " ".join(map(str, numbers[start:start + count].tolist())) + "\n")
    for name in groom.attributes:
        report.lose(f"the attribute {name}", "an OBJ file holds only positions")
