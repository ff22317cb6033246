"""Lights and fibres in Blender's Python: their units, and the tilt of scales towards the root."""

import math
import os
import tempfile
import unittest

import bpy
import numpy as np

from hairtruth import cases, cycles


def read(path):
    """Return the linear colours of a picture, from its bottom row."""
    picture = bpy.data.images.load(path)
    picture.colorspace_settings.name = "Non-Color"
    width, height = picture.size
    return np.array(picture.pixels[:]).reshape(height, width, 4)[:, :, :3]


def trace():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "picture.exr")
        cycles.render(path, 1)
        return read(path)


def add_matte_plane(albedo):
    """Add a square of one metre around the target, upright and towards the eye."""
    plane = bpy.data.meshes.new("plane")
    half = cycles.UNIT / 2
    plane.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [],
                      [(0, 1, 2, 3)])
    material = bpy.data.materials.new("matte")
    material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    node.inputs["Base Color"].default_value = (albedo, albedo, albedo, 1)
    node.inputs["Specular IOR Level"].default_value = 0
    plane.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("plane", plane))


class TestLights(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.world = bpy.data.worlds.new("sky")
        cycles.set_options(16, 64)
        cycles.add_camera()

    def test_lights_have_the_irradiance_of_the_cases(self):
        add_matte_plane(0.5)
        for light in (cases.Light("sun", 45), cases.Light("lamps"), cases.Light("sky")):
            irradiance = np.full(3, light.sky())
            for way, color in light.suns():
                irradiance += np.array(color) * max(way[2], 0)
            for at, color in light.lamps():
                to = np.array(at) - cases.TARGET
                irradiance += np.array(color) * max(to[2], 0) / np.dot(to, to) ** 1.5
            cycles.add_lights(light)
            middle = trace()[7:9, 7:9].mean((0, 1))
            with self.subTest(light.name):
                np.testing.assert_allclose(middle, irradiance * 0.5 / math.pi, rtol=0.005)

    def test_the_sky_is_hidden_from_the_eye(self):
        cycles.add_lights(cases.Light("sky"))
        self.assertEqual(trace().max(), 0)


class TestFibre(unittest.TestCase):
    def test_scales_tilt_highlights_towards_the_root(self):
        # The fibre is upright and black, and its root is on top. The sun is 25 degrees above the
        # horizon, and reflection without a tilt goes 25 degrees below. The eye is at 2 degrees.
        strand = np.zeros((1, 9, 3))
        strand[0, :, 1] = np.linspace(1.7, 1.3, 9)
        tilt, seen = cases.TILT, []
        try:
            for cases.TILT in (0.2, -0.2):
                fibre = cycles.make_scene(strand, 0.01, 32, 64)
                fibre.inputs["Absorption Coefficient"].default_value = (50, 50, 50)
                cycles.add_lights(cases.Light("sun"))
                seen.append(trace().mean())
        finally:
            cases.TILT = tilt
        self.assertGreater(seen[0], 10 * seen[1])


if __name__ == "__main__":
    unittest.main()
