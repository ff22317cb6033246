"""Alembic: round trips, Unreal's groom schema, scopes, transforms and motion."""

import imath
import numpy as np
from alembic3d import Abc, AbcCoreAbstract, AbcGeom

from hairconvert.groom import Attribute, Motion
from tests.support import ConvertTest, add_attributes, make_groom
from tests.test_usd import NAMES

GUESS = "an Alembic file does not tell its unit"
G = AbcGeom.GeometryScope


class AlembicRoundTripTest(ConvertTest):
    def test_keeps_positions_and_all_attributes(self):
        for kind in ("straight", "curly", "clumped", "braid"):
            with self.subTest(kind=kind):
                groom = add_attributes(make_groom(kind, uneven=True))
                path, said = self.write(groom, "a.abc")
                back = self.read(path)
                self.assert_same_strands(groom, back)
                self.assert_same_attributes(groom, back, NAMES[1:])
                self.assert_same_attributes(groom, back, ["width"], 1e-6)
                self.assertEqual(said, [])
                self.assertEqual(len(self.report.sentences), 1)
                self.assertIn(GUESS, self.report.sentences[0])
                for name in NAMES[1:]:
                    self.assertEqual(back.attributes[name].values.dtype,
                                     groom.attributes[name].values.dtype, name)

    def test_in_metres_every_bit_is_kept(self):
        groom = add_attributes(make_groom())
        path, _ = self.write(groom, "a.abc", "--output-scale", "1")
        back = self.read(path, "--scale", "1")
        np.testing.assert_array_equal(back.points, groom.points)
        self.assert_same_attributes(groom, back, NAMES)
        self.assertEqual(self.report.sentences, [])

    def test_keeps_types_and_scopes_of_own_attributes(self):
        groom = make_groom()
        random = np.random.default_rng(1)
        for scope, n in (("groom", 1), ("strand", 100), ("vertex", 1600)):
            for dtype in ("f2", "f4", "f8", "i4", "?"):
                for shape in ((n,), (n, 2), (n, 3), (n, 4), (n, 7)):
                    values = random.integers(0, 2, shape).astype(dtype)
                    groom.attributes[f"own_{scope}_{dtype}_{len(shape)}_{shape[-1]}"] = \
                        Attribute(scope, values)
            groom.attributes["text_" + scope] = Attribute(scope, np.array(["a", "b c"] * n)[:n])
        path, said = self.write(groom, "a.abc")
        back = self.read(path, "--scale", "0.01")
        self.assertEqual(said + self.report.sentences, [])
        for name, a in groom.attributes.items():
            b = back.attributes[name]
            self.assertEqual((b.scope, b.values.shape), (a.scope, a.values.shape), name)
            np.testing.assert_array_equal(a.values, b.values, err_msg=name)
            if a.values.dtype.kind != "U":
                self.assertEqual(b.values.dtype, a.values.dtype, name)

    def test_other_whole_numbers_are_told(self):
        groom = make_groom()
        groom.attributes["small"] = Attribute("strand", np.full(100, -3, np.int16))
        groom.attributes["large"] = Attribute("strand", np.full(100, 1 << 40, np.int64))
        path, said = self.write(groom, "a.abc")
        self.assertEqual(len(said), 2)
        self.assertIn("small becomes whole numbers of 32 bits", said[0])
        self.assertIn("large is not kept", said[1])
        self.assertEqual(self.read(path).attributes["small"].values.tolist(), [-3] * 100)

    def test_schema_is_that_of_unreal(self):
        groom = add_attributes(make_groom())
        path, _ = self.write(groom, "a.abc")
        archive = Abc.IArchive(path)
        schema = AbcGeom.ICurves(archive.getTop(), "strands").getSchema()
        arb = schema.getArbGeomParams()
        want = {"groom_guide": ("kInt32POD", 1, "uni"), "groom_group_id": ("kInt32POD", 1, "uni"),
                "groom_root_uv": ("kFloat32POD", 2, "uni"), "groom_id": ("kInt32POD", 1, "uni"),
                "groom_width": ("kFloat32POD", 1, "vtx"),
                "groom_color": ("kFloat32POD", 3, "vtx"),
                "groom_roughness": ("kFloat32POD", 1, "vtx"),
                "groom_closest_guides": ("kInt32POD", 3, "uni"),
                "groom_guide_weights": ("kFloat32POD", 3, "uni")}
        headers = {arb.getPropertyHeader(i).getName(): arb.getPropertyHeader(i)
                   for i in range(arb.getNumProperties())}
        for name, expected in want.items():
            h = headers[name]
            got = (h.getDataType().getPod().name, h.getDataType().getExtent(),
                   h.getMetaData().get("geoScope"))
            self.assertEqual(got, expected, name)
        for name in ("groom_version_major", "groom_version_minor", "groom_tool"):
            self.assertTrue(headers[name].isScalar())
        points = np.array(memoryview(schema.getValue().getPositions()))
        np.testing.assert_allclose(points, 100 * groom.points, rtol=1e-6)

    def test_motion_is_kept(self):
        for times in (np.arange(5) / 30, np.array([0.0, 0.1, 0.5])):
            groom = make_groom()
            groom.motion = Motion(times, lambda i: groom.points + [0, 0.01 * i, 0])
            path, _ = self.write(groom, f"a{len(times)}.abc", "--output-up", "z")
            back = self.read(path, "--up", "z")
            np.testing.assert_allclose(back.motion.times, times, atol=1e-9)
            for i in range(len(times)):
                np.testing.assert_allclose(back.motion.read(i), groom.motion.read(i), atol=1e-6)
            posed = self.read(path, "--up", "z", "--frame", str(times[2]))
            np.testing.assert_allclose(posed.points, groom.motion.read(2), atol=1e-6)

    def test_through_usd_and_back(self):
        groom = add_attributes(make_groom("braid", uneven=True))
        groom.motion = Motion(np.arange(3) / 24, lambda i: groom.points + [0, 0.01 * i, 0])
        path, _ = self.write(groom, "a.abc")
        self.assertEqual(self.convert("convert", path, self.path("b.usdc"))[0], 0)
        self.assertEqual(self.convert("convert", self.path("b.usdc"), self.path("c.abc"))[0], 0)
        back = self.read(self.path("c.abc"))
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, NAMES[1:])
        np.testing.assert_allclose(back.motion.read(2), groom.motion.read(2), atol=1e-6)

    def test_large_groom(self):
        groom = add_attributes(make_groom("curly", strands=100000, vertices=32))
        path, _ = self.write(groom, "a.abc")
        back = self.read(path)
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, NAMES[1:])


