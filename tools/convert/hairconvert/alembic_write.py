"""Writes a groom as curves of Alembic, with the attributes of Unreal's groom schema."""

import imath
import numpy as np
from alembic3d import Abc, AbcCoreAbstract, AbcGeom

from hairconvert import __version__, names
from hairconvert.groom import GROOM, STRAND, VERTEX
from hairconvert.report import InputError, TOOL
from hairconvert.timing import find_rate

SCOPES = {GROOM: AbcGeom.GeometryScope.kConstantScope, STRAND: AbcGeom.GeometryScope.kUniformScope,
          VERTEX: AbcGeom.GeometryScope.kVertexScope}
SCHEMA_VERSION = (1, 5)
LETTERS = {"float32": "f", "float64": "d", "int32": "i"}
SCALARS = {"float32": ("Float", imath.FloatArrayFromBuffer),
           "float64": ("Double", imath.DoubleArrayFromBuffer),
           "int32": ("Int32", imath.IntArrayFromBuffer)}


def write(groom, path, options, report):
    """Write an archive with one object of curves."""
    rate = find_rate(groom.motion.times) if groom.motion else 24.0
    archive = Abc.CreateArchiveWithInfo(str(path), rate, f"{TOOL} {__version__}", "")
    sampling = 0
    if groom.motion:
        sampling = archive.addTimeSampling(_find_sampling(groom.motion.times, rate))
    # An archive is complete when the last object of it is gone, so none may outlive this call.
    _write_curves(archive.getTop(), groom, sampling, options, report)


def _find_sampling(times, rate):
    steps = np.arange(len(times)) / rate + times[0]
    if np.allclose(times, steps, rtol=0, atol=1e-4 / rate):
        return AbcCoreAbstract.TimeSampling(1 / rate, float(times[0]))
    stored = AbcCoreAbstract.TimeVector()
    for t in times:
        stored.append(float(t))
    return AbcCoreAbstract.TimeSampling(AbcCoreAbstract.TimeSamplingType(
        AbcCoreAbstract.AcyclicFlag.kAcyclic), stored)


def _write_curves(top, groom, sampling, options, report):
    schema = AbcGeom.OCurves(top, "strands", sampling).getSchema()
    counts = imath.IntArrayFromBuffer(groom.counts.astype(np.int32))
    kind, basis = AbcGeom.CurveType.kLinear, AbcGeom.BasisType.kNoBasis
    if options.basis != "linear":
        report.say("curves are linear, because Alembic has no pinned curves")
    width = AbcGeom.OFloatGeomParamSample()
    if "width" in groom.attributes:
        a = groom.attributes["width"]
        width = AbcGeom.OFloatGeomParamSample(imath.FloatArrayFromBuffer(
            np.ascontiguousarray(a.values, np.float32)), SCOPES[a.scope])
    uvs, normals = AbcGeom.OV2fGeomParamSample(), AbcGeom.ON3fGeomParamSample()
    for i in range(len(groom.motion) if groom.motion else 1):
        points = groom.motion.read(i) if groom.motion else groom.points
        if not np.isfinite(points).all():
            raise InputError(f"frame {i} has a position that is not finite")
        schema.set(AbcGeom.OCurvesSchemaSample(
            imath.V3fArrayFromBuffer(np.ascontiguousarray(points, np.float32)), counts, kind,
            AbcGeom.CurvePeriodicity.kNonPeriodic, width, uvs, normals, basis))
    _write_attributes(schema.getArbGeomParams(), groom, report)


def _write_attributes(parent, groom, report):
    for name, number in zip(("groom_version_major", "groom_version_minor"), SCHEMA_VERSION):
        Abc.OInt16Property(parent, name).setValue(number)
    Abc.OStringProperty(parent, "groom_tool").setValue(f"{TOOL} {__version__}")
    for name, a in groom.attributes.items():
        theirs = names.SCHEMA.get(name, name)
        if "/" in theirs or not theirs:
            report.lose(f"the attribute {name}", "Alembic allows no such name")
            continue
        values = _whole_numbers(a.values, name, report)
        if name in names.SCHEMA and a.values.dtype.kind == "f":
            values = values.astype(np.float32)
        if values is not None:
            _write_param(parent, theirs, a, values)


def _whole_numbers(values, name, report):
    """Return values of a type that can be written fast, or None after a sentence."""
    if values.dtype.kind not in "iu" or values.dtype == np.int32:
        return values
    if values.size and (values.min() < -2 ** 31 or values.max() >= 2 ** 31):
        report.lose(f"the attribute {name}", "its whole numbers need more than 32 bits")
        return None
    report.say(f"the attribute {name} becomes whole numbers of 32 bits")
    return values.astype(np.int32)


def _write_param(parent, name, attribute, values):
    scope, size = SCOPES[attribute.scope], 1
    components = values.shape[1] if values.ndim == 2 else 1
    kind = values.dtype.name
    if values.dtype.kind == "U":
        array, type_name, size = _strings(values.ravel()), "String", components
    elif kind == "bool":
        array, type_name, size = _bools(values.ravel()), "Boolean", components
    elif kind == "float16":
        flat = np.ascontiguousarray(values.ravel(), np.float32)
        array, type_name, size = imath.FloatArrayFromBuffer(flat), "Half", components
    elif components in (2, 3) and values.ndim == 2:
        vector = f"V{components}{LETTERS[kind]}"
        array = getattr(imath, vector + "ArrayFromBuffer")(np.ascontiguousarray(values))
        type_name = vector
        if components == 3 and kind == "float32":
            type_name = {"color": "C3f", "point": "P3f", "normal": "N3f"}.get(attribute.role, "V3f")
            array = imath.C3fArray(array) if attribute.role == "color" else array
    else:
        type_name, make = SCALARS[kind]
        array, size = make(np.ascontiguousarray(values.ravel())), components
    param = getattr(AbcGeom, f"O{type_name}GeomParam")(parent, name, False, scope, size)
    param.set(getattr(AbcGeom, f"O{type_name}GeomParamSample")(array, scope))


def _strings(values):
    array = imath.StringArray(len(values))
    for i, v in enumerate(values.tolist()):
        array[i] = v
    return array


def _bools(values):
    array = imath.BoolArray(False, len(values))
    for i in np.flatnonzero(values).tolist():
        array[i] = True
    return array
