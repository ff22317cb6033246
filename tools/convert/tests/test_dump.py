"""Dumps of hair-capture as USD time samples and Alembic caches."""

import os
import struct
import subprocess

import numpy as np

from hairconvert.dump import HEADER
from tests.support import ConvertTest, add_attributes, make_groom


class DumpTest(ConvertTest):
    def dump(self, groom, frames=4, fps=30.0, first=0, file="a.dump", followers=0, **other):
        """Write a dump in which strands rise by 1 cm per frame."""
        header = np.zeros(1, HEADER)
        header["name"], header["version"], header["fps"] = b"HAIRDUMP", 1, fps
        header["strands"], header["vertices"] = len(groom.counts), groom.counts[0]
        header["frames"], header["first"], header["followers"] = frames, first, followers
        for key, value in other.items():
            header[key] = value
        with open(self.path(file), "wb") as out:
            out.write(header.tobytes())
            for i in range(min(frames, 4)):
                out.write((groom.points + [0, 0.01 * i, 0]).astype("<f4").tobytes())
        return self.path(file)

    def test_motion_to_usd_and_alembic(self):
        groom = make_groom("curly", vertices=12)
        path = self.dump(groom, first=6)
        for out, options in (("b.usda", ()), ("b.usdc", ("--output-up", "z")), ("b.abc", ())):
            status, said = self.convert("motion", path, self.path(out), *options, "--width", "7e-5")
            self.assertEqual((status, said), (0, ""))
            back = self.read(self.path(out))
            np.testing.assert_allclose(back.motion.times, np.arange(6, 10) / 30, atol=1e-9)
            for i in range(4):
                np.testing.assert_allclose(back.motion.read(i), groom.points + [0, 0.01 * i, 0],
                                           atol=1e-6)
            self.assertEqual(back.attributes["guide"].values.tolist(), [1])
            np.testing.assert_allclose(back.attributes["width"].values, [7e-5], rtol=1e-6)

    def test_motion_gets_the_attributes_of_the_haircut(self):
        rest = add_attributes(make_groom("straight", vertices=12))
        # The dump has other strands and vertices, in another order.
        moved = make_groom("straight", vertices=23)
        order = np.random.default_rng(7).permutation(100)[:60]
        moved.points = moved.points.reshape(100, 23, 3)[order].reshape(-1, 3)
        moved.counts = moved.counts[:60]
        haircut, _ = self.write(rest, "a.usdc")
        status, said = self.convert("motion", self.dump(moved), self.path("b.usdc"), "--groom",
                                    haircut)
        self.assertEqual(status, 0, said)
        back = self.read(self.path("b.usdc"))
        for name in ("id", "root_uv", "group", "guide_weights", "stiffness"):
            np.testing.assert_array_equal(back.attributes[name].values,
                                          rest.attributes[name].values[order], err_msg=name)
        # Every other vertex lies at a vertex of the haircut.
        width = back.attributes["width"].values.reshape(60, 23)[:, ::2]
        np.testing.assert_allclose(width, rest.attributes["width"].values.reshape(100, 12)[order],
                                   rtol=1e-6)
        self.assertIn("closest_guides is not kept", said)

    def test_haircut_of_other_roots_is_told(self):
        haircut, _ = self.write(add_attributes(make_groom(seed=9, vertices=8)), "a.usdc")
        status, said = self.convert("motion", self.dump(make_groom(vertices=8)),
                                    self.path("b.usdc"), "--groom", haircut)
        self.assertEqual(status, 0)
        self.assertIn("no attributes of the haircut are used", said)

    def test_frame_of_a_dump_becomes_a_haircut(self):
        groom = make_groom(vertices=16)
        path = self.dump(groom, fps=10.0)
        status, said = self.convert("convert", path, self.path("b.tfx"), "--frame", "0.2")
        self.assertEqual(status, 0)
        self.assertIn("the motion of 4 frames is not kept", said)
        np.testing.assert_allclose(self.read(self.path("b.tfx")).points, groom.points + [0, 0.02, 0],
                                   atol=1e-6)

    def test_wrong_use(self):
        path = self.dump(make_groom())
        self.assertEqual(self.convert("motion", path, self.path("b.hair"))[0], 2)
        hair, _ = self.write(make_groom(), "a.hair")
        self.assertEqual(self.convert("motion", hair, self.path("b.usda"))[0], 2)
        status, said = self.convert("motion", path, self.path("b.usda"), "--groom",
                                    self.path("none.hair"))
        self.assertEqual(status, 4)
        self.assertIn("none.hair: there is no such file", said)

    def test_hostile_dumps(self):
        groom = make_groom(strands=4, vertices=4)
        cases = [({"version": 2}, "no dump"), ({"name": b"OTHER"}, "no dump"),
                 ({"strands": 0}, "no strands"), ({"strands": 1 << 31}, "more than"),
                 ({"vertices": 1 << 31}, "more than"), ({"frames": 0}, "claims"),
                 ({"frames": 1 << 31}, "claims"), ({"frames": 5}, "do not make"),
                 ({"fps": 0}, "claims"), ({"fps": float("nan")}, "claims"),
                 ({"fps": float("inf")}, "claims")]
        for i, (change, words) in enumerate(cases):
            status, said = self.guarded("info", self.dump(groom, file=f"{i}.dump", **change))
            self.assertEqual(status, 4, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)
        path = self.dump(groom)
        with open(path, "r+b") as file:
            file.seek(HEADER.itemsize + 12 * 16 * 2)  # The third frame.
            file.write(struct.pack("<f", float("nan")))
        for out in ("b.usda", "b.abc"):
            status, said = self.guarded("motion", path, self.path(out))
            self.assertEqual(status, 4, said)
            self.assertIn("frame 2 has a position that is not finite", said)
            self.assertFalse(os.path.exists(self.path(out)))

    def test_capture_writes_dumps_that_are_read(self):
        tool, groom = os.environ.get("HAIR_CAPTURE"), os.environ.get("HAIR_GROOM")
        if not tool or not groom:
            self.fail("HAIR_CAPTURE and HAIR_GROOM do not name the programs hair-capture and "
                      "hair-groom")
        subprocess.run([groom, "generate", "bob", self.path("a.tfx"), "--guides", "64"],
                       check=True, capture_output=True)
        subprocess.run([tool, "--groom", self.path("a.tfx"), "--frames", "0:8", "--fps", "24",
                        "--motion", "shake", "--dump-guides", self.path("g.dump"),
                        "--dump-followers", self.path("f.dump"), "--followers", "500"],
                       check=True, capture_output=True)
        rest = self.read(self.path("a.tfx"))
        for name in ("g", "f"):
            for ending in ("usdc", "abc"):
                out = self.path(f"{name}.{ending}")
                self.assertEqual(self.convert("motion", self.path(name + ".dump"), out)[0], 0)
                dump, back = self.read(self.path(name + ".dump")), self.read(out)
                self.assertEqual(len(back.motion), 8)
                np.testing.assert_allclose(back.motion.times, np.arange(8) / 24, atol=1e-9)
                for i in range(8):
                    np.testing.assert_allclose(back.motion.read(i), dump.motion.read(i), atol=1e-6)
        guides = self.read(self.path("g.dump"))
        # The guides begin where those of the haircut do, and move.
        distance = np.abs(guides.points[guides.starts()][:, None] -
                          rest.points[rest.starts()][None]).max(axis=2).min(axis=1)
        self.assertLess(distance.max(), 1e-4)
        self.assertGreater(np.abs(guides.motion.read(7) - guides.points).max(), 1e-3)
