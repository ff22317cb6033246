"""USD: round trips, interpolations, units, transforms and motion."""

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from hairconvert.groom import GROOM, Attribute, Motion, lengths
from tests.support import ConvertTest, add_attributes, make_groom

NAMES = ["width", "color", "opacity", "root_uv", "group", "guide", "id", "closest_guides",
         "guide_weights", "roughness", "stiffness"]


class UsdRoundTripTest(ConvertTest):
    def test_keeps_positions_and_all_attributes(self):
        for kind in ("straight", "curly", "clumped", "braid"):
            for ending in (".usda", ".usdc", ".usd"):
                with self.subTest(kind=kind, ending=ending):
                    groom = add_attributes(make_groom(kind, uneven=True))
                    path, said = self.write(groom, "a" + ending)
                    back = self.read(path)
                    self.assert_same_strands(groom, back)
                    self.assert_same_attributes(groom, back, NAMES)
                    self.assertEqual(said + self.report.sentences, [])
                    for name in NAMES:
                        self.assertEqual(back.attributes[name].values.dtype,
                                         groom.attributes[name].values.dtype, name)

    def test_keeps_types_and_scopes_of_own_attributes(self):
        groom = make_groom()
        random = np.random.default_rng(1)
        for scope, n in (("groom", 1), ("strand", 100), ("vertex", 1600)):
            for dtype in ("f2", "f4", "f8", "i4", "i8", "u1", "u4", "u8", "?"):
                for shape in ((n,), (n, 2), (n, 3), (n, 4), (n, 7)):
                    values = random.integers(0, 2, shape).astype(dtype)
                    name = f"own:{scope}_{dtype.replace('?', 'b')}_{len(shape)}_{shape[-1]}"
                    groom.attributes[name] = Attribute(scope, values)
            groom.attributes["text_" + scope] = Attribute(scope, np.array(["a", "b c"] * n)[:n])
        path, said = self.write(groom, "a.usdc")
        back = self.read(path)
        self.assertEqual(said + self.report.sentences, [])
        for name, a in groom.attributes.items():
            b = back.attributes[name]
            self.assertEqual((b.scope, b.values.shape), (a.scope, a.values.shape), name)
            np.testing.assert_array_equal(a.values, b.values, err_msg=name)
            self.assertEqual(b.values.dtype.kind, a.values.dtype.kind, name)

    def test_catmull_rom_curves_keep_their_vertices(self):
        groom = make_groom("curly", vertices=32, uneven=True)
        path, _ = self.write(groom, "a.usda", "--basis", "catmullRom")
        self.assert_same_strands(groom, self.read(path))
        self.assertIn("polylines of 1 edges per segment, at most", self.report.sentences[0])
        finer = self.read(path, "--samples", "4")
        np.testing.assert_array_equal(finer.counts, 4 * (groom.counts - 1) + 1)

    def test_unit_and_axis_of_the_stage(self):
        groom = add_attributes(make_groom())
        path, _ = self.write(groom, "a.usda", "--output-scale", "0.01", "--output-up", "z")
        stage = Usd.Stage.Open(path)
        self.assertEqual(UsdGeom.GetStageMetersPerUnit(stage), 0.01)
        self.assertEqual(UsdGeom.GetStageUpAxis(stage), "Z")
        points = np.array(UsdGeom.BasisCurves(stage.GetPrimAtPath("/hair/strands"))
                          .GetPointsAttr().Get())
        np.testing.assert_allclose(points[:, 2], 100 * groom.points[:, 1], rtol=1e-5)
        back = self.read(path)
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, ["width"], 1e-6)

    def test_motion_is_kept(self):
        groom = make_groom()
        times = np.arange(5) / 30
        groom.motion = Motion(times, lambda i: groom.points + [0, 0.01 * i, 0])
        for options in ((), ("--output-up", "z", "--output-scale", "0.1")):
            path, _ = self.write(groom, f"a{len(options)}.usdc", *options)
            back = self.read(path)
            np.testing.assert_allclose(back.motion.times, times, atol=1e-9)
            for i in range(5):
                np.testing.assert_allclose(back.motion.read(i), groom.motion.read(i), atol=1e-6)
        self.assertEqual(Usd.Stage.Open(path).GetTimeCodesPerSecond(), 30)
        posed = self.read(path, "--frame", "3")
        np.testing.assert_allclose(posed.points, groom.motion.read(3), atol=1e-6)
        status, said = self.convert("convert", path, self.path("a.hair"))
        self.assertEqual(status, 0)
        self.assertIn("the motion of 5 frames is not kept", said)

    def test_through_hair_and_back(self):
        groom = add_attributes(make_groom("braid", uneven=True))
        usd, _ = self.write(groom, "a.usda")
        self.assertEqual(self.convert("convert", usd, self.path("b.hair"))[0], 0)
        self.assertEqual(self.convert("convert", self.path("b.hair"), self.path("c.usda"))[0], 0)
        back = self.read(self.path("c.usda"))
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, ["width"])
        self.assert_same_attributes(groom, back, ["color", "opacity"], 1e-6)

    def test_large_groom(self):
        groom = add_attributes(make_groom("curly", strands=100000, vertices=32))
        path, _ = self.write(groom, "a.usdc")
        back = self.read(path)
        self.assert_same_strands(groom, back)
        self.assert_same_attributes(groom, back, NAMES)


