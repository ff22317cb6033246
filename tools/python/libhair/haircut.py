"""Haircuts, grooms and collision meshes, which need no OpenGL."""

import numpy as np

from ._native import call, ffi, hair, host, new_desc, to_dict
from .arrays import array, floats, integers, pointer, small_integers
from .settings import CLASSES


def _exactly(values, count, width, name):
    """Return `count` rows of floats."""
    out = floats(values, width, name)
    if len(out) != count:
        raise ValueError(f"{name} has {len(out)} rows, not {count}")
    return out


def _find_kind(name):
    """Return the value of hair_strand_attribute_kind of a name."""
    kinds = []
    while (text := hair.hair_strand_attribute_name(len(kinds))) != ffi.NULL:
        kinds.append(ffi.string(text).decode())
    if name not in kinds:
        raise ValueError(f"the kind of an attribute is {name!r}, not one of {', '.join(kinds)}")
    return kinds.index(name)


def _set_map(c, map, values, name):
    """Let a hair_map have values: rows of an image, or a number for each vertex or triangle of the scalp."""
    shape = np.shape(values)
    out = floats(values, 1, name)
    if len(shape) == 2:
        map.source, map.height, map.width = hair.HAIR_MAP_SOURCE_IMAGE, *shape
    elif shape == (c.scalp_vertex_count,):
        map.source = hair.HAIR_MAP_SOURCE_VERTICES
    elif shape == (c.scalp_triangle_count,):
        map.source = hair.HAIR_MAP_SOURCE_TRIANGLES
    else:
        raise ValueError(f"{name} has the shape {shape}, which is no image, and not that of the scalp's "
                         f"{c.scalp_vertex_count} vertices or {c.scalp_triangle_count} triangles")  # fmt: skip
    map.values = pointer("float", out)
    return out


def _set_attributes(c, values, maps):
    """Let a hair_groom_desc have attributes of strands. Return what must be kept while the desc is used."""
    of_strands, of_maps = list(dict(values or {}).items()), list(maps.items() if isinstance(maps, dict) else maps or ())
    attributes = ffi.new("hair_strand_attribute[]", len(of_strands) + len(of_maps))
    kept = [attributes]
    for i, (name, numbers) in enumerate(of_strands + of_maps):
        attributes[i] = new_desc("hair_strand_attribute")[0]
        attributes[i].kind = _find_kind(name)
        if i < len(of_strands):
            kept.append(_exactly(numbers, c.strand_count, 1, f"strand_attributes[{name!r}]"))
            attributes[i].strand_values = pointer("float", kept[-1])
        else:
            kept.append(_set_map(c, attributes[i].map, numbers, f"attribute_maps[{name!r}]"))
    c.strand_attributes, c.strand_attribute_count = attributes, len(attributes)
    return kept


def _map_array(info, map):
    """Return the values of a hair_map, copied."""
    if map.source == hair.HAIR_MAP_SOURCE_IMAGE:
        return array(map.values, map.height * map.width, 1, np.float32).reshape(map.height, map.width)
    of_vertices = map.source == hair.HAIR_MAP_SOURCE_VERTICES
    return array(map.values, info.scalp_vertex_count if of_vertices else info.scalp_triangle_count, 1, np.float32)


def _joint_names(info):
    """Return the names of joints, or None."""
    if info.scalp_joint_names == ffi.NULL:
        return None
    names, at = [], info.scalp_joint_names
    for _ in range(info.scalp_joint_count):
        name = ffi.string(at)
        names.append(name.decode())
        at += len(name) + 1
    return names


def _set_arrays(c, positions, strand_vertices, strand_groups=None, strand_radii=None, scalp_positions=None,
                scalp_triangles=None, scalp_density=None, scalp_uvs=None, strand_attributes=None,
                attribute_maps=None, strand_guides=None):  # fmt: skip
    """Let a hair_groom_desc point at arrays. Return what must be kept while the desc is used."""
    kept = []

    def keep(kind, array):
        kept.append(array)
        return pointer(kind, array)

    if positions is not None:
        points, vertices = floats(positions, 3, "positions"), integers(strand_vertices, "strand_vertices")
        if int(vertices.sum(dtype=np.uint64)) != len(points):
            raise ValueError(f"strand_vertices add up to {vertices.sum()}, and there are {len(points)} positions")
        c.positions, c.strand_vertices = keep("float", points), keep("uint32_t", vertices)
        c.strand_count = len(vertices)
    if strand_groups is not None:
        c.strand_groups = keep("uint8_t", small_integers(strand_groups, c.strand_count, "strand_groups"))
    if strand_guides is not None:
        c.strand_guides = keep("uint8_t", small_integers(strand_guides, c.strand_count, "strand_guides"))
    if strand_radii is not None:
        c.strand_radii = keep("float", _exactly(strand_radii, c.strand_count, 1, "strand_radii"))
    if scalp_positions is not None:
        points = floats(scalp_positions, 3, "scalp_positions")
        triangles = integers(() if scalp_triangles is None else scalp_triangles, "scalp_triangles")
        c.scalp_positions, c.scalp_vertex_count = keep("float", points), len(points)
        c.scalp_triangles, c.scalp_triangle_count = keep("uint32_t", triangles), len(triangles) // 3
    if scalp_density is not None:
        c.scalp_density = keep("float", _exactly(scalp_density, c.scalp_vertex_count, 1, "scalp_density"))
    if scalp_uvs is not None:
        c.scalp_uvs = keep("float", _exactly(scalp_uvs, c.scalp_vertex_count, 2, "scalp_uvs"))
    if strand_attributes is not None or attribute_maps is not None:
        kept += _set_attributes(c, strand_attributes, attribute_maps)
    return kept


