"""The model of a haircut that every reader fills and every writer takes.

Positions are in metres, +y is up, and strands run from root to tip. Colours are linear.
"""

import dataclasses

import numpy as np

from hairconvert.names import FACTORS
from hairconvert.report import InputError

MAX_STRANDS = 1 << 24  # The limits of the library.
MAX_VERTICES = 1 << 26

# Scopes of an attribute: one value for all, one per strand, one per vertex.
GROOM, STRAND, VERTEX = "groom", "strand", "vertex"

# Components, 0 for any number, and kinds of numbers of attributes with a meaning.
KNOWN = {"width": (1, "f"), "color": (3, "f"), "opacity": (1, "f"), "roughness": (1, "f"),
         "root_uv": (2, "f"), "group": (1, "iub"), "group_name": (1, "U"), "guide": (1, "iub"),
         "id": (1, "iu"), "closest_guides": (0, "iu"), "guide_weights": (0, "f"),
         "vertex_uv": (2, "f"), "tfx_thickness": (1, "f"), **{f: (1, "fiub") for f in FACTORS}}
OF_STRANDS = ("root_uv", "group", "group_name", "guide", "id", "closest_guides", "guide_weights",
              "tfx_thickness", *FACTORS)


@dataclasses.dataclass
class Attribute:
    """Values of one name. Row i belongs to the groom, to strand i or to vertex i."""

    scope: str
    values: np.ndarray  # (n,) or (n, components). Strings have a dtype of kind U.
    role: str = ""  # "color", "uv", "point", "vector", "normal" or empty

    def rows(self):
        """Return the number of values."""
        return len(self.values)


@dataclasses.dataclass
class Motion:
    """Positions of all vertices at several times. `read(i)` returns those of frame i, (n, 3)."""

    times: np.ndarray  # s, ascending
    read: object

    def __len__(self):
        return len(self.times)


@dataclasses.dataclass
class Groom:
    """Strands with their attributes."""

    counts: np.ndarray  # vertices of each strand, int64
    points: np.ndarray  # (n, 3) float64, strand after strand, m
    attributes: dict = dataclasses.field(default_factory=dict)
    motion: Motion = None
    format: str = ""
    unit: float = None  # metres of a unit of the file, None if the file does not tell
    up: str = None  # axis of the file that points up
    scalp: object = None  # Mesh on which the strands grow

    def strand_count(self):
        """Return the number of strands."""
        return len(self.counts)

    def vertex_count(self):
        """Return the number of vertices of all strands."""
        return len(self.points)

    def starts(self):
        """Return the first vertex of each strand."""
        return np.cumsum(self.counts) - self.counts

    def strand_of_vertex(self):
        """Return the strand of each vertex."""
        return np.repeat(np.arange(len(self.counts)), self.counts)

    def rows_of(self, scope):
        """Return the number of rows of an attribute of a scope."""
        return {GROOM: 1, STRAND: len(self.counts), VERTEX: len(self.points)}[scope]

    def values(self, name, scope):
        """Return the values of an attribute at a scope that is as fine or finer, or None."""
        attribute = self.attributes.get(name)
        if attribute is None:
            return None
        return widen(attribute, scope, self)


def widen(attribute, scope, groom):
    """Return the values of an attribute repeated to a finer scope."""
    values = attribute.values
    if attribute.scope == scope:
        return values
    if attribute.scope == GROOM:
        return np.repeat(values, groom.rows_of(scope), axis=0)
    if attribute.scope == STRAND and scope == VERTEX:
        return np.repeat(values, groom.counts, axis=0)
    raise ValueError(f"{attribute.scope} is finer than {scope}")


def check_counts(strands, vertices):
    """Refuse counts that the library refuses."""
    if strands < 1:
        raise InputError("the file has no strands")
    if strands > MAX_STRANDS:
        raise InputError(f"the file claims {strands} strands, more than {MAX_STRANDS}")
    if vertices > MAX_VERTICES:
        raise InputError(f"the file claims {vertices} vertices, more than {MAX_VERTICES}")


def select(groom, keep):
    """Return the groom with only the strands whose entry of `keep` is true."""
    if keep.all():
        return groom
    vertices = np.repeat(keep, groom.counts)
    attributes = {}
    for name, a in groom.attributes.items():
        chosen = {GROOM: slice(None), STRAND: keep, VERTEX: vertices}[a.scope]
        attributes[name] = Attribute(a.scope, a.values[chosen], a.role)
    motion = groom.motion
    if motion:
        motion = Motion(motion.times, lambda i, read=motion.read: read(i)[vertices])
    _renumber_guides(attributes, keep)
    return Groom(groom.counts[keep], groom.points[vertices], attributes, motion, groom.format,
                 scalp=groom.scalp)


