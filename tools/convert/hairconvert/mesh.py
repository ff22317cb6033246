"""The model of a scalp: a triangle mesh with texture coordinates and skin weights."""

import dataclasses

import numpy as np

from hairconvert.groom import rotate_to_y
from hairconvert.report import InputError

MAX_TRIANGLES = 1 << 24
INFLUENCES = 4  # joints of a vertex


@dataclasses.dataclass
class Mesh:
    """A mesh in its pose at rest. Positions are in metres, with +y up."""

    points: np.ndarray  # (n, 3) float64
    triangles: np.ndarray  # (m, 3) int64
    uv: np.ndarray = None  # (n, 2)
    joints: np.ndarray = None  # (n, 4) int64, indices of joint_names
    weights: np.ndarray = None  # (n, 4) float64, their sum is 1
    joint_names: list = dataclasses.field(default_factory=list)
    density: np.ndarray = None  # (n,) fraction of followers
    maps: list = dataclasses.field(default_factory=list)  # contents of chunks of .groom
    format: str = ""
    unit: float = None  # metres of a unit of the file, None if the file does not tell
    up: str = None  # axis of the file that points up


def check_mesh(mesh, report):
    """Refuse meshes without triangles, and leave out triangles that cannot be used."""
    if len(mesh.triangles) == 0:
        raise InputError("the mesh has no triangles")
    if len(mesh.triangles) > MAX_TRIANGLES:
        raise InputError(f"the mesh has {len(mesh.triangles)} triangles, more than "
                         f"{MAX_TRIANGLES}")
    n = len(mesh.points)
    if mesh.triangles.min() < 0 or mesh.triangles.max() >= n:
        raise InputError(f"a triangle has a vertex outside of the {n} vertices")
    finite = np.isfinite(mesh.points).all(axis=1) & (np.abs(mesh.points) <= 1e6).all(axis=1)
    if mesh.uv is not None and not np.isfinite(mesh.uv).all():
        report.lose("the texture coordinates of the mesh", "a value is not finite")
        mesh.uv = None
    good = finite[mesh.triangles].all(axis=1)
    good &= np.linalg.norm(areas(mesh), axis=1) > 0
    if not good.any():
        raise InputError("the mesh has no triangle with an area and finite positions")
    if not good.all():
        report.say(f"{(~good).sum()} triangles are left out, because they have no area or a "
                   "position that is not finite")
        mesh.triangles = mesh.triangles[good]
    mesh.points = np.where(finite[:, None], mesh.points, 0.0)
    _check_skin(mesh, report)
    return mesh


def _check_skin(mesh, report):
    if mesh.weights is None:
        return
    wrong = not np.isfinite(mesh.weights).all() or (mesh.weights < 0).any()
    if wrong or mesh.joints.min() < 0 or mesh.joints.max() >= len(mesh.joint_names):
        report.lose("the skin of the mesh", "a weight is not in [0, 1] or a joint does not exist")
        mesh.joints = mesh.weights = None
        return
    total = mesh.weights.sum(axis=1, keepdims=True)
    if (total == 0).any():
        report.say(f"{(total == 0).sum()} vertices of the mesh have no weight and follow the "
                   "first joint")
        mesh.weights[total[:, 0] == 0, 0] = 1
        total[total == 0] = 1
    mesh.weights = mesh.weights / total


def areas(mesh):
    """Return the normal of each triangle, twice as long as its area."""
    with np.errstate(invalid="ignore", over="ignore"):
        a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
        return np.cross(b - a, c - a)


def vertex_normals(mesh):
    """Return unit normals of vertices, weighted by the areas of their triangles."""
    normals = np.zeros_like(mesh.points)
    for k in range(3):
        np.add.at(normals, mesh.triangles[:, k], areas(mesh))
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.where(length > 0, normals / np.where(length > 0, length, 1), [0.0, 1.0, 0.0])


def place_mesh(mesh, scale, up):
    """Turn a mesh of a file into metres with +y up."""
    mesh.points = rotate_to_y(mesh.points, up) * scale
    return mesh


def keep_influences(joints, weights):
    """Return the four joints with the largest weights of each vertex."""
    order = np.argsort(-weights, axis=1, kind="stable")[:, :INFLUENCES]
    rows = np.arange(len(weights))[:, None]
    joints, weights = joints[rows, order], weights[rows, order]
    missing = INFLUENCES - joints.shape[1]
    if missing > 0:
        joints = np.pad(joints, ((0, 0), (0, missing)))
        weights = np.pad(weights, ((0, 0), (0, missing)))
    return joints, weights
