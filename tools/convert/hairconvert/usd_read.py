"""Reads BasisCurves of USD."""

import numpy as np
from pxr import Sdf, Usd, UsdGeom

from hairconvert import basis, names
from hairconvert.groom import Groom, Motion
from hairconvert.interpolation import Values
from hairconvert.merge import collect, merge
from hairconvert.report import InputError, find_reason

MAX_PRIMS = 1 << 20
# Properties that the reader uses, or that positions and counts replace.
USED = {"points", "curveVertexCounts", "type", "basis", "wrap", "widths", "extent", "visibility",
        "purpose", "xformOpOrder", "primvars:widths"}
ROLES = {"Color": "color", "TextureCoordinate": "uv", "Point": "point", "Vector": "vector",
         "Normal": "normal"}
NAMES = {"displayColor": "color", "displayOpacity": "opacity", "surface_uv_coordinate": "root_uv"}


def read(path, options, report):
    """Return the groom of all BasisCurves of a stage, in the units of the stage."""
    try:
        stage = Usd.Stage.Open(str(path))
    except Exception as error:
        raise InputError(f"USD cannot open the file: {find_reason(error)}") from None
    if not stage:
        raise InputError("USD cannot open the file")
    prims = _find_curves(stage, report)
    parts = collect(_Curves(prim, options, report) for prim in prims)
    if not parts:
        raise InputError("the file has no BasisCurves with vertices")
    codes = np.unique(np.concatenate([p.codes for p in parts]))
    rest = options.frame if options.frame is not None else \
        codes[0] if len(codes) else Usd.TimeCode.Default()
    rate = stage.GetTimeCodesPerSecond()
    if not 1e-6 <= rate <= 1e6:
        raise InputError(f"timeCodesPerSecond is {rate:g}, not in [1e-6, 1e6]")
    grooms = [p.to_groom(rest, codes, rate) for p in parts]
    groom = merge(grooms, [p.prim.GetName() for p in parts], report)
    groom.format, groom.unit = "usd", find_unit(stage, report)
    groom.up = "z" if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z else "y"
    return groom


def find_unit(stage, report):
    """Return the metres of a unit of a stage."""
    unit = UsdGeom.GetStageMetersPerUnit(stage)
    if not (1e-9 <= unit <= 1e9):
        raise InputError(f"metersPerUnit is {unit:g}, not in [1e-9, 1e9]")
    if not UsdGeom.StageHasAuthoredMetersPerUnit(stage):
        report.say(f"metersPerUnit is not in the file, so USD's default {unit:g} is used: --scale "
                   "changes the unit")
    return unit


def _find_curves(stage, report):
    """Return all BasisCurves, and say which other geometry is not read."""
    found, others, count = [], {}, 0
    for prim in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)):
        count += 1
        if count > MAX_PRIMS:
            raise InputError(f"the stage has more than {MAX_PRIMS} prims")
        if prim.IsA(UsdGeom.BasisCurves):
            found.append(prim)
        elif prim.IsA(UsdGeom.Gprim) or prim.IsA(UsdGeom.PointInstancer):
            others[prim.GetTypeName()] = others.get(prim.GetTypeName(), 0) + 1
    for kind, n in others.items():
        report.say(f"{n} prims of the type {kind} are not read, because they are no BasisCurves")
    return found


