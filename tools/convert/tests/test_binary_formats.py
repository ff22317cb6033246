"""Round trips through .hair, .tfx, .data and OBJ, and what they say that they do not keep."""

import os
import subprocess
import unittest

import numpy as np

from hairconvert.groom import lengths, resample
from tests.support import ConvertTest, add_attributes, make_groom


class RoundTripTest(ConvertTest):
    def test_every_format_keeps_positions(self):
        for kind in ("straight", "curly", "clumped", "braid"):
            for ending in (".hair", ".groom", ".data", ".obj"):
                with self.subTest(kind=kind, ending=ending):
                    groom = make_groom(kind, uneven=True)
                    path, said = self.write(groom, "a" + ending)
                    self.assert_same_strands(groom, self.read(path))
                    self.assertEqual(said, [])

    def test_tfx_keeps_positions_of_equal_strands(self):
        groom = make_groom("curly", vertices=32)
        path, said = self.write(groom, "a.tfx")
        self.assert_same_strands(groom, self.read(path))
        self.assertEqual(said, [])

    def test_hair_keeps_width_opacity_color(self):
        groom = add_attributes(make_groom(uneven=True))
        path, said = self.write(groom, "a.hair")
        back = self.read(path)
        self.assert_same_attributes(groom, back, ["width"])
        self.assert_same_attributes(groom, back, ["opacity", "color"], 1e-6)
        self.assertEqual(set(back.attributes), {"width", "opacity", "color"})
        for name in set(groom.attributes) - set(back.attributes):
            self.assertEqual(sum(f"the attribute {name} " in s for s in said), 1, name)

    def test_tfx_keeps_root_uv_and_color(self):
        groom = add_attributes(make_groom(vertices=8))
        path, said = self.write(groom, "a.tfx")
        back = self.read(path)
        self.assert_same_attributes(groom, back, ["root_uv", "opacity"])
        self.assert_same_attributes(groom, back, ["color"], 1e-6)
        self.assertTrue(any("width is not kept" in s for s in said))

    def test_bytes_of_a_second_writing_are_equal(self):
        for ending in (".hair", ".data", ".tfx"):
            path, _ = self.write(add_attributes(make_groom(vertices=16)), "a" + ending)
            again, _ = self.write(self.read(path), "b" + ending)
            with open(path, "rb") as a, open(again, "rb") as b:
                difference = np.frombuffer(a.read(), "u1") != np.frombuffer(b.read(), "u1")
            # Colours go through linear space, which can change their last bit.
            limit = 0 if ending == ".data" else 0.15
            self.assertLessEqual(difference.mean(), limit, ending)

    def test_bytes_after_the_last_strand_are_told(self):
        groom = make_groom()
        for ending in (".hair", ".data"):
            path, _ = self.write(groom, "a" + ending)
            with open(path, "ab") as file:
                file.write(bytes(range(24)))
            self.assert_same_strands(groom, self.read(path))
            self.assertIn("are not read", self.report.sentences[0])

    def test_tfx_resamples_uneven_strands(self):
        groom = make_groom(vertices=30, uneven=True)
        path, said = self.write(groom, "a.tfx")
        back = self.read(path)
        self.assertTrue((back.counts == 32).all())
        self.assertTrue(any("resampled to 32" in s for s in said))
        np.testing.assert_allclose(lengths(back), lengths(groom), rtol=0.01)

    def test_scale_and_up_of_input_and_output(self):
        groom = add_attributes(make_groom())
        path, _ = self.write(groom, "a.hair", "--output-scale", "0.01", "--output-up", "z")
        raw = self.read(path)
        np.testing.assert_allclose(raw.points[:, 2], 100 * groom.points[:, 1], rtol=1e-5)
        np.testing.assert_allclose(raw.points[:, 1], -100 * groom.points[:, 2], rtol=1e-5)
        back = self.read(path, "--scale", "0.01", "--up", "z")
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, ["width"], 1e-6)

    def test_up_x_turns_the_axis(self):
        groom = make_groom()
        path, _ = self.write(groom, "a.hair")
        back = self.read(path, "--up", "x")
        np.testing.assert_array_equal(back.points[:, 1], groom.points[:, 0])
        np.testing.assert_array_equal(back.points[:, 0], -groom.points[:, 1])

    def test_tip_first_reverses_strands(self):
        groom = make_groom(uneven=True)
        path, _ = self.write(groom, "a.hair")
        back = self.read(path, "--tip-first")
        first, last = groom.points[:groom.counts[0]], back.points[:groom.counts[0]]
        np.testing.assert_array_equal(first, last[::-1])

    def test_take_selects_guides(self):
        from hairconvert.formats import _take
        groom = add_attributes(make_groom())
        guides = _take(groom, "guides", self._report())
        self.assertEqual(len(guides.counts), 20)
        np.testing.assert_array_equal(guides.attributes["id"].values, np.arange(0, 100, 5))
        # Guides are numbered anew, so each strand still names the same guides.
        before = groom.attributes["closest_guides"].values[::5]
        np.testing.assert_array_equal(guides.attributes["closest_guides"].values, before // 5)

    def _report(self):
        from hairconvert.report import Report
        return Report()

    def test_library_reads_what_is_written(self):
        tool = os.environ.get("HAIR_GROOM")
        if not tool:
            self.fail("HAIR_GROOM does not name the program hair-groom")
        groom = add_attributes(make_groom("curly", vertices=16))
        for ending in (".hair", ".tfx", ".groom"):
            path, _ = self.write(groom, "a" + ending)
            said = subprocess.run([tool, "info", path], capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertIn("100", said.stdout)
            again = self.path("b" + ending)
            subprocess.run([tool, "convert", path, again], check=True, capture_output=True)
            self.assert_same_strands(groom, self.read(again), 1e-4)


class ResampleTest(unittest.TestCase):
    def test_straight_strands_stay_straight(self):
        groom = make_groom(uneven=True)
        line = groom.points[groom.starts()][:, None, :] + \
            np.linspace(0, 1, 5)[None, :, None] * np.array([0.1, 0, 0])
        groom.counts = np.full(len(groom.counts), 5, np.int64)
        groom.points = line.reshape(-1, 3)
        groom.attributes.clear()
        more = resample(groom, 9)
        np.testing.assert_allclose(lengths(more), 0.1, rtol=1e-12)
        steps = np.diff(more.points.reshape(-1, 9, 3)[:, :, 0], axis=1)
        np.testing.assert_allclose(steps, 0.1 / 8, rtol=1e-9)

    def test_ends_stay(self):
        groom = make_groom("curly", vertices=20, uneven=True)
        some = resample(groom, 8)
        np.testing.assert_allclose(some.points[::8], groom.points[groom.starts()], atol=1e-15)
        ends = groom.starts() + groom.counts - 1
        np.testing.assert_allclose(some.points[7::8], groom.points[ends], atol=1e-15)

    def test_strands_with_that_count_keep_their_vertices(self):
        groom = make_groom("curly", vertices=8, uneven=True)
        some = resample(groom, 8)
        same = np.flatnonzero(groom.counts == 8)
        self.assertGreater(len(same), 0)
        for i in same:
            start = groom.starts()[i]
            np.testing.assert_array_equal(some.points[8 * i:8 * i + 8],
                                          groom.points[start:start + 8])

    def test_strand_of_repeated_vertices(self):
        groom = make_groom(strands=1, vertices=4)
        groom.points[:] = groom.points[0]
        some = resample(groom, 8)
        np.testing.assert_array_equal(some.points, np.tile(groom.points[0], (8, 1)))


class ObjTest(ConvertTest):
    def obj(self, text):
        path = self.path("a.obj")
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        return path

    def test_edges_are_joined(self):
        path = self.obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 2 0\nl 1 2\nl 2 3\nl 4 5\n")
        self.assertEqual(self.read(path).counts.tolist(), [3, 2])

    def test_negative_indices_count_back(self):
        path = self.obj("v 0 0 0\nv 1 0 0\nl -2 -1\nv 5 0 0\nv 6 0 0\nl -2 -1\n")
        self.assertEqual(self.read(path).points[:, 0].tolist(), [0, 1, 5, 6])

    def test_colors_after_positions_and_continued_lines(self):
        path = self.obj("v 0 0 0 1 1 1\nv 1 0 0\nv 2 0 0 1\nl 1 \\\n2 3\n")
        self.assertEqual(self.read(path).points[:, 0].tolist(), [0, 1, 2])
