#!/usr/bin/env python3
"""Write walker.glb, a mannequin that walks and nods, for scenes and tests: walker.py OUT.glb

The body is one closed surface around cones and ellipsoids. The mannequin is 1.73 m tall, faces +z and walks 1.2 m/s along +z. The animation has two steps of each leg, and the head nods once.
"""
import json
import math
import struct
import sys

KEYS, PERIOD, SPEED = 33, 2.2, 1.2
COLORS = [(0.46, 0.30, 0.22), (0.10, 0.16, 0.24), (0.06, 0.055, 0.05), (0.03, 0.025, 0.02)]
# Name, parent and place of each joint at rest, m. Joints of the right side mirror the left ones.
JOINTS = [("hips", None, (0, 0.95, 0)), ("spine", "hips", (0, 1.12, -0.01)), ("chest", "spine", (0, 1.28, -0.02)),
          ("neck", "chest", (0, 1.46, -0.03)), ("head", "neck", (0, 1.55, -0.015))]
for side, sign in (("left", 1), ("right", -1)):
    JOINTS += [(side + "_arm", "chest", (0.165 * sign, 1.395, -0.03)),
               (side + "_forearm", side + "_arm", (0.31 * sign, 1.19, -0.03)),
               (side + "_hand", side + "_forearm", (0.435 * sign, 0.99, 0.0)),
               (side + "_leg", "hips", (0.09 * sign, 0.92, 0)),
               (side + "_shin", side + "_leg", (0.10 * sign, 0.50, 0.01)),
               (side + "_foot", side + "_shin", (0.10 * sign, 0.09, -0.02))]
INDEX = {name: i for i, (name, _, _) in enumerate(JOINTS)}
PLACE = {name: place for name, _, place in JOINTS}


# Rounded cones of the body: joint, ends, radii. Those of the left side have x > 0.
CONES = [("head", (0, 1.580, 0.030), (0, 1.540, 0.055), 0.056, 0.034),
         ("head", (0, 1.608, 0.094), (0, 1.588, 0.104), 0.013, 0.015),
         ("neck", (0, 1.580, -0.012), (0, 1.430, -0.028), 0.050, 0.056),
         ("chest", (-0.130, 1.395, -0.030), (0.130, 1.395, -0.030), 0.056, 0.056)]
LEFT = [("arm", (0.160, 1.395, -0.030), (0.310, 1.190, -0.030), 0.050, 0.039),
        ("forearm", (0.310, 1.190, -0.030), (0.430, 1.000, 0.000), 0.038, 0.027),
        ("hand", (0.445, 0.975, 0.000), (0.500, 0.890, 0.015), 0.034, 0.024),
        ("leg", (0.095, 0.920, 0.000), (0.105, 0.500, 0.010), 0.084, 0.055),
        ("shin", (0.105, 0.500, 0.010), (0.105, 0.090, -0.020), 0.054, 0.040),
        ("foot", (0.105, 0.045, -0.030), (0.108, 0.040, 0.130), 0.044, 0.036)]
# Ellipsoids: joint, centre, semi-axes.
ELLIPSOIDS = [("head", (0, 1.630, 0.000), (0.078, 0.099, 0.097)), ("chest", (0, 1.290, -0.015), (0.158, 0.170, 0.105)),
              ("spine", (0, 1.100, -0.005), (0.135, 0.160, 0.096)), ("hips", (0, 0.940, -0.005), (0.158, 0.110, 0.106))]
for _side, _sign in (("left_", 1), ("right_", -1)):
    CONES += [(_side + name, (_sign * a[0], *a[1:]), (_sign * b[0], *b[1:]), r, q) for name, a, b, r, q in LEFT]
BLEND = 0.03  # m, over which parts join
SHARE = 0.016  # m, over which the weights of joints fall


def steps(*ranges):
    """Return coordinates from ranges of (begin, end, step)."""
    out = []
    for first, last, step in ranges:
        count = round((last - first) / step)
        out += [first + (last - first) * i / count for i in range(count)]
    return out + [ranges[-1][1]]


def distances(p):
    """Return the joint and the signed distance of each part of the body."""
    out = []
    for name, a, b, r, q in CONES:
        axis, to = [v - u for u, v in zip(a, b)], [v - u for u, v in zip(a, p)]
        t = min(max(sum(u * v for u, v in zip(axis, to)) / sum(u * u for u in axis), 0), 1)
        out.append((name, math.dist(to, [t * u for u in axis]) - r - t * (q - r)))
    for name, center, axes in ELLIPSOIDS:
        to = [u - v for u, v in zip(p, center)]
        one = math.hypot(*[u / v for u, v in zip(to, axes)])
        two = math.hypot(*[u / (v * v) for u, v in zip(to, axes)])
        out.append((name, one * (one - 1) / two if two > 1e-6 else -min(axes)))
    return out


