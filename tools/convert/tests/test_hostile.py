"""Hostile files give one sentence and exit status 4, never a traceback."""

import os
import struct

import numpy as np

from hairconvert.formats import FORMATS
from tests.support import ConvertTest, add_attributes, make_groom

ENDINGS = [e for f in FORMATS for e in f.endings]
WRITTEN = [e for f in FORMATS if f.writer for e in f.endings]


class HostileTest(ConvertTest):
    def assert_refused(self, path, words=""):
        status, said = self.guarded("info", path)
        self.assertEqual(status, 4, said)
        self.assertNotIn("Traceback", said)
        self.assertTrue(said.startswith("hair-convert: "), said)
        self.assertLessEqual(said.count("\n"), 3, said)
        self.assertIn(words, said)

    def assert_survived(self, path):
        status, said = self.guarded("info", path)
        self.assertIn(status, (0, 4), said)
        self.assertNotIn("Traceback", said)

    def file(self, name, data):
        path = self.path(name)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def test_empty_and_short_files(self):
        for ending in ENDINGS:
            for size in (0, 1, 3, 4, 100):
                with self.subTest(ending=ending, size=size):
                    self.assert_refused(self.file("a" + ending, b"\1" * size))

    def test_random_bytes(self):
        random = np.random.default_rng(3)
        for ending in ENDINGS:
            for size in (16, 300, 5000):
                with self.subTest(ending=ending, size=size):
                    self.assert_refused(self.file("a" + ending, random.bytes(size)))

    def test_truncated_files(self):
        for ending in WRITTEN:
            path, _ = self.write(add_attributes(make_groom(strands=10, vertices=8)), "w" + ending)
            with open(path, "rb") as file:
                data = file.read()
            for part in (0.1, 0.3, 0.5, 0.7, 0.9, 0.99):
                with self.subTest(ending=ending, part=part):
                    cut = self.file("a" + ending, data[:int(part * len(data))])
                    if ending == ".obj":  # A text can end after any polyline.
                        self.assert_survived(cut)
                    else:
                        self.assert_refused(cut)

    def test_flipped_bytes(self):
        random = np.random.default_rng(4)
        for ending in WRITTEN:
            path, _ = self.write(add_attributes(make_groom(strands=10, vertices=8)), "w" + ending)
            with open(path, "rb") as file:
                data = np.frombuffer(file.read(), np.uint8)
            for _ in range(30):
                bad = data.copy()
                bad[random.integers(0, min(len(bad), 4096), 8)] = random.integers(0, 256, 8)
                self.assert_survived(self.file("a" + ending, bad.tobytes()))

    def test_positions_that_are_not_finite(self):
        for ending in (".hair", ".groom", ".data", ".tfx", ".obj"):
            groom = make_groom(vertices=8)
            groom.points[:] = np.nan
            path, _ = self.write(groom, "a" + ending)
            self.assert_refused(path, "not finite")
            groom = make_groom(vertices=8)
            groom.points[3] = np.inf
            path, _ = self.write(groom, "b" + ending)
            self.assertEqual(len(self.read(path).counts), 99)
            self.assertIn("1 strands are left out", self.report.sentences[0])

    def test_width_that_is_not_finite_is_left_out(self):
        groom = add_attributes(make_groom())
        groom.attributes["width"].values[5] = np.nan
        path, _ = self.write(groom, "a.hair")
        self.assertNotIn("width", self.read(path).attributes)
        self.assertIn("the attribute width is not kept", self.report.sentences[0])

    def test_huge_counts(self):
        huge = 0x7fffffff
        hair = b"HAIR" + struct.pack("<IIII", huge, huge, 3, 0) + bytes(108)
        self.assert_refused(self.file("a.hair", hair), "more than")
        self.assert_refused(self.file("a.hair", b"HAIR" + struct.pack("<IIII", 9, 9 << 20, 3, 0)
                                      + bytes(108)), "exceed the file")
        tfx = struct.pack("<fIIIIIII", 4, huge, huge, 160, 0, 0, 0, 0) + bytes(128)
        self.assert_refused(self.file("a.tfx", tfx), "more than")
        self.assert_refused(self.file("a.data", struct.pack("<ii", huge, 1)), "exceed")
        self.assert_refused(self.file("a.data", struct.pack("<ii", 1, huge)), "exceed")
        self.assert_refused(self.file("a.data", struct.pack("<ii", -5, 1)))
        self.assert_refused(self.file("a.obj", b"v 0 0 0\nl 1 99999999999999999999\n"))

    def test_files_without_strands(self):
        self.assert_refused(self.file("a.hair", b"HAIR" + bytes(124)), "no strands")
        self.assert_refused(self.file("a.data", bytes(4)), "no strands")
        self.assert_refused(self.file("a.data", struct.pack("<iifff", 1, 1, 0, 0, 0)), "fewer")
        self.assert_refused(self.file("a.obj", b"v 0 0 0\nf 1 1 1\n"), "no polyline")

    def test_offsets_into_the_header(self):
        self.assert_refused(self.file("a.tfx", struct.pack("<fIIIIIII", 4, 1, 4, 8, 0, 0, 0, 0)
                                      + bytes(400)), "lies in the header")

    def test_names_with_control_characters_are_escaped(self):
        status, said = self.guarded("info", self.path("a\x1b[31m.hair"))
        self.assertEqual(status, 4)
        self.assertNotIn("\x1b", said)


