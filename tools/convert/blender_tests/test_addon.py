"""The add-on in Blender without a window: grooms by Blender's hair nodes go out and come back."""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import bpy
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
import blender_addon

CONVERT, GROOM, CAPTURE = (os.environ.get(n) for n in ("HAIR_CONVERT", "HAIR_GROOM", "HAIR_CAPTURE"))
RADIUS, HEIGHT = 0.1, 1.6
# Node group of a groom and values of its inputs.
STYLES = {
    "straight": (None, {}),
    "clumped": ("Clump Hair Curves", {"Guide Distance": 0.03, "Existing Guide Map": False}),
    "braid": ("Braid Hair Curves", {"Guide Distance": 0.05, "Existing Guide Map": False,
                                    "Radius": 0.01, "Frequency": 3.0}),
    "curly": ("Curl Hair Curves", {"Guide Distance": 0.02, "Existing Guide Map": False,
                                   "Radius": 0.01, "Frequency": 4.0}),
}


def setUpModule():
    if not CONVERT or not GROOM or not CAPTURE:
        raise AssertionError("HAIR_CONVERT, HAIR_GROOM and HAIR_CAPTURE do not name the programs")
    blender_addon.register()


def make_scene(style, strands=100, vertices=9):
    """Make an empty scene with hair of a style on a ball. Return hair and ball."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=RADIUS, location=(0, 0, HEIGHT), segments=48,
                                         ring_count=24)
    ball = bpy.context.object
    data = bpy.data.hair_curves.new("groom")
    hair = bpy.data.objects.new("groom", data)
    bpy.context.scene.collection.objects.link(hair)
    data.surface, data.surface_uv_map = ball, "UVMap"
    data.add_curves([vertices] * strands)
    random = np.random.default_rng(1)
    out = random.normal(size=(strands, 3))
    out[:, 2] = np.abs(out[:, 2])
    out /= np.linalg.norm(out, axis=1)[:, None]
    t = np.linspace(0, 1, vertices)
    points = out[:, None] * (RADIUS + 0.2 * t)[None, :, None] + [0, 0, HEIGHT]
    points[:, :, 2] -= 0.05 * t * t
    n = strands * vertices
    fill(data, "position", "FLOAT_VECTOR", "POINT", "vector", points)
    fill(data, "radius", "FLOAT", "POINT", "value", random.uniform(2e-5, 5e-5, n))
    fill(data, "surface_uv_coordinate", "FLOAT2", "CURVE", "vector", random.uniform(0, 1, 2 * strands))
    fill(data, "groom_group_id", "INT", "CURVE", "value", np.arange(strands) % 3)
    fill(data, "groom_guide", "INT", "CURVE", "value", np.arange(strands) % 5 == 0)
    fill(data, "stiffness", "FLOAT", "CURVE", "value", random.uniform(0, 1, strands))
    fill(data, "damping", "FLOAT", "POINT", "value", random.uniform(0, 1, n))
    fill(data, "direction", "FLOAT_VECTOR", "CURVE", "vector", random.uniform(0, 1, 3 * strands))
    group, inputs = STYLES[style]
    if group:
        add_nodes(hair, group, inputs)
    return hair, ball


def fill(data, name, kind, domain, member, values):
    """Set an attribute of hair curves."""
    attribute = data.attributes.get(name) or data.attributes.new(name, kind, domain)
    dtype = np.int32 if kind == "INT" else np.float32
    attribute.data.foreach_set(member, np.asarray(values).astype(dtype).ravel())


def add_nodes(hair, group, inputs):
    """Add a node group of Blender's assets as a modifier."""
    path = os.path.join(bpy.utils.system_resource("DATAFILES"), "assets", "geometry_nodes",
                        "procedural_hair_node_assets.blend")
    with bpy.data.libraries.load(path) as (_, wanted):
        wanted.node_groups = [group]
    modifier = hair.modifiers.new(group, "NODES")
    modifier.node_group = wanted.node_groups[0]
    for item in modifier.node_group.interface.items_tree:
        if item.item_type == "SOCKET" and item.in_out == "INPUT" and item.name in inputs:
            modifier[item.identifier] = inputs[item.name]


def evaluated(hair):
    """Return positions in the world, counts, and other attributes of evaluated hair."""
    found = hair.evaluated_get(bpy.context.evaluated_depsgraph_get())
    data, attributes = found.data, {}
    for a in data.attributes:
        member, size, dtype = {"FLOAT": ("value", 1, "f4"), "INT": ("value", 1, "i4"),
                               "FLOAT2": ("vector", 2, "f4"), "FLOAT_VECTOR": ("vector", 3, "f4"),
                               }.get(a.data_type, (None, 0, ""))
        if member:
            values = np.zeros(len(a.data) * size, dtype)
            a.data.foreach_get(member, values)
            attributes[a.name] = values.reshape(-1, size)
    counts = np.array([c.points_length for c in data.curves])
    matrix = np.array(found.matrix_world, np.float64)
    points = attributes.pop("position") @ matrix[:3, :3].T + matrix[:3, 3]
    return points, counts, attributes


