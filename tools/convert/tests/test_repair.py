"""Repair at import: closest points, seated roots, strands that are led out of the head."""

import unittest

import numpy as np

from hairconvert import tfxmesh
from hairconvert.groom import Groom, lengths
from hairconvert.mesh import Mesh
from hairconvert.repair import MARGIN, find_bones, fit_to_scalp
from hairconvert.report import Report
from hairconvert.surface import Surface
from tests.support import ConvertTest, make_groom

RADIUS, CENTER = 0.1, np.array([0, 1.6, 0])


def make_sphere(rings=40, sides=60, cut=False):
    """Return a sphere, or without its lower half."""
    v, u = np.meshgrid(np.linspace(0, 1, rings + 1), np.linspace(0, 1, sides + 1), indexing="ij")
    polar, angle = np.pi * v.ravel(), 2 * np.pi * u.ravel()
    out = np.stack([np.sin(polar) * np.sin(angle), np.cos(polar), np.sin(polar) * np.cos(angle)], 1)
    i, j = np.meshgrid(np.arange(rings), np.arange(sides), indexing="ij")
    a = (i * (sides + 1) + j).ravel()
    b, c, d = a + sides + 1, a + 1, a + sides + 2
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([c, b, d], 1)])
    points = np.round(CENTER + RADIUS * out, 12)
    mesh = Mesh(points, triangles, uv=np.stack([u.ravel(), 1 - v.ravel()], 1))
    if cut:
        mesh.triangles = triangles[points[triangles, 1].mean(axis=1) > CENTER[1]]
    area = np.linalg.norm(np.cross(*[points[mesh.triangles[:, k]] - points[mesh.triangles[:, 0]]
                                     for k in (1, 2)]), axis=1)
    mesh.triangles = mesh.triangles[area > 1e-12]
    return mesh


def make_spikes(vertices=12):
    """Return strands that stand off the sphere, with curls at their ends."""
    groom = make_groom(vertices=vertices)
    out = (groom.points[groom.starts()] - CENTER) / RADIUS
    t = np.tile(np.linspace(0, 1, vertices), len(out))
    groom.points = CENTER + np.repeat(out, vertices, axis=0) * (RADIUS + 0.1 * t)[:, None]
    groom.points += 0.01 * np.stack([t * np.sin(9 * t), 0 * t, t * t], axis=1)
    return groom


def depth(points):
    """Return how far points lie outside of the sphere, which the mesh leaves by 0.2 mm."""
    return np.linalg.norm(points - CENTER, axis=1) - RADIUS


class SurfaceTest(unittest.TestCase):
    def test_closest_points_equal_a_search_of_all_triangles(self):
        from hairconvert.surface import barycentric
        random = np.random.default_rng(8)
        mesh = make_sphere(12, 16)
        # Large and small triangles together.
        mesh.points = np.concatenate([mesh.points, [[-1, 1, -1], [1, 1, -1], [0, 1, 2]]])
        mesh.triangles = np.concatenate([mesh.triangles, [[len(mesh.points) - k for k in (3, 2, 1)]]])
        surface = Surface(mesh)
        points = CENTER + random.normal(size=(300, 3)) * 0.15
        triangle, weights = surface.closest(points)
        got = np.linalg.norm(points - surface.at(triangle, weights), axis=1)
        n = len(surface.corners)
        every = np.repeat(points, n, axis=0)
        corners = np.tile(surface.corners, (len(points), 1, 1))
        found = np.einsum("ni,nij->nj", barycentric(every, corners), corners)
        want = np.linalg.norm(every - found, axis=1).reshape(-1, n).min(axis=1)
        np.testing.assert_allclose(got, want, atol=1e-12)

    def test_barycentric_coordinates_give_the_closest_point(self):
        from hairconvert.surface import barycentric
        random = np.random.default_rng(9)
        corners, p = random.normal(size=(200, 3, 3)), random.normal(size=(200, 3))
        w = barycentric(p, corners)
        np.testing.assert_allclose(w.sum(axis=1), 1, atol=1e-12)
        self.assertGreaterEqual(w.min(), 0)
        gap = np.linalg.norm(p - np.einsum("ni,nij->nj", w, corners), axis=1)
        for _ in range(200):
            other = random.dirichlet((0.5, 0.5, 0.5), 200)
            there = np.linalg.norm(p - np.einsum("ni,nij->nj", other, corners), axis=1)
            self.assertTrue((gap <= there + 1e-12).all())

    def test_sign_of_distances(self):
        random = np.random.default_rng(10)
        points = CENTER + random.uniform(-0.2, 0.2, (5000, 3))
        distance, closest, normal = Surface(make_sphere()).distance(points)
        np.testing.assert_allclose(distance, depth(points), atol=5e-4)
        np.testing.assert_allclose(np.abs(distance), np.linalg.norm(points - closest, axis=1))
        np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-9)

    def test_sign_at_sharp_corners(self):
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        mesh = Mesh(corners, np.array([t for f in faces for t in ((f[0], f[1], f[2]),
                                                                 (f[0], f[2], f[3]))]))
        surface = Surface(mesh)
        if surface.volume() < 0:
            surface.flip()
        self.assertAlmostEqual(surface.volume(), 1)
        points = np.random.default_rng(11).uniform(-0.5, 1.5, (4000, 3))
        distance, _, _ = surface.distance(points)
        inside = ((points > 0) & (points < 1)).all(axis=1)
        np.testing.assert_array_equal(distance < 0, inside)

    def test_points_below_an_open_edge_are_outside(self):
        surface = Surface(make_sphere(cut=True))
        below = CENTER + np.array([[0, -0.05, 0], [0.02, -0.2, 0], [0, 0.05, 0]])
        distance, _, _ = surface.distance(below)
        self.assertEqual((distance < 0).tolist(), [False, False, True])


