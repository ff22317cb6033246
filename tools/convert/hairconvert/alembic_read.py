"""Reads curves of Alembic, with the attributes of Unreal's groom schema."""

import numpy as np
from alembic3d import Abc, AbcGeom, Util

from hairconvert import basis, names
from hairconvert.groom import Groom, Motion
from hairconvert.interpolation import Values
from hairconvert.merge import collect, merge
from hairconvert.report import InputError, find_reason

MAX_OBJECTS = 1 << 20
MAX_DEPTH = 200
MAX_FRAMES = 1 << 20
BASES = {"kBezierBasis": basis.BEZIER, "kBsplineBasis": basis.BSPLINE,
         "kCatmullromBasis": basis.CATMULL_ROM}
SCOPES = {"con": "constant", "uni": "uniform", "var": "varying", "vtx": "vertex",
          "fvr": "faceVarying"}
ROLES = {"rgb": "color", "rgba": "color", "point": "point", "normal": "normal"}
HALF, BOOL = Util.POD.kFloat16POD, Util.POD.kBooleanPOD
TYPES = {Util.POD.kInt8POD: np.int8, Util.POD.kUint8POD: np.uint8, Util.POD.kInt16POD: np.int16,
         Util.POD.kUint16POD: np.uint16, Util.POD.kInt32POD: np.int32,
         Util.POD.kUint32POD: np.uint32, BOOL: np.bool_, HALF: np.float16,
         Util.POD.kFloat32POD: np.float32, Util.POD.kFloat64POD: np.float64}


def read(path, options, report):
    """Return the groom of all curves of an archive, in the units of the archive."""
    try:
        archive = Abc.IArchive(str(path))
    except Exception as error:
        raise InputError(f"Alembic cannot open the file: {find_reason(error)}") from None
    parts = collect(_Curves(parent, name, transforms, options, report)
                    for parent, name, transforms in _find_curves(archive.getTop(), report))
    if not parts:
        raise InputError("the file has no curves with vertices")
    times = np.unique(np.concatenate([p.times for p in parts]))
    rest = options.frame if options.frame is not None else times[0]
    grooms = [p.to_groom(rest, times, archive) for p in parts]
    groom = merge(grooms, [p.name for p in parts], report)
    groom.format = "abc"
    if not options.scale:
        report.say("an Alembic file does not tell its unit, so 0.01 m is used: --scale changes the "
                   "unit")
    return groom


def _find_curves(top, report):
    """Return parent, name and transforms of each object that is a curve."""
    found, others, open_objects, count = [], {}, [(top, (), 0)], 0
    while open_objects:
        parent, transforms, depth = open_objects.pop()
        if depth > MAX_DEPTH:
            raise InputError(f"objects are nested more than {MAX_DEPTH} deep")
        for i in range(parent.getNumChildren()):
            count += 1
            if count > MAX_OBJECTS:
                raise InputError(f"the archive has more than {MAX_OBJECTS} objects")
            header = parent.getChildHeader(i)
            name, below = header.getName(), transforms
            if AbcGeom.ICurves.matches(header):
                found.append((parent, name, transforms))
            elif AbcGeom.IXform.matches(header):
                below = (*transforms, AbcGeom.IXform(parent, name).getSchema())
            else:
                kind = header.getMetaData().get("schema").split("_v")[0] or "without a schema"
                others[kind] = others.get(kind, 0) + 1
            open_objects.append((parent.getChild(i), below, depth + 1))
    for kind, n in others.items():
        report.say(f"{n} objects {kind} are not read, because they are no curves")
    return found