def _renumber_guides(attributes, keep):
    """Let closest_guides name the strands that are left. A guide that is gone becomes -1."""
    closest = attributes.get("closest_guides")
    if closest is None:
        return
    new = np.where(keep, np.cumsum(keep) - 1, -1)
    old = closest.values.astype(np.int64)
    inside = (old >= 0) & (old < len(keep))
    values = np.where(inside, new[np.clip(old, 0, len(keep) - 1)], -1)
    attributes["closest_guides"] = Attribute(closest.scope, values.astype(np.int32), closest.role)


def clean(groom, report):
    """Leave out strands that cannot be used and attributes that are not finite, and say so."""
    if len(groom.counts) == 0:
        raise InputError("the file has no strands")
    finite = np.isfinite(groom.points).all(axis=1) & (np.abs(groom.points) <= 1e6).all(axis=1)
    bad = np.zeros(len(groom.counts), bool)
    np.logical_or.at(bad, groom.strand_of_vertex()[~finite], True)
    short = groom.counts < 2
    if bad.any():
        report.say(f"{bad.sum()} strands are left out, because a position is not finite or is "
                   "farther than 1000 km")
    if (short & ~bad).any():
        report.say(f"{(short & ~bad).sum()} strands are left out, because they have fewer than 2 "
                   "vertices")
    if (bad | short).all():
        raise InputError("no strand can be used: each has fewer than 2 vertices or a position "
                         "that is not finite")
    groom = select(groom, ~(bad | short))
    for name, a in list(groom.attributes.items()):
        if a.values.dtype.kind == "f" and not np.isfinite(a.values).all():
            report.lose(f"the attribute {name}", "a value is not finite")
            del groom.attributes[name]
    check_known(groom, report)
    return groom


def check_known(groom, report):
    """Give attributes of known names the shape and scope that writers expect."""
    for name, (components, kinds) in KNOWN.items():
        a = groom.attributes.get(name)
        if a is None:
            continue
        shape = a.values.shape[1:]
        if name == "color" and shape == (4,):
            groom.attributes.setdefault("opacity", Attribute(a.scope, a.values[:, 3]))
            a.values, shape = a.values[:, :3], (3,)
        right = shape == () if components == 1 else \
            len(shape) == 1 and (shape[0] == components or components == 0)
        if not right or a.values.dtype.kind not in kinds:
            size = "x".join(map(str, shape)) or "1"
            report.lose(f"the attribute {name}", f"its values are {size} of {a.values.dtype}")
            del groom.attributes[name]
        elif name in OF_STRANDS and a.scope == VERTEX:
            report.say(f"the attribute {name} is that of the root of each strand")
            groom.attributes[name] = Attribute(STRAND, a.values[groom.starts()], a.role)


def reverse(groom):
    """Return the groom with each strand from its other end."""
    last = np.repeat(groom.starts() + groom.counts - 1, groom.counts)
    within = np.arange(len(groom.points)) - np.repeat(groom.starts(), groom.counts)
    order = last - within
    attributes = {
        name: Attribute(a.scope, a.values[order] if a.scope == VERTEX else a.values, a.role)
        for name, a in groom.attributes.items()}
    motion = groom.motion
    if motion:
        motion = Motion(motion.times, lambda i, read=motion.read: read(i)[order])
    return Groom(groom.counts, groom.points[order], attributes, motion, groom.format,
                 scalp=groom.scalp)


def lengths(groom):
    """Return the length of each strand, m."""
    return np.add.reduceat(_steps(groom), groom.starts())


def _steps(groom):
    """Return the distance of each vertex from the vertex before, 0 at roots."""
    steps = np.zeros(len(groom.points))
    steps[1:] = np.linalg.norm(np.diff(groom.points, axis=0), axis=1)
    steps[groom.starts()] = 0
    return steps


def place(groom, scale, up):
    """Return positions, widths and directions of a file in metres with +y up."""
    return _transform(groom, lambda v: rotate_to_y(v, up), scale)


