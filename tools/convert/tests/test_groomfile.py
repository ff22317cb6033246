"""The .groom format: what it keeps, and that the library and hair-convert read each other's files."""

import base64
import json
import os
import re
import shutil
import struct
import subprocess
import zlib
from types import SimpleNamespace

import numpy as np

from hairconvert.groom import STRAND, VERTEX, Attribute, lengths
from hairconvert import names
from hairconvert.binary import Bytes
from hairconvert.groomfile import Chunk, _find_chunks, _read_names, _write_names
from hairconvert.meshes import read_mesh
from hairconvert.report import InputError, Report
from tests.test_mesh import make_gltf
from tests.support import ConvertTest, add_attributes, make_groom


class GroomFileTest(ConvertTest):
    def tool(self, *arguments):
        """Run hair-groom, and return what it prints."""
        tool = os.environ.get("HAIR_GROOM")
        if not tool:
            self.fail("HAIR_GROOM does not name the program hair-groom")
        said = subprocess.run([tool, *arguments], capture_output=True, text=True)
        self.assertEqual(said.returncode, 0, said.stderr)
        return said.stdout

    def test_groups_and_widths_of_strands_are_kept(self):
        groom = make_groom(uneven=True)
        groom.attributes["group"] = Attribute(STRAND, np.arange(100, dtype=np.int32) % 8)
        width = np.linspace(1e-5, 1e-4, 100).astype(np.float32)
        groom.attributes["width"] = Attribute(STRAND, width)
        color = np.random.default_rng(1).uniform(0, 1, (100, 3)).astype(np.float32)
        groom.attributes["color"] = Attribute(STRAND, color, "color")
        path, said = self.write(groom, "a.groom")
        back = self.read(path)
        self.assertEqual(said, [])
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, ["group", "width"])
        self.assert_same_attributes(groom, back, ["color"], 1.6e-5)

    def test_positions_are_within_1e_5_of_the_length(self):
        random = np.random.default_rng(5)
        groom = make_groom("curly", vertices=60, uneven=True)
        groom.points = (groom.points * np.repeat(random.uniform(0.01, 30, 100), groom.counts)[:, None])
        groom.points = groom.points.astype(np.float32).astype(np.float64)
        back = self.read(self.write(groom, "a.groom")[0])
        error = np.linalg.norm(groom.points - back.points, axis=1)
        relative = error / np.repeat(lengths(groom), groom.counts)
        self.assertLessEqual(relative.max(), 1e-5)
        self.assertGreater(relative.max(), 1e-6)
        np.testing.assert_array_equal(back.points[back.starts()], groom.points[groom.starts()])

    def test_strands_that_rounding_would_damage_are_exact(self):
        groom = make_groom(strands=3, vertices=4)
        groom.points[:4] = [[0, 0, 0], [0, 0, 2.0002e-6], [0, 0, 0.1], [0, 0, 0.2]]
        groom.points = groom.points.astype(np.float32).astype(np.float64)
        back = self.read(self.write(groom, "a.groom")[0])
        np.testing.assert_array_equal(back.points[:4], groom.points[:4])
        self.assert_same_strands(groom, back)

    def test_library_reads_the_same_strands_and_groups(self):
        groom = make_groom("braid", strands=200, vertices=24, uneven=True)
        groom.attributes["group"] = Attribute(STRAND, (np.arange(200) % 3).astype(np.int32))
        groom.attributes["width"] = Attribute("groom", np.array([8e-5], np.float32))
        color = np.random.default_rng(2).uniform(0, 1, (len(groom.points), 3)).astype(np.float32)
        groom.attributes["color"] = Attribute(VERTEX, color, "color")
        path, said = self.write(groom, "a.groom")
        self.assertEqual(said, ["colours are those at 8 even places of each strand"])
        self.assertIn("groups:    of every strand", self.tool("info", path))
        self.tool("convert", path, self.path("b.groom"))
        with open(path, "rb") as a, open(self.path("b.groom"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_files_of_the_library_are_read(self):
        self.tool("generate", "bob", self.path("a.groom"))
        self.tool("convert", self.path("a.groom"), self.path("a.hair"))
        a, b = self.read(self.path("a.groom")), self.read(self.path("a.hair"))
        np.testing.assert_array_equal(a.counts, b.counts)
        np.testing.assert_array_equal(a.points, b.points)
        self.assertTrue(a.values("guide", STRAND).all())

    def test_groups_of_alembic_become_groups(self):
        groom = make_groom()
        groom.attributes["group"] = Attribute(STRAND, 10 * (np.arange(100, dtype=np.int32) % 3))
        path, _ = self.write(groom, "a.abc")
        status, said = self.convert("convert", path, self.path("a.groom"))
        self.assertEqual(status, 0, said)
        self.assertIn("the groups 0, 10, 20 become 0 to 2", said)
        back = self.read(self.path("a.groom"))
        np.testing.assert_array_equal(back.attributes["group"].values, np.arange(100) % 3)
        groom.attributes["group"] = Attribute(STRAND, np.arange(100, dtype=np.int32))
        self.assertIn("the attribute group is not kept, because a .groom file has at most 8 groups, "
                      "not 100", self.write(groom, "b.groom")[1])

    def test_scalp_with_skin_and_texture_coordinates_is_kept(self):
        gltf, data = make_gltf()
        gltf["buffers"][0]["uri"] = "data:;base64," + base64.b64encode(data).decode()
        with open(self.path("head.gltf"), "w", encoding="utf-8") as file:
            json.dump(gltf, file)
        groom = make_groom(strands=20)
        groom.points += [0.5, -1, 0.5]
        path, _ = self.write(groom, "a.hair")
        status, said = self.convert("convert", path, self.path("a.groom"), "--scalp",
                                    self.path("head.gltf"))
        self.assertEqual(status, 0, said)
        self.assertIn("scalp:     4 vertices, 2 triangles, texture coordinates, 2 joints",
                      self.tool("info", self.path("a.groom")))
        mesh = read_mesh(self.path("head.gltf"), SimpleNamespace(mesh=None, scale=None, up=None),
                         Report())
        back = self.read(self.path("a.groom"))
        np.testing.assert_allclose(back.scalp.points, mesh.points, atol=1e-6)
        np.testing.assert_array_equal(back.scalp.triangles, mesh.triangles)
        np.testing.assert_allclose(back.scalp.uv, mesh.uv, atol=1e-6)
        np.testing.assert_array_equal(back.scalp.joints, mesh.joints)
        np.testing.assert_allclose(back.scalp.weights, mesh.weights, atol=1e-6)
        self.assertEqual(back.scalp.joint_names, mesh.joint_names)
        # Another unit and axis turn the scalp like the strands.
        turned = self.read(self.path("a.groom"), "--scale", "0.5", "--up", "z")
        np.testing.assert_allclose(turned.scalp.points[:, 1], 0.5 * mesh.points[:, 2], atol=1e-6)
        _, said = self.convert("convert", self.path("a.groom"), self.path("b.hair"))
        self.assertIn("the scalp is not kept, because a .hair file holds strands only", said)
        status, said = self.convert("scalp", self.path("a.groom"), self.path("a.tfxmesh"))
        self.assertEqual(status, 0, said)
        status, said = self.convert("scalp", self.write(groom, "c.groom")[0], self.path("c.obj"))
        self.assertEqual(status, 4)
        self.assertIn('no chunk "SCLP"', said)

    def test_every_attribute_that_is_not_kept_is_told(self):
        path, said = self.write(add_attributes(make_groom(vertices=8)), "a.groom")
        self.assertEqual(set(self.read(path).attributes), {"width", "group", "color", "guide"})
        for name in ("opacity", "root_uv", "id", "roughness", "stiffness"):
            self.assertEqual(sum(f"the attribute {name} " in s for s in said), 1, name)

    def test_guides_among_strands_are_kept(self):
        groom = add_attributes(make_groom())
        path, said = self.write(groom, "a.groom")
        self.assert_same_attributes(groom, self.read(path), ["guide"])
        self.assertEqual(len(self.read(path, "--take", "guides").counts), 20)
        said = self.tool("info", path)
        self.assertIn("strands:   100, of 100", said)
        self.assertIn("guides:    20 of the strands", said)
        self.assertRegex(said, r"groom: +20 guides of ")  # The library simulates them.
        with open(path, "rb") as file:
            data = bytearray(file.read())
        at = data.index(b"GUID")
        for flag, sentence in ((2, "has the flag 2 of a strand, not 0 or 1"), (1, "")):
            data[at + 16] = flag
            self.seal(data, at)
            with open(self.path("b.groom"), "wb") as file:
                file.write(data)
            status, said = self.convert("info", self.path("b.groom"))
            self.assertEqual(status, 4 if sentence else 0)
            self.assertIn(sentence, said)

    def test_factors_go_through_usd_and_alembic_and_back_exactly(self):
        groom = make_groom(uneven=True)
        random = np.random.default_rng(8)
        for name, (low, high) in names.FACTORS.items():
            values = random.uniform(low, high, 100).astype(np.float32)
            groom.attributes[name] = Attribute(STRAND, np.clip(values, np.float32(low), np.float32(high)))
        path, said = self.write(groom, "a.groom")
        self.assertEqual(said, [])
        self.assertIn("attributes: stiffness of every strand, damping of every strand, shape_frequency",
                      self.tool("info", path))
        with open(path, "rb") as file:
            data = file.read()
        for other in ("a.usda", "a.abc"):
            self.assertEqual(self.convert("convert", path, self.path(other))[0], 0)
            self.assert_same_attributes(groom, self.read(self.path(other)), names.FACTORS)
            self.assertEqual(self.convert("convert", self.path(other), self.path("b.groom"))[0], 0)
            self.assert_same_attributes(groom, self.read(self.path("b.groom")), names.FACTORS)
        at = data.index(b"ATTR")
        for value, words in ((-1.0, "has a factor of stiffness that is not in [0, 100]"),
                             (np.nan, "has a factor of stiffness that is not in [0, 100]")):
            bad = bytearray(data)
            bad[at + 48:at + 52] = struct.pack("<f", value)
            self.seal(bad, at)
            with open(self.path("c.groom"), "wb") as file:
                file.write(bad)
            status, said = self.convert("info", self.path("c.groom"))
            self.assertEqual(status, 4)
            self.assertIn(f'the chunk "ATTR" at byte {at} {words}', said)

    def test_factors_are_all_that_the_library_has(self):
        header = os.path.join(os.path.dirname(__file__), "../../../include/hair/hair_groom.h")
        with open(header, encoding="utf-8") as file:
            kinds = re.findall(r"^    HAIR_STRAND_ATTRIBUTE_(\w+)", file.read(), re.MULTILINE)
        self.assertEqual([f"hair_{kind.lower()}" for kind in kinds], list(names.FACTORS))

    def test_factors_that_the_library_refuses_or_does_not_know_are_told(self):
        groom = make_groom()
        groom.attributes["hair_clump"] = Attribute(STRAND, np.full(100, 2, np.float32))
        groom.attributes["hair_shine"] = Attribute(STRAND, np.ones(100, np.float32))
        groom.attributes["hair_frizz"] = Attribute("groom", np.array([3], np.int32))
        path, said = self.write(groom, "a.groom")
        self.assertTrue(any("hair_clump is not kept, because a value is not in [0, 1]" in s for s in said))
        self.assertTrue(any("hair_shine is not kept" in s for s in said))
        np.testing.assert_array_equal(self.read(path).attributes["hair_frizz"].values, np.full(100, 3))
        with open(path, "rb") as file:
            data = bytearray(file.read())
        at = data.index(b"ATTR")
        data[at + 16:at + 21] = b"shine"
        self.seal(data, at)
        with open(path, "wb") as file:
            file.write(data)
        self.assertNotIn("hair_frizz", self.read(path).attributes)
        self.assertIn("the attribute shine is not kept, because the name is unknown",
                      self.report.sentences)

    def test_file_with_every_chunk_of_the_library_is_kept(self):
        folder, path = os.path.dirname(__file__), self.path("named.groom")
        shutil.copy(os.path.join(folder, "../../../tests/fuzz/corpus/groomfile/named"), path)
        groom = self.read(path)
        self.assertEqual(self.report.sentences, [])
        self.assertEqual(len(groom.scalp.maps), 6)
        np.testing.assert_array_equal(groom.attributes["hair_stiffness"].values, [0.5, 1, 2, 100])
        status, said = self.convert("convert", path, self.path("a.groom"))
        self.assertEqual(status, 0)
        self.assertNotIn("not kept", said)
        a, b = self.tool("info", path), self.tool("info", self.path("a.groom"))
        # A file of guides only needs no flags.
        self.assertEqual(a.replace("guides:    3 of the strands\n", ""), b)
        chunks = [_find_chunks(Bytes(open(p, "rb").read()), Report()) for p in (path, self.path("a.groom"))]
        for letters in ("DENS", "TEXC", "JNTN"):
            self.assertEqual(chunks[0][letters].data, chunks[1][letters].data, letters)
        for letters in ("ATTR", "MAPS"):
            self.assertEqual([c.data for c in chunks[0][letters]], [c.data for c in chunks[1][letters]])

    def seal(self, data, at):
        """Write the checksum of the chunk at a byte."""
        end = at + 16 + struct.unpack_from("<Q", data, at + 4)[0]
        checksum = zlib.crc32(data[at + 16:end], zlib.crc32(data[at:at + 12]))
        data[at + 12:at + 16] = struct.pack("<I", checksum)

    def test_wrong_names_of_joints_are_refused(self):
        chunk = Chunk("JNTN", 7, b"hip\0head\0")
        self.assertEqual(_read_names(chunk, 2), ["hip", "head"])
        for joints, count, words in ((b"hip\0", 2, "does not have 2 names"), (b"hip", 1, "1 names"),
                                    (b"", 1, "1 names"), (b"\xff\0", 1, "not UTF-8")):
            with self.assertRaisesRegex(InputError, f'chunk "JNTN" at byte 7.*{words}'):
                _read_names(Chunk("JNTN", 7, joints), count)
        self.assertEqual(_write_names(["a\0b", "\ud800"]), b"a_b\0?\0")

    def test_long_strands_need_an_option(self):
        status, said = self.convert("convert", self.write(make_groom(vertices=300), "a.hair")[0],
                                    self.path("a.groom"))
        self.assertEqual(status, 4)
        self.assertIn("use --vertices", said)

    def test_damage_is_told_with_its_chunk_and_byte(self):
        path, _ = self.write(add_attributes(make_groom(vertices=8)), "a.groom")
        with open(path, "rb") as file:
            data = file.read()
        at = 32
        while at < len(data):
            bad, letters = bytearray(data), data[at:at + 4].decode()
            bad[at + 17] ^= 1
            with open(self.path("b.groom"), "wb") as file:
                file.write(bad)
            status, said = self.convert("info", self.path("b.groom"))
            self.assertEqual(status, 4)
            self.assertIn(f'the chunk "{letters}" at byte {at} is damaged', said)
            at += 16 + struct.unpack_from("<Q", data, at + 4)[0]

    def test_changed_bytes_with_valid_checksums_are_survived(self):
        random = np.random.default_rng(6)
        path, _ = self.write(add_attributes(make_groom(strands=5, vertices=4)), "a.groom")
        with open(path, "rb") as file:
            data = file.read()
        for _ in range(300):
            bad = bytearray(data)
            for _ in range(2):
                bad[random.integers(32, len(bad))] = random.integers(0, 256)
            at = 32
            while at + 16 <= len(bad):
                end = at + 16 + struct.unpack_from("<Q", bad, at + 4)[0]
                checksum = zlib.crc32(bad[at + 16:end], zlib.crc32(bad[at:at + 12]))
                bad[at + 12:at + 16] = struct.pack("<I", checksum)
                at = end
            with open(self.path("b.groom"), "wb") as file:
                file.write(bad)
            status, said = self.convert("info", self.path("b.groom"))
            self.assertIn(status, (0, 4), said)
            self.assertNotIn("Traceback", said)