class _Curves:
    """One BasisCurves prim."""

    def __init__(self, prim, options, report):
        self.prim, self.report = prim, report
        self.stage = prim.GetStage()  # Frames are read later, so the stage must live.
        self.curves = UsdGeom.BasisCurves(prim)
        points = self.curves.GetPointsAttr()
        self.codes = self._time_codes(points)
        first = Usd.TimeCode(options.frame) if options.frame is not None else \
            Usd.TimeCode(self.codes[0]) if len(self.codes) else Usd.TimeCode.EarliestTime()
        self.first = first
        self.counts = _array(self.curves.GetCurveVertexCountsAttr().Get(first), np.int64)
        self.points = _array(points.Get(first), np.float64).reshape(-1, 3)
        self.valid = self._check()
        if not self.valid:
            return
        self.sampler = self._make_sampler(options)
        self.values = Values(len(self.counts), len(self.points), self.sampler, report)
        self.attributes = self.values.attributes
        self._read_attributes()
        if len(self.codes) > 1 and self._topology_changes():
            report.lose(f"the motion of {prim.GetPath()}", "the numbers of its vertices change")
            self.codes = self.codes[:1]

    def _time_codes(self, points):
        codes = set(points.GetTimeSamples())
        prim = self.prim
        while prim and not prim.IsPseudoRoot():
            if prim.IsA(UsdGeom.Xformable):
                codes.update(UsdGeom.Xformable(prim).GetTimeSamples())
            prim = prim.GetParent()
        return np.array(sorted(codes))

    def _check(self):
        where = self.prim.GetPath()
        if len(self.counts) == 0 or len(self.points) == 0:
            self.report.say(f"{where} is left out, because it has no vertices")
            return False
        if self.counts.min() < 0 or self.counts.sum() != len(self.points):
            self.report.say(f"{where} is left out, because its counts make {self.counts.sum()} "
                            f"vertices, but it has {len(self.points)} points")
            return False
        return True

    def _topology_changes(self):
        samples = self.curves.GetCurveVertexCountsAttr().GetTimeSamples()
        return any(not np.array_equal(
            _array(self.curves.GetCurveVertexCountsAttr().Get(t), np.int64), self.counts)
            for t in samples)

    def _make_sampler(self, options):
        kind, wrap = self.curves.GetTypeAttr().Get(), self.curves.GetWrapAttr().Get()
        form = basis.LINEAR if kind == "linear" else self.curves.GetBasisAttr().Get()
        if form not in (basis.LINEAR, *basis.MATRICES):
            raise InputError(f"{self.prim.GetPath()} has the unknown basis {form}")
        return basis.make_sampler(form, wrap, self.counts, self.points, options.samples, self.report)

    def _read_attributes(self):
        primvars = UsdGeom.PrimvarsAPI(self.prim)
        for p in sorted(primvars.FindPrimvarsWithInheritance(), key=lambda p: p.GetPrimvarName()):
            if p.HasValue():
                self._read_primvar(p)
        widths = self.curves.GetWidthsAttr()
        if widths.HasAuthoredValue() and not primvars.HasPrimvar("widths"):
            self._add("width", widths.Get(self.first), self.curves.GetWidthsInterpolation(), 1, "",
                      widths.GetNumTimeSamples())
        normals = self.curves.GetNormalsAttr()
        if normals.HasAuthoredValue() and not primvars.HasPrimvar("normals"):
            self._add("normals", normals.Get(self.first), self.curves.GetNormalsInterpolation(), 1,
                      "normal", normals.GetNumTimeSamples())
        for p in self.prim.GetAuthoredProperties():
            self._report_property(p)

    def _report_property(self, prop):
        name = prop.GetName()
        if name in USED or name == "normals" or name.startswith(("primvars:", "xformOp:")):
            return
        if name in ("velocities", "accelerations"):
            self.report.lose(f"the attribute {name}", "positions of frames determine the motion")
        else:
            self.report.lose(f"the property {name}", "only primvars, widths and normals are read")

    def _read_primvar(self, primvar):
        name, kind = primvar.GetPrimvarName(), primvar.GetTypeName()
        if name in names.METADATA:
            return
        role = ROLES.get(str(kind.role), "")
        ours = "width" if name == "widths" else NAMES.get(name) or names.TO_MODEL.get(name, name)
        schema = name in names.TO_MODEL
        if schema and ours in self.attributes:  # surface_uv_coordinate and displayColor go first.
            return
        values = primvar.ComputeFlattened(self.first)
        size = primvar.GetElementSize()
        if size <= 1 and schema:
            size = names.COMPONENTS.get(ours, 1)
        if not isinstance(values, (bool, int, float, str)) and values is not None and \
                not hasattr(values, "__len__"):
            values = None
        self._add(ours, values, primvar.GetInterpolation(), size,
                  names.ROLES.get(ours, role), primvar.GetAttr().GetNumTimeSamples())

    def _add(self, name, values, interpolation, size, role, samples):
        table = _table(values)
        if samples > 1 and table is not None:
            self.report.lose(f"the change in time of the attribute {name}",
                             "only positions have frames")
        self.values.add(name, table, interpolation, size, role)

    def _positions(self, code):
        """Return positions in the space of the stage."""
        points = _array(self.curves.GetPointsAttr().Get(code), np.float64).reshape(-1, 3)
        if len(points) != len(self.points):
            raise InputError(f"{self.prim.GetPath()} has {len(points)} points at time "
                             f"{code}, but {len(self.points)} before")
        if self.sampler is not None:
            points = self.sampler.sample(points)
        matrix = self._matrix(code)
        return points if matrix is None else points @ matrix[:3, :3] + matrix[3, :3]

    def _matrix(self, code):
        """Return the transform to the space of the stage, or None for the identity."""
        cache = UsdGeom.XformCache(Usd.TimeCode(code) if code is not None else self.first)
        matrix = np.array(cache.GetLocalToWorldTransform(self.prim), np.float64)
        return None if np.array_equal(matrix, np.eye(4)) else matrix

    def to_groom(self, rest, codes, rate):
        """Return the strands at the rest time, with motion if there are several times."""
        points = self._positions(rest)
        counts = self.counts if self.sampler is None else self.sampler.counts
        matrix = self._matrix(rest)
        if matrix is not None:
            basis.turn(self.attributes, matrix)
        groom = Groom(counts, points, self.attributes)
        if len(codes) > 1 and len(self.codes) > 1:
            groom.motion = Motion(codes / rate, lambda i: self._positions(codes[i]))
        return groom


def _array(value, dtype):
    """Return the numbers of an array of USD, empty if there are none."""
    return np.zeros(0, dtype) if value is None else np.array(value).astype(dtype)


def _table(values):
    """Return values of USD as an array with a row each, or None for other types."""
    if values is None:
        return None
    if isinstance(values, (str, bool, int, float)):
        return np.array([values])
    if isinstance(values, (Sdf.AssetPath, Sdf.AssetPathArray)):
        return None
    table = np.array(values)
    if table.dtype.kind in "OU":
        try:
            table = np.array([str(v) for v in values])
        except TypeError:
            return None
    if not hasattr(type(values), "FromNumpy") and table.ndim == 1 and table.dtype.kind != "U":
        table = table[None, :]  # A single vector.
    if table.dtype.kind not in "fiubU" or table.ndim > 2:
        return None
    return table
