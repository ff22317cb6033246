"""Haircuts, grooms and collision meshes, which need no OpenGL."""

import numpy as np

from ._native import call, ffi, hair, host, new_desc, to_dict
from .arrays import array, floats, integers, pointer, small_integers
from .settings import CLASSES


class Asset:
    """A haircut as arrays. Asset.read() and Asset.generate() make it."""

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
        """The arrays of hair_asset_info, copied. Those that the haircut lacks are None."""
        info = self._info()
        return {
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
    number of vertices of each strand. strand_groups has the group of each strand. `members` are those
    of GroomDesc.
    """

    def __init__(self, asset=None, *, positions=None, strand_vertices=None, scalp_positions=None,
                 scalp_triangles=None, strand_groups=None, members=None, **more):  # fmt: skip
        desc, out, kept = CLASSES["GroomDesc"](), ffi.new("hair_groom**"), []
        c = desc._c
        if asset is not None:
            call(hair.hair_asset_to_groom_desc, asset._c, c)
        else:
            if positions is None or strand_vertices is None:
                raise ValueError("a groom needs an asset, or positions and strand_vertices")
            kept += [floats(positions, 3, "positions"), integers(strand_vertices, "strand_vertices")]
            if int(kept[1].sum(dtype=np.uint64)) != len(kept[0]):
                raise ValueError(f"strand_vertices add up to {kept[1].sum()}, and there are {len(kept[0])} positions")
            c.positions, c.strand_vertices = pointer("float", kept[0]), pointer("uint32_t", kept[1])
            c.strand_count = len(kept[1])
        if strand_groups is not None:
            kept.append(small_integers(strand_groups, c.strand_count, "strand_groups"))
            c.strand_groups = pointer("uint8_t", kept[-1])
        if scalp_positions is not None:
            points = floats(scalp_positions, 3, "scalp_positions")
            triangles = integers(() if scalp_triangles is None else scalp_triangles, "scalp_triangles")
            kept += [points, triangles]
            c.scalp_positions, c.scalp_vertex_count = pointer("float", points), len(points)
            c.scalp_triangles, c.scalp_triangle_count = pointer("uint32_t", triangles), len(triangles) // 3
        desc.update(members or {}, **more)
        c.host = host
        call(hair.hair_groom_create, c, out)
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