class _Curves:
    """One object of curves."""

    def __init__(self, parent, name, transforms, options, report):
        self.name, self.transforms, self.report = name, transforms, report
        self.schema = AbcGeom.ICurves(parent, name).getSchema()
        self.times = self._find_times()
        self.first = self._index(options.frame) if options.frame is not None else 0
        sample = self.schema.getValue(_select(self.schema, self.first))
        self.counts = _numbers(sample.getCurvesNumVertices(), np.int64)
        self.points = _numbers(sample.getPositions(), np.float64).reshape(-1, 3)
        self.valid = self._check()
        if not self.valid:
            return
        self.sampler = self._make_sampler(sample, options)
        self.values = Values(len(self.counts), len(self.points), self.sampler, report)
        self._read_attributes()

    def _find_times(self):
        times = set()
        for schema in (self.schema, *self.transforms):
            count, sampling = schema.getNumSamples(), schema.getTimeSampling()
            if count > MAX_FRAMES:
                raise InputError(f"{self.name} has {count} frames, more than {MAX_FRAMES}")
            if schema is self.schema or count > 1:
                times.update(sampling.getSampleTime(i) for i in range(max(count, 1)))
        times = np.array(sorted(times))
        if not np.isfinite(times).all():
            raise InputError(f"{self.name} has a time that is not finite")
        return times

    def _index(self, time, schema=None):
        schema = schema or self.schema
        return schema.getTimeSampling().getNearIndex(float(time), max(schema.getNumSamples(), 1))

    def _check(self):
        if len(self.counts) == 0 or len(self.points) == 0:
            self.report.say(f"{self.name} is left out, because it has no vertices")
            return False
        if self.counts.min() < 0 or self.counts.sum() != len(self.points):
            self.report.say(f"{self.name} is left out, because its counts make "
                            f"{self.counts.sum()} vertices, but it has {len(self.points)} points")
            return False
        return True

    def _make_sampler(self, sample, options):
        kind, form = sample.getType().name, basis.LINEAR
        if kind == "kCubic":
            form = BASES.get(sample.getBasis().name, basis.LINEAR)
        if kind == "kVariableOrder" or (kind == "kCubic" and form == basis.LINEAR):
            self.report.say(f"curves of {sample.getBasis().name} and {kind} become polylines "
                            "through their control points")
        wrap = basis.PERIODIC if sample.getWrap().name == "kPeriodic" else basis.NONPERIODIC
        return basis.make_sampler(form, wrap, self.counts, self.points, options.samples,
                                  self.report)

    def _read_attributes(self):
        arb = self.schema.getArbGeomParams()
        for i in range(arb.getNumProperties() if arb.valid() else 0):
            self._read_property(arb, arb.getPropertyHeader(i))
        for name, param, role in (("width", self.schema.getWidthsParam(), ""),
                                  ("normals", self.schema.getNormalsParam(), "normal"),
                                  ("uv", self.schema.getUVsParam(), "uv")):
            if param.valid() and name not in self.values.attributes:
                self._read_param(name, param, role)
        if self.schema.getVelocitiesProperty().valid():
            self.report.lose("the attribute velocities", "positions of frames determine the motion")

    def _read_param(self, name, param, role):
        table = _table(param.getValueProperty(), self._sample_of(param.getValueProperty()))
        if param.isIndexed() and table is not None:
            table = _by_index(table, _numbers(param.getIndexProperty().getValue(), np.int64))
        scope = param.getScope().name.removeprefix("k").removesuffix("Scope").lower()
        self._report_frames(name, param.getValueProperty())
        self.values.add(name, table, "faceVarying" if scope == "facevarying" else scope, 1, role)

    def _sample_of(self, prop):
        return _select(prop, min(self.first, max(prop.getNumSamples() - 1, 0)))

    def _report_frames(self, name, prop):
        if prop.getNumSamples() > 1 and not prop.isConstant():
            self.report.lose(f"the change in time of the attribute {name}",
                             "only positions have frames")

    def _read_property(self, parent, header):
        name = header.getName()
        if name in names.METADATA:
            return
        ours = names.TO_MODEL.get(name, name)
        meta = header.getMetaData()
        role = "" if name in names.TO_MODEL else ROLES.get(meta.get("interpretation"), "")
        if header.isScalar():
            self._read_scalar(parent, name, ours)
            return
        prop, indices = parent, None
        if header.isCompound():
            inner = Abc.ICompoundProperty(parent, name)
            if inner.getPropertyHeader(".vals") is None or inner.getNumProperties() != 2:
                self.report.lose(f"the attribute {ours}", "its type is neither numbers, vectors "
                                 "nor strings")
                return
            prop = Abc.IArrayProperty(inner, ".vals")
            indices = _numbers(Abc.IArrayProperty(inner, ".indices").getValue(), np.int64)
        else:
            prop = Abc.IArrayProperty(parent, name)
        table = _table(prop, self._sample_of(prop))
        if indices is not None and table is not None:
            table = _by_index(table, indices)
        self._report_frames(ours, prop)
        extent = meta.get("arrayExtent")
        size = int(extent) if extent.isdigit() else 1
        if size == 1 and name in names.TO_MODEL:
            size = names.COMPONENTS.get(ours, 1)
        self.values.add(ours, table, SCOPES.get(meta.get("geoScope"), "unknown"),
                        size, names.ROLES.get(ours, role))

    def _read_scalar(self, parent, name, ours):
        value = Abc.IScalarProperty(parent, name).getValue()
        table = np.array([value])
        if table.dtype.kind == "i":
            table = table.astype(np.int32)
        self.values.add(ours, table if table.dtype.kind in "fiubU" else None, "constant")

    def _positions(self, time):
        sample = self.schema.getValue(_select(self.schema, self._index(time)))
        points = _numbers(sample.getPositions(), np.float64).reshape(-1, 3)
        if len(points) != len(self.points):
            raise InputError(f"{self.name} has {len(points)} points at {time:g} s, but "
                             f"{len(self.points)} before")
        if self.sampler is not None:
            points = self.sampler.sample(points)
        matrix = self._matrix(time)
        return points if matrix is None else points @ matrix[:3, :3] + matrix[3, :3]

    def _matrix(self, time):
        """Return the transform of the object at a time, or None for the identity."""
        matrix = np.eye(4)
        for schema in reversed(self.transforms):
            at = schema.getValue(_select(schema, self._index(time, schema)))
            m = at.getMatrix()
            matrix = matrix @ np.array([[m[i][j] for j in range(4)] for i in range(4)])
            if not at.getInheritsXforms():
                break
        return None if np.array_equal(matrix, np.eye(4)) else matrix

    def to_groom(self, rest, times, archive):
        """Return the strands at the rest time, with motion if there are several times."""
        points = self._positions(rest)
        counts = self.counts if self.sampler is None else self.sampler.counts
        matrix = self._matrix(rest)
        if matrix is not None:
            basis.turn(self.values.attributes, matrix)
        groom = Groom(counts, points, self.values.attributes)
        if len(times) > 1:
            # The archive must live as long as frames are read.
            groom.motion = Motion(times, lambda i, keep=archive: self._positions(times[i]))
        return groom


