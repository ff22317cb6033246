"""OBJ files: polylines as strands, faces as a scalp."""

import numpy as np

from hairconvert.binary import load
from hairconvert.groom import MAX_VERTICES, Groom, check_counts
from hairconvert.mesh import Mesh
from hairconvert.report import InputError


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


def read_mesh(path, name, report):
    """Return the faces of an OBJ file as a mesh. Faces with more corners become fans."""
    lines = join_lines(load(path))
    points, uvs = read_vectors(lines, b"v ", 3), read_vectors(lines, b"vt ", 2)
    corners, used = [], (name is None)
    before = [0, 0]
    for line in lines:
        if line.startswith(b"v "):
            before[0] += 1
        elif line.startswith(b"vt "):
            before[1] += 1
        elif name is not None and line.startswith((b"o ", b"g ")):
            used = line[2:].strip().decode(errors="replace") == name
        elif used and line.startswith(b"f "):
            face = [_corner(t, before) for t in line.split()[1:]]
            corners += [c for i in range(1, len(face) - 1) for c in (face[0], face[i], face[i + 1])]
    if not corners:
        raise InputError(f"the file has no face of the name {name}" if name else
                         "the file has no face, which is a line that begins with f")
    return _to_mesh(points, uvs, np.array(corners, np.int64))


def _corner(token, before):
    """Return the vertex and the texture coordinate of a corner, -1 if there is none."""
    parts, out = token.split(b"/"), [-1, -1]
    try:
        for k in range(min(len(parts), 2)):
            if parts[k]:
                number = int(parts[k])
                out[k] = number - 1 if number > 0 else number + before[k]
    except ValueError:
        raise InputError("a corner of a face is not a whole number") from None
    return out


def _to_mesh(points, uvs, corners):
    if (corners[:, 0] < 0).any() or corners[:, 0].max() >= len(points) or \
            np.abs(corners).max() > MAX_VERTICES:
        raise InputError(f"a face has a vertex outside of the {len(points)} vertices")
    if len(uvs) == 0 or (corners[:, 1] < 0).any() or corners[:, 1].max() >= len(uvs):
        return Mesh(points, corners[:, 0].reshape(-1, 3), format="obj")
    # A vertex with several texture coordinates becomes several vertices.
    pairs, inverse = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(points[pairs[:, 0]], inverse.reshape(-1, 3), uv=uvs[pairs[:, 1]], format="obj")


def write_mesh(mesh, path, report):
    """Write a mesh with its texture coordinates."""
    with open(path, "w", encoding="ascii") as file:
        np.savetxt(file, mesh.points, fmt="v %.9g %.9g %.9g")
        corners = (mesh.triangles + 1).repeat(2, axis=1) if mesh.uv is not None else \
            mesh.triangles + 1
        if mesh.uv is not None:
            np.savetxt(file, mesh.uv, fmt="vt %.9g %.9g")
        np.savetxt(file, corners, fmt="f %d/%d %d/%d %d/%d" if mesh.uv is not None else
                   "f %d %d %d")
    if mesh.weights is not None:
        report.lose("the skin of the mesh", "an OBJ file has none")