def surface(p):
    """Return the signed distance of all parts, joined smoothly."""
    least = 9.0
    for _, distance in distances(p):
        h = max(BLEND - abs(least - distance), 0) / BLEND
        least = min(least, distance) - h * h * BLEND / 4
    return least


def weigh(p):
    rows = distances(p)
    least, out = min(distance for _, distance in rows), {}
    for name, distance in rows:
        out[name] = max(out.get(name, 0), math.exp(-(distance - least) / SHARE))
    return {name: w / sum(out.values()) for name, w in out.items() if w > 0.02}


def color_of(p):
    """Return the index of the material of a place: skin, shirt, trousers or shoes."""
    if p[1] > 1.47 or (abs(p[0]) > 0.42 and p[1] < 1.04):
        return 0
    if p[1] > 0.93 or abs(p[0]) > 0.25:
        return 1
    return 2 if p[1] > 0.10 else 3


def build():
    """Return positions and triangles of one closed surface, by a net of one vertex per cell (Gibson 1998)."""
    half = steps((0, 0.1, 0.025), (0.1, 0.19, 0.045), (0.19, 0.568, 0.063))
    x = [-v for v in reversed(half[1:])] + half
    y = steps((-0.03, 0.42, 0.1125), (0.42, 0.60, 0.06), (0.60, 0.84, 0.08), (0.84, 1.36, 0.052), (1.36, 1.769, 0.0215))
    z = steps((-0.16, 0.20, 0.03))
    size = len(x), len(y), len(z)
    value = {(i, j, k): surface((x[i], y[j], z[k])) for i in range(size[0]) for j in range(size[1])
             for k in range(size[2])}
    index, positions, triangles = {}, [], []
    corners = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    for i in range(size[0] - 1):
        for j in range(size[1] - 1):
            for k in range(size[2] - 1):
                points = []
                for a in corners:
                    for axis in range(3):
                        b = tuple(v + (axis == n) for n, v in enumerate(a))
                        if a[axis]:
                            continue
                        u, v = value[i + a[0], j + a[1], k + a[2]], value[i + b[0], j + b[1], k + b[2]]
                        if (u < 0) != (v < 0):
                            t = u / (u - v)
                            p, q = [(x[i + c[0]], y[j + c[1]], z[k + c[2]]) for c in (a, b)]
                            points.append([m + t * (n - m) for m, n in zip(p, q)])
                if points:
                    index[i, j, k] = len(positions)
                    positions.append([sum(p[n] for p in points) / len(points) for n in range(3)])
    for (i, j, k), u in value.items():
        for axis in range(3):
            other = tuple(v + (axis == n) for n, v in enumerate((i, j, k)))
            if other not in value or (u < 0) == (value[other] < 0):
                continue
            m, n = [[c == (axis + e) % 3 for c in range(3)] for e in (1, 2)]
            cells = [tuple(v - e * p - f * q for v, p, q in zip((i, j, k), m, n)) for e, f in ((1, 1), (0, 1), (0, 0), (1, 0))]
            a, b, c, d = [index[cell] for cell in cells]
            triangles += [(a, b, c), (a, c, d)] if u < 0 else [(a, c, b), (a, d, c)]
    for p in positions:  # Newton's method
        for _ in range(4):
            f, e = surface(p), 1e-4
            g = [(surface([v + e * (n == m) for m, v in enumerate(p)]) - f) / e for n in range(3)]
            for n in range(3):
                p[n] -= f * g[n] / max(sum(v * v for v in g), 0.25)
    return positions, triangles


def turn(x=0, y=0, z=0):
    """Return the quaternion of turns about x, then y, then z, xyzw."""
    out = (0, 0, 0, 1)
    for axis, angle in ((0, x), (1, y), (2, z)):
        a, s, c = [0, 0, 0], math.sin(angle / 2), math.cos(angle / 2)
        a[axis] = s
        x1, y1, z1, w1 = a[0], a[1], a[2], c
        x2, y2, z2, w2 = out
        out = (w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2, w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
               w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2, w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2)
    return out