def sample(points, counts, kind="kLinear", wrap="kNonPeriodic", form="kNoBasis", width=None):
    """Return a sample of curves."""
    return AbcGeom.OCurvesSchemaSample(
        imath.V3fArrayFromBuffer(np.ascontiguousarray(points, np.float32)),
        imath.IntArrayFromBuffer(np.array(counts, np.int32)), getattr(AbcGeom.CurveType, kind),
        getattr(AbcGeom.CurvePeriodicity, wrap), width or AbcGeom.OFloatGeomParamSample(),
        AbcGeom.OV2fGeomParamSample(), AbcGeom.ON3fGeomParamSample(),
        getattr(AbcGeom.BasisType, form))


def line(n):
    """Return points whose x coordinate is their number."""
    return np.stack([np.arange(n), np.arange(n) % 3, np.zeros(n)], axis=1)


class AlembicReadTest(ConvertTest):
    def archive(self, fill, name="a.abc", options=("--scale", "1")):
        """Write an archive by a function and read the archive."""
        path = self.path(name)
        fill(Abc.OArchive(path))
        return self.read(path, *options)

    def test_every_basis_and_wrap(self):
        for form, wrap, counts, segments in (
                ("kBezierBasis", "kNonPeriodic", (4, 7), (1, 2)),
                ("kBezierBasis", "kPeriodic", (3, 6), (1, 2)),
                ("kBsplineBasis", "kNonPeriodic", (4, 7), (1, 4)),
                ("kBsplineBasis", "kPeriodic", (4, 7), (4, 7)),
                ("kCatmullromBasis", "kNonPeriodic", (4, 7), (1, 4)),
                ("kCatmullromBasis", "kPeriodic", (4, 7), (4, 7))):
            def fill(archive):
                AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(
                    sample(line(sum(counts)), counts, "kCubic", wrap, form))
            groom = self.archive(fill, form + wrap + ".abc", ("--samples", "3", "--scale", "1"))
            self.assertEqual(groom.counts.tolist(), [3 * s + 1 for s in segments], form + wrap)

    def test_other_bases_keep_their_control_points(self):
        def fill(archive):
            AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(
                sample(line(8), (4, 4), "kCubic", form="kHermiteBasis"))
        groom = self.archive(fill)
        self.assertEqual(groom.counts.tolist(), [4, 4])
        self.assertIn("kHermiteBasis", self.report.sentences[0])

    def test_widths_of_every_scope(self):
        for scope, n in ((G.kConstantScope, 1), (G.kUniformScope, 2), (G.kVaryingScope, 8),
                         (G.kVertexScope, 8)):
            values = np.arange(1, n + 1, dtype=np.float32)

            def fill(archive):
                width = AbcGeom.OFloatGeomParamSample(imath.FloatArrayFromBuffer(values), scope)
                AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(
                    sample(line(8), (4, 4), width=width))
            groom = self.archive(fill, f"{scope}.abc")
            width = groom.values("width", "vertex")
            self.assertEqual((width[0], width[-1]), (1, n))

    def test_groom_width_goes_before_width(self):
        def fill(archive):
            ones = imath.FloatArrayFromBuffer(np.ones(1, np.float32))
            width = AbcGeom.OFloatGeomParamSample(ones, G.kConstantScope)
            schema = AbcGeom.OCurves(archive.getTop(), "c").getSchema()
            schema.set(sample(line(8), (4, 4), width=width))
            twos = imath.FloatArrayFromBuffer(np.array([2, 3], np.float32))
            AbcGeom.OFloatGeomParam(schema.getArbGeomParams(), "groom_width", False,
                                    G.kUniformScope, 1).set(
                AbcGeom.OFloatGeomParamSample(twos, G.kUniformScope))
        self.assertEqual(self.archive(fill).attributes["width"].values.tolist(), [2, 3])

    def test_indexed_and_vector_parameters(self):
        def fill(archive):
            schema = AbcGeom.OCurves(archive.getTop(), "c").getSchema()
            schema.set(sample(line(8), (4, 4)))
            arb = schema.getArbGeomParams()
            indices = imath.UnsignedIntArray(1, 8)
            indices[3] = 0
            tones = imath.FloatArrayFromBuffer(np.array([5, 7], np.float32))
            AbcGeom.OFloatGeomParam(arb, "tone", True, G.kVertexScope, 1).set(
                AbcGeom.OFloatGeomParamSample(tones, indices, G.kVertexScope))
            flat = imath.IntArrayFromBuffer(np.array([0, 1, 1, 1, 0, 0], np.int32))
            AbcGeom.OInt32GeomParam(arb, "groom_closest_guides", False, G.kUniformScope, 3).set(
                AbcGeom.OInt32GeomParamSample(flat, G.kUniformScope))
            AbcGeom.OInt16GeomParam(arb, "groom_guide", False, G.kConstantScope, 1).set(
                AbcGeom.OInt16GeomParamSample(imath.ShortArray(1, 1), G.kConstantScope))
        groom = self.archive(fill)
        self.assertEqual(groom.attributes["tone"].values.tolist(), [7, 7, 7, 5, 7, 7, 7, 7])
        self.assertEqual(groom.attributes["closest_guides"].values.tolist(), [[0, 1, 1], [1, 0, 0]])
        self.assertEqual(groom.attributes["guide"].scope, "groom")
        self.assertEqual(groom.attributes["guide"].values.tolist(), [1])

    def test_values_that_fit_nothing_are_named(self):
        def fill(archive):
            schema = AbcGeom.OCurves(archive.getTop(), "c").getSchema()
            schema.set(sample(line(8), (4, 4)))
            five = imath.FloatArrayFromBuffer(np.ones(5, np.float32))
            AbcGeom.OFloatGeomParam(schema.getArbGeomParams(), "short", False, G.kVertexScope,
                                    1).set(AbcGeom.OFloatGeomParamSample(five, G.kVertexScope))
        self.assertEqual(self.archive(fill).attributes, {})
        self.assertIn("the attribute short is not kept", self.report.sentences[0])

    def test_moving_transforms_apply(self):
        def fill(archive):
            number = archive.addTimeSampling(AbcCoreAbstract.TimeSampling(0.1, 0.0))
            form = AbcGeom.OXform(archive.getTop(), "x", number)
            for i in range(3):
                moved = AbcGeom.XformSample()
                moved.setTranslation(imath.V3d(0, i, 0))
                form.getSchema().set(moved)
            inner = AbcGeom.OXform(form, "y")
            scaled = AbcGeom.XformSample()
            scaled.setScale(imath.V3d(2, 2, 2))
            inner.getSchema().set(scaled)
            ones = imath.FloatArrayFromBuffer(np.ones(1, np.float32))
            AbcGeom.OCurves(inner, "c").getSchema().set(sample(
                line(8), (4, 4), width=AbcGeom.OFloatGeomParamSample(ones, G.kConstantScope)))
        groom = self.archive(fill)
        np.testing.assert_allclose(groom.points, 2 * line(8))
        np.testing.assert_allclose(groom.motion.times, [0, 0.1, 0.2])
        np.testing.assert_allclose(groom.motion.read(2), 2 * line(8) + [0, 2, 0])
        self.assertAlmostEqual(float(groom.attributes["width"].values[0]), 2)

    def test_objects_become_groups(self):
        def fill(archive):
            AbcGeom.OCurves(archive.getTop(), "beard").getSchema().set(sample(line(3), (3,)))
            AbcGeom.OCurves(archive.getTop(), "brows").getSchema().set(sample(line(8), (4, 4)))
        groom = self.archive(fill)
        self.assertEqual(groom.attributes["group"].values.tolist(), [0, 1, 1])
        self.assertEqual(groom.attributes["group_name"].values.tolist(), ["beard", "brows", "brows"])

    def test_archives_that_hold_nothing_usable(self):
        def nothing(archive):
            AbcGeom.OXform(archive.getTop(), "x")

        def wrong(archive):
            AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(sample(line(8), (4, 5)))

        def negative(archive):
            AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(sample(line(8), (-4, 12)))

        def not_finite(archive):
            AbcGeom.OCurves(archive.getTop(), "c").getSchema().set(
                sample(np.full((8, 3), np.nan), (4, 4)))
        for i, (fill, words) in enumerate(((nothing, "no curves"), (wrong, "9 vertices"),
                                           (negative, "left out"), (not_finite, "not finite"))):
            path = self.path(f"{i}.abc")
            fill(Abc.OArchive(path))
            status, said = self.guarded("info", path)
            self.assertEqual(status, 4, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)
