"""The .groom format of the library: strands, radii, groups, colours and the scalp in chunks."""

import struct
import zlib

import numpy as np

from hairconvert import names, tracks
from hairconvert.binary import Bytes, load
from hairconvert.groom import (STRAND, VERTEX, Attribute, Groom, check_counts, find_places,
                               fractions, lengths)
from hairconvert.mesh import Mesh, check_mesh
from hairconvert.report import InputError

MAGIC = b"GROOM\r\n\x1a"
HEADER, CHUNK = 32, 16  # bytes of the header, and before the content of a chunk
MAX_VERTICES = 256  # of a strand
GROUPS = 8
COLORS = 8  # at even places of a strand
MAX_JOINTS, MAX_SCALP = 65536, 4194304  # joints, and vertices or triangles of a scalp
MAX_ERROR, UNIT, SHORTEST = 5e-6, 5.7e-6, 1e-5  # of the length of a strand
BIAS, MIN_STEP, MAX_STEP = 128, 64, 160
KNOWN = {"STRD", "CURV", "RADI", "GRUP", "COLR", "SCLP", "DENS", "TEXC", "SKIN", "GUID", "JNTN"}
NAMED = {"ATTR", "MAPS"}  # chunks that may stand several times, with names
NAME, MAP_HEADER = 32, 48  # bytes of a name, and before the values of a map
IMAGE, VERTICES, TRIANGLES = 1, 2, 3  # sources of maps


class Chunk:
    """The content of a chunk. Errors name the chunk and its byte."""

    def __init__(self, letters, at, data):
        self.letters, self.at, self.data = letters, at, data

    def refuse(self, what):
        """Refuse the file for a reason."""
        raise InputError(f'the chunk "{self.letters}" at byte {self.at} {what}')

    def array(self, at, count, dtype):
        """Return numbers of the content."""
        end = at + count * np.dtype(dtype).itemsize
        if end > len(self.data):
            self.refuse(f"has {len(self.data)} bytes, fewer than {end}")
        return np.frombuffer(self.data, dtype, count, at)

    def check_size(self, size):
        """Refuse a content of another size."""
        if len(self.data) != size:
            self.refuse(f"has {len(self.data)} bytes, not {size}")


def read(data, options, report):
    """Return the groom of the bytes of a .groom file."""
    chunks = _find_chunks(Bytes(data), report)
    for letters in ("STRD", "CURV"):
        if letters not in chunks:
            raise InputError(f'the file has no chunk "{letters}"')
    counts, is_guides = _read_counts(chunks["STRD"])
    groom = Groom(counts, _read_points(chunks["CURV"], counts), format="groom")
    if is_guides:
        groom.attributes["guide"] = Attribute("groom", np.ones(1, np.int32))
    elif "GUID" in chunks:
        groom.attributes["guide"] = Attribute(STRAND, _read_guides(chunks["GUID"], len(counts)))
    if "RADI" in chunks:
        chunks["RADI"].check_size(4 * len(counts))
        radii = chunks["RADI"].array(0, len(counts), "<f4")
        groom.attributes["width"] = Attribute(STRAND, 2 * radii)
    if "GRUP" in chunks:
        groom.attributes["group"] = Attribute(STRAND, _read_groups(chunks["GRUP"], len(counts)))
    if "COLR" in chunks:
        groom.attributes["color"] = _read_colors(chunks["COLR"], groom)
    for chunk in chunks.get("ATTR", []):
        _read_factors(chunk, groom, report)
    if "SCLP" in chunks:
        groom.scalp = check_mesh(_read_scalp(chunks), report)
    return groom


def read_mesh(path, name, report):
    """Return the scalp of a .groom file."""
    chunks = _find_chunks(Bytes(load(path)), report)
    if "SCLP" not in chunks:
        raise InputError('the file has no chunk "SCLP", the scalp')
    mesh = _read_scalp(chunks)
    if mesh.density is not None or mesh.maps:
        report.lose("the density and the maps of the scalp", "files of meshes have none")
    return mesh