def _select(prop, index):
    """Return the selector of a sample. The package takes any number for a time."""
    return Abc.ISampleSelector(float(prop.getTimeSampling().getSampleTime(index)))


def _by_index(table, indices):
    """Return the rows of the indices, or an empty table if an index is out of range."""
    if len(indices) and (indices.min() < 0 or indices.max() >= len(table)):
        return table[:0]
    return table[indices]


def _numbers(array, dtype):
    """Return an array of imath as an array of numpy."""
    if array is None:
        return np.zeros(0, dtype)
    try:
        return np.array(memoryview(array)).astype(dtype)
    except TypeError:  # A type of imath without access to its memory.
        return np.array([array[i] for i in range(len(array))], dtype)


def _table(prop, selector):
    """Return an array property as rows, or None for types that the model does not hold."""
    pod = prop.getDataType().getPod()
    array = prop.getValue(selector)
    if pod == Util.POD.kStringPOD:
        return np.array([str(array[i]) for i in range(len(array))])
    if pod not in TYPES:
        return None
    if hasattr(array, "r") and hasattr(array, "b"):
        channels = [_numbers(getattr(array, c), TYPES[pod]) for c in "rgba" if hasattr(array, c)]
        return np.stack(channels, axis=1)
    try:
        table = _numbers(array, TYPES[pod])
    except (TypeError, ValueError):  # Matrices, boxes and quaternions.
        return None
    return table if table.ndim <= 2 else None