class Asset:
    """A haircut as arrays. Asset.read(), Asset.generate() and Asset.create() make it."""

    def __init__(self, pointer):
        self._c = ffi.gc(pointer, hair.hair_asset_destroy)

    @classmethod
    def read(cls, source, **members):
        """Read the bytes of a .groom, .hair or .tfx file, or the file of a path. `members` are those of Import."""
        if not isinstance(source, (bytes, bytearray, memoryview)):
            with open(source, "rb") as file:
                source = file.read()
        desc, settings, out = new_desc("hair_asset_desc"), CLASSES["Import"](members), ffi.new("hair_asset**")
        setattr(desc, "import", settings._c)
        desc.host = host
        source = bytes(source)
        call(hair.hair_asset_read, desc, source, len(source), out)
        return cls(out[0])

    @classmethod
    def generate(cls, style="long", **members):
        """Make a built-in haircut. `members` are those of StyleDesc."""
        desc, out = CLASSES["StyleDesc"](members, style=style), ffi.new("hair_asset**")
        desc._c.host = host
        call(hair.hair_asset_generate, desc._c, out)
        return cls(out[0])

    @classmethod
    def create(cls, positions, strand_vertices, *, scalp_joints=None, scalp_weights=None, joint_count=0,
               scalp_joint_names=None, members=None, **arrays):  # fmt: skip
        """Make a haircut of arrays, to write a file.

        `arrays` are strand_groups, strand_guides, strand_radii, scalp_positions, scalp_triangles, scalp_density,
        scalp_uvs, strand_attributes and attribute_maps, which Groom explains. A vertex of the scalp has four joints,
        below joint_count, and four weights. scalp_joint_names has the names of all joints. `members` are those of GroomDesc.
        """
        desc, out, joints, weights = CLASSES["GroomDesc"](), ffi.new("hair_asset**"), ffi.NULL, ffi.NULL
        names = ffi.NULL
        c = desc._c
        kept = _set_arrays(c, positions, strand_vertices, **arrays)
        if scalp_joints is not None:
            numbers = integers(scalp_joints, "scalp_joints")
            if len(numbers) != 4 * c.scalp_vertex_count or (len(numbers) and numbers.max() > 65535):
                raise ValueError(f"scalp_joints must be {4 * c.scalp_vertex_count} integers from 0 to 65535")
            kept += [numbers.astype(np.uint16), _exactly(scalp_weights, c.scalp_vertex_count, 4, "scalp_weights")]
            joints, weights = pointer("uint16_t", kept[-2]), pointer("float", kept[-1])
        if scalp_joint_names is not None:
            if len(scalp_joint_names) != joint_count or any("\0" in name for name in scalp_joint_names):
                raise ValueError(f"scalp_joint_names must be {joint_count} names without a character 0")
            names = ffi.new("char[]", "".join(name + "\0" for name in scalp_joint_names).encode())
        desc.update(members or {})
        c.host = host
        call(hair.hair_asset_create, c, joints, weights, joint_count, names, out)
        del kept  # The library has copied the arrays.
        return cls(out[0])

    def write(self, format="hair"):
        """Return the bytes of a file: "groom", "hair" or "tfx4"."""
        formats = {"groom": hair.HAIR_FORMAT_GROOM, "hair": hair.HAIR_FORMAT_HAIR, "tfx4": hair.HAIR_FORMAT_TFX4}
        if format not in formats:
            raise ValueError(f'the format is {format!r}, not "groom", "hair" or "tfx4"')
        size = ffi.new("size_t*")
        call(hair.hair_asset_write, self._c, formats[format], ffi.NULL, 0, size)
        out = ffi.new("char[]", size[0])
        call(hair.hair_asset_write, self._c, formats[format], out, size[0], size)
        return bytes(ffi.buffer(out, size[0]))

    def _info(self):
        info = new_desc("hair_asset_info")
        call(hair.hair_asset_describe, self._c, info)
        return info

    @property
    def info(self):
        """The numbers of hair_asset_info."""
        return to_dict(self._info()[0])

    @property
    def arrays(self):
        """The arrays of hair_asset_info, copied. Those that the haircut lacks are None.

        strand_attributes has the factors of strands by the names of kinds, and attribute_maps has pairs of
        a name and a map. Groom and create() take both.
        """
        info = self._info()
        attributes = [info.strand_attributes[i] for i in range(info.strand_attribute_count)]
        names = [ffi.string(hair.hair_strand_attribute_name(a.kind)).decode() for a in attributes]
        return {
            "strand_attributes": {n: array(a.strand_values, info.strand_count, 1, np.float32)
                                  for n, a in zip(names, attributes) if a.strand_values != ffi.NULL},
            "attribute_maps": [(n, _map_array(info, a.map)) for n, a in zip(names, attributes) if a.map.source],
            "strand_guides": array(info.strand_guides, info.strand_count, 1, np.uint8),
            "scalp_joint_names": _joint_names(info),
            "positions": array(info.positions, info.vertex_count, 3, np.float32),
            "strand_vertices": array(info.strand_vertices, info.strand_count, 1, np.uint32),
            "strand_radii": array(info.strand_radii, info.strand_count, 1, np.float32),
            "strand_colors": array(info.strand_colors, info.strand_count * 8, 3, np.float32),
            "strand_groups": array(info.strand_groups, info.strand_count, 1, np.uint8),
            "scalp_positions": array(info.scalp_positions, info.scalp_vertex_count, 3, np.float32),
            "scalp_triangles": array(info.scalp_triangles, info.scalp_triangle_count, 3, np.uint32),
            "scalp_density": array(info.scalp_density, info.scalp_vertex_count, 1, np.float32),
            "scalp_uvs": array(info.scalp_uvs, info.scalp_vertex_count, 2, np.float32),
            "scalp_joints": array(info.scalp_joints, info.scalp_vertex_count, 4, np.uint16),
            "scalp_weights": array(info.scalp_weights, info.scalp_vertex_count, 4, np.float32),
        }


