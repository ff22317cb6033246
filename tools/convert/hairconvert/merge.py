"""Joins several grooms of one file into one."""

import numpy as np

from hairconvert import names
from hairconvert.groom import GROOM, STRAND, VERTEX, Attribute, Groom, Motion, check_counts, widen

# Values that mean nothing, where 0 would mean something: no guide, and no change by a factor.
NOTHING = {"closest_guides": -1, **{f: 1 for f in names.FACTORS}}
FINENESS = [GROOM, STRAND, VERTEX]


def collect(parts):
    """Return the parts that are valid, or refuse the file as soon as they are too many."""
    found, strands, vertices = [], 0, 0
    for p in parts:
        if p.valid:
            found.append(p)
            strands, vertices = strands + len(p.counts), vertices + len(p.points)
            check_counts(strands, vertices)
    return found


def merge(parts, part_names, report):
    """Return one groom of several. Without a group in the file, each part becomes a group."""
    if len(parts) == 1:
        return parts[0]
    if not any("group" in p.attributes for p in parts):
        report.say(f"the {len(parts)} curves of the file become groups")
        for i, (part, name) in enumerate(zip(parts, part_names)):
            part.attributes["group"] = Attribute(GROOM, np.array([i], np.int32))
            part.attributes.setdefault("group_name", Attribute(GROOM, np.array([name])))
    _shift_guides(parts)
    whole = Groom(np.concatenate([p.counts for p in parts]),
                  np.concatenate([p.points for p in parts]), format=parts[0].format)
    for name in dict.fromkeys(n for p in parts for n in p.attributes):
        attribute = _join(name, parts, report)
        if attribute is not None:
            whole.attributes[name] = attribute
    if any(p.motion for p in parts):
        times = next(p.motion.times for p in parts if p.motion)
        whole.motion = Motion(times, lambda i: np.concatenate(
            [p.motion.read(i) if p.motion else p.points for p in parts]))
    return whole


def _shift_guides(parts):
    """Let closest_guides name strands of the whole instead of strands of a part."""
    first = 0
    for p in parts:
        closest = p.attributes.get("closest_guides")
        if closest is not None:
            values = closest.values.astype(np.int32)
            p.attributes["closest_guides"] = Attribute(
                closest.scope, np.where(values >= 0, values + np.int32(first), values))
        first += len(p.counts)


def _join(name, parts, report):
    """Return an attribute of all parts, or None after a sentence."""
    having = [p.attributes[name] for p in parts if name in p.attributes]
    kinds = {("text" if a.values.dtype.kind == "U" else "number", a.values.shape[1:])
             for a in having}
    if len(kinds) > 1:
        report.lose(f"the attribute {name}", "the curves of the file have different types of it")
        return None
    scope = max((a.scope for a in having), key=FINENESS.index)
    if scope == GROOM:
        rows = np.concatenate([a.values for a in having])
        if len(having) == len(parts) and (rows == rows[0]).all():
            return having[0]
        scope = STRAND
    nothing = NOTHING.get(name, "0 or empty")
    if len(having) < len(parts):
        report.say(f"the attribute {name} is {nothing} in {len(parts) - len(having)} of "
                   f"{len(parts)} curves, which do not have it")
    dtype = np.result_type(*[a.values.dtype for a in having])
    values = []
    for p in parts:
        a = p.attributes.get(name)
        if a is None:
            empty = np.zeros((p.rows_of(scope), *having[0].values.shape[1:]), dtype)
            values.append(empty + NOTHING[name] if name in NOTHING else empty)
        else:
            values.append(widen(a, scope, p).astype(dtype, copy=False))
    return Attribute(scope, np.concatenate(values), having[0].role)
