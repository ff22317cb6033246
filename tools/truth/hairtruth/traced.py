"""Path tracing of the cases by Mitsuba 3."""

import math
import multiprocessing

import mitsuba as mi
import numpy as np

from hairtruth import cases


def use(variant):
    mi.set_variant(variant)


# Mitsuba moves the start of a ray off a surface by 1.8e-4 of 1 plus the largest coordinate. Around
# the origin, in millimetres, this is less than a strand's radius.
UNIT = 1000.0  # of Mitsuba's lengths in a metre
DEPTH = 200  # of paths
CRASHES = 4  # after which a case is given up


def _place(position):
    """Return a position in Mitsuba's space."""
    return [UNIT * (x - middle) for x, middle in zip(position, cases.TARGET)]


def _spline(vertices):
    """Return the control points of natural cubic B-splines through the vertices of strands."""
    inner = vertices.shape[1] - 2
    points = 6 * vertices[:, 1:-1]
    points[:, 0] -= vertices[:, 0]
    points[:, -1] -= vertices[:, -1]
    factor = np.zeros(inner)
    for i in range(inner):
        pivot = 1 / (4 - (factor[i - 1] if i else 0))
        factor[i] = pivot
        points[:, i] = pivot * (points[:, i] - (points[:, i - 1] if i else 0))
    for i in reversed(range(inner - 1)):
        points[:, i] -= factor[i] * points[:, i + 1]
    first, last = vertices[:, :1], vertices[:, -1:]
    return np.concatenate([2 * first - points[:, :1], first, points, last,
                           2 * last - points[:, -1:]], 1)


def _write_curves(points, radius, path):
    """Write control points in the text format of Mitsuba's cubic B-splines."""
    with open(path, "w", encoding="ascii") as file:
        for strand in points:
            file.writelines(f"{x:.4f} {y:.4f} {z:.4f} {UNIT * radius:g}\n" for x, y, z in strand)
            file.write("\n")


def _lights(light):
    for i, (way, color) in enumerate(light.suns()):
        yield f"sun{i}", {"type": "directional", "direction": [-x for x in way],
                          "irradiance": {"type": "rgb", "value": list(color)}}
    for i, (at, color) in enumerate(light.lamps()):
        yield f"lamp{i}", {"type": "point", "position": _place(at),
                           "intensity": {"type": "rgb", "value": [UNIT**2 * c for c in color]}}
    if light.sky():
        yield "sky", {"type": "constant",
                      "radiance": {"type": "rgb", "value": light.sky() / math.pi}}


def write_strands(strands, radius, path):
    """Write strands as curves that Mitsuba reads."""
    _write_curves(_spline(UNIT * (strands - np.array(cases.TARGET, np.float64))), radius, path)


def _render(case, curves, size, samples, seed):
    scene = {
        "type": "scene",
        "hair": {"type": "bsplinecurve", "filename": curves,
                 "bsdf": _fibre(cases.absorption(case.reflectance))},
        "integrator": {"type": "path", "max_depth": DEPTH, "rr_depth": 20, "hide_emitters": True},
        "sensor": {
            "type": "perspective", "fov": cases.FIELD_OF_VIEW, "fov_axis": "y",
            "to_world": mi.ScalarTransform4f().look_at(_place(cases.EYE), [0, 0, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": size, "height": size,
                     "rfilter": {"type": "box"}, "pixel_format": "rgb"},
            "sampler": {"type": "independent", "sample_count": samples},
        },
    }
    scene.update(_lights(case.light))
    return np.array(mi.render(mi.load_dict(scene), spp=samples, seed=seed))


def _save(variant, path, *arguments):
    use(variant)
    np.save(path, _render(*arguments))


def pictures(variant, case, curves, size, samples, parts):
    """Return linear colours of pictures that differ by their random numbers. Mitsuba 3.9 crashes on
    a few camera rays of some seeds, so each picture has a process, and another seed if it crashes."""
    traces = []
    path = f"{curves}.{case.name}.npy"
    for seed in range(parts + CRASHES):
        process = multiprocessing.get_context("spawn").Process(
            target=_save, args=(variant, path, case, curves, size, samples, seed))
        process.start()
        process.join()
        if process.exitcode == 0:
            traces.append(np.load(path))
        if len(traces) == parts:
            return np.array(traces)
    raise RuntimeError(f"{case.name}: Mitsuba crashed {CRASHES + 1} times")


def _fibre(sigma):
    return {"type": "hair", "sigma_a": {"type": "rgb", "value": list(sigma)},
            "longitudinal_roughness": cases.ALONG, "azimuthal_roughness": cases.AROUND,
            "scale_tilt": -math.degrees(cases.TILT),  # tilts towards the root are negative there
            "int_ior": cases.REFRACTION, "ext_ior": 1.0}


def read_exr(path):
    """Return the linear colours of a picture."""
    bitmap = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    return np.array(bitmap)