def _read_scalp(chunks):
    chunk = chunks["SCLP"]
    vertices, triangles = (int(n) for n in chunk.array(0, 2, "<u4"))
    chunk.check_size(8 + 12 * (vertices + triangles))
    points = chunk.array(8, 3 * vertices, "<f4").reshape(-1, 3).astype(np.float64)
    corners = chunk.array(8 + 12 * vertices, 3 * triangles, "<u4").reshape(-1, 3).astype(np.int64)
    mesh = Mesh(points, corners, format="groom")
    if "TEXC" in chunks:
        chunks["TEXC"].check_size(8 * vertices)
        mesh.uv = chunks["TEXC"].array(0, 2 * vertices, "<f4").reshape(-1, 2).astype(np.float64)
    if "SKIN" in chunks:
        chunks["SKIN"].check_size(4 + 24 * vertices)
        joints = int(chunks["SKIN"].array(0, 1, "<u4")[0])
        if not 1 <= joints <= MAX_JOINTS:
            chunks["SKIN"].refuse(f"has {joints} joints, not in [1, {MAX_JOINTS}]")
        mesh.joints = chunks["SKIN"].array(4, 4 * vertices, "<u2").reshape(-1, 4).astype(np.int64)
        mesh.weights = chunks["SKIN"].array(4 + 8 * vertices, 4 * vertices, "<f4").reshape(-1, 4)
        mesh.weights = mesh.weights.astype(np.float64)
        mesh.joint_names = [f"joint{i}" for i in range(joints)]
        if "JNTN" in chunks:
            mesh.joint_names = _read_names(chunks["JNTN"], joints)
    if "DENS" in chunks:
        chunks["DENS"].check_size(4 * vertices)
        mesh.density = chunks["DENS"].array(0, vertices, "<f4")
    for chunk in chunks.get("MAPS", []):
        source, width, height = (int(n) for n in chunk.array(NAME + 4, 3, "<u4"))
        counts = {0: 0, IMAGE: width * height, VERTICES: vertices, TRIANGLES: triangles}
        if source not in counts:
            chunk.refuse(f"has the source {source}, not in [0, {TRIANGLES}]")
        chunk.check_size(MAP_HEADER + 4 * counts[source])
        mesh.maps.append(chunk.data)
    return mesh


def _read_factors(chunk, groom, report):
    """Read an attribute of strands, whose name is in the chunk."""
    name = bytes(chunk.array(0, NAME, "u1")).split(b"\0")[0].decode("ascii", "replace")
    ours = f"hair_{name}"
    if ours not in names.FACTORS:
        report.lose(f"the attribute {name}", "the name is unknown")
        return
    if ours in groom.attributes:
        chunk.refuse(f'has the name "{name}" again')
    chunk.check_size(NAME + 4 * len(groom.counts))
    values, (low, high) = chunk.array(NAME, len(groom.counts), "<f4"), names.FACTORS[ours]
    if not _is_within(values, low, high):
        chunk.refuse(f"has a factor of {name} that is not in [{low}, {high}]")
    groom.attributes[ours] = Attribute(STRAND, values.astype(np.float32))


def _is_within(values, low, high):
    return bool(((values >= np.float32(low)) & (values <= np.float32(high))).all())


def _find_chunks(file, report):
    file.array("header", 0, HEADER, "u1")
    data = file.data
    if data[:8] != MAGIC:
        raise InputError('the file does not begin with "GROOM", 13, 10, 26')
    version, count = struct.unpack_from("<II", data, 8)
    size, crc = struct.unpack_from("<QI", data, 16)
    if crc != zlib.crc32(data[:24]):
        raise InputError("the checksum at byte 24 is not that of the header")
    if version != 1:
        raise InputError(f"the version at byte 8 is {version}, and only version 1 can be read")
    if size > len(file):
        raise InputError(f"the file ends at byte {len(file)}, but it had {size} bytes")
    chunks, at = {}, HEADER
    for _ in range(count):
        if at + CHUNK > size:
            raise InputError(f"the file ends at byte {size}, but it has {count} chunks")
        letters = data[at:at + 4].decode("ascii", "replace")
        length, crc = struct.unpack_from("<QI", data, at + 4)
        end = at + CHUNK + length
        if end > size:
            raise InputError(f'the chunk "{letters}" at byte {at} has {length} bytes, but the file '
                             f"ends at byte {size}")
        if crc != zlib.crc32(data[at + CHUNK:end], zlib.crc32(data[at:at + 12])):
            raise InputError(f'the chunk "{letters}" at byte {at} is damaged')
        if letters in chunks and letters in KNOWN:
            raise InputError(f'the chunk "{letters}" stands again at byte {at}')
        if letters in NAMED:
            chunks.setdefault(letters, []).append(Chunk(letters, at, data[at + CHUNK:end]))
        elif letters in KNOWN:
            chunks[letters] = Chunk(letters, at, data[at + CHUNK:end])
        else:
            report.say(f'the chunk "{letters}" is unknown and not read')
        at = end
    return chunks


