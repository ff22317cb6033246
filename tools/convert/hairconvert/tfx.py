"""The binary .tfx formats of TressFX, versions 3 and 4: guides with equal numbers of vertices."""

import numpy as np

from hairconvert.binary import Bytes, to_linear, to_srgb
from hairconvert.groom import STRAND, VERTEX, Attribute, Groom, check_counts, resample
from hairconvert.report import InputError

# Byte of the offset, components and scope of each section.
VERSION4 = {"positions": (12, 4, VERTEX), "root_uv": (16, 2, STRAND), "vertex_uv": (20, 2, VERTEX),
            "tfx_thickness": (24, 1, STRAND), "color": (28, 4, VERTEX)}
VERSION3 = {"positions": (144, 3, VERTEX), "tfx_thickness": (148, 1, STRAND),
            "root_uv": (152, 2, STRAND), "color": (156, 4, VERTEX),
            "guide index": (160, 1, STRAND), "vertex_uv": (164, 2, VERTEX)}
HEADERS = {3: 296, 4: 160}
SIZES = (4, 8, 16, 32, 64)


def read(data, options, report):
    """Return the groom of the bytes of a binary .tfx file."""
    file = Bytes(data)
    number = file.number("header", 0, "<f4")
    if not 3 <= number < 5:
        if bytes(data[:256]).isascii():
            raise InputError("a .tfx text is not read: hair-groom convert writes it as binary .tfx")
        raise InputError(f"the version at byte 0 is {number:g}, not 3 or 4")
    version = int(number)
    file.array("header", 0, HEADERS[version], "u1")
    strands, each = file.number("header", 4), file.number("header", 8)
    check_counts(strands, strands * each)
    if each < 2:
        raise InputError(f"the vertices of each strand at byte 8 are {each}, fewer than 2")
    sections = {}
    for name, (at, components, scope) in (VERSION4 if version == 4 else VERSION3).items():
        offset = file.number("header", at)
        if offset == 0 and name != "positions":
            continue
        if offset < HEADERS[version]:
            raise InputError(f"the offset of {name} at byte {at} is {offset}, which lies in the "
                             "header")
        rows = strands * each if scope == VERTEX else strands
        values = file.array(f"values of {name}", offset, rows * components, "<f4")
        sections[name] = values.reshape(rows, components) if components > 1 else values
    return _to_groom(strands, each, sections, report)


def _to_groom(strands, each, sections, report):
    positions = sections.pop("positions")
    counts = np.full(strands, each, np.int64)
    groom = Groom(counts, positions[:, :3].astype(np.float64), format="tfx")
    groom.attributes["guide"] = Attribute("groom", np.ones(1, np.int32))
    if positions.shape[1] == 4 and not _is_default(positions[:, 3], each):
        report.lose("the inverse mass of vertices", "masses come from the physics settings")
    if sections.pop("guide index", None) is not None:
        report.lose("the guide index of strands", "guides are chosen anew")
    color = sections.pop("color", None)
    if color is not None:
        linear = to_linear(color[:, :3]).astype(np.float32)
        groom.attributes["color"] = Attribute(VERTEX, linear, "color")
        if (color[:, 3] != 1).any():
            groom.attributes["opacity"] = Attribute(VERTEX, color[:, 3])
    uv = sections.pop("root_uv", None)
    if uv is not None and uv.any():
        groom.attributes["root_uv"] = Attribute(STRAND, uv, "uv")
    for name, values in sections.items():
        scope = STRAND if name == "tfx_thickness" else VERTEX
        groom.attributes[name] = Attribute(scope, values, "uv" if name == "vertex_uv" else "")
    return groom


def _is_default(masses, each):
    return (masses.reshape(-1, each)[:, 2:] == 1).all() and not \
        masses.reshape(-1, each)[:, :2].any()


def write(groom, path, options, report):
    """Write a .tfx file of version 4."""
    groom = _fit(groom, report)
    each, header = int(groom.counts[0]), np.zeros(HEADERS[4] // 4, "<u4")
    header[0:1].view("<f4")[0] = 4
    header[1:3] = len(groom.counts), each
    positions = np.zeros((len(groom.points), 4), "<f4")
    positions[:, :3] = groom.points
    positions[:, 3] = np.arange(len(groom.points)) % each >= 2
    root_uv = groom.values("root_uv", STRAND) if _scope(groom, "root_uv") != VERTEX else None
    if root_uv is None:
        root_uv = np.zeros((len(groom.counts), 2))
    sections = [(3, positions), (4, root_uv)]
    kept = {"root_uv", "guide"}
    if "vertex_uv" in groom.attributes:
        sections.append((5, groom.values("vertex_uv", VERTEX)))
    if _scope(groom, "tfx_thickness") in ("groom", STRAND):
        sections.append((6, groom.values("tfx_thickness", STRAND)))
    if "color" in groom.attributes:
        sections.append((7, _colors(groom)))
        kept |= {"color", "opacity"}
    at = HEADERS[4]
    for index, values in sections:
        header[index] = at
        at += values.size * 4
    if at > 0xffffffff:
        raise InputError(f"a .tfx of {at} bytes is longer than 4294967295")
    with open(path, "wb") as file:
        file.write(header.tobytes())
        for _, values in sections:
            file.write(np.ascontiguousarray(values, "<f4").tobytes())
    for name in groom.attributes:
        if name == "width":
            report.lose("the attribute width", "the thickness of a .tfx file is a factor, not a "
                        "length")
        elif name not in kept and name not in ("vertex_uv", "tfx_thickness"):
            report.lose(f"the attribute {name}", "a .tfx file holds only root_uv, vertex_uv, "
                        "thickness factors, and colours with opacities")


def _scope(groom, name):
    attribute = groom.attributes.get(name)
    return attribute.scope if attribute else None


def _colors(groom):
    colors = np.ones((len(groom.points), 4))
    colors[:, :3] = to_srgb(groom.values("color", VERTEX))
    if "opacity" in groom.attributes:
        colors[:, 3] = groom.values("opacity", VERTEX)
    return colors


def _fit(groom, report):
    """Give all strands the same number of vertices, one that .tfx files can have."""
    most = int(groom.counts.max())
    if (groom.counts == most).all() and most in SIZES:
        return groom
    count = next((s for s in SIZES if s >= most), SIZES[-1])
    report.say(f"strands are resampled to {count} vertices each, because a .tfx file needs 4, 8, "
               "16, 32 or 64 in all")
    return resample(groom, count)
