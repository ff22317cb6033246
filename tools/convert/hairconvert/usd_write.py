"""Writes a groom as BasisCurves of USD."""

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, Vt

from hairconvert import names
from hairconvert.groom import GROOM, STRAND, VERTEX
from hairconvert.report import InputError
from hairconvert.timing import find_rate

INTERPOLATIONS = {GROOM: UsdGeom.Tokens.constant, STRAND: UsdGeom.Tokens.uniform,
                  VERTEX: UsdGeom.Tokens.vertex}
# Name of the type of values and class of the array, by the type of numpy and the components.
SCALARS = {"float16": "Half", "float32": "Float", "float64": "Double", "int32": "Int",
           "int64": "Int64", "uint8": "UChar", "uint32": "UInt", "uint64": "UInt64",
           "bool": "Bool", "int8": "Int", "int16": "Int", "uint16": "Int"}
ROLES = {("color", 3): "Color3", ("color", 4): "Color4", ("uv", 2): "TexCoord2",
         ("uv", 3): "TexCoord3", ("point", 3): "Point3", ("vector", 3): "Vector3",
         ("normal", 3): "Normal3"}
LETTERS = {"Half": "h", "Float": "f", "Double": "d", "Int": "i"}


def write(groom, path, options, report):
    """Write a stage with one BasisCurves."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, options.output_scale or 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z if options.output_up == "z" else
                           UsdGeom.Tokens.y)
    root = UsdGeom.Xform.Define(stage, "/hair")
    stage.SetDefaultPrim(root.GetPrim())
    curves = UsdGeom.BasisCurves.Define(stage, "/hair/strands")
    linear = options.basis == "linear"
    curves.CreateTypeAttr("linear" if linear else "cubic")
    if not linear:
        curves.CreateBasisAttr(UsdGeom.Tokens.catmullRom)
    curves.CreateWrapAttr(UsdGeom.Tokens.nonperiodic if linear else UsdGeom.Tokens.pinned)
    curves.CreateCurveVertexCountsAttr(Vt.IntArray.FromNumpy(groom.counts.astype(np.int32)))
    radius = _half_width(groom)
    curves.CreatePointsAttr(_vectors(groom.points))
    curves.CreateExtentAttr(_extent(groom.points, radius))
    if groom.motion:
        _write_motion(stage, curves, groom.motion, radius)
    _write_attributes(curves, groom, report)
    stage.GetRootLayer().Save()


def _half_width(groom):
    width = groom.attributes.get("width")
    return float(width.values.max()) / 2 if width is not None else 0.0


def _vectors(points):
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points, np.float32))


def _extent(points, radius):
    low, high = points.min(axis=0) - radius, points.max(axis=0) + radius
    return Vt.Vec3fArray([Gf.Vec3f(*map(float, low)), Gf.Vec3f(*map(float, high))])


def _write_motion(stage, curves, motion, radius):
    rate = find_rate(motion.times)
    stage.SetTimeCodesPerSecond(rate)
    stage.SetFramesPerSecond(rate)
    codes = [float(c) for c in np.round(motion.times * rate, 6)]
    stage.SetStartTimeCode(codes[0])
    stage.SetEndTimeCode(codes[-1])
    for i, code in enumerate(codes):
        points = motion.read(i)
        if not np.isfinite(points).all():
            raise InputError(f"frame {i} has a position that is not finite")
        curves.GetPointsAttr().Set(_vectors(points), code)
        curves.GetExtentAttr().Set(_extent(points, radius), code)


def _write_attributes(curves, groom, report):
    primvars = UsdGeom.PrimvarsAPI(curves.GetPrim())
    for name, a in groom.attributes.items():
        if name == "width":
            # Blender reads uniform widths as those of vertices, and beyond the end of the array.
            scope = VERTEX if a.scope == STRAND else a.scope
            curves.CreateWidthsAttr(Vt.FloatArray.FromNumpy(
                np.ascontiguousarray(groom.values(name, scope), np.float32)))
            curves.SetWidthsInterpolation(INTERPOLATIONS[scope])
        elif name == "normals" and a.values.shape[1:] == (3,):
            curves.CreateNormalsAttr(_vectors(a.values))
            curves.SetNormalsInterpolation(INTERPOLATIONS[a.scope])
        elif name == "color":
            _write_primvar(primvars, "displayColor", a, report)
        elif name == "opacity":
            _write_primvar(primvars, "displayOpacity", a, report)
        else:
            if name == "root_uv":  # The name that Blender reads.
                _write_primvar(primvars, "surface_uv_coordinate", a, report)
            _write_primvar(primvars, names.SCHEMA.get(name, name), a, report)


def _write_primvar(primvars, name, attribute, report):
    valid = ":".join(Tf.MakeValidIdentifier(part) for part in name.split(":"))
    if valid != name:
        report.say(f"the attribute {name} gets the name {valid}, because USD allows only letters, "
                   "digits and underscores")
    kind, array, size, values = _find_type(attribute, name)
    primvar = primvars.CreatePrimvar(valid, kind, INTERPOLATIONS[attribute.scope],
                                     size if size > 1 else -1)
    if array is Vt.StringArray:
        primvar.Set(Vt.StringArray([str(v) for v in values.ravel()]))
        return
    primvar.Set(array.FromNumpy(values))


def _find_type(attribute, name):
    """Return the type of a primvar, the class of its array, the size of its elements, its values.
    """
    values = attribute.values
    components = values.shape[1] if values.ndim == 2 else 1
    if values.dtype.kind == "U":
        return Sdf.ValueTypeNames.StringArray, Vt.StringArray, components, values
    scalar = "Float" if name.startswith("display") else SCALARS[values.dtype.name]
    if scalar in ("Int", "Float"):
        values = values.astype(np.int32 if scalar == "Int" else np.float32, copy=False)
    values, letter = np.ascontiguousarray(values), LETTERS.get(scalar)
    if letter and values.ndim == 2 and 2 <= components <= 4:
        prefix = ROLES.get((attribute.role, components))
        kind = f"{prefix}{letter}" if prefix and letter != "i" else f"{scalar}{components}"
        array = getattr(Vt, f"Vec{components}{letter}Array")
        return getattr(Sdf.ValueTypeNames, kind + "Array"), array, 1, values
    kind = getattr(Sdf.ValueTypeNames, f"{scalar}Array")
    return kind, getattr(Vt, f"{scalar}Array"), components, values.ravel()
