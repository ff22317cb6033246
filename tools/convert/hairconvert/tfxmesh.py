"""The .tfxmesh text and the .tfxbone file of TressFX: a skinned mesh, and joints of strands."""

import numpy as np

from hairconvert.binary import Bytes, load
from hairconvert.mesh import MAX_TRIANGLES, Mesh, vertex_normals
from hairconvert.report import InputError


def read(path, name, report):
    """Return the mesh of a .tfxmesh file."""
    lines = [line.split() for line in load(path).splitlines()
             if line.strip() and not line.lstrip().startswith(b"#")]
    reader = _Lines(lines)
    bones = reader.section(b"numOfBones", 2, False)
    vertices = reader.section(b"numOfVertices", 15, True)
    triangles = reader.section(b"numOfTriangles", 4, True)
    return Mesh(vertices[:, 1:4], triangles[:, 1:4].astype(np.int64),
                joints=vertices[:, 7:11].astype(np.int64), weights=vertices[:, 11:15].copy(),
                joint_names=[b[1].decode(errors="replace") for b in bones], format="tfxmesh")


class _Lines:
    def __init__(self, lines):
        self.lines, self.at = lines, 0

    def section(self, key, columns, numbers):
        """Return the lines after a line with a key and a count."""
        head = self.lines[self.at] if self.at < len(self.lines) else []
        if len(head) != 2 or head[0] != key or not head[1].isdigit():
            raise InputError(f"a line {key.decode()} with a count is missing")
        count = int(head[1])
        if count > MAX_TRIANGLES or self.at + 1 + count > len(self.lines):
            raise InputError(f"{key.decode()} claims {count} lines, more than the file has")
        rows = self.lines[self.at + 1:self.at + 1 + count]
        self.at += 1 + count
        if any(len(r) < columns for r in rows):
            raise InputError(f"a line of {key.decode()} has fewer than {columns} words")
        if not numbers:
            return rows
        try:
            table = np.array([r[:columns] for r in rows]).astype(np.float64)
        except ValueError:
            raise InputError(f"a line of {key.decode()} has a word that is no number") from None
        if not np.isfinite(table).all():
            raise InputError(f"a line of {key.decode()} has a number that is not finite")
        return table.reshape(-1, columns)


def write(mesh, path, report):
    """Write a .tfxmesh file. A mesh without a skin gets one joint, root."""
    names, joints, weights = mesh.joint_names, mesh.joints, mesh.weights
    if weights is None:
        report.say("the mesh has no skin and follows one joint, root")
        names, joints = ["root"], np.zeros((len(mesh.points), 4), np.int64)
        weights = np.tile([1.0, 0, 0, 0], (len(mesh.points), 1))
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"numOfBones {len(names)}\n# index, name\n")
        for i, name in enumerate(names):
            file.write(f"{i} {'_'.join(str(name).split()) or 'joint'}\n")
        n = len(mesh.points)
        file.write(f"numOfVertices {n}\n# index, position, normal, joints, weights\n")
        table = np.column_stack([np.arange(n), mesh.points, vertex_normals(mesh), joints, weights])
        np.savetxt(file, table, fmt="%d " + "%.9g " * 6 + "%d " * 4 + "%.9g " * 3 + "%.9g")
        m = len(mesh.triangles)
        file.write(f"numOfTriangles {m}\n# index, vertices\n")
        np.savetxt(file, np.column_stack([np.arange(m), mesh.triangles]), fmt="%d")
    if mesh.uv is not None:
        report.lose("the texture coordinates of the mesh", "a .tfxmesh file has none")


def write_bones(names, joints, weights, path):
    """Write a .tfxbone file: the joints and weights of each strand."""
    with open(path, "wb") as file:
        file.write(np.array([len(names)], "<i4").tobytes())
        for i, name in enumerate(names):
            text = str(name).encode() + b"\0"
            file.write(np.array([i, len(text)], "<i4").tobytes() + text)
        rows = np.zeros(len(joints), [("strand", "<i4"),
                                      ("pairs", [("joint", "<i4"), ("weight", "<f4")], 4)])
        rows["strand"] = np.arange(len(joints))
        rows["pairs"]["joint"], rows["pairs"]["weight"] = joints, weights
        file.write(np.array([len(joints)], "<i4").tobytes() + rows.tobytes())


def read_bones(data):
    """Return names, joints and weights of the bytes of a .tfxbone file."""
    file, names, at = Bytes(data), [], 4
    for i in range(file.number("count of joints", 0, "<i4")):
        length = file.number("length of a name", at + 4, "<i4")
        text = file.array("name of a joint", at + 8, length, "u1").tobytes()
        names.append(text.rstrip(b"\0").decode(errors="replace"))
        at += 8 + length
    count = file.number("count of strands", at, "<i4")
    kind = [("strand", "<i4"), ("pairs", [("joint", "<i4"), ("weight", "<f4")], 4)]
    rows = file.array("joints of strands", at + 4, count, np.dtype(kind))
    return names, rows["pairs"]["joint"].astype(np.int64), rows["pairs"]["weight"]
