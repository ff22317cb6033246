"""Reads triangle meshes of USD, in the pose of the first time."""

import numpy as np
from pxr import Usd, UsdGeom, UsdSkel

from hairconvert.mesh import Mesh, keep_influences
from hairconvert.report import InputError, find_reason
from hairconvert.usd_read import find_unit


def read(path, name, report):
    """Return the meshes of a stage as one mesh, or those of the prims of a name."""
    try:
        stage = Usd.Stage.Open(str(path))
    except Exception as error:
        raise InputError(f"USD cannot open the file: {find_reason(error)}") from None
    parts = []
    for prim in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)):
        parent = prim.GetParent().GetName()
        if prim.IsA(UsdGeom.Mesh) and (not name or name in (prim.GetName(), parent)):
            parts.append(_read_prim(UsdGeom.Mesh(prim), report))
    if not parts:
        raise InputError(f"the file has no mesh of the name {name}" if name else
                         "the file has no mesh")
    first = np.cumsum([0] + [len(p.points) for p in parts])
    mesh = Mesh(np.concatenate([p.points for p in parts]),
                np.concatenate([p.triangles + n for p, n in zip(parts, first)]), format="usd")
    if all(p.uv is not None for p in parts):
        mesh.uv = np.concatenate([p.uv for p in parts])
    if all(p.weights is not None for p in parts):
        mesh.joint_names = list(dict.fromkeys(n for p in parts for n in p.joint_names))
        mesh.joints = np.concatenate([
            np.array([mesh.joint_names.index(n) for n in p.joint_names])[p.joints] for p in parts])
        mesh.weights = np.concatenate([p.weights for p in parts])
    mesh.unit = find_unit(stage, report)
    mesh.up = "z" if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z else "y"
    return mesh


def _read_prim(prim, report):
    time = Usd.TimeCode.EarliestTime()
    points = prim.GetPointsAttr().Get(time)
    sizes, corners = (a.Get(time) for a in (prim.GetFaceVertexCountsAttr(),
                                            prim.GetFaceVertexIndicesAttr()))
    if points is None or sizes is None or corners is None:
        raise InputError(f"{prim.GetPath()} has no faces")
    points, sizes, corners = np.array(points, np.float64), np.array(sizes), np.array(corners)
    if len(sizes) and (sizes.min() < 0 or sizes.sum() != len(corners)):
        raise InputError(f"the faces of {prim.GetPath()} make {sizes.sum()} corners, but it has "
                         f"{len(corners)}")
    if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
        raise InputError(f"a face of {prim.GetPath()} has a vertex outside of the {len(points)} "
                         "vertices")
    if prim.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        report.say(f"faces of {prim.GetPath()} are turned round, because they are left-handed")
    matrix = np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(prim.GetPrim()))
    points = points @ matrix[:3, :3] + matrix[3, :3]
    uv, joints, weights, names = None, None, None, []
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st")
    if primvar.HasValue():
        uv = _values_of_corners(np.array(primvar.ComputeFlattened(time)), corners, len(points))
    skin = UsdSkel.BindingAPI(prim.GetPrim())
    if skin.GetJointIndicesPrimvar().HasValue() and skin.GetJointWeightsPrimvar().HasValue():
        joints, weights, names = _read_skin(skin, len(points), report)
    return _split_corners(points, corners, uv, joints, weights, names,
                          _fans(sizes, prim.GetOrientationAttr().Get()))


def _values_of_corners(values, corners, count):
    """Return texture coordinates per corner, or None if they fit neither corners nor vertices."""
    if values.ndim != 2 or values.shape[1] != 2:
        return None
    if len(values) == len(corners):
        return values.astype(np.float64)
    return values[corners].astype(np.float64) if len(values) == count else None


def _read_skin(skin, count, report):
    joints = np.array(skin.GetJointIndicesPrimvar().ComputeFlattened())
    weights = np.array(skin.GetJointWeightsPrimvar().ComputeFlattened(), np.float64)
    size = skin.GetJointIndicesPrimvar().GetElementSize()
    names = skin.GetJointsAttr().Get()
    if names is None:
        skeleton = UsdSkel.BindingAPI.GetInheritedSkeleton(skin)
        names = skeleton.GetJointsAttr().Get() if skeleton else None
    if len(joints) != count * size or len(weights) != count * size or not names:
        report.lose("the skin of the mesh", "its counts do not fit the vertices or joints")
        return None, None, []
    joints, weights = keep_influences(joints.reshape(count, size).astype(np.int64),
                                      weights.reshape(count, size))
    return joints, weights, [str(n).rsplit("/", 1)[-1] for n in names]


def _fans(sizes, orientation):
    """Return the corners of triangles that divide faces."""
    starts, most = np.cumsum(sizes) - sizes, int(sizes.max(initial=0))
    parts = [np.stack([starts[sizes > k + 1], starts[sizes > k + 1] + k,
                       starts[sizes > k + 1] + k + 1], axis=1) for k in range(1, most - 1)]
    fans = np.concatenate(parts) if parts else np.zeros((0, 3), np.int64)
    return fans[:, ::-1] if orientation == UsdGeom.Tokens.leftHanded else fans


def _split_corners(points, corners, uv, joints, weights, names, fans):
    """Return a mesh in which a vertex has one texture coordinate."""
    triangles, vertex = corners[fans].astype(np.int64), np.arange(len(points))
    if uv is not None:
        rows = np.column_stack([corners, uv])
        unique, inverse = np.unique(rows, axis=0, return_inverse=True)
        vertex, triangles = unique[:, 0].astype(np.int64), inverse.reshape(-1)[fans]
        uv = unique[:, 1:]
    return Mesh(points[vertex], triangles, uv=uv,
                joints=None if joints is None else joints[vertex],
                weights=None if weights is None else weights[vertex], joint_names=names)