def lengths(points, counts):
    """Return the length of the strand of each vertex."""
    ends = np.cumsum(counts)
    parts = [np.linalg.norm(np.diff(p, axis=0), axis=1).sum() for p in np.split(points, ends[:-1])]
    return np.repeat(parts, counts)


class AddonTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def convert(self, *arguments):
        done = subprocess.run([CONVERT, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def import_hair(self, path):
        """Import into an empty scene. Return the hair object."""
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.assertEqual(bpy.ops.hair.import_cache(filepath=path, program=CONVERT), {"FINISHED"})
        hair = [o for o in bpy.context.scene.objects if o.type == "CURVES"]
        self.assertEqual(len(hair), 1)
        return hair[0]

    def test_round_trip_keeps_positions_and_attributes(self):
        for style in STYLES:
            for strands in (100, 2000):
                with self.subTest(style=style, strands=strands):
                    hair, _ = make_scene(style, strands)
                    points, counts, attributes = evaluated(hair)
                    self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path("a.usdc")),
                                     {"FINISHED"})
                    self.convert("convert", self.path("a.usdc"), self.path("b.usdc"))
                    got, got_counts, got_attributes = evaluated(
                        self.import_hair(self.path("b.usdc")))
                    np.testing.assert_array_equal(got_counts, counts)
                    error = np.linalg.norm(got - points, axis=1)
                    self.assertLess((error / lengths(points, counts)).max(), 1e-5)
                    for name in ("groom_group_id", "groom_guide", "stiffness", "damping",
                                 "direction", "surface_uv_coordinate"):
                        np.testing.assert_array_equal(got_attributes[name], attributes[name], name)
                    np.testing.assert_allclose(got_attributes["radius"], attributes["radius"],
                                               rtol=1e-6)

    def test_groom_files_keep_blender_hair_on_both_ways(self):
        """Go from Blender by USD to .groom, by USD to Blender, and from there to .groom again."""
        worst = 0
        for style in STYLES:
            for strands in (100, 100000 if style in ("straight", "curly") else 2000):
                with self.subTest(style=style, strands=strands):
                    hair, _ = make_scene(style, strands)
                    fill(hair.data, "hair_stiffness", "FLOAT", "CURVE", "value", np.linspace(0, 100, strands))
                    points, counts, attributes = evaluated(hair)
                    long = lengths(points, counts)
                    self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path("a.usdc")), {"FINISHED"})
                    self.convert("convert", self.path("a.usdc"), self.path("b.groom"))
                    self.convert("convert", self.path("b.groom"), self.path("c.usdc"))
                    self.import_hair(self.path("c.usdc"))
                    self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path("d.groom"), program=CONVERT),
                                     {"FINISHED"})
                    self.convert("convert", self.path("d.groom"), self.path("e.usdc"))
                    for path in ("c.usdc", "e.usdc"):
                        got, got_counts, found = evaluated(self.import_hair(self.path(path)))
                        np.testing.assert_array_equal(got_counts, counts)
                        error = (np.linalg.norm(got - points, axis=1) / long).max()
                        worst = max(worst, error)
                        self.assertLess(error, 1e-5, path)
                        for name in ("groom_group_id", "groom_guide", "hair_stiffness"):
                            np.testing.assert_array_equal(found[name], attributes[name], f"{path} {name}")
        print(f"hair is within {worst:.1e} of its length after .groom files on both ways")

    def test_nodes_change_the_hair(self):
        straight, _, _ = evaluated(make_scene("straight")[0])
        for style in ("clumped", "braid", "curly"):
            points, _, _ = evaluated(make_scene(style)[0])
            self.assertTrue(len(points) != len(straight) or np.abs(points - straight).max() > 1e-3)

    def test_export_for_the_library_is_fitted_to_the_scalp(self):
        hair, ball = make_scene("straight")
        data = hair.data
        points = np.zeros(len(data.points) * 3, np.float32)
        data.attributes["position"].data.foreach_get("vector", points)
        data.attributes["position"].data.foreach_set("vector", points + np.float32(0.003))
        for name in ("a.tfx", "a.hair", "a.abc"):
            self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path(name), program=CONVERT),
                             {"FINISHED"})
        subprocess.run([GROOM, "info", self.path("a.tfx")], check=True, capture_output=True)
        roots, counts, _ = evaluated(self.import_hair(self.path("a.tfx")))
        roots = roots[np.cumsum(counts) - counts]
        off = np.linalg.norm(roots - [0, 0, HEIGHT], axis=1) - RADIUS
        self.assertLess(np.abs(off).max(), 6e-4)  # The faces of the ball lie that far inside.

    def test_groom_keeps_strands_groups_and_scalp(self):
        hair, ball = make_scene("curly")
        fill(hair.data, "hair_stiffness", "FLOAT", "CURVE", "value",
             np.linspace(0, 100, len(hair.data.curves)))
        points, counts, attributes = evaluated(hair)
        self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path("a.groom"), program=CONVERT),
                         {"FINISHED"})
        info = subprocess.run([GROOM, "info", self.path("a.groom")], check=True,
                              capture_output=True, text=True).stdout
        triangles = sum(len(p.vertices) - 2 for p in ball.data.polygons)
        self.assertRegex(info, f"strands: +{len(counts)}, ")
        self.assertRegex(info, f"scalp: .* {triangles} triangles, texture coordinates")
        self.assertIn("attributes: stiffness of every strand", info)
        got, got_counts, got_attributes = evaluated(self.import_hair(self.path("a.groom")))
        np.testing.assert_array_equal(got_counts, counts)
        for name in ("groom_group_id", "groom_guide", "hair_stiffness"):
            np.testing.assert_array_equal(got_attributes[name], attributes[name], name)
        starts = np.repeat(np.cumsum(counts) - counts, counts)
        np.testing.assert_allclose(got_attributes["radius"], attributes["radius"][starts], rtol=1e-6)
        # The fit to the scalp may move roots, so shapes are compared from the root on.
        error = np.linalg.norm((got - got[starts]) - (points - points[starts]), axis=1)
        near = error < 1.2e-5 * lengths(points, counts)
        self.assertGreater(near.mean(), 0.9)

    def test_simulated_hair_comes_back_as_animation(self):
        make_scene("straight")
        self.assertEqual(bpy.ops.hair.export_groom(filepath=self.path("a.tfx"), program=CONVERT),
                         {"FINISHED"})
        subprocess.run([CAPTURE, "--groom", self.path("a.tfx"), "--frames", "0:6", "--fps", "24",
                        "--motion", "shake", "--dump-guides", self.path("a.dump")],
                       check=True, capture_output=True)
        hair = self.import_hair(self.path("a.dump"))
        with open(self.path("a.dump"), "rb") as file:
            strands, vertices, frames = struct.unpack("<III", file.read(24)[12:])
            file.seek(40)
            want = np.frombuffer(file.read(), "<f4").reshape(frames, strands * vertices, 3)
        self.assertEqual(frames, 6)
        for frame in (0, 3, 5):
            bpy.context.scene.frame_set(frame)
            got, counts, _ = evaluated(hair)
            self.assertEqual(counts.tolist(), [vertices] * strands)
            # The axis +y of the library is +z of Blender.
            expected = np.stack([want[frame, :, 0], -want[frame, :, 2], want[frame, :, 1]], axis=1)
            np.testing.assert_allclose(got, expected, atol=2e-6)

    def test_commands_of_the_tutorial_make_their_files(self):
        run = os.path.join(os.path.dirname(__file__), "..", "tutorial", "run.sh")
        done = subprocess.run(["sh", run, os.path.dirname(GROOM), self.folder, "sh", "convert",
                               "blender"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name in ("blender.png", "head.png", "motion.png"):
            self.assertTrue(os.path.getsize(self.path(name)), name)
        # Blender makes the groom that is there for readers without Blender. The order of objects in
        # USD can differ.
        made, stored = (subprocess.run([GROOM, "info", path], check=True, capture_output=True).stdout
                        for path in (self.path("head.groom"),
                                     os.path.join(os.path.dirname(run), "head.groom")))
        self.assertEqual(made, stored)

    def test_failures_are_reported(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        with self.assertRaisesRegex(RuntimeError, "no hair curves"):
            bpy.ops.hair.export_groom(filepath=self.path("a.usdc"))
        make_scene("straight", 4)
        with self.assertRaisesRegex(RuntimeError, "does not end in"):
            bpy.ops.hair.export_groom(filepath=self.path("a.xyz"), program=CONVERT)
        with self.assertRaisesRegex(RuntimeError, "there is no such file"):
            bpy.ops.hair.import_cache(filepath=self.path("none.dump"), program=CONVERT)


if __name__ == "__main__":
    RESULT = unittest.main(exit=False).result
    sys.stderr.flush()
    sys.stdout.flush()
    # Blender as a module can hang at the end of Python, so the end is not waited for.
    os._exit(0 if RESULT.wasSuccessful() and RESULT.testsRun else 1)