class RepairTest(ConvertTest):
    def fit(self, groom, mesh=None, seat_within=0.02):
        self.report = Report()
        fitted, self.surface = fit_to_scalp(groom, mesh or make_sphere(), seat_within, self.report)
        return fitted

    def assert_fits(self, groom, before):
        """Check that roots lie on the scalp, nothing is inside, and lengths are kept."""
        distance, _, _ = self.surface.distance(groom.points)
        self.assertLess(np.abs(distance[groom.starts()]).max(), 1.1e-4)
        self.assertGreater(distance.min(), -1.1e-4)
        np.testing.assert_allclose(lengths(groom), lengths(before), rtol=1e-9)

    def test_haircut_that_fits_is_not_changed(self):
        groom = make_spikes()
        fitted = self.fit(groom, make_sphere(200, 300))
        np.testing.assert_array_equal(fitted.points, groom.points)
        self.assertEqual(self.report.sentences, [])

    def test_roots_are_seated_and_shapes_kept(self):
        groom = make_spikes()
        random = np.random.default_rng(12)
        # Half of the strands float, others begin too deep.
        out = (groom.points[groom.starts()] - CENTER) / RADIUS
        shift = out * random.uniform(-0.002, 0.01, len(out))[:, None]
        groom.points += np.repeat(shift, groom.counts, axis=0)
        fitted = self.fit(groom)
        self.assert_fits(fitted, groom)
        self.assertEqual(len(self.report.sentences), 2)
        self.assertIn("ended off the scalp at their roots", self.report.sentences[0])
        self.assertIn("began inside the head", self.report.sentences[1])
        # Each strand moved as it was.
        moved = (fitted.points - groom.points).reshape(100, 12, 3)
        np.testing.assert_allclose(moved, np.repeat(moved[:, :1], 12, axis=1), atol=1e-12)

    def test_strands_inside_the_head_are_led_out(self):
        # Strands go from the top of the head straight through the head.
        angle = np.linspace(0, 2 * np.pi, 50, endpoint=False)
        root = CENTER + RADIUS * np.stack([0.5 * np.cos(angle), 0.75 ** 0.5 + 0 * angle,
                                           0.5 * np.sin(angle)], 1)
        line = root[:, None] + np.linspace(0, 0.25, 32)[None, :, None] * np.array([0.1, -1, 0])
        groom = Groom(np.full(50, 32), line.reshape(-1, 3))
        fitted = self.fit(groom)
        self.assert_fits(fitted, groom)
        self.assertTrue(any("50 strands ran inside the head" in s for s in self.report.sentences))
        # Vertices that were led out lie at the margin, not far away.
        self.assertLess(np.median(self.surface.distance(fitted.points)[0]), 0.2)
        close = depth(fitted.points) < 2 * MARGIN
        self.assertGreater(close.sum(), 100)

    def test_only_strands_inside_change(self):
        groom = make_groom("curly", vertices=16)
        groom = self.fit(groom, make_sphere(200, 300))
        dipped = Groom(groom.counts, groom.points.copy())
        third = slice(3 * 16, 4 * 16)
        out = (groom.points[3 * 16] - CENTER) / RADIUS
        dipped.points[third] -= np.linspace(0, 0.5, 16)[:, None] * out
        fitted = self.fit(dipped, make_sphere(200, 300))
        self.assert_fits(fitted, dipped)
        same = np.ones(len(groom.points), bool)
        same[third] = False
        np.testing.assert_array_equal(fitted.points[same], dipped.points[same])
        self.assertIn("1 strands ran inside the head", self.report.sentences[-1])

    def test_sides_of_a_parting_are_kept(self):
        # Strands left and right of x = 0 that sag into the head.
        x = np.concatenate([-np.linspace(0.002, 0.03, 20), np.linspace(0.002, 0.03, 20)])
        root = CENTER + np.stack([x, np.sqrt(RADIUS ** 2 - x ** 2), 0 * x], 1)
        step = np.stack([np.sign(x), -0.5 + 0 * x, 0 * x], 1) * 0.01
        line = root[:, None] + np.arange(16)[None, :, None] * step[:, None]
        groom = Groom(np.full(40, 16), line.reshape(-1, 3))
        fitted = self.fit(groom)
        self.assert_fits(fitted, groom)
        np.testing.assert_array_equal(np.sign(fitted.points[:, 0]), np.repeat(np.sign(x), 16))

    def test_far_roots_stay_and_are_told(self):
        groom = make_groom(vertices=4)
        groom.points[:4] += [0, 1, 0]
        fitted = self.fit(groom)
        np.testing.assert_array_equal(fitted.points[:4], groom.points[:4])
        self.assertTrue(any("1 roots lie more than 20 mm" in s for s in self.report.sentences))
        self.assertFalse(any("1 roots lie" in s for s in self._sentences(groom, 2.0)))

    def _sentences(self, groom, within):
        self.fit(groom, seat_within=within)
        return self.report.sentences

    def test_open_scalp_and_normals_that_point_inward(self):
        for cut in (False, True):
            mesh = make_sphere(cut=cut)
            mesh.triangles = mesh.triangles[:, ::-1]
            groom = make_groom(vertices=12)
            out = (groom.points[groom.starts()] - CENTER) / RADIUS
            groom.points += np.repeat(0.005 * out, 12, axis=0)
            fitted = self.fit(groom, mesh)
            self.assertIn("turned round", self.report.sentences[0])
            self.assertLess(np.abs(depth(fitted.points[fitted.starts()])).max(), 5e-4)

    def test_root_uv_comes_from_the_scalp(self):
        groom = make_groom(vertices=4)
        uv = self.fit(groom).attributes["root_uv"].values
        out = (groom.points[groom.starts()] - CENTER) / RADIUS
        want = 1 - np.arccos(out[:, 1]) / np.pi
        np.testing.assert_allclose(uv[:, 1], want, atol=2e-3)
        u = np.arctan2(out[:, 0], out[:, 2]) / (2 * np.pi) % 1
        np.testing.assert_allclose(np.abs((uv[:, 0] - u + 0.5) % 1 - 0.5), 0, atol=2e-2)

    def test_bones_come_from_the_skin(self):
        mesh = make_sphere()
        height = np.clip((mesh.points[:, 1] - CENTER[1]) / RADIUS, 0, 1)
        mesh.joint_names = ["neck", "head"]
        mesh.joints = np.tile([0, 1, 0, 0], (len(mesh.points), 1))
        mesh.weights = np.stack([1 - height, height, 0 * height, 0 * height], 1)
        groom = make_groom(vertices=4)
        fitted = self.fit(groom, mesh)
        joints, weights = find_bones(fitted, mesh, self.surface)
        np.testing.assert_allclose(weights.sum(axis=1), 1)
        head = (weights * (joints == 1)).sum(axis=1)
        want = (fitted.points[fitted.starts()][:, 1] - CENTER[1]) / RADIUS
        np.testing.assert_allclose(head, want, atol=5e-3)

    def test_command_line(self):
        mesh, groom = make_sphere(), make_groom(vertices=8)
        mesh.joint_names, mesh.joints = ["head"], np.zeros((len(mesh.points), 4), int)
        mesh.weights = np.tile([1.0, 0, 0, 0], (len(mesh.points), 1))
        tfxmesh.write(mesh, self.path("s.tfxmesh"), Report())
        groom.points += [0, 0.01, 0]
        path, _ = self.write(groom, "a.hair")
        status, said = self.convert("convert", path, self.path("b.tfx"), "--scalp",
                                    self.path("s.tfxmesh"), "--bones", self.path("b.tfxbone"))
        self.assertEqual(status, 0, said)
        self.assertIn("are moved onto the scalp", said)
        back = self.read(self.path("b.tfx"))
        self.assertLess(np.abs(depth(back.points[back.starts()])).max(), 5e-4)
        with open(self.path("b.tfxbone"), "rb") as file:
            names, joints, _ = tfxmesh.read_bones(file.read())
        self.assertEqual((names, len(joints)), (["head"], 100))
        self.assertEqual(self.convert("convert", path, self.path("b.tfx"), "--bones", "x")[0], 2)
        status, said = self.convert("convert", path, self.path("b.tfx"), "--scalp",
                                    self.path("none.obj"))
        self.assertEqual(status, 4)
        self.assertIn("none.obj: there is no such file", said)
