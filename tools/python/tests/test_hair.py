"""Tests of haircuts, simulation and pictures."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import libhair
from libhair._native import current_loader, ffi

ROOT = pathlib.Path(os.environ["HAIR_ROOT"])


def turn(angle):
    """Return a rotation about the vertical axis."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]])


class HaircutTest(unittest.TestCase):
    """Assets, grooms and collision meshes, which need no OpenGL."""

    def test_asset_survives_a_file(self):
        asset = libhair.Asset.generate("bob", guide_count=64)
        self.assertEqual(asset.info["strand_count"], 64)
        again = libhair.Asset.read(asset.write("hair"))
        np.testing.assert_array_equal(again.arrays["positions"], asset.arrays["positions"])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "bob.hair")
            path.write_bytes(asset.write())
            scaled = libhair.Asset.read(path, scale=2)
        np.testing.assert_allclose(scaled.arrays["positions"], 2 * asset.arrays["positions"], rtol=1e-6)
        self.assertIsNone(again.arrays["scalp_positions"])
        self.assertEqual(asset.arrays["scalp_triangles"].shape[1], 3)

    def test_hostile_bytes_raise_with_the_offset(self):
        with self.assertRaisesRegex(libhair.HairFileError, "byte"):
            libhair.Asset.read(libhair.Asset.generate().write()[:1000])
        for size in (0, 3, 200):
            with self.assertRaises(libhair.HairFileError):
                libhair.Asset.read(bytes(size))

    def test_groom_of_arrays(self):
        positions = np.zeros((20, 8, 3))
        positions[:, :, 0] = np.arange(20)[:, None] * 0.01
        positions[:, :, 1] = -0.02 * np.arange(8)
        groom = libhair.Groom(positions=positions, strand_vertices=[8] * 20, strand_set="guides", follower_count=100)
        self.assertEqual(groom.info["guide_count"], 20)
        self.assertEqual(groom.info["follower_count"], 100)
        np.testing.assert_allclose(groom.info["length"], 0.14, rtol=1e-5)

    def test_groups_of_strands(self):
        positions = np.zeros((20, 8, 3))
        positions[:, :, 0] = np.arange(20)[:, None] * 0.01
        positions[:, :, 1] = -0.02 * np.arange(8)
        arrays = {"positions": positions, "strand_vertices": [8] * 20, "strand_set": "guides"}
        groups = np.arange(20) % 3
        groom = libhair.Groom(**arrays, strand_groups=groups)
        self.assertEqual(groom.info["group_count"], 3)
        np.testing.assert_array_equal(groom.groups, groups)
        np.testing.assert_array_equal(libhair.Groom(**arrays).groups, np.zeros(20))
        for wrong in (groups[1:], [256] * 20, [-1] * 20, [0.5] * 20):
            with self.assertRaises(ValueError):
                libhair.Groom(**arrays, strand_groups=wrong)
        with self.assertRaisesRegex(libhair.HairArgumentError, r"strand_groups\[0\] is 8, not in \[0, 7\]"):
            libhair.Groom(**arrays, strand_groups=[8] * 20)

    def test_asset_of_arrays_survives_a_groom_file(self):
        positions = np.zeros((20, 8, 3))
        positions[:, :, 0] = np.arange(20)[:, None] * 0.01
        positions[:, :, 1] = -0.02 * np.arange(8)
        arrays = {"positions": positions, "strand_vertices": [8] * 20}
        more = {
            "strand_groups": np.arange(20) % 8, "strand_radii": np.linspace(1e-5, 5e-5, 20),
            "scalp_positions": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "scalp_triangles": [0, 1, 2],
            "scalp_density": [0, 0.5, 1], "scalp_uvs": [[0, 0], [1, 0], [0, 1]],
            "scalp_joints": np.arange(12) % 3, "scalp_weights": [[0.25] * 4] * 3,
        }  # fmt: skip
        names = ["hip", "neck", "h\u00e4r"]
        asset = libhair.Asset.create(
            **arrays, **more, joint_count=3, scalp_joint_names=names, members={"strand_set": "guides"}
        )
        again = libhair.Asset.read(asset.write("groom"))
        self.assertEqual(again.arrays["scalp_joint_names"], names)
        self.assertEqual(again.info["scalp_joint_count"], 3)
        for name, values in more.items():
            np.testing.assert_allclose(again.arrays[name].ravel(), np.ravel(values), rtol=1e-6, err_msg=name)
        np.testing.assert_allclose(again.arrays["positions"], positions.reshape(-1, 3), atol=1.4e-6)
        self.assertEqual(libhair.Groom(again, follower_count=100).info["group_count"], 8)
        for wrong in ({"strand_radii": [1]}, {"scalp_weights": [[1, 0, 0, 0]]}, {"scalp_joints": [0]}):
            with self.assertRaises(ValueError):
                libhair.Asset.create(**arrays, **{**more, **wrong}, joint_count=3)
        with self.assertRaisesRegex(libhair.HairArgumentError, r"scalp_joints\[2\] is 2, not in \[0, 1\]"):
            libhair.Asset.create(**arrays, **more, joint_count=2)

    def test_attributes_survive_a_groom_file(self):
        positions = np.zeros((20, 8, 3))
        positions[:, :, 0] = np.arange(20)[:, None] * 0.01
        positions[:, :, 1] = -0.02 * np.arange(8)
        scalp = {"scalp_positions": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "scalp_triangles": [0, 1, 2],
                 "scalp_uvs": [[0, 0], [1, 0], [0, 1]]}  # fmt: skip
        arrays = {"positions": positions, "strand_vertices": [8] * 20, **scalp}
        values = {"stiffness": np.linspace(0, 100, 20, dtype=np.float32), "length": np.full(20, 0.5, np.float32)}
        maps = [("frizz", np.array([[0, 1, 2], [3, 4, 0.5]], np.float32)), ("frizz", np.ones(3, np.float32)),
                ("radius", np.array([0.25], np.float32))]  # fmt: skip
        asset = libhair.Asset.create(**arrays, strand_attributes=values, attribute_maps=maps)
        again = libhair.Asset.read(asset.write("groom"))
        for name, numbers in values.items():
            np.testing.assert_array_equal(again.arrays["strand_attributes"][name], numbers)
        self.assertEqual([n for n, _ in again.arrays["attribute_maps"]], ["frizz", "frizz", "radius"])
        for (_, a), (_, b) in zip(again.arrays["attribute_maps"], maps):
            np.testing.assert_array_equal(a, b)
        self.assertNotIn("map_sets", again.info)
        for groom in (libhair.Groom(again), libhair.Groom(**arrays, strand_attributes=values)):
            np.testing.assert_allclose(groom.info["length"], 0.07, rtol=1e-4)
        for wrong in ({"strand_attributes": {"shine": [1] * 20}}, {"strand_attributes": {"frizz": [1]}},
                      {"attribute_maps": {"frizz": [1, 2]}}):  # fmt: skip
            with self.assertRaises(ValueError):
                libhair.Groom(**arrays, **wrong)
        with self.assertRaisesRegex(libhair.HairArgumentError, r"map.values\[0\] is 5, not in \[0, 4\]"):
            libhair.Groom(**arrays, attribute_maps={"frizz": [[5]]})

    def test_given_guides_are_the_guides(self):
        positions = np.zeros((20, 8, 3))
        positions[:, :, 0] = np.arange(20)[:, None] * 0.01
        positions[:, :, 1] = -0.02 * np.arange(8)
        arrays = {"positions": positions, "strand_vertices": [8] * 20, "strand_guides": (np.arange(20) % 5 == 0).astype(int)}
        again = libhair.Asset.read(libhair.Asset.create(**arrays).write("groom"))
        for groom in (libhair.Groom(**arrays), libhair.Groom(again)):
            self.assertEqual(groom.info["guide_count"], 4)
        self.assertEqual(libhair.Groom(again, guide_count=7).info["guide_count"], 7)
        with self.assertRaises(ValueError):
            libhair.Groom(**{**arrays, "strand_guides": [1]})
        with self.assertRaises(ValueError):
            libhair.Asset.create(**arrays, joint_count=2, scalp_joint_names=["hip"])

    def test_names_of_joints_and_guides_of_a_file_are_read(self):
        asset = libhair.Asset.read(ROOT / "tests/fuzz/corpus/groomfile/named")
        self.assertEqual(asset.arrays["scalp_joint_names"], ["hip", "neck", "head", "h\u00e4r", "\U0001f9b1"])
        np.testing.assert_array_equal(asset.arrays["strand_guides"], [1, 0, 1, 1])
        self.assertIsNone(libhair.Asset.generate().arrays["scalp_joint_names"])

    def test_wrong_arrays_raise(self):
        for positions, counts in (([0, 0, 0, 1], [2]), ([0] * 6, [3]), ([0] * 6, [-2]), ([0] * 6, [1.5]), (None, [1])):
            with self.assertRaises(ValueError):
                libhair.Groom(positions=positions, strand_vertices=counts)
        with self.assertRaisesRegex(libhair.HairArgumentError, "guide_vertices"):
            libhair.Groom(libhair.Asset.generate(), guide_vertices=1)

    def test_closed_mesh_is_closed(self):
        corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
        self.assertTrue(libhair.CollisionMesh(corners, triangles, resolution=16).info["is_closed"])
        with self.assertLogs("libhair", "WARNING"):
            self.assertFalse(libhair.CollisionMesh(corners, triangles[1:], resolution=16).info["is_closed"])


