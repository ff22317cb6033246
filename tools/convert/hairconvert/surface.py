"""Closest points on a triangle mesh, with signed distances and normals."""

import igl
import numpy as np


class Surface:
    """A mesh that answers queries. Normals point out of the head."""

    def __init__(self, mesh):
        self.mesh = mesh
        # Vertices with several texture coordinates have the same position, so they become one.
        self.points, same = np.unique(mesh.points, axis=0, return_inverse=True)
        self.triangles = np.ascontiguousarray(same.reshape(-1)[mesh.triangles], np.int64)
        self.corners = self.points[self.triangles]
        self._make_normals()
        self.tree = igl.AABB()
        self.tree.init(self.points, self.triangles)

    def _make_normals(self):
        a, b, c = self.corners.transpose(1, 0, 2)
        self.normals = np.cross(b - a, c - a)
        self.normals /= np.maximum(np.linalg.norm(self.normals, axis=1, keepdims=True), 1e-300)
        edges = np.sort(self.triangles[:, [[1, 2], [2, 0], [0, 1]]], axis=2).reshape(-1, 2)
        unique, self.edges, uses = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        self.edges = self.edges.reshape(-1, 3)  # edge k lies opposite corner k
        self.edge_normals = np.zeros((len(unique), 3))
        self.vertex_normals = np.zeros_like(self.points)
        for k in range(3):
            np.add.at(self.edge_normals, self.edges[:, k], self.normals)
            u = self.corners[:, (k + 1) % 3] - self.corners[:, k]
            v = self.corners[:, (k + 2) % 3] - self.corners[:, k]
            cosine = (u * v).sum(axis=1) / np.maximum(
                np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1), 1e-300)
            angle = np.arccos(np.clip(cosine, -1, 1))
            np.add.at(self.vertex_normals, self.triangles[:, k], angle[:, None] * self.normals)
        self.edge_is_open = uses == 1
        self.vertex_is_open = np.zeros(len(self.points), bool)
        self.vertex_is_open[unique[self.edge_is_open].ravel()] = True
        self.is_closed = not self.edge_is_open.any()

    def flip(self):
        """Turn all normals round."""
        self.normals *= -1
        self.edge_normals *= -1
        self.vertex_normals *= -1

    def volume(self):
        """Return the signed volume, positive if normals of a closed mesh point out."""
        a, b, c = self.corners.transpose(1, 0, 2) - self.corners.mean(axis=(0, 1))
        sign = np.sign((np.cross(b - a, c - a) * self.normals).sum(axis=1))
        return float(((np.cross(a, b) * c).sum(axis=1) * sign).sum() / 6)

    def closest(self, points):
        """Return the triangle and the barycentric coordinates of the closest point of each."""
        points = np.ascontiguousarray(points, np.float64)
        if len(points) == 0:
            return np.zeros(0, np.int64), np.zeros((0, 3))
        _, triangle, found = self.tree.squared_distance(self.points, self.triangles, points)
        triangle = triangle.reshape(-1)
        return triangle, barycentric(found.reshape(-1, 3), self.corners[triangle])

    def at(self, triangle, weights):
        """Return positions on the surface."""
        return np.einsum("ni,nij->nj", weights, self.corners[triangle])

    def distance(self, points):
        """Return signed distances, negative inside, closest positions and unit normals there.

        Points whose closest point lies on an open edge are outside.
        """
        triangle, weights = self.closest(points)
        closest = self.at(triangle, weights)
        zero = weights <= 1e-7
        count, rows = zero.sum(axis=1), np.arange(len(points))
        normal = self.normals[triangle]
        edge = self.edges[triangle, np.argmax(zero, axis=1)]
        vertex = self.triangles[triangle, np.argmax(weights, axis=1)]
        normal = np.where((count == 1)[:, None], self.edge_normals[edge], normal)
        normal = np.where((count == 2)[:, None], self.vertex_normals[vertex], normal)
        normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        away = points - closest
        gap = np.linalg.norm(away, axis=1)
        inside = (away * normal).sum(axis=1) < 0
        inside &= ~((count == 1) & self.edge_is_open[edge])
        inside &= ~((count == 2) & self.vertex_is_open[vertex])
        # The direction to the closest point is exact, unless the point lies on the surface.
        exact = away / np.maximum(gap, 1e-300)[:, None] * np.where(inside, -1, 1)[:, None]
        normal = np.where((gap > 1e-9)[:, None], exact, normal)
        return np.where(inside, -gap, gap)[rows], closest, normal


def barycentric(p, corners):
    """Return the barycentric coordinates of the point of each triangle that is closest to p."""
    a, b, c = corners.transpose(1, 0, 2)
    ab, ac, bc = b - a, c - a, c - b
    normal = np.cross(ab, ac)
    area = np.maximum((normal * normal).sum(axis=1), 1e-300)
    v = (np.cross(p - a, ac) * normal).sum(axis=1) / area
    w = (np.cross(ab, p - a) * normal).sum(axis=1) / area
    out = np.stack([1 - v - w, v, w], axis=1)
    outside = (out < 0).any(axis=1)
    if not outside.any():
        return out
    p, a, b, ab, ac, bc = (x[outside] for x in (p, a, b, ab, ac, bc))
    best, gap = np.zeros((len(p), 3)), np.full(len(p), np.inf)
    for origin, along, i, j in ((a, ab, 0, 1), (b, bc, 1, 2), (a, ac, 0, 2)):
        t = ((p - origin) * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-300)
        t = np.clip(t, 0, 1)
        d = np.linalg.norm(p - origin - t[:, None] * along, axis=1)
        nearer = d < gap
        gap = np.where(nearer, d, gap)
        found = np.zeros((len(p), 3))
        found[:, i], found[:, j] = 1 - t, t
        best = np.where(nearer[:, None], found, best)
    out[outside] = best
    return out