class CommandLineTest(ConvertTest):
    def test_wrong_use_is_status_2(self):
        for arguments in ([], ["convert", "a.hair"], ["info", "a.unknown"],
                          ["convert", "a.hair", "b.unknown"], ["info", "a.hair", "--scale", "0"],
                          ["info", "a.hair", "--vertices", "1"], ["other"]):
            with self.subTest(arguments=arguments):
                status, said = self.convert(*arguments)
                self.assertEqual(status, 2, said)
                self.assertNotIn("Traceback", said)

    def test_missing_input_is_status_4(self):
        for path in (self.path("none.hair"), self.folder + "/x.data"):
            self.assertEqual(self.convert("info", path)[0], 4)

    def test_output_in_a_missing_folder_is_status_1(self):
        path, _ = self.write(make_groom(), "a.hair")
        status, said = self.convert("convert", path, self.path("none/b.hair"))
        self.assertEqual(status, 1)
        self.assertIn("No such file", said)

    def test_failure_leaves_the_old_output_and_nothing_else(self):
        path, _ = self.write(make_groom(), "a.hair")
        with open(self.path("b.hair"), "wb") as file:
            file.write(b"old")
        with open(self.path("c.hair"), "wb") as file:
            file.write(b"HAIR")
        status, _ = self.convert("convert", self.path("c.hair"), self.path("b.hair"))
        self.assertEqual(status, 4)
        with open(self.path("b.hair"), "rb") as file:
            self.assertEqual(file.read(), b"old")
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.hair", "b.hair", "c.hair"])
        self.assertEqual(self.convert("convert", path, self.path("b.hair"))[0], 0)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.hair", "b.hair", "c.hair"])

    def test_a_crash_becomes_a_sentence(self):
        import signal
        from hairconvert.guard import run_guarded
        temporary = self.path("t")
        with open(temporary, "w", encoding="ascii"):
            pass
        saved = os.dup(2)
        with open(self.path("e"), "w+b") as file:
            os.dup2(file.fileno(), 2)
            try:
                status = run_guarded(lambda: os.kill(os.getpid(), signal.SIGSEGV), temporary)
            finally:
                os.dup2(saved, 2)
                os.close(saved)
            file.seek(0)
            self.assertIn(b"crash with signal 11", file.read())
        self.assertEqual(status, 4)
        self.assertFalse(os.path.exists(temporary))

    def test_info_lists_attributes(self):
        path, _ = self.write(add_attributes(make_groom()), "a.hair")
        self.assertEqual(self.convert("info", path)[0], 0)
        self.assertIn("strands     100", self.out)
        self.assertIn("width: float32 per vertex", self.out)