def _read_counts(chunk):
    strands, vertices, kind = (int(n) for n in chunk.array(0, 3, "<u4"))
    check_counts(strands, vertices)
    chunk.check_size(12 + strands)
    counts = chunk.array(12, strands, "u1").astype(np.int64) + 1
    if kind > 1:
        chunk.refuse(f"has the set {kind} of strands, not in [0, 1]")
    if counts.min() < 2 or counts.sum() != vertices:
        chunk.refuse(f"has strands of {counts.sum()} vertices, not {vertices} and 2 or more in each")
    return counts, kind == 1


def _read_tracks(chunk, counts, floats, at):
    """Return the numbers of the tracks whose widths begin at a byte of the content."""
    widths = chunk.array(at, len(counts), "<u4")
    at += 4 * len(counts)
    if (widths >> 30).any() or widths[floats].any():
        chunk.refuse(f"has the widths 0x{widths.max():x} of a strand")
    chunk.check_size(at + (tracks.count_bits(widths, counts, floats) + 7) // 8)
    return tracks.unpack(chunk.data[at:], widths, counts, floats)


def _read_points(chunk, counts):
    strands = len(counts)
    roots = chunk.array(0, 3 * strands, "<f4").reshape(-1, 3)
    steps = chunk.array(12 * strands, strands, "u1").astype(np.int64)
    wrong = (steps != 0) & ((steps < MIN_STEP) | (steps > MAX_STEP))
    if wrong.any():
        chunk.refuse(f"has the step {steps[wrong][0]}, not 0 or in [{MIN_STEP}, {MAX_STEP}]")
    whole, bits = _read_tracks(chunk, counts, steps == 0, 13 * strands)
    return _place(roots, steps, whole, bits, counts)


def _place(roots, steps, whole, bits, counts):
    """Return positions of whole numbers of units from roots, or of the bits of floats."""
    unit = np.repeat(np.ldexp(1.0, steps - BIAS), counts)[:, None]
    with np.errstate(invalid="ignore"):
        points = (np.repeat(roots.astype(np.float64), counts, axis=0) + unit * whole).astype("<f4")
    floats = np.repeat(steps == 0, counts)
    floats[np.cumsum(counts) - counts] = False  # Roots are numbers of their own.
    points[floats] = bits[floats].astype("<u4").view("<f4")
    return points.astype(np.float64)


def _read_groups(chunk, strands):
    chunk.check_size(strands)
    groups = chunk.array(0, strands, "u1").astype(np.int32)
    if groups.max() >= GROUPS:
        chunk.refuse(f"has the group {groups.max()}, not in [0, {GROUPS - 1}]")
    return groups


def _read_guides(chunk, strands):
    chunk.check_size(strands)
    guides = chunk.array(0, strands, "u1").astype(np.int32)
    if guides.max() > 1:
        chunk.refuse(f"has the flag {guides.max()} of a strand, not 0 or 1")
    return guides


def _read_names(chunk, count):
    """Return the names of joints, each of which ends in a byte 0."""
    joints = chunk.data.split(b"\0")
    if len(joints) != count + 1 or joints[-1]:
        chunk.refuse(f"does not have {count} names that end in a byte 0")
    try:
        return [name.decode() for name in joints[:-1]]
    except UnicodeDecodeError:
        chunk.refuse("has a name that is not UTF-8")


def _read_colors(chunk, groom):
    strands = len(groom.counts)
    roots = chunk.array(0, 3 * strands, "<u2").reshape(-1, 3).astype(np.int64)
    each = np.full(strands, COLORS, np.int64)
    whole, _ = _read_tracks(chunk, each, np.zeros(strands, bool), 6 * strands)
    numbers = whole.reshape(strands, COLORS, 3) + roots[:, None]
    if numbers.min() < 0 or numbers.max() > 65535:
        chunk.refuse("has a colour that is not in [0, 65535]")
    colors = np.square(numbers / 65535).astype(np.float32)
    if (colors == colors[:, :1]).all():
        return Attribute(STRAND, colors[:, 0], "color")
    at = fractions(groom) * (COLORS - 1)
    before = np.minimum(at.astype(np.int64), COLORS - 2)
    strand, weight = groom.strand_of_vertex(), (at - before)[:, None]
    blend = colors[strand, before] * (1 - weight) + colors[strand, before + 1] * weight
    return Attribute(VERTEX, blend.astype(np.float32), "color")


# Writing ---------------------------------------------------------------------------------------

def write(groom, path, options, report):
    """Write a .groom file."""
    if groom.counts.max() > MAX_VERTICES:
        raise InputError(f"a strand has {groom.counts.max()} vertices, more than the "
                         f"{MAX_VERTICES} of a .groom file: use --vertices")
    strands = len(groom.counts)
    guide = groom.values("guide", STRAND)
    is_guides = guide is not None and bool(guide.all())
    chunks = [("STRD", struct.pack("<III", strands, len(groom.points), is_guides)
               + (groom.counts - 1).astype("u1").tobytes()),
              ("CURV", _write_points(groom))]
    for letters, name, encode in (("RADI", "width", _write_radii), ("GRUP", "group", _write_groups),
                                  ("COLR", "color", _write_colors)):
        content = encode(groom, report) if name in groom.attributes else None
        if content is not None:
            chunks.append((letters, content))
    if guide is not None and not is_guides and guide.any():
        chunks.append(("GUID", (guide != 0).astype("u1").tobytes()))
    if groom.scalp:
        chunks += _write_scalp(groom.scalp, report)
    for name in names.FACTORS:
        if name in groom.attributes:
            chunks += _write_factors(groom, name, report)
    if groom.scalp:
        chunks += _write_maps(groom.scalp, report)
    for name in groom.attributes:
        if name not in ("guide", "width", "group", "color", *names.FACTORS):
            report.lose(f"the attribute {name}", "a .groom file holds only widths, groups, "
                        "colours, guides and factors of the library")
    _write_chunks(path, chunks)


def _write_chunks(path, chunks):
    content = b""
    for letters, data in chunks:
        head = letters.encode() + struct.pack("<Q", len(data))
        content += head + struct.pack("<I", zlib.crc32(data, zlib.crc32(head))) + data
    head = MAGIC + struct.pack("<IIQ", 1, len(chunks), HEADER + len(content))
    with open(path, "wb") as file:
        file.write(head + struct.pack("<II", zlib.crc32(head), 0) + content)


def _write_points(groom):
    """Return the chunk of positions, in units that keep every vertex within the error."""
    counts, points = groom.counts, groom.points.astype("<f4")
    roots, own = points[groom.starts()], points.astype(np.float64)
    length = lengths(Groom(counts, own))
    steps = BIAS - 1 + np.frexp(UNIT * length)[1].astype(np.int64)
    steps[(steps < MIN_STEP) | (steps > MAX_STEP)] = 0
    bits = points.view("<u4").astype(np.int64)
    whole = np.zeros(points.shape, np.int64)
    for attempt in range(4):
        unit = np.repeat(np.ldexp(1.0, steps - BIAS), counts)[:, None]
        with np.errstate(invalid="ignore", over="ignore"):
            offset = (own - np.repeat(roots.astype(np.float64), counts, axis=0)) / unit
        floats = np.repeat(steps == 0, counts)
        offset = np.clip(np.nan_to_num(offset), -2.0 ** 28, 2.0 ** 28)
        whole = np.where(floats[:, None], 0, np.floor(offset + 0.5)).astype(np.int64)
        bad = (steps != 0) & ~_is_kept(groom, own, _place(roots, steps, whole, bits, counts), length)
        if not bad.any():
            break
        # Smaller units come first. Then numbers are kept as they are.
        steps[bad] = np.where(attempt < 2, np.maximum(steps[bad] - 1, MIN_STEP), 0)
    widths, data = tracks.pack(whole, counts, bits, steps == 0)
    return roots.tobytes() + steps.astype("u1").tobytes() + widths.tobytes() + data


def _is_kept(groom, before, after, length):
    """Return which strands the library reads with all their vertices near enough."""
    with np.errstate(invalid="ignore", over="ignore"):
        error = np.linalg.norm(after - before, axis=1)
    near = np.maximum.reduceat(error, groom.starts()) <= MAX_ERROR * length
    read = Groom(groom.counts, after)
    steps = np.zeros(len(after))
    with np.errstate(invalid="ignore", over="ignore"):
        steps[1:] = np.linalg.norm(np.diff(after, axis=0), axis=1)
    steps[groom.starts()] = np.inf
    return near & (np.minimum.reduceat(steps, groom.starts()) >= SHORTEST * lengths(read))


def _write_scalp(mesh, report):
    vertices = len(mesh.points)
    if max(vertices, len(mesh.triangles)) > MAX_SCALP:
        raise InputError(f"the scalp has {vertices} vertices and {len(mesh.triangles)} triangles, "
                         f"more than {MAX_SCALP}")
    chunks = [("SCLP", struct.pack("<II", vertices, len(mesh.triangles))
               + mesh.points.astype("<f4").tobytes() + mesh.triangles.astype("<u4").tobytes())]
    if mesh.density is not None:
        chunks.append(("DENS", mesh.density.astype("<f4").tobytes()))
    if mesh.uv is not None and (np.abs(mesh.uv) <= 1e6).all():
        chunks.append(("TEXC", mesh.uv.astype("<f4").tobytes()))
    elif mesh.uv is not None:
        report.lose("the texture coordinates of the scalp", "a value is not in [-1e6, 1e6]")
    if mesh.weights is not None and len(mesh.joint_names) <= MAX_JOINTS:
        chunks.append(("SKIN", struct.pack("<I", len(mesh.joint_names))
                       + mesh.joints.astype("<u2").tobytes()
                       + mesh.weights.astype("<f4").tobytes()))
        chunks.append(("JNTN", _write_names(mesh.joint_names)))
    elif mesh.weights is not None:
        report.lose("the skin of the scalp", f"it has more than {MAX_JOINTS} joints")
    return chunks


def _write_factors(groom, name, report):
    """Return the chunk of an attribute of strands, or none."""
    values, (low, high) = groom.values(name, STRAND).astype("<f4"), names.FACTORS[name]
    if not _is_within(values, low, high):
        report.lose(f"the attribute {name}", f"a value is not in [{low}, {high}]")
        return []
    name = name.removeprefix("hair_").encode().ljust(NAME, b"\0")
    return [("ATTR", name + values.tobytes())]


def _write_maps(mesh, report):
    """Return the chunks of the maps of a scalp. Triangles may have been left out since."""
    kept = []
    for content in mesh.maps:
        source = struct.unpack_from("<I", content, NAME + 4)[0]
        fits = len(content) == MAP_HEADER + 4 * len(mesh.triangles)
        if (source == TRIANGLES and not fits) or (source == IMAGE and mesh.uv is None):
            report.lose("a map of the scalp", "the mesh of the scalp is another")
        else:
            kept.append(("MAPS", content))
    return kept


def _write_names(joints):
    """Return the names of joints, of which each ends in a byte 0."""
    return b"".join(n.replace("\0", "_").encode(errors="replace") + b"\0" for n in joints)


def _write_radii(groom, report):
    attribute = groom.attributes["width"]
    width = groom.values("width", VERTEX)[groom.starts()].astype(np.float64)
    if attribute.scope == VERTEX and (groom.values("width", VERTEX)
                                      != np.repeat(width, groom.counts)).any():
        report.say("the width is that of the root of each strand")
    if not ((width >= 0) & (width <= 2e6)).all():
        return report.lose("the attribute width", "a value is not in [0, 2e6]")
    return (0.5 * width).astype("<f4").tobytes()


def _write_groups(groom, report):
    groups = groom.values("group", STRAND).astype(np.int64)
    known = np.unique(groups)
    if len(known) > GROUPS:
        return report.lose("the attribute group", f"a .groom file has at most {GROUPS} groups, not "
                           f"{len(known)}")
    if known[0] < 0 or known[-1] >= GROUPS:
        report.say(f"the groups {', '.join(map(str, known))} become 0 to {len(known) - 1}")
        groups = np.searchsorted(known, groups)
    return groups.astype("u1").tobytes()


def _write_colors(groom, report):
    attribute, strands = groom.attributes["color"], len(groom.counts)
    if attribute.scope == VERTEX:
        before, weight = find_places(groom, COLORS)
        after = np.minimum(before + 1, len(groom.points) - 1)
        colors = attribute.values[before] * (1 - weight[:, None]) \
            + attribute.values[after] * weight[:, None]
        if groom.counts.max() > 2:
            report.say(f"colours are those at {COLORS} even places of each strand")
    else:
        colors = np.repeat(groom.values("color", STRAND), COLORS, axis=0)
    if not ((colors >= 0) & (colors <= 1)).all():
        return report.lose("the attribute color", "a value is not in [0, 1]")
    numbers = np.floor(np.sqrt(colors.astype(np.float64)) * 65535 + 0.5).astype(np.int64)
    numbers = numbers.reshape(strands, COLORS, 3)
    roots = numbers[:, 0]
    each = np.full(strands, COLORS, np.int64)
    whole = (numbers - roots[:, None]).reshape(-1, 3)
    widths, data = tracks.pack(whole, each, whole, np.zeros(strands, bool))
    return roots.astype("<u2").tobytes() + widths.tobytes() + data
