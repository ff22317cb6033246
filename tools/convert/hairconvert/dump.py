"""Reads dumps of hair-capture: positions of all strands in every frame."""

import os

import numpy as np

from hairconvert.groom import GROOM, STRAND, VERTEX, Attribute, Groom, Motion, check_counts
from hairconvert.report import InputError

HEADER = np.dtype([("name", "S8"), ("version", "<u4"), ("strands", "<u4"), ("vertices", "<u4"),
                   ("frames", "<u4"), ("first", "<u4"), ("followers", "<u4"), ("fps", "<f8")])
MAX_FRAMES = 1 << 20
SAME_ROOT = 1e-3  # distance of roots that belong to the same strand, m


def read(path, options, report):
    """Return the groom of a dump. Frames are read from the file when they are needed."""
    size = os.path.getsize(path)
    if size < HEADER.itemsize:
        raise InputError(f"the file of {size} bytes is shorter than the header of "
                         f"{HEADER.itemsize}")
    header = np.fromfile(path, HEADER, 1)[0]
    strands, vertices, frames = (int(header[n]) for n in ("strands", "vertices", "frames"))
    fps = float(header["fps"])
    if header["name"] != b"HAIRDUMP" or header["version"] != 1:
        raise InputError("the file is no dump of version 1 of hair-capture")
    check_counts(strands, strands * vertices)
    if not 1 <= frames <= MAX_FRAMES or not 1e-3 <= fps <= 1e6:
        raise InputError(f"the header claims {frames} frames, {fps:g} a second")
    if size != HEADER.itemsize + 12 * strands * vertices * frames:
        raise InputError(f"{frames} frames of {strands} strands with {vertices} vertices do not "
                         f"make the file of {size} bytes")
    data = np.memmap(path, "<f4", "r", HEADER.itemsize, (frames, strands * vertices, 3))
    times = (int(header["first"]) + np.arange(frames)) / fps
    index = 0
    if options.frame is not None:
        index = int(np.argmin(np.abs(times - options.frame)))
    groom = Groom(np.full(strands, vertices, np.int64), data[index].astype(np.float64),
                  format="dump")
    groom.attributes["guide"] = Attribute(GROOM, np.array([not header["followers"]], np.int32))
    groom.motion = Motion(times, lambda i: data[i].astype(np.float64))
    return groom


def add_attributes(groom, rest, report):
    """Give a groom with motion the attributes of the haircut that it came from, `rest`."""
    match = _match_roots(groom, rest)
    if match is None:
        report.say("no attributes of the haircut are used, because roots of the first frame lie "
                   "more than 1 mm from every root of the haircut")
        return
    for name, a in rest.attributes.items():
        if name in groom.attributes:
            continue
        values = a.values
        if name == "closest_guides":
            report.lose(f"the attribute {name}", "strands have other numbers in a dump")
            continue
        if a.scope == STRAND:
            values = values[match]
        elif a.scope == VERTEX:
            values = _spread(values, rest, match, groom)
        groom.attributes[name] = Attribute(a.scope, values, a.role)


def _match_roots(groom, rest):
    """Return the strand of the haircut of each strand, or None if a root has no partner."""
    roots, others = groom.points[groom.starts()], rest.points[rest.starts()]
    if len(roots) == len(others) and (np.abs(roots - others) <= SAME_ROOT).all():
        return np.arange(len(roots))
    # Roots in the same cell of a grid, or in a neighbouring cell, can be partners.
    cells = {}
    for i, cell in enumerate(np.floor(others / SAME_ROOT).astype(np.int64).tolist()):
        cells.setdefault(tuple(cell), []).append(i)
    steps = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    match = np.zeros(len(roots), np.int64)
    for i, cell in enumerate(np.floor(roots / SAME_ROOT).astype(np.int64).tolist()):
        near = [j for s in steps for j in cells.get((cell[0] + s[0], cell[1] + s[1],
                                                     cell[2] + s[2]), ())]
        if not near:
            return None
        match[i] = near[int(np.argmin(((others[near] - roots[i]) ** 2).sum(axis=1)))]
    return match


def _spread(values, rest, match, groom):
    """Return values per vertex at the same fractions of strands with other numbers of vertices."""
    starts, counts = rest.starts()[match], rest.counts[match]
    each = int(groom.counts[0])
    at = np.linspace(0, 1, each)[None, :] * (counts - 1)[:, None]
    before = np.minimum(at.astype(np.int64), (counts - 2)[:, None])
    t = at - before
    before = (before + starts[:, None]).ravel()
    if values.dtype.kind != "f":
        return values[before + (t.ravel() >= 0.5)]
    t = t.reshape(-1, *[1] * (values.ndim - 1))
    return (values[before] * (1 - t) + values[before + 1] * t).astype(values.dtype)
