"""The .data format of USC-HairSalon: a count of vertices and positions per strand."""

import struct

import numpy as np

from hairconvert.binary import Bytes
from hairconvert.groom import Groom, check_counts
from hairconvert.report import InputError


def read(data, options, report):
    """Return the groom of the bytes of a .data file."""
    file = Bytes(data)
    strands = file.number("count of strands", 0, "<i4")
    # Each strand needs the 4 bytes of its count.
    if strands > (len(file) - 4) // 4:
        raise InputError(f"the {strands} strands at byte 0 exceed the file of {len(file)} bytes")
    check_counts(strands, 0)
    counts, at, size = np.zeros(strands, np.int64), 4, len(file)
    words = np.ones(size // 4, bool)
    words[0] = False
    for i in range(strands):
        if at + 4 > size:
            raise InputError(f"the file ends at byte {size}, before strand {i}")
        count = struct.unpack_from("<i", data, at)[0]
        if count < 0 or at + 4 + 12 * count > size:
            raise InputError(f"strand {i} at byte {at} claims {count} vertices, which exceed the "
                             f"file of {size} bytes")
        words[at // 4] = False
        counts[i] = count
        at += 4 + 12 * count
    check_counts(strands, int(counts.sum()))
    if at < size:
        report.say(f"the bytes after the strands, from byte {at} on, are not read")
    words[at // 4:] = False
    points = np.frombuffer(data, "<f4", len(words))[words].reshape(-1, 3).astype(np.float64)
    return Groom(counts, points, format="data")


def write(groom, path, options, report):
    """Write a .data file."""
    strands = len(groom.counts)
    words = np.zeros(1 + strands + 3 * len(groom.points), "<u4")
    heads = 1 + np.arange(strands) + 3 * groom.starts()
    is_point = np.ones(len(words), bool)
    is_point[0] = is_point[heads] = False
    words[0] = strands
    words[heads] = groom.counts
    words[is_point] = groom.points.astype("<f4").view("<u4").ravel()
    with open(path, "wb") as file:
        file.write(words.tobytes())
    for name in groom.attributes:
        report.lose(f"the attribute {name}", "a .data file holds only positions")
