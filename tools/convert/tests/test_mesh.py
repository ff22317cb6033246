"""Meshes of glTF, OBJ and .tfxmesh: geometry, texture coordinates, skins, hostile files."""

import base64
import json
import os
import struct

import numpy as np

from hairconvert import tfxmesh
from hairconvert.mesh import Mesh, check_mesh
from hairconvert.meshes import read_mesh, write_mesh
from hairconvert.report import Report
from tests.support import ConvertTest, make_parser


def make_gltf(skin=True, index_type=5123, indices=(0, 1, 2, 2, 1, 3), mode=4):
    """Return the JSON and the bytes of a square of two triangles that hangs on two joints."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], "<f4")
    uv = np.array([[0, 1], [1, 1], [0, 0], [1, 0]], "<f4")
    joints = np.array([[0, 1, 0, 0]] * 4, "u1")
    weights = np.array([[255, 0, 0, 0], [0, 255, 0, 0], [128, 127, 0, 0], [255, 0, 0, 0]], "u1")
    inverse = np.tile(np.eye(4, dtype="<f4"), (2, 1, 1))
    inverse[1, 3, 0] = -5  # Column-major, so this moves by -5 along x.
    number = {5121: "u1", 5123: "<u2", 5125: "<u4"}[index_type]
    arrays = [(points, "VEC3", 5126), (uv, "VEC2", 5126), (joints, "VEC4", 5121),
              (weights, "VEC4", 5121), (inverse.reshape(2, 16), "MAT4", 5126),
              (np.array(indices, number).reshape(-1, 1), "SCALAR", index_type)]
    data, views, accessors = b"", [], []
    for values, kind, number in arrays:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": values.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": number, "type": kind,
                          "count": len(values)})
        data += values.tobytes() + bytes(-values.nbytes % 4)
    accessors[3]["normalized"] = True
    attributes = {"POSITION": 0, "TEXCOORD_0": 1}
    if skin:
        attributes |= {"JOINTS_0": 2, "WEIGHTS_0": 3}
    half = 0.5 ** 0.5
    nodes = [{"name": "head", "mesh": 0}, {"name": "root", "children": [2]},
             {"name": "neck", "translation": [5, 2, 0]},
             {"name": "up", "children": [0, 1], "rotation": [0, 0, half, half], "scale": [2] * 3}]
    if skin:
        nodes[0]["skin"] = 0
        nodes[3] = {"name": "up", "children": [0, 1]}
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [3]}], "nodes": nodes,
            "meshes": [{"name": "scalp", "primitives": [
                {"attributes": attributes, "indices": 5, "mode": mode}]}],
            "skins": [{"joints": [1, 2], "inverseBindMatrices": 4}],
            "buffers": [{"byteLength": len(data)}], "bufferViews": views,
            "accessors": accessors}, data


class MeshCase(ConvertTest):
    def mesh(self, path, *options):
        self.report = Report()
        return read_mesh(path, make_parser().parse_args(["scalp", path, "x.obj", *options]),
                         self.report)

    def glb(self, gltf, data, name="a.glb"):
        text = json.dumps(gltf).encode()
        text += b" " * (-len(text) % 4)
        data += bytes(-len(data) % 4)
        body = struct.pack("<II", len(text), 0x4e4f534a) + text + \
            struct.pack("<II", len(data), 0x004e4942) + data
        return self.file(name, struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)

    def file(self, name, data):
        path = self.path(name)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def refuse(self, path, words=""):
        status, said = self.guarded("info", path)
        self.assertEqual(status, 4, said)
        self.assertIn(words, said)
        self.assertNotIn("Traceback", said)


class GltfTest(MeshCase):
    def test_transforms_of_nodes_apply(self):
        mesh = self.mesh(self.glb(*make_gltf(skin=False)))
        np.testing.assert_allclose(mesh.points, [[0, 0, 0], [0, 2, 0], [-2, 0, 0], [-2, 2, 0]],
                                   atol=1e-6)
        self.assertEqual(mesh.triangles.tolist(), [[0, 1, 2], [2, 1, 3]])
        np.testing.assert_allclose(mesh.uv, [[0, 0], [1, 0], [0, 1], [1, 1]])
        self.assertIsNone(mesh.weights)

    def test_skin_poses_the_mesh(self):
        mesh = self.mesh(self.glb(*make_gltf()))
        # The second joint lies 2 higher than where it is bound.
        np.testing.assert_allclose(
            mesh.points, [[0, 0, 0], [1, 2, 0], [0, 1 + 2 * 127 / 255, 0], [1, 1, 0]], atol=1e-6)
        self.assertEqual(mesh.joint_names, ["root", "neck"])
        np.testing.assert_allclose(mesh.weights[2, :2], [128 / 255, 127 / 255], atol=1e-6)
        self.assertEqual(mesh.joints[2, :2].tolist(), [0, 1])

    def test_text_with_buffers_of_all_kinds(self):
        gltf, data = make_gltf()
        gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + \
            base64.b64encode(data).decode()
        first = self.mesh(self.file("a.gltf", json.dumps(gltf).encode()))
        gltf["buffers"][0]["uri"] = "my%20data.bin"
        self.file("my data.bin", data)
        second = self.mesh(self.file("b.gltf", json.dumps(gltf).encode()))
        np.testing.assert_array_equal(first.points, second.points)

    def test_indices_strips_and_fans(self):
        for number in (5121, 5123, 5125):
            mesh = self.mesh(self.glb(*make_gltf(index_type=number)))
            self.assertEqual(mesh.triangles.tolist(), [[0, 1, 2], [2, 1, 3]])
        mesh = self.mesh(self.glb(*make_gltf(indices=(0, 1, 2, 3), mode=5)))
        self.assertEqual(mesh.triangles.tolist(), [[0, 1, 2], [1, 3, 2]])
        mesh = self.mesh(self.glb(*make_gltf(indices=(0, 1, 3, 2), mode=6)))
        self.assertEqual(mesh.triangles.tolist(), [[0, 1, 3], [0, 3, 2]])

    def test_sparse_and_interleaved_accessors(self):
        gltf, data = make_gltf(skin=False)
        gltf["nodes"] = [{"mesh": 0}]
        gltf["scenes"] = [{"nodes": [0]}]
        at = len(data)
        data += struct.pack("<HH3f", 3, 0, 9, 8, 7)
        gltf["bufferViews"] += [{"buffer": 0, "byteOffset": at, "byteLength": 2},
                                {"buffer": 0, "byteOffset": at + 4, "byteLength": 12}]
        gltf["accessors"][0]["sparse"] = {
            "count": 1, "indices": {"bufferView": 6, "componentType": 5123},
            "values": {"bufferView": 7}}
        wide = np.zeros((4, 5), "<f4")
        wide[:, 1:3] = [[0.25, 1]] * 4
        gltf["bufferViews"][1] = {"buffer": 0, "byteOffset": len(data), "byteLength": 80,
                                  "byteStride": 20}
        gltf["accessors"][1]["byteOffset"] = 4
        mesh = self.mesh(self.glb(gltf, data + wide.tobytes()))
        self.assertEqual(mesh.points[3].tolist(), [9, 8, 7])
        self.assertEqual(mesh.uv.tolist(), [[0.25, 0]] * 4)

    def test_mesh_is_chosen_by_name(self):
        path = self.glb(*make_gltf())
        for name in ("head", "scalp"):
            self.assertEqual(len(self.mesh(path, "--mesh", name).triangles), 2)
        status, said = self.convert("scalp", path, self.path("b.obj"), "--mesh", "other")
        self.assertEqual(status, 4)
        self.assertIn("no mesh of the name other", said)

    def test_hostile_files(self):
        gltf, data = make_gltf()

        def changed(change):
            copy = json.loads(json.dumps(gltf))
            change(copy)
            return self.glb(copy, data)
        cases = [
            (lambda g: g["nodes"][2].update(children=[1]), "node"),
            (lambda g: g["nodes"][3].update(children=[3, 0]), "below itself"),
            (lambda g: g["accessors"][0].update(count=1 << 27), "exceed"),
            (lambda g: g["accessors"][0].update(count=-1), "unknown type or count"),
            (lambda g: g["accessors"][0].update(bufferView=99), "does not exist"),
            (lambda g: g["bufferViews"][0].update(byteOffset=1 << 40), "exceed"),
            (lambda g: g["bufferViews"][0].update(byteStride=1 << 40), "exceed"),
            (lambda g: g["bufferViews"][0].update(byteOffset=-4), "exceed"),
            (lambda g: g["buffers"][0].update(uri="../../etc/passwd"), "no file"),
            (lambda g: g["buffers"][0].update(uri="data:,%%%"), "base64"),
            (lambda g: g["meshes"][0]["primitives"][0].update(indices=2), "no triangle"),
            (lambda g: g.update(extensionsRequired=["KHR_draco_mesh_compression"]), "draco"),
            (lambda g: g.update(asset={"version": "1.0"}), "version"),
            (lambda g: g.update(meshes=[]), "does not exist"),
            (lambda g: g.update(nodes="x"), ""),
            (lambda g: g["nodes"][2].update(translation="abc"), ""),
            (lambda g: g["scenes"][0].update(nodes=[]), "no mesh"),
            (lambda g: g["nodes"][2].update(translation=[float("nan")] * 3), ""),
        ]
        for i, (change, words) in enumerate(cases):
            with self.subTest(case=i):
                if i == len(cases) - 1:  # Half of the mesh is left.
                    self.assertIn(self.guarded("info", changed(change))[0], (0, 4))
                else:
                    self.refuse(changed(change), words)
        self.refuse(self.glb(*make_gltf(indices=(0, 1, 9))), "outside of the 4 vertices")
        self.refuse(self.file("b.gltf", b"[" * 100000), "JSON")
        self.refuse(self.file("c.glb", b"glTF" + b"\xff" * 30))
        random = np.random.default_rng(6)
        with open(self.glb(gltf, data), "rb") as file:
            good = file.read()
        for size in range(0, len(good), 97):
            self.refuse(self.file("d.glb", good[:size]))
        for _ in range(200):
            bad = np.frombuffer(good, np.uint8).copy()
            bad[random.integers(0, len(bad), 5)] = random.integers(0, 256, 5)
            status, said = self.guarded("info", self.file("e.glb", bad.tobytes()))
            self.assertIn(status, (0, 4), said)
            self.assertNotIn("Traceback", said)


class MeshFormatTest(MeshCase):
    def test_tfxmesh_keeps_the_skin(self):
        mesh = self.mesh(self.glb(*make_gltf()))
        status, said = self.convert("scalp", self.path("a.glb"), self.path("b.tfxmesh"))
        self.assertEqual(status, 0)
        self.assertIn("texture coordinates of the mesh is not kept", said)
        back = self.mesh(self.path("b.tfxmesh"))
        np.testing.assert_allclose(back.points, mesh.points, atol=1e-7)
        np.testing.assert_array_equal(back.triangles, mesh.triangles)
        np.testing.assert_allclose(back.weights, mesh.weights, atol=1e-7)
        np.testing.assert_array_equal(back.joints, mesh.joints)
        self.assertEqual(back.joint_names, mesh.joint_names)

    def test_obj_keeps_texture_coordinates(self):
        mesh = self.mesh(self.glb(*make_gltf()))
        status, said = self.convert("scalp", self.path("a.glb"), self.path("b.obj"),
                                    "--output-scale", "0.01", "--output-up", "z")
        self.assertEqual(status, 0)
        self.assertIn("the skin of the mesh is not kept", said)
        back = self.mesh(self.path("b.obj"), "--scale", "0.01", "--up", "z")
        np.testing.assert_allclose(back.points[back.triangles], mesh.points[mesh.triangles],
                                   atol=1e-7)
        np.testing.assert_allclose(back.uv[back.triangles], mesh.uv[mesh.triangles], atol=1e-7)

    def test_obj_polygons_groups_and_seams(self):
        path = self.file("a.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\n"
                         b"o other\nf 1 2 3\no scalp\nf 1/1 2/2 3/1 -1/-1\n")
        mesh = self.mesh(path, "--mesh", "scalp")
        self.assertEqual(len(mesh.triangles), 2)
        self.assertEqual(len(self.mesh(path).triangles), 3)
        self.refuse(self.file("b.tfxmesh", b"numOfBones 99\n"), "claims")
        self.assertEqual(self.convert("scalp", self.file("c.obj", b"v 0 0 0\nf 1 1 2\n"),
                                      self.path("d.obj"))[0], 4)

    def test_usd_meshes(self):
        from pxr import Sdf, Usd, UsdGeom, UsdSkel, Vt
        stage = Usd.Stage.CreateNew(self.path("a.usda"))
        UsdGeom.SetStageMetersPerUnit(stage, 0.01)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
        root = UsdGeom.Xform.Define(stage, "/head")
        root.AddTranslateOp().Set((0, 0, 100))
        mesh = UsdGeom.Mesh.Define(stage, "/head/scalp")
        mesh.CreatePointsAttr([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0), (5, 20, 0)])
        mesh.CreateFaceVertexCountsAttr([4, 3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3, 3, 2, 4])
        UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
            "st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying").Set(
            [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (0.75, 0), (0, 0.5)])
        skin = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
        skin.CreateJointsAttr(Vt.TokenArray(["root", "root/neck"]))
        skin.CreateJointIndicesPrimvar(False, 2).Set([0, 1] * 5)
        skin.CreateJointWeightsPrimvar(False, 2).Set([0.25, 0.75] * 5)
        stage.GetRootLayer().Save()
        for options in ((), ("--mesh", "scalp"), ("--mesh", "head")):
            got = self.mesh(self.path("a.usda"), *options)
            self.assertEqual(len(got.triangles), 3)
            corners = got.points[got.triangles]
            np.testing.assert_allclose(corners[0], [[0, 1, 0], [0.1, 1, 0], [0.1, 1, -0.1]],
                                       atol=1e-7)
            np.testing.assert_allclose(got.uv[got.triangles][1], [[0.5, 0], [0.75, 0], [0, 0.5]])
            self.assertEqual(got.joint_names, ["root", "neck"])
            self.assertEqual(got.weights[0].tolist(), [0.75, 0.25, 0, 0])
        mesh.GetFaceVertexIndicesAttr().Set([0, 1, 2, 3, 3, 2, 9])
        stage.GetRootLayer().Save()
        status, said = self.convert("scalp", self.path("a.usda"), self.path("b.obj"))
        self.assertEqual(status, 4)
        self.assertIn("outside of the 5 vertices", said)

    def test_weights_are_normalized_or_left_out(self):
        def checked(weights):
            points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
            self.report = Report()
            return check_mesh(Mesh(points, np.array([[0, 1, 2]]), joints=np.zeros((3, 4), int),
                                   weights=np.array(weights, float), joint_names=["root"]),
                              self.report)
        mesh = checked([[2, 2, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0]])
        self.assertEqual(mesh.weights.tolist(), [[0.5, 0.5, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0]])
        self.assertIn("1 vertices of the mesh have no weight", self.report.sentences[0])
        for wrong in (-1, np.nan):
            mesh = checked([[1, 0, 0, 0], [wrong, 2, 0, 0], [1, 0, 0, 0]])
            self.assertIsNone(mesh.weights)
            self.assertIn("the skin of the mesh is not kept", self.report.sentences[0])

    def test_bones_of_strands(self):
        joints, weights = np.array([[1, 0, 0, 0]] * 3), np.array([[0.75, 0.25, 0, 0]] * 3)
        tfxmesh.write_bones(["root", "neck"], joints, weights, self.path("a.tfxbone"))
        with open(self.path("a.tfxbone"), "rb") as file:
            names, back, found = tfxmesh.read_bones(file.read())
        self.assertEqual(names, ["root", "neck"])
        np.testing.assert_array_equal(back, joints)
        np.testing.assert_array_equal(found, weights)

    def test_real_meshes(self):
        folder = os.environ.get("HAIR_CONVERT_DATA")
        if not folder:
            self.skipTest("HAIR_CONVERT_DATA names no folder with haircuts")
        for base, _, names in os.walk(folder):
            for name in names:
                if name.endswith(".tfxmesh"):
                    mesh = self.mesh(os.path.join(base, name))
                    out = self.path("o.tfxmesh")
                    arguments = make_parser().parse_args(["scalp", "x.obj", out])
                    write_mesh(mesh, out, out, arguments, Report())
                    back = self.mesh(out)
                    np.testing.assert_allclose(back.points, mesh.points, atol=1e-7)
                    np.testing.assert_allclose(back.weights, mesh.weights, atol=1e-6)
                if name.endswith(".tfxbone"):
                    with open(os.path.join(base, name), "rb") as file:
                        data = file.read()
                    tfxmesh.write_bones(*tfxmesh.read_bones(data), self.path("o.tfxbone"))
                    with open(self.path("o.tfxbone"), "rb") as file:
                        self.assertEqual(len(file.read()), len(data))