class Groom:
    """An immutable haircut that hair is made from.

    The strands are those of an asset, or arrays: positions of all vertices, strand after strand, and the
    number of vertices of each strand. strand_groups has the group of each strand, and strand_guides 1 for each
    strand that is a guide, otherwise 0. strand_attributes has factors of all strands by the names of kinds, as {"stiffness": factors}. attribute_maps has maps of
    factors on the scalp in the same way: an image as rows, or a number for each vertex or triangle.
    `members` are those of GroomDesc.
    """

    def __init__(self, asset=None, *, positions=None, strand_vertices=None, scalp_positions=None,
                 scalp_triangles=None, strand_groups=None, scalp_uvs=None, strand_attributes=None,
                 attribute_maps=None, strand_guides=None, members=None, **more):  # fmt: skip
        desc, out = CLASSES["GroomDesc"](), ffi.new("hair_groom**")
        c = desc._c
        if asset is not None:
            call(hair.hair_asset_to_groom_desc, asset._c, c)
            positions = None
        elif positions is None or strand_vertices is None:
            raise ValueError("a groom needs an asset, or positions and strand_vertices")
        # The library copies the arrays before `kept` ends.
        kept = _set_arrays(c, positions, strand_vertices, strand_groups, None, scalp_positions, scalp_triangles,
                           None, scalp_uvs, strand_attributes, attribute_maps, strand_guides)  # fmt: skip
        desc.update(members or {}, **more)
        c.host = host
        call(hair.hair_groom_create, c, out)
        del kept
        self._c = ffi.gc(out[0], hair.hair_groom_destroy)

    @property
    def groups(self):
        """The group of each guide."""
        count = self.info["guide_count"]
        out = np.zeros(count, dtype=np.uint8)
        call(hair.hair_groom_get_groups, self._c, pointer("uint8_t", out), count)
        return out

    @property
    def info(self):
        """The numbers of hair_groom_info."""
        out = new_desc("hair_groom_info")
        call(hair.hair_groom_describe, self._c, out)
        return to_dict(out[0])


class CollisionMesh:
    """A triangle mesh to collide with. `members` are those of CollisionMeshDesc."""

    def __init__(self, positions, triangles, **members):
        desc, out = CLASSES["CollisionMeshDesc"](), ffi.new("hair_collision_mesh**")
        points, corners = floats(positions, 3, "positions"), integers(triangles, "triangles")
        c = desc._c
        c.positions, c.vertex_count = pointer("float", points), len(points)
        c.triangles, c.triangle_count = pointer("uint32_t", corners), len(corners) // 3
        desc.update(members)
        c.host = host
        call(hair.hair_collision_mesh_create, c, out)
        self._c = ffi.gc(out[0], hair.hair_collision_mesh_destroy)

    @property
    def info(self):
        """The numbers of hair_collision_mesh_info."""
        out = new_desc("hair_collision_mesh_info")
        call(hair.hair_collision_mesh_describe, self._c, out)
        return to_dict(out[0])
