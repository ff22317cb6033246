"""Tests of settings by name. `make test-python` runs them in an environment that has the wheel."""

import json
import math
import unittest

import numpy as np

import libhair
from libhair._native import ffi, hair


class SettingsTest(unittest.TestCase):
    """Every struct and every member, by the description of the library."""

    def test_layouts_of_cffi_are_those_of_the_library(self):
        for title in STRUCTS:
            struct = getattr(libhair, title)()
            kind = getattr(libhair, title)._kind
            name = ffi.string(hair.hair_struct_name(kind)).decode()
            self.assertEqual(ffi.sizeof(name), hair.hair_struct_size(kind), name)
            for member in struct.members():
                path = [int(part) if part.isdigit() else part for part in member.name.split(".")]
                self.assertEqual(ffi.offsetof(name, *path), member.offset, member.name)

    def test_every_member_has_its_default(self):
        count = 0
        for title in STRUCTS:
            struct = getattr(libhair, title)()
            for member in struct.members():
                if member.type in ("pointer", "texture") or member.name in REQUIRED:
                    continue
                value = struct[member.name]
                values = tuple(value.T.ravel()) if member.layout == "matrix" else value
                values = values if isinstance(values, tuple) else (values,)
                self.assertEqual(len(values), member.count)
                for one, default in zip(values, member.defaults):
                    expected = member.choices[int(default)] if member.type == "enum" else default
                    self.assertTrue(one == expected or math.isclose(one, expected, rel_tol=1e-6), member.name)
                count += 1
        self.assertGreater(count, 190)

    def test_every_member_takes_other_values_and_refuses_values_beyond_the_range(self):
        for title in STRUCTS:
            struct = getattr(libhair, title)()
            for member in struct.members():
                if member.type in ("pointer", "texture") or member.layout == "matrix" or member.name in REQUIRED:
                    continue
                if member.type == "enum":
                    struct[member.name] = member.choices[-1]
                    self.assertEqual(struct[member.name], member.choices[-1])
                    bad = "no_such_choice"
                elif member.type == "bool":
                    struct[member.name] = not member.defaults[0]
                    self.assertIs(struct[member.name], not member.defaults[0])
                    bad = "maybe"
                else:
                    bad = (math.inf,) * member.count if member.type == "float" else (1 << 70,) * member.count
                before = struct[member.name]
                with self.assertRaises(libhair.HairArgumentError) as caught:
                    struct[member.name] = bad
                self.assertIn(member.name, str(caught.exception))
                self.assertEqual(struct[member.name], before)

    def test_sentence_of_a_refusal_names_value_and_range(self):
        with self.assertRaisesRegex(ValueError, r"damping.*-1.*\[0, 1000\]"):
            libhair.Physics(damping=-1)

    def test_elements_groups_and_tuples_are_the_same_member(self):
        look = libhair.Look({"color.root": (0.5, 0.25, 0.125)})
        self.assertEqual(look.color.root, (0.5, 0.25, 0.125))
        look.color.root = [0, 0.5, 1]
        self.assertEqual(look["color.root.g"], 0.5)
        look["strand.taper[3]"] = 0.75
        self.assertEqual(look.strand.taper[3], 0.75)
        self.assertIn("strand", dir(look))
        self.assertIn("radius", dir(look.strand))
        with self.assertRaises(AttributeError):
            _ = look.strand.no_such_member
        with self.assertRaises(libhair.HairArgumentError):
            look.no_such_member = 1

    def test_matrices_are_arrays_for_column_vectors(self):
        matrix = libhair.look_at((0.3, 1.6, 1.2), (0, 1.5, 0))
        view = libhair.View(view=matrix)
        self.assertEqual(view._c.view[13], np.float32(matrix[1, 3]))
        np.testing.assert_allclose(view.view, matrix, rtol=1e-6)
        view["view[12]"] = 2
        self.assertEqual(view.view[0, 3], 2)
        for wrong in (np.eye(3), range(16), 1):
            with self.assertRaisesRegex(ValueError, "4x4"):
                view.projection = wrong

    def test_textures_are_integers_and_pointers_are_refused(self):
        view = libhair.View(color_texture=7)
        self.assertEqual(view.color_texture, 7)
        with self.assertRaises(libhair.HairArgumentError):
            _ = view["lights"]

    def test_json_returns_and_presets_are_short(self):
        for title in STRUCTS:
            struct = getattr(libhair, title)()
            again = getattr(libhair, title)()
            again.from_json(struct.to_json())
            self.assertEqual(again.to_json(), struct.to_json())
        physics = libhair.Physics(damping=2.5, gravity=(0, -1.62, 0))
        preset = physics.to_json(libhair.Physics())
        self.assertEqual(json.loads(preset), {"damping": 2.5, "gravity": [0, -1.62, 0]})
        again = libhair.Physics()
        again.from_json(preset)
        self.assertEqual(again.to_json(), physics.to_json())
        self.assertIn("damping", repr(physics))

    def test_bad_json_raises_and_changes_nothing(self):
        physics = libhair.Physics(damping=3)
        for text, error in (("{", libhair.HairFileError), ('{"damping": -1}', libhair.HairArgumentError),
                            ('{"nothing": 1}', libhair.HairArgumentError), (b"\xff", libhair.HairFileError)):  # fmt: skip
            with self.assertRaises(error):
                physics.from_json(text)
            self.assertEqual(physics.damping, 3)

    def test_a_copy_is_independent(self):
        look = libhair.Look({"strand.radius": 1e-4})
        copy = look.copy()
        copy.strand.radius = 2e-4
        self.assertEqual(look.strand.radius, 1e-4)
        self.assertEqual(copy.strand.radius, 2e-4)


# These numbers have no default that the library accepts.
REQUIRED = ("strand_count", "vertex_count", "triangle_count")
STRUCTS = [name for name in libhair.__all__ if isinstance(getattr(libhair, name), type)
           and issubclass(getattr(libhair, name), libhair.Settings) and name != "Settings"]  # fmt: skip