class HairTest(unittest.TestCase):
    """Simulation and drawing, in one context."""

    @classmethod
    def setUpClass(cls):
        cls.context = libhair.Context()
        cls.addClassCleanup(cls.context.close)
        cls.groom = libhair.Groom(libhair.Asset.generate("long", guide_count=64), follower_count=4000)

    def make(self, **members):
        hair = libhair.Hair(self.context, self.groom, **members)
        self.addCleanup(hair.close)
        return hair

    def test_turned_head_moves_hair_and_settings_act(self):
        hair = self.make(physics=libhair.Physics(damping=50))
        self.assertEqual(hair.physics.damping, 50)
        at_rest = hair.read("guides")
        self.assertEqual(at_rest.shape, (self.groom.info["guide_vertex_count"], 3))
        hair.transform = turn(0.5)
        np.testing.assert_allclose(hair.transform, turn(0.5), atol=1e-6)
        for _ in range(4):
            hair.step(1 / 60)
        moved = hair.read("guides")
        roots = np.linalg.norm(moved - at_rest @ turn(0.5)[:3, :3].T, axis=1).min()
        self.assertLess(roots, 1e-5)
        self.assertGreater(np.abs(moved - at_rest).max(), 0.02)
        self.assertTrue(np.isfinite(moved).all())
        hair.teleport(np.eye(4))
        hair.reset()
        np.testing.assert_allclose(hair.read("guides"), at_rest, atol=1e-4)
        self.assertEqual(hair.solver_stats["reset"], 0)

    def test_lists_act_as_single_calls(self):
        listed, single = [self.make(), self.make()], [self.make(), self.make()]
        for frame in range(3):
            for k, hair in enumerate(listed + single):
                hair.transform = turn(0.1 * frame + 0.3 * (k % 2))
            libhair.step_list(listed, 1 / 60)
            for hair in single:
                hair.step(1 / 60)
        for ours, theirs in zip(listed, single):
            np.testing.assert_array_equal(ours.read("guides"), theirs.read("guides"))
        libhair.step_list([], 1 / 60)
        with self.assertRaisesRegex(libhair.HairArgumentError, "in the list before"):
            libhair.draw_list([listed[0], listed[0]], libhair.View())

    def test_groups_have_physics_of_their_own(self):
        hair = self.make()
        physics = hair.group_physics(3)
        physics.shape.stiffness_tip = 4
        hair.set_group_physics(3, physics)
        self.assertEqual(hair.group_physics(3).shape.stiffness_tip, 4)
        self.assertEqual(hair.physics.shape.stiffness_tip, 1)
        hair.set_group_physics(3, None)
        self.assertEqual(hair.group_physics(3).shape.stiffness_tip, 1)
        physics.gravity = (0, -5, 0)
        look = libhair.GroupLook(radius=2)
        look.color.root = (1, 0, 0)
        hair.set_group_look(1, look)
        self.assertEqual(hair.group_look(1).radius, 2)
        with self.assertRaisesRegex(libhair.HairArgumentError, "gravity is 0,-5,0 for group 3 but 0,-9.81,0 for the"):
            hair.set_group_physics(3, physics)

    def test_cut_hair_falls_and_grows_again(self):
        hair = self.make()
        guides = self.groom.info["guide_count"]
        height = 1.5  # Below all roots.
        cut = libhair.CutDesc(start=(0, height, 0), normal=(0, -1, 0))
        info, pieces = hair.cut(cut, pieces=True)
        self.assertGreater(info["strands"], 0)
        self.assertGreater(info["length"], 0.1)
        self.assertGreater(hair.read("followers")[:, 1].min(), height - 3e-3)
        before = pieces.read("guides")
        self.assertLess(before[:, 1].max(), height + 3e-3)
        for _ in range(6):
            pieces.step(1 / 60)
        fallen = before[:, 1].mean() - pieces.read("guides")[:, 1].mean()
        self.assertTrue(0.02 < fallen < 0.06, fallen)
        pieces.close()
        self.assertLess(hair.lengths(guides).min(), 1)
        hair.set_lengths(np.ones(guides))
        self.assertEqual(hair.lengths(guides).min(), 1)
        self.assertEqual(hair.cut(shape="capsule", start=(0, 9, 0), end=(0, 9, 1)), ({"strands": 0,
                         "guides": 0, "length": 0.0}, None))
        with self.assertRaisesRegex(libhair.HairArgumentError, "fractions.1. is 2, not in"):
            hair.set_lengths([1, 2])

    def test_followers_have_a_vertex_for_each_end_of_a_segment(self):
        hair = self.make(look=libhair.Look({"strand.segments": 8}))
        followers = hair.read("followers")
        self.assertEqual(len(followers), self.groom.info["follower_count"] * 9)
        self.assertEqual(len(hair.read("smooth")) > 0, True)
        with self.assertRaises(ValueError):
            hair.read("leaders")

    def test_saved_state_repeats_the_motion(self):
        hair = self.make()
        hair.transform = turn(0.4)
        for _ in range(3):
            hair.step(1 / 60)
        state = hair.save()
        hair.step(1 / 60)
        expected = hair.read()
        hair.load(state)
        hair.step(1 / 60)
        np.testing.assert_array_equal(hair.read(), expected)
        with self.assertRaises(libhair.HairFileError):
            hair.load(state[:-1])

    def test_colliders_pins_wind_and_scalp_act(self):
        still, changed = self.make(), self.make()
        ball = libhair.Collider(shape="sphere", position=(0.1, 1.45, 0), size=(0.1, 0, 0))
        changed.set_colliders([ball])
        changed.set_pins([libhair.Pin(guide=0, position=(0, 1.9, 0))])
        changed.set_wind(libhair.Wind(velocity=(3, 0, 0)), [libhair.WindSource()])
        self.assertEqual(changed.wind.velocity, (3, 0, 0))
        for hair in (still, changed):
            for _ in range(5):
                hair.step(1 / 60)
        self.assertGreater(np.abs(still.read() - changed.read()).max(), 0.01)
        distance = np.linalg.norm(changed.read() - [0.1, 1.45, 0], axis=1)
        self.assertGreater(distance.min(), 0.09)
        corners = libhair.Asset.generate("long", guide_count=64).arrays["scalp_positions"]
        changed.set_scalp(corners + [0, 0.01, 0], np.eye(4))
        changed.set_wind(None)
        changed.step(1 / 60)
        with self.assertRaises(libhair.HairArgumentError):
            changed.set_scalp(corners[1:])
        self.assertTrue((changed.bounds[0] < changed.bounds[1]).all())

    def test_joints_of_the_scalp_move_hair_as_its_positions_do(self):
        by_joints, by_positions = self.make(), self.make()
        corners = libhair.Asset.generate("long", guide_count=64).arrays["scalp_positions"]
        poses = np.array([np.eye(4), np.eye(4)])
        poses[1, :3, 3] = 0.02, 0, 0.01
        half = np.tile([0.5, 0.5, 0, 0], (len(corners), 1))
        by_joints.set_scalp_weights(np.tile([0, 1, 0, 0], (len(corners), 1)), half, 2)
        by_joints.set_scalp_joints(poses, np.eye(4))
        by_positions.set_scalp(corners + [0.01, 0, 0.005])
        for hair in (by_joints, by_positions):
            hair.step(1 / 60)
        np.testing.assert_allclose(by_joints.read(), by_positions.read(), atol=1e-4)
        by_joints.set_scalp_weights(None, None, 0)
        with self.assertRaises(libhair.HairArgumentError):
            by_joints.set_scalp_joints(poses)

    def test_mesh_collider_pushes_hair_out(self):
        corners = 0.1 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        mesh = libhair.CollisionMesh(corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
        block = libhair.Collider(position=(0.1, 1.42, 0))
        libhair.set_mesh(block, mesh)
        hair = self.make()
        hair.set_colliders([block])
        for _ in range(10):
            hair.step(1 / 60)
        inside = (np.abs(hair.read() - [0.1, 1.42, 0]) < 0.09).all(axis=1)
        self.assertEqual(inside.sum(), 0)

    def test_picture_shows_hair_in_its_colour(self):
        look = libhair.Look({"strand.radius": 4e-4, "color.root": (0.5, 0.02, 0.02), "color.tip": (0.5, 0.02, 0.02)})
        hair = self.make(look=look)
        background = (0, 0, 1, 1)
        picture = libhair.render([hair], (0, 1.6, 1.4), (0, 1.55, 0), (160, 120), background=background)
        self.assertEqual(picture.shape, (120, 160, 4))
        self.assertEqual(tuple(picture[0, 0]), (0, 0, 255, 255))
        red = (picture[:, :, 0] > picture[:, :, 1]) & (picture[:, :, 2] < 128)
        self.assertGreater(red.mean(), 0.03)
        self.assertLess(red.mean(), 0.6)
        rows = np.nonzero(red.any(axis=1))[0]
        self.assertLess(rows.min(), 60)  # The head is at the top of the first row's picture.
        dark = libhair.render([hair], (0, 1.6, 1.4), (0, 1.55, 0), (160, 120), background=background,
                              lights=[], view=libhair.View(ambient=(0.01, 0.01, 0.01)))  # fmt: skip
        self.assertLess(dark[red][:, 0].mean(), 0.6 * picture[red][:, 0].mean())
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "hair.png")
            libhair.write_png(path, picture)
            self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_refusals_of_pictures(self):
        hair = self.make()
        with self.assertRaises(ValueError):
            libhair.render([hair], (0, 1.6, 1.4), (0, 1.55, 0), (0, 120))
        with self.assertRaises(ValueError):
            libhair.render([hair], (0, 1.6, 1.4), (0, 1.55, 0), (64, 64), samples=1000)
        with self.assertRaises(ValueError):
            libhair.write_png("/nowhere", np.zeros((2, 2)))
        with self.assertRaises(ValueError):
            hair.transform = np.eye(3)
        with self.assertRaisesRegex(libhair.HairArgumentError, "rigid|rotation|transform"):
            hair.transform = 2 * np.eye(4)

    def test_contexts_take_turns_and_close_in_any_order(self):
        first, other = self.make(), libhair.Context()
        second = libhair.Hair(other, self.groom)
        for _ in range(2):
            first.step(1 / 60)
            second.step(1 / 60)
        np.testing.assert_array_equal(first.read(), second.read())
        other.close()
        other.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            second.step(1 / 60)
        second.close()
        first.step(1 / 60)

    def test_current_context_of_the_caller_is_taken(self):
        self.context.make_current()
        with libhair.Context(current=True) as guest, libhair.Hair(guest, self.groom) as hair:
            hair.step(1 / 60)
            self.assertEqual(len(hair.read()), self.groom.info["guide_vertex_count"])
            self.assertGreater(guest.memory["gpu"] if "gpu" in guest.memory else 1, 0)

    def test_functions_of_a_current_context_come_from_any_loader(self):
        self.context.make_current()
        self.assertIsNone(current_loader())  # It is a context of EGL.
        addresses = {}

        def find(name):
            """Return addresses as pointers and as integers in turn."""
            pointer = self.context.get_proc(ffi.new("char[]", name), ffi.NULL)
            addresses[name] = int(ffi.cast("intptr_t", pointer))
            return pointer if len(addresses) % 2 else addresses[name]

        with libhair.Context(current=True, get_proc=find) as guest, libhair.Hair(guest, self.groom) as hair:
            hair.step(1 / 60)
        self.assertGreater(len(addresses), 100)
        with self.assertRaisesRegex(libhair.HairOpenGLError, "does not find glGetIntegerv"):
            libhair.Context(current=True, get_proc=lambda _name: None)

    def test_no_current_context_raises(self):
        caught = []

        def run():
            try:
                libhair.Context(current=True)
            except libhair.HairOpenGLError as error:
                caught.append(str(error))

        thread = threading.Thread(target=run)
        thread.start()
        thread.join()
        self.assertEqual(len(caught), 1)

    def test_example_prints_errors_and_draws_a_plot(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [sys.executable, ROOT / "tools/python/examples/error_against_time.py", "--quick",
                 "--out", pathlib.Path(folder, "plot.png"), "--json", pathlib.Path(folder, "rows.json")],
                capture_output=True, text=True, check=False)  # fmt: skip
            self.assertEqual(run.returncode, 0, run.stderr)
            rows = json.loads(pathlib.Path(folder, "rows.json").read_text("utf-8"))
            self.assertEqual(pathlib.Path(folder, "plot.png").read_bytes()[:4], b"\x89PNG")
        errors = {(row["solver"], row["substeps"]): row["error"] for row in rows}
        self.assertIn("direct", run.stdout)
        self.assertLess(errors["direct", 8], errors["direct", 2])
        self.assertTrue(all(row["milliseconds"] > 0 for row in rows))