class UsdReadTest(ConvertTest):
    def stage(self, name="a.usda", unit=1.0):
        stage = Usd.Stage.CreateNew(self.path(name))
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
        if unit:
            UsdGeom.SetStageMetersPerUnit(stage, unit)
        return stage

    def curves(self, stage, path="/c", counts=(4, 4), kind="linear", basis=None, wrap=None):
        curves = UsdGeom.BasisCurves.Define(stage, path)
        n = sum(counts)
        points = np.stack([np.arange(n), np.arange(n) % 3, np.zeros(n)], axis=1)
        curves.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points.astype(np.float32)))
        curves.CreateCurveVertexCountsAttr(list(counts))
        curves.CreateTypeAttr(kind)
        if basis:
            curves.CreateBasisAttr(basis)
        if wrap:
            curves.CreateWrapAttr(wrap)
        return curves

    def saved(self, stage, *options):
        stage.GetRootLayer().Save()
        return self.read(stage.GetRootLayer().realPath, *options)

    def test_every_basis_and_wrap_with_every_interpolation(self):
        for basis in ("bezier", "bspline", "catmullRom"):
            for wrap in ("nonperiodic", "periodic", "pinned"):
                counts = (3, 6) if basis == "bezier" and wrap == "periodic" else (4, 7)
                stage = self.stage(f"{basis}{wrap}.usda")
                curves = self.curves(stage, counts=counts, kind="cubic", basis=basis, wrap=wrap)
                api, step = UsdGeom.PrimvarsAPI(curves.GetPrim()), 3 if basis == "bezier" else 1
                segments = {"nonperiodic": lambda n: (n - 4) // step + 1,
                            "periodic": lambda n: n // step,
                            "pinned": lambda n: (n - 1 if step == 1 else (n - 4) // 3 + 1)}[wrap]
                ends = [segments(n) + (wrap != "periodic") for n in counts]
                for name, n in (("constant", 1), ("uniform", 2), ("varying", sum(ends)),
                                ("vertex", sum(counts))):
                    api.CreatePrimvar("x_" + name, Sdf.ValueTypeNames.FloatArray, name).Set(
                        list(map(float, range(n))))
                groom = self.saved(stage, "--samples", "2")
                with self.subTest(basis=basis, wrap=wrap):
                    self.assertEqual(groom.counts.tolist(), [2 * segments(n) + 1 for n in counts])
                    scopes = [groom.attributes["x_" + n].scope
                              for n in ("constant", "uniform", "varying", "vertex")]
                    self.assertEqual(scopes, ["groom", "strand", "vertex", "vertex"])
                    # The x coordinate of a point is its number, as is the value.
                    np.testing.assert_allclose(groom.attributes["x_vertex"].values,
                                               groom.points[:, 0], atol=1e-5)
                    self.assertEqual(groom.attributes["x_varying"].values[2], ends[0] > 1)

    def test_widths_of_every_interpolation(self):
        for interpolation, n in (("constant", 1), ("uniform", 2), ("varying", 8), ("vertex", 8)):
            stage = self.stage(interpolation + ".usda")
            curves = self.curves(stage)
            curves.CreateWidthsAttr([0.1 * (i + 1) for i in range(n)])
            curves.SetWidthsInterpolation(interpolation)
            groom = self.saved(stage)
            width = groom.values("width", "vertex")
            self.assertEqual(len(width), 8)
            self.assertAlmostEqual(float(width[0]), 0.1, 6)
            self.assertAlmostEqual(float(width[-1]), 0.1 * n, 6)

    def test_primvar_widths_go_before_widths(self):
        stage = self.stage()
        curves = self.curves(stage)
        curves.CreateWidthsAttr([0.5])
        curves.SetWidthsInterpolation("constant")
        UsdGeom.PrimvarsAPI(curves.GetPrim()).CreatePrimvar(
            "widths", Sdf.ValueTypeNames.FloatArray, "uniform").Set([0.25, 0.75])
        self.assertEqual(self.saved(stage).attributes["width"].values.tolist(), [0.25, 0.75])

    def test_indexed_primvars_are_flattened(self):
        stage = self.stage()
        primvar = UsdGeom.PrimvarsAPI(self.curves(stage).GetPrim()).CreatePrimvar(
            "tone", Sdf.ValueTypeNames.FloatArray, "vertex")
        primvar.Set([5.0, 7.0])
        primvar.SetIndices(Vt.IntArray([0, 1, 1, 0, 0, 0, 1, 1]))
        self.assertEqual(self.saved(stage).attributes["tone"].values.tolist(),
                         [5, 7, 7, 5, 5, 5, 7, 7])

    def test_flat_arrays_of_the_schema_become_vectors(self):
        stage = self.stage()
        api = UsdGeom.PrimvarsAPI(self.curves(stage).GetPrim())
        api.CreatePrimvar("groom_closest_guides", Sdf.ValueTypeNames.IntArray, "uniform").Set(
            [0, 1, 1, 1, 0, 0])
        api.CreatePrimvar("groom_guide_weights", Sdf.ValueTypeNames.Float3Array, "uniform").Set(
            [Gf.Vec3f(1, 0, 0), Gf.Vec3f(0, 1, 0)])
        groom = self.saved(stage)
        self.assertEqual(groom.attributes["closest_guides"].values.tolist(), [[0, 1, 1], [1, 0, 0]])
        self.assertEqual(groom.attributes["guide_weights"].values.tolist(), [[1, 0, 0], [0, 1, 0]])

    def test_values_that_fit_nothing_are_named(self):
        stage = self.stage()
        curves = self.curves(stage)
        api = UsdGeom.PrimvarsAPI(curves.GetPrim())
        api.CreatePrimvar("short", Sdf.ValueTypeNames.FloatArray, "vertex").Set([1.0] * 5)
        api.CreatePrimvar("asset", Sdf.ValueTypeNames.Asset, "constant").Set("x.png")
        api.CreatePrimvar("groom_color", Sdf.ValueTypeNames.FloatArray, "uniform").Set([1.0, 2.0])
        curves.GetPrim().CreateAttribute("userProperties:made", Sdf.ValueTypeNames.String).Set("x")
        curves.CreateVelocitiesAttr([Gf.Vec3f(1, 2, 3)] * 8)
        groom = self.saved(stage)
        self.assertEqual(groom.attributes, {})
        for name in ("short", "asset", "color", "userProperties:made", "velocities"):
            told = [s for s in self.report.sentences if f" {name} is not kept" in s]
            self.assertEqual(len(told), 1, (name, self.report.sentences))

    def test_transforms_apply_to_positions_and_widths(self):
        stage = self.stage()
        parent = UsdGeom.Xform.Define(stage, "/p")
        parent.AddTranslateOp().Set((10, 0, 0))
        parent.AddScaleOp().Set((2, 2, 2))
        curves = self.curves(stage, "/p/c")
        curves.AddRotateZOp().Set(90)
        curves.CreateWidthsAttr([0.5])
        curves.SetWidthsInterpolation("constant")
        groom = self.saved(stage)
        np.testing.assert_allclose(groom.points[1], [10 - 2, 2, 0], atol=1e-6)
        self.assertAlmostEqual(float(groom.attributes["width"].values[0]), 1, 6)

    def test_moving_transform_is_motion(self):
        stage = self.stage()
        stage.SetTimeCodesPerSecond(10)
        curves = self.curves(stage)
        op = curves.AddTranslateOp()
        for code in (0, 5, 10):
            op.Set((0, code, 0), code)
        groom = self.saved(stage)
        np.testing.assert_allclose(groom.motion.times, [0, 0.5, 1])
        np.testing.assert_allclose(groom.motion.read(2)[:, 1] - groom.points[:, 1], 10)
        self.assertAlmostEqual(self.saved(stage, "--frame", "2.5").points[0, 1], 2.5)

    def test_curves_become_groups(self):
        stage = self.stage()
        self.curves(stage, "/beard", (3,))
        brows = self.curves(stage, "/brows", (4, 4))
        UsdGeom.PrimvarsAPI(brows.GetPrim()).CreatePrimvar(
            "tone", Sdf.ValueTypeNames.FloatArray, "uniform").Set([5.0, 7.0])
        groom = self.saved(stage)
        self.assertEqual(groom.counts.tolist(), [3, 4, 4])
        self.assertEqual(groom.attributes["group"].values.tolist(), [0, 1, 1])
        self.assertEqual(groom.attributes["group_name"].values.tolist(), ["beard", "brows", "brows"])
        self.assertEqual(groom.attributes["tone"].values.tolist(), [0, 5, 7])
        self.assertTrue(any("tone is 0 or empty in 1 of 2" in s for s in self.report.sentences))

    def test_guides_of_later_curves_keep_their_strands(self):
        stage = self.stage()
        self.curves(stage, "/beard", (3,))
        brows = self.curves(stage, "/brows", (4, 4))
        UsdGeom.PrimvarsAPI(brows.GetPrim()).CreatePrimvar(
            "groom_closest_guides", Sdf.ValueTypeNames.IntArray, "uniform", 2).Set([0, 1, 1, -1])
        closest = self.saved(stage).attributes["closest_guides"].values
        # Strand 0 of the second curves is strand 1 of the file. -1 names no strand.
        self.assertEqual(closest.tolist(), [[-1, -1], [1, 2], [2, -1]])

    def test_instances_are_read(self):
        stage = self.stage()
        UsdGeom.Xform.Define(stage, "/proto")
        self.curves(stage, "/proto/c")
        for i in range(2):
            copy = UsdGeom.Xform.Define(stage, f"/copy{i}")
            copy.AddTranslateOp().Set((0, 0, 5 * (i + 1)))
            copy.GetPrim().GetReferences().AddInternalReference("/proto")
            copy.GetPrim().SetInstanceable(True)
        self.assertEqual(self.saved(stage).points[:, 2].tolist(), [0] * 8 + [5] * 8 + [10] * 8)

    def test_unit_that_is_missing_is_told(self):
        stage = self.stage(unit=None)
        self.curves(stage)
        groom = self.saved(stage)
        self.assertAlmostEqual(lengths(groom)[0], 0.01 * sum(
            np.hypot(1, d) for d in (1, 1, 2)), 6)
        self.assertTrue(any("metersPerUnit is not in the file" in s for s in self.report.sentences))

    def test_other_geometry_is_told(self):
        stage = self.stage()
        self.curves(stage)
        UsdGeom.Mesh.Define(stage, "/m")
        self.saved(stage)
        self.assertTrue(any("1 prims of the type Mesh" in s for s in self.report.sentences))

    def test_usdz_is_read(self):
        from pxr import UsdUtils
        stage = self.stage()
        self.curves(stage)
        stage.GetRootLayer().Save()
        UsdUtils.CreateNewUsdzPackage(self.path("a.usda"), self.path("a.usdz"))
        self.assertEqual(len(self.read(self.path("a.usdz")).counts), 2)


class UsdHostileTest(ConvertTest):
    def refuse(self, text, words):
        path = self.path("a.usda")
        with open(path, "w", encoding="ascii") as file:
            file.write("#usda 1.0\n" + text)
        status, said = self.guarded("info", path)
        self.assertEqual(status, 4, said)
        self.assertIn(words, said)
        self.assertNotIn("Traceback", said)

    CURVES = """def BasisCurves "c" {{
        uniform token type = "{kind}"
        int[] curveVertexCounts = {counts}
        point3f[] points = {points}
    }}"""

    def test_no_curves(self):
        self.refuse("", "no BasisCurves")
        self.refuse('def Mesh "m" {}', "no BasisCurves")
        self.refuse('def BasisCurves "c" {}', "no BasisCurves with vertices")

    def test_counts_that_do_not_fit(self):
        for counts in ("[5]", "[-1, 3]", "[2147483647, 2147483647]", "[]"):
            self.refuse(self.CURVES.format(kind="linear", counts=counts,
                                           points="[(0,0,0), (1,1,1)]"), "left out")

    def test_positions_that_are_not_finite(self):
        self.refuse(self.CURVES.format(kind="linear", counts="[2]", points="[(nan,0,0), (1,1,1)]"),
                    "not finite")
        self.refuse(self.CURVES.format(kind="cubic", counts="[4]",
                                       points="[(inf,0,0), (1,1,1), (nan, 1, 1), (0,0,0)]"),
                    "not finite")

    def test_cubic_curves_with_too_few_points(self):
        self.refuse(self.CURVES.format(kind="cubic", counts="[3]",
                                       points="[(0,0,0), (1,1,1), (2,2,2)]"), "fewer than 2")

    def test_units_that_are_no_units(self):
        for unit in ("0", "-1", "nan", "inf", "1e300"):
            self.refuse(f"(\nmetersPerUnit = {unit}\n)\n" + self.CURVES.format(
                kind="linear", counts="[2]", points="[(0,0,0), (1,1,1)]"), "metersPerUnit")

    def test_cyclic_references(self):
        self.refuse('(\nsubLayers = [@a.usda@]\n)\n', "a.usda")
        self.refuse('def "a" (references = </b>) {}\ndef "b" (references = </a>) {}\n',
                    "no BasisCurves")

    def test_topology_that_changes_keeps_the_first_pose(self):
        path = self.path("t.usda")
        with open(path, "w", encoding="ascii") as file:
            file.write("""#usda 1.0
            def BasisCurves "c" {
                uniform token type = "linear"
                int[] curveVertexCounts.timeSamples = { 0: [2], 1: [3] }
                point3f[] points.timeSamples = { 0: [(0,0,0), (1,1,1)],
                                                 1: [(0,0,0), (1,1,1), (2,2,2)] }
            }""")
        groom = self.read(path)
        self.assertIsNone(groom.motion)
        self.assertTrue(any("the motion of /c is not kept" in s for s in self.report.sentences))
