"""Reads triangle meshes of glTF 2.0, text and binary, in their pose at rest, with skin weights."""

import base64
import binascii
import json
import os
import struct
import urllib.parse

import numpy as np

from hairconvert.binary import Bytes, load
from hairconvert.mesh import Mesh, keep_influences
from hairconvert.report import InputError

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
SUPPORTED = {"KHR_texture_transform", "KHR_materials_unlit", "KHR_mesh_quantization"}


def read(path, name, report):
    """Return the mesh of a file: all meshes, or those of the nodes or meshes of a name."""
    return _Scene(path, report).read(name)


def _get(container, index, what):
    """Return an element of a list of the file, or refuse the file."""
    if not isinstance(container, list) or not isinstance(index, int) or \
            not 0 <= index < len(container) or not isinstance(container[index], dict):
        raise InputError(f"{what} {index!r} does not exist")
    return container[index]


class _Scene:
    def __init__(self, path, report):
        self.path, self.report = path, report
        data = load(path)
        self.binary = None
        text = self._open_container(data) if data[:4] == b"glTF" else data
        try:
            self.json = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise InputError(f"the text is not JSON: {error}") from None
        if not isinstance(self.json, dict) or not isinstance(self.json.get("asset"), dict):
            raise InputError("the text is not that of glTF, because it has no asset")
        if not str(self.json["asset"].get("version", "")).startswith("2."):
            raise InputError(f"the version is {self.json['asset'].get('version')}, not 2")
        for extension in self.json.get("extensionsRequired", []):
            if extension not in SUPPORTED:
                raise InputError(f"the file requires the extension {extension}, which is not read")
        self.buffers = {}
        self.worlds = {}

    def _open_container(self, data):
        """Return the JSON chunk of a .glb file, and keep the binary chunk."""
        if len(data) < 20:
            raise InputError(f"the file of {len(data)} bytes is shorter than the header")
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2 or length > len(data):
            raise InputError(f"the header claims version {version} and {length} bytes, but the "
                             f"file has {len(data)}")
        chunks, at = {}, 12
        while at + 8 <= length:
            size, kind = struct.unpack_from("<II", data, at)
            if at + 8 + size > length:
                raise InputError(f"the chunk at byte {at} exceeds the file")
            chunks.setdefault(kind, data[at + 8:at + 8 + size])
            at += 8 + size
        if 0x4e4f534a not in chunks:
            raise InputError("the file has no chunk of JSON")
        self.binary = chunks.get(0x004e4942)
        return chunks[0x4e4f534a]

    def _buffer(self, index):
        if index in self.buffers:
            return self.buffers[index]
        buffer = _get(self.json.get("buffers"), index, "buffer")
        uri = buffer.get("uri")
        if uri is None:
            data = self.binary if index == 0 else None
        elif str(uri).startswith("data:"):
            try:
                data = base64.b64decode(str(uri).partition(",")[2], validate=True)
            except (binascii.Error, ValueError):
                raise InputError(f"buffer {index} is not base64") from None
        else:
            data = self._read_beside(urllib.parse.unquote(str(uri)))
        if data is None:
            raise InputError(f"buffer {index} has no bytes")
        self.buffers[index] = Bytes(data)
        return self.buffers[index]

    def _read_beside(self, name):
        """Return the bytes of a file in the folder of the glTF file or below."""
        folder = os.path.realpath(os.path.dirname(os.path.abspath(self.path)))
        path = os.path.realpath(os.path.join(folder, name))
        if not path.startswith(folder + os.sep) or not os.path.isfile(path):
            raise InputError(f"there is no file {name} beside or below the file")
        return load(path)

    def _view(self, view_index, at, count, components, dtype):
        """Return rows of numbers of a buffer view."""
        view = _get(self.json.get("bufferViews"), view_index, "buffer view")
        start = int(view.get("byteOffset", 0))
        length = int(view.get("byteLength", 0))
        size = np.dtype(dtype).itemsize * components
        stride = int(view.get("byteStride", 0)) or size
        needed = at + (count - 1) * stride + size if count else 0
        if at < 0 or count < 0 or stride < size or needed > length:
            raise InputError(f"{count} elements exceed the {length} bytes of buffer view "
                             f"{view_index}")
        data = self._buffer(view.get("buffer")).array("bytes of a buffer view", start, length, "u1")
        if count == 0:
            return np.zeros((0, components), dtype)
        rows = np.lib.stride_tricks.as_strided(data[at:], (count, size), (stride, 1))
        return np.ascontiguousarray(rows).view(dtype).reshape(count, components)

    def accessor(self, index):
        """Return the values of an accessor, (n, components)."""
        a = _get(self.json.get("accessors"), index, "accessor")
        dtype, components = TYPES.get(a.get("componentType")), COMPONENTS.get(a.get("type"))
        count = a.get("count")
        if not dtype or not components or not isinstance(count, int) or not 0 < count < 1 << 28:
            raise InputError(f"accessor {index} has an unknown type or count")
        if "bufferView" in a:
            values = self._view(a["bufferView"], int(a.get("byteOffset", 0)), count, components,
                                dtype).copy()
        elif "sparse" not in a:
            raise InputError(f"accessor {index} has no buffer view")
        else:
            values = np.zeros((count, components), dtype)
        if "sparse" in a:
            self._apply_sparse(a["sparse"], values, index)
        if a.get("normalized") and dtype != "<f4":
            values = np.maximum(values / float(np.iinfo(dtype).max), -1.0)
        return values

    def _apply_sparse(self, sparse, values, index):
        count, where, what = sparse["count"], sparse["indices"], sparse["values"]
        dtype = TYPES.get(where.get("componentType"), "<u4")
        rows = self._view(where["bufferView"], int(where.get("byteOffset", 0)), count, 1,
                          dtype)[:, 0].astype(np.int64)
        if count and rows.max() >= len(values):
            raise InputError(f"a sparse index of accessor {index} is out of range")
        values[rows] = self._view(what["bufferView"], int(what.get("byteOffset", 0)), count,
                                  values.shape[1], values.dtype)

    def read(self, name):
        """Return the meshes of the scene as one mesh."""
        parts = []
        for index in self._walk():
            node = self.json["nodes"][index]
            if "mesh" not in node:
                continue
            mesh = _get(self.json.get("meshes"), node["mesh"], "mesh")
            if name and name not in (node.get("name"), mesh.get("name")):
                continue
            for primitive in mesh.get("primitives", []):
                part = self._primitive(primitive, node, self.worlds[index])
                if part is not None:
                    parts.append(part)
        if not parts:
            raise InputError(f"the file has no mesh of the name {name}" if name else
                             "the file has no mesh of triangles")
        return self._join(parts)

    def _walk(self):
        """Return all nodes of the scene, after computing their transforms."""
        nodes = self.json.get("nodes", [])
        scenes = self.json.get("scenes")
        children = {c for n in nodes if isinstance(n, dict) for c in n.get("children", [])}
        roots = [i for i in range(len(nodes)) if i not in children]
        if scenes:
            roots = _get(scenes, self.json.get("scene", 0), "scene").get("nodes", [])
        order, waiting = [], [(r, np.eye(4)) for r in roots]
        while waiting:
            index, above = waiting.pop()
            node = _get(nodes, index, "node")
            if index in self.worlds:
                raise InputError(f"node {index} is below two nodes or below itself")
            self.worlds[index] = above @ _local_matrix(node)
            order.append(index)
            waiting += [(c, self.worlds[index]) for c in node.get("children", [])]
        return sorted(order)

    def _primitive(self, primitive, node, world):
        mode = primitive.get("mode", 4)
        attributes = primitive.get("attributes", {})
        if mode not in (4, 5, 6) or "POSITION" not in attributes:
            self.report.say("a primitive of points or lines is not read")
            return None
        points = self.accessor(attributes["POSITION"]).astype(np.float64)
        n = len(points)
        if points.shape[1] != 3:
            raise InputError("positions are not of the type VEC3")
        indices = np.arange(n)
        if "indices" in primitive:
            indices = self.accessor(primitive["indices"])[:, 0].astype(np.int64)
        part = Mesh(points, _to_triangles(indices, mode))
        uv = attributes.get("TEXCOORD_0")
        if uv is not None:
            part.uv = self.accessor(uv)[:, :2].astype(np.float64)
            # The origin of glTF is the upper left corner, that of the other formats the lower.
            part.uv[:, 1] = 1 - part.uv[:, 1]
        if "skin" in node and "JOINTS_0" in attributes and "WEIGHTS_0" in attributes:
            self._skin(part, node["skin"], attributes)
        else:
            part.points = points @ world[:3, :3].T + world[:3, 3]
        for array in (part.uv, part.joints):
            if array is not None and len(array) != n:
                raise InputError("attributes of a primitive have different counts")
        return part

    def _skin(self, part, index, attributes):
        """Put a skinned primitive into the pose of its joints. The node's transform is unused."""
        skin = _get(self.json.get("skins"), index, "skin")
        nodes = skin.get("joints", [])
        joints, weights, k = [], [], 0
        while f"JOINTS_{k}" in attributes and f"WEIGHTS_{k}" in attributes:
            joints.append(self.accessor(attributes[f"JOINTS_{k}"]).astype(np.int64))
            weights.append(self.accessor(attributes[f"WEIGHTS_{k}"]).astype(np.float64))
            k += 1
        joints, weights = np.concatenate(joints, axis=1), np.concatenate(weights, axis=1)
        if len(joints) != len(part.points) or joints.shape != weights.shape or \
                joints.max() >= len(nodes):
            raise InputError("joints and weights do not fit the vertices or the skin")
        matrices = np.array([self.worlds.get(j, np.eye(4)) for j in nodes])
        if "inverseBindMatrices" in skin:
            inverse = self.accessor(skin["inverseBindMatrices"])
            if inverse.shape[0] < len(nodes) or inverse.shape[1] != 16:
                raise InputError("the skin has fewer inverse bind matrices than joints")
            matrices = matrices @ inverse[:len(nodes)].reshape(-1, 4, 4).transpose(0, 2, 1)
        if k > 1:
            self.report.say("the four largest weights of each vertex are kept")
        out = np.zeros_like(part.points)
        total = np.maximum(weights.sum(axis=1), 1e-30)
        for i in range(joints.shape[1]):
            m = matrices[joints[:, i]]
            moved = np.einsum("nij,nj->ni", m[:, :3, :3], part.points) + m[:, :3, 3]
            out += moved * (weights[:, i] / total)[:, None]
        part.points = out
        part.joints, part.weights = keep_influences(joints, weights)
        part.joint_names = [str(_get(self.json["nodes"], j, "node").get("name", f"node{j}"))
                            for j in nodes]

    def _join(self, parts):
        """Return several primitives as one mesh. A joint of several skins is kept once."""
        names = list(dict.fromkeys(n for p in parts for n in p.joint_names))
        first, triangles = 0, []
        for p in parts:
            triangles.append(p.triangles + first)
            first += len(p.points)
            if names and p.joints is None:
                self.report.say("a primitive without a skin follows the first joint")
                p.joints = np.zeros((len(p.points), 4), np.int64)
                p.weights = np.tile([1.0, 0, 0, 0], (len(p.points), 1))
            elif names:
                p.joints = np.array([names.index(n) for n in p.joint_names])[p.joints]
        mesh = Mesh(np.concatenate([p.points for p in parts]), np.concatenate(triangles),
                    joint_names=names, format="glTF")
        if all(p.uv is not None for p in parts):
            mesh.uv = np.concatenate([p.uv for p in parts])
        elif any(p.uv is not None for p in parts):
            self.report.lose("the texture coordinates of the mesh", "a primitive has none")
        if names:
            mesh.joints = np.concatenate([p.joints for p in parts])
            mesh.weights = np.concatenate([p.weights for p in parts])
        return mesh


def _to_triangles(indices, mode):
    if mode == 4:
        return indices[:len(indices) // 3 * 3].reshape(-1, 3)
    n = max(len(indices) - 2, 0)
    i = np.arange(n)
    if mode == 5:
        flip = i % 2
        return np.stack([indices[i], indices[i + 1 + flip], indices[i + 2 - flip]], axis=1)
    return np.stack([np.full(n, indices[0]), indices[i + 1], indices[i + 2]], axis=1)


def _local_matrix(node):
    """Return the transform of a node, for column vectors."""
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    x, y, z, w = (float(v) for v in node.get("rotation", (0, 0, 0, 1)))
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]) * np.array(node.get("scale", (1, 1, 1)), np.float64)
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix
