"""Make a groom in Blender without a window: wavy hair above an undercut, as two groups of guides.

    python make_groom.py SCALP.obj HAIR_CONVERT OUT.groom [PICTURE.png]

The script takes the steps of the tutorial. It needs bpy, Blender as a Python package.
"""

import math
import os
import sys

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import blender_addon

GROUPS = {"top": 0, "undercut": 1}
GUIDES, VERTICES = 420, 24
SKIN, HAIR = (0.55, 0.36, 0.27, 1), (0.14, 0.06, 0.025, 1)
CENTRE = np.array([0, 0.01, 1.63])  # of the skull, m


def import_scalp(path):
    """Import the scalp and give it texture coordinates, which hair curves need."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=path)
    scalp = bpy.context.selected_objects[0]
    bpy.ops.object.transform_apply()
    bpy.ops.object.shade_smooth()
    mesh = scalp.data
    layer = mesh.uv_layers.new(name="UVMap")
    for loop in mesh.loops:
        x, y, z = np.array(mesh.vertices[loop.vertex_index].co) - CENTRE
        away, around = math.atan2(math.hypot(x, y), z) / math.pi, math.atan2(y, x)
        layer.data[loop.index].uv = (0.5 + 0.5 * away * math.cos(around),
                                     0.5 + 0.5 * away * math.sin(around))
    return scalp


def scatter_roots(scalp):
    """Return points of a mesh far from each other, their normals and texture coordinates."""
    mesh, random = scalp.data, np.random.default_rng(3)
    mesh.calc_loop_triangles()
    corners = np.array([[mesh.vertices[v].co for v in t.vertices] for t in mesh.loop_triangles])
    uvs = np.array([[mesh.uv_layers[0].data[i].uv for i in t.loops] for t in mesh.loop_triangles])
    areas = np.array([t.area for t in mesh.loop_triangles])
    chosen = random.choice(len(areas), 12 * GUIDES, p=areas / areas.sum())
    a, b = np.sqrt(random.uniform(size=len(chosen))), random.uniform(size=len(chosen))
    weights = np.stack([1 - a, a * (1 - b), a * b], axis=1)[:, :, None]
    points = (weights * corners[chosen]).sum(axis=1)
    nearest, keep = np.full(len(points), np.inf), []
    for _ in range(GUIDES):  # The next root is the point farthest from all before.
        keep.append(int(nearest.argmax()))
        nearest = np.minimum(nearest, np.linalg.norm(points - points[keep[-1]], axis=1))
    normals = points[keep] - CENTRE
    return (points[keep], normals / np.linalg.norm(normals, axis=1)[:, None],
            (weights * uvs[chosen]).sum(axis=1)[keep])


def comb(roots, normals):
    """Return strands that fall to both sides of a parting."""
    random = np.random.default_rng(4)
    side = np.where(roots[:, 0] > 0.035, 1.0, -1.0)
    way = np.stack([side, np.full(len(side), -0.3), np.zeros(len(side))], axis=1)
    way += 0.1 * random.normal(size=way.shape)
    way -= (way * normals).sum(axis=1)[:, None] * normals
    lengths = 0.15 * random.uniform(0.8, 1.1, (len(roots), 1))
    return grow(roots, lengths,
                lambda t: (0.55 - 0.35 * t) * normals + 0.9 * way + [0, 0, -1.6 * t])


def trim(roots, normals):
    """Return short strands that point down and away from the skin."""
    return grow(roots, 0.014, lambda t: 0.6 * normals + [0, 0, -0.7])


def grow(roots, lengths, find_direction):
    """Return strands that go in a direction that changes from root, 0, to tip, 1."""
    points = [roots]
    for k in range(VERTICES - 1):
        ahead = find_direction(k / (VERTICES - 1))
        ahead = ahead / np.linalg.norm(ahead, axis=1)[:, None]
        points.append(points[-1] + lengths / (VERTICES - 1) * ahead)
    return np.stack(points, axis=1)


def add_hair(scalp, group, points, uvs):
    """Add hair curves on the scalp, with the attributes that the library understands."""
    data = bpy.data.hair_curves.new(group)
    hair = bpy.data.objects.new(group, data)
    bpy.context.scene.collection.objects.link(hair)
    data.surface, data.surface_uv_map = scalp, "UVMap"
    data.add_curves([VERTICES] * len(points))
    fill(data, "position", "FLOAT_VECTOR", "POINT", "vector", points)
    fill(data, "radius", "FLOAT", "POINT", "value", np.full(points.size // 3, 4e-4))
    fill(data, "surface_uv_coordinate", "FLOAT2", "CURVE", "vector", uvs)
    fill(data, "groom_group_id", "INT", "CURVE", "value", np.full(len(points), GROUPS[group]))
    fill(data, "groom_guide", "INT", "CURVE", "value", np.ones(len(points)))
    return hair


def fill(data, name, kind, domain, member, values):
    """Set an attribute of hair curves."""
    attribute = data.attributes.get(name) or data.attributes.new(name, kind, domain)
    dtype = np.int32 if kind == "INT" else np.float32
    attribute.data.foreach_set(member, np.asarray(values).astype(dtype).ravel())


def add_modifier(hair, name, inputs):
    """Add one of Blender's hair nodes as a modifier."""
    path = os.path.join(bpy.utils.system_resource("DATAFILES"), "assets", "geometry_nodes",
                        "procedural_hair_node_assets.blend")
    with bpy.data.libraries.load(path) as (_, wanted):
        wanted.node_groups = [name]
    modifier = hair.modifiers.new(name, "NODES")
    modifier.node_group = wanted.node_groups[0]
    for item in modifier.node_group.interface.items_tree:
        if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.name in inputs:
            modifier[item.identifier] = inputs[item.name]


def render(path, size=480):
    """Draw the scene into a picture with Cycles, on the CPU."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", "SUN"))
    camera.location, camera.data.lens = (-0.42, -0.85, 1.75), 90
    light.location, light.data.energy = (-1.5, -1.5, 3.5), 3
    for o in (camera, light):
        scene.collection.objects.link(o)
        o.rotation_euler = (o.location - Vector((0, 0, 1.63))).to_track_quat("Z", "Y").to_euler()
    for o, color in ((o, SKIN if o.type == "MESH" else HAIR) for o in scene.objects
                     if o.type in ("MESH", "CURVES")):
        material = bpy.data.materials.new(o.name)
        material.use_nodes = True
        material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = color
        o.data.materials.append(material)
    scene.world = bpy.data.worlds.new("world")
    scene.world.color = (0.25, 0.25, 0.27)
    scene.camera = camera
    scene.render.engine, scene.cycles.samples = "CYCLES", 32
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def main(scalp_path, program, out, picture=""):
    """Make the groom, export the groom through the add-on, and draw the groom as Blender sees it."""
    blender_addon.register()
    scalp = import_scalp(scalp_path)
    roots, normals, uvs = scatter_roots(scalp)
    above = roots[:, 2] > 1.665
    top = add_hair(scalp, "top", comb(roots[above], normals[above]), uvs[above])
    add_modifier(top, "Curl Hair Curves", {"Guide Distance": 0.03, "Existing Guide Map": False,
                                           "Radius": 0.006, "Frequency": 2.5})
    add_hair(scalp, "undercut", trim(roots[~above], normals[~above]), uvs[~above])
    if bpy.ops.hair.export_groom(filepath=out, program=os.path.abspath(program)) != {"FINISHED"}:
        return 1
    if picture:
        render(os.path.abspath(picture))
    return 0


if __name__ == "__main__":
    RESULT = main(*sys.argv[1:5])
    sys.stdout.flush()
    os._exit(RESULT)  # Blender as a module can hang at the end of Python.