def unplace(groom, scale, up):
    """Return positions, widths and directions in a file's unit of `scale` metres and its axis."""
    return _transform(groom, lambda v: rotate_from_y(v, up), 1 / scale)


def _transform(groom, rotate, scale):
    attributes = {}
    for name, a in groom.attributes.items():
        values = a.values
        if a.role in ("point", "vector", "normal") and values.ndim == 2 and values.shape[1] == 3:
            values = rotate(values)
        if a.role in ("point", "vector") or name == "width":
            values = values if scale == 1 else values.astype(np.float64) * scale
        attributes[name] = Attribute(a.scope, values, a.role)
    motion = groom.motion
    if motion:
        motion = Motion(motion.times, lambda i, read=motion.read: rotate(read(i)) * scale)
    scalp = groom.scalp
    if scalp:
        scalp = dataclasses.replace(scalp, points=rotate(scalp.points) * scale)
    return Groom(groom.counts, rotate(groom.points) * scale, attributes, motion, groom.format,
                 scalp=scalp)


def rotate_to_y(v, up):
    """Return vectors of a file whose axis `up` points up, with +y up."""
    if up == "z":
        return np.stack([v[:, 0], v[:, 2], -v[:, 1]], axis=1)
    if up == "x":
        return np.stack([-v[:, 1], v[:, 0], v[:, 2]], axis=1)
    return v


def rotate_from_y(v, up):
    """Return vectors with +y up as those of a file whose axis `up` points up."""
    if up == "z":
        return np.stack([v[:, 0], -v[:, 2], v[:, 1]], axis=1)
    if up == "x":
        return np.stack([v[:, 1], -v[:, 0], v[:, 2]], axis=1)
    return v


def resample(groom, count):
    """Return the groom with `count` vertices per strand, evenly spaced along the polyline.

    Strands that have as many vertices already keep their vertices.
    """
    if (groom.counts == count).all():
        return groom
    before, weight = _places(groom, count)

    def blend(values):
        if values.dtype.kind != "f":
            return values[np.where(weight < 0.5, before, before + 1)]
        w = weight.reshape(-1, *[1] * (values.ndim - 1))
        after = np.minimum(before + 1, len(values) - 1)
        return (values[before] * (1 - w) + values[after] * w).astype(values.dtype)

    attributes = {
        name: Attribute(a.scope, blend(a.values) if a.scope == VERTEX else a.values, a.role)
        for name, a in groom.attributes.items()}
    motion = groom.motion
    if motion:
        motion = Motion(motion.times, lambda i, read=motion.read: blend(read(i)))
    counts = np.full(len(groom.counts), count, np.int64)
    return Groom(counts, blend(groom.points), attributes, motion, groom.format, scalp=groom.scalp)


def fractions(groom):
    """Return the fraction of the length of its strand at each vertex."""
    starts, vertices, steps = groom.starts(), groom.counts, _steps(groom)
    total = np.maximum(np.add.reduceat(steps, starts), 1e-300)
    along = np.cumsum(steps)
    along -= np.repeat(along[starts], vertices)
    return np.minimum(along / np.repeat(total, vertices), 1)


def find_places(groom, count):
    """Return the vertex before each of `count` even places of each strand, and the weight of the
    vertex after that."""
    starts, vertices, fraction = groom.starts(), groom.counts, fractions(groom)
    # Keys grow within a strand from 2i to 2i + 1, so one search serves all strands.
    strand = np.arange(len(vertices))
    keys = 2 * np.repeat(strand, vertices) + fraction
    wanted = np.linspace(0, 1, count)
    targets = (2 * strand[:, None] + wanted[None, :]).ravel()
    before = np.searchsorted(keys, targets, side="right") - 1
    before = np.clip(before, np.repeat(starts, count), np.repeat(starts + vertices - 2, count))
    span = fraction[before + 1] - fraction[before]
    aim = np.tile(wanted, len(vertices))
    weight = np.where(span > 0, (aim - fraction[before]) / np.where(span > 0, span, 1), 0)
    return before, np.clip(weight, 0, 1)


def _places(groom, count):
    """Return the same as find_places(), but the vertices themselves of strands of `count`."""
    starts, (before, weight) = groom.starts(), find_places(groom, count)
    same = np.repeat(groom.counts == count, count)
    within = np.tile(np.arange(count), len(groom.counts))
    last = same & (within == count - 1)
    before = np.where(same, np.repeat(starts, count) + within - last, before)
    return before, np.where(same, last * 1.0, weight)
