"""The .hair format ("cyHair"): all strands, each with its own number of vertices."""

import numpy as np

from hairconvert.binary import Bytes, to_linear, to_srgb
from hairconvert.groom import VERTEX, Attribute, Groom, check_counts
from hairconvert.report import InputError

HEADER = 128
SEGMENTS, POINTS, THICKNESS, TRANSPARENCY, COLORS = 1, 2, 4, 8, 16
MAX_STRAND_VERTICES = 65536
INFO = b"hair: metres, +y up, root first"


def read(data, options, report):
    """Return the groom of the bytes of a .hair file."""
    file = Bytes(data)
    file.array("header", 0, HEADER, "u1")
    strands, vertices, arrays, segments = (file.number("header", at) for at in (4, 8, 12, 16))
    check_counts(strands, vertices)
    if not arrays & POINTS:
        raise InputError(f"the arrays 0x{arrays:x} at byte 12 lack the points")
    if arrays > 31:
        report.say(f"unknown arrays among those 0x{arrays:x} at byte 12 are not read")
    at, found = HEADER, {}
    for bit, name, count, dtype in (
            (SEGMENTS, "segments", strands, "<u2"), (POINTS, "points", 3 * vertices, "<f4"),
            (THICKNESS, "thicknesses", vertices, "<f4"),
            (TRANSPARENCY, "transparencies", vertices, "<f4"),
            (COLORS, "colours", 3 * vertices, "<f4")):
        if arrays & bit:
            found[bit] = file.array(name, at, count, dtype)
            at += found[bit].nbytes
    if len(file) > at and arrays <= 31:
        report.say(f"the bytes after the arrays, from byte {at} on, are not read")
    counts = found[SEGMENTS].astype(np.int64) + 1 if arrays & SEGMENTS else \
        np.full(strands, segments + 1, np.int64)
    if counts.sum() != vertices:
        raise InputError(f"the segments make {counts.sum()} points, not the {vertices} that byte "
                         "8 says")
    groom = Groom(counts, found[POINTS].reshape(-1, 3).astype(np.float64), format="hair")
    _add_attributes(groom, found)
    return groom


def _add_attributes(groom, found):
    if THICKNESS in found:
        groom.attributes["width"] = Attribute(VERTEX, found[THICKNESS])
    if TRANSPARENCY in found:
        groom.attributes["opacity"] = Attribute(VERTEX, 1 - found[TRANSPARENCY])
    if COLORS in found:
        colors = to_linear(found[COLORS].reshape(-1, 3)).astype(np.float32)
        groom.attributes["color"] = Attribute(VERTEX, colors, "color")


def write(groom, path, options, report):
    """Write a .hair file."""
    if groom.counts.max() > MAX_STRAND_VERTICES:
        raise InputError(f"a strand has {groom.counts.max()} vertices, more than the "
                         f"{MAX_STRAND_VERTICES} of a .hair file: use --vertices")
    width, opacity, color = (groom.values(n, VERTEX) for n in ("width", "opacity", "color"))
    arrays = SEGMENTS | POINTS | (THICKNESS if width is not None else 0) | \
        (TRANSPARENCY if opacity is not None else 0) | (COLORS if color is not None else 0)
    header = np.zeros(HEADER, np.uint8)
    header[:4] = np.frombuffer(b"HAIR", np.uint8)
    header[4:20] = np.array([len(groom.counts), len(groom.points), arrays, 0], "<u4").view("u1")
    header[20:40] = np.array([1e-4, 0, 0.1, 0.04, 0.02], "<f4").view("u1")
    header[40:40 + len(INFO)] = np.frombuffer(INFO, np.uint8)
    with open(path, "wb") as file:
        file.write(header.tobytes())
        file.write((groom.counts - 1).astype("<u2").tobytes())
        file.write(groom.points.astype("<f4").tobytes())
        if width is not None:
            file.write(width.astype("<f4").tobytes())
        if opacity is not None:
            file.write((1 - opacity.astype(np.float64)).astype("<f4").tobytes())
        if color is not None:
            file.write(to_srgb(color).astype("<f4").tobytes())
    for name in groom.attributes:
        if name not in ("width", "opacity", "color"):
            report.lose(f"the attribute {name}", "a .hair file holds only widths, opacities and "
                        "colours")