def pose(t):
    """Return the rotations of joints and the place of the hips at a fraction of the period."""
    step = 4 * math.pi * t
    once = 2 * math.pi * t
    out = {"hips": turn(y=0.07 * math.sin(step)), "spine": turn(y=-0.06 * math.sin(step), x=0.03),
           "chest": turn(y=-0.10 * math.sin(step), z=0.02 * math.cos(step)),
           "neck": turn(x=0.06 + 0.12 * math.sin(once)),
           "head": turn(x=-0.05 + 0.30 * math.sin(once), y=0.22 * math.sin(once + 1), z=0.05 * math.sin(step))}
    for side, phase in (("left", 0), ("right", math.pi)):
        swing = 0.42 * math.sin(step + phase)
        knee = 0.12 + 0.75 * max(math.cos(step + phase), 0) ** 2
        out[side + "_leg"] = turn(x=-swing - 0.08)
        out[side + "_shin"] = turn(x=knee)
        out[side + "_foot"] = turn(x=0.6 * (swing + 0.08 - knee))
        sign = 1 if side == "left" else -1
        out[side + "_arm"] = turn(x=0.6 * swing, z=-0.36 * sign)
        out[side + "_forearm"] = turn(x=-0.2 - 0.25 * max(-swing, 0))
    hips = (0.012 * math.sin(step), 0.95 - 0.012 + 0.016 * math.cos(2 * step), SPEED * PERIOD * t)
    return out, hips


class File:
    """The JSON and the bytes of a file."""

    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def accessor(self, form, component, kind, rows, **more):
        data = b"".join(struct.pack("<" + form, *row) for row in rows)
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "type": kind,
                               "count": len(rows), **more})
        return len(self.accessors) - 1


def quantize(weights):
    """Return four joints and weights of bytes with the sum 255."""
    best = sorted(weights.items(), key=lambda item: -item[1])[:4]
    whole = [round(255 * w) for _, w in best]
    whole[0] += 255 - sum(whole)
    joints = [INDEX[name] if w else 0 for (name, _), w in zip(best, whole)]
    return joints + [0] * (4 - len(best)), whole + [0] * (4 - len(best))


def main(path):
    file, primitives, materials = File(), [], []
    positions, triangles = build()
    rows = [quantize(weigh(p)) for p in positions]
    positions = [[round(v, 5) for v in p] for p in positions]
    lower = [min(p[k] for p in positions) for k in range(3)]
    upper = [max(p[k] for p in positions) for k in range(3)]
    attributes = {"POSITION": file.accessor("3f", 5126, "VEC3", positions, min=lower, max=upper),
                  "JOINTS_0": file.accessor("4B", 5121, "VEC4", [row[0] for row in rows]),
                  "WEIGHTS_0": file.accessor("4B", 5121, "VEC4", [row[1] for row in rows], normalized=True)}
    for i, color in enumerate(COLORS):
        corners = [(v,) for t in triangles for v in t if i == color_of([max((positions[w][k] for w in t), key=abs) for k in range(3)])]
        primitives.append({"attributes": attributes, "indices": file.accessor("H", 5123, "SCALAR", corners),
                           "material": i})
        materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0}})
    binds = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1) for _, _, (x, y, z) in JOINTS]
    nodes = [{"name": "walker", "children": [1, 2]}, {"name": "body", "mesh": 0, "skin": 0}]
    for name, parent, place in JOINTS:
        above = PLACE[parent] if parent else (0, 0, 0)
        node = {"name": name, "translation": [round(a - b, 6) for a, b in zip(place, above)]}
        children = [2 + INDEX[child] for child, of, _ in JOINTS if of == name]
        nodes.append({**node, "children": children} if children else node)
    skin = {"joints": [2 + i for i in range(len(JOINTS))],
            "inverseBindMatrices": file.accessor("16f", 5126, "MAT4", binds)}

    poses = [pose(i / (KEYS - 1)) for i in range(KEYS)]
    times = file.accessor("f", 5126, "SCALAR", [(PERIOD * i / (KEYS - 1),) for i in range(KEYS)], min=[0], max=[PERIOD])
    samplers, channels = [], []

    def animate(joint, path_name, output):
        channels.append({"sampler": len(samplers), "target": {"node": 2 + INDEX[joint], "path": path_name}})
        samplers.append({"input": times, "output": output})

    animate("hips", "translation", file.accessor("3f", 5126, "VEC3", [hips for _, hips in poses]))
    for name, _, _ in JOINTS:
        if name in poses[0][0]:
            rows = [[round(32767 * v) for v in p[name]] for p, _ in poses]
            animate(name, "rotation", file.accessor("4h", 5122, "VEC4", rows, normalized=True))
    document = {"asset": {"version": "2.0", "generator": "walker.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": nodes, "meshes": [{"primitives": primitives}], "skins": [skin], "materials": materials,
                "animations": [{"name": "walk", "channels": channels, "samplers": samplers}],
                "buffers": [{"byteLength": len(file.bytes)}], "bufferViews": file.views, "accessors": file.accessors}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = file.bytes + b"\0" * (-len(file.bytes) % 4)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)


if __name__ == "__main__":
    main(sys.argv[1])
