"""Fits a haircut to its scalp: roots are seated, and strands inside the head are led out."""

import numpy as np

from hairconvert.groom import STRAND, Attribute, Groom
from hairconvert.mesh import keep_influences
from hairconvert.surface import Surface

SEATED = 1e-4  # distance of a root from the scalp that needs no repair, m
MARGIN = 5e-4  # distance of a vertex from the scalp after it is led out, m
TURNS = 12  # iterations that turn an edge out of the head


def fit_to_scalp(groom, mesh, seat_within, report):
    """Return the groom after the repair, with root_uv of the scalp, and the surface."""
    surface = Surface(mesh)
    _orient(surface, groom, report)
    points = groom.points.copy()
    _seat_roots(groom, points, surface, seat_within, report)
    _lead_out(groom, points, surface, report)
    if groom.motion and not np.array_equal(points, groom.points):
        report.lose(f"the motion of {len(groom.motion)} frames",
                    "only the pose at rest can be fitted to a scalp")
    motion = groom.motion if np.array_equal(points, groom.points) else None
    fitted = Groom(groom.counts, points, groom.attributes, motion, groom.format)
    if mesh.uv is not None and "root_uv" not in fitted.attributes:
        triangle, weights = surface.closest(points[groom.starts()])
        uv = np.einsum("ni,nij->nj", weights, mesh.uv[mesh.triangles[triangle]])
        fitted.attributes["root_uv"] = Attribute(STRAND, uv.astype(np.float32), "uv")
    return fitted, surface


def _orient(surface, groom, report):
    """Let normals point out of the head: by the volume if the mesh is closed, else by the hair."""
    if surface.is_closed:
        inward = surface.volume() < 0
    else:
        roots = groom.starts()
        triangle, _ = surface.closest(groom.points[roots])
        along = groom.points[roots + groom.counts - 1] - groom.points[roots]
        inward = np.sign((along * surface.normals[triangle]).sum(axis=1)).sum() < 0
    if inward:
        report.say("the normals of the scalp are turned round, because they point into the head")
        surface.flip()


def _seat_roots(groom, points, surface, seat_within, report):
    """Move strands as they are, such that their roots lie on the scalp."""
    roots = groom.points[groom.starts()]
    distance, closest, _ = surface.distance(roots)
    gap = np.abs(distance)
    far = gap > seat_within
    move = (gap > SEATED) & ~far
    shift = np.where(move[:, None], closest - roots, 0)
    points += np.repeat(shift, groom.counts, axis=0)
    for what, which in (("ended off the scalp at their roots and are moved onto", distance > 0),
                        ("began inside the head and are moved out to", distance < 0)):
        n = (move & which).sum()
        if n:
            report.say(f"{n} strands {what} the scalp, by at most "
                       f"{1e3 * gap[move & which].max():.3g} mm")
    if far.any():
        report.say(f"{far.sum()} roots lie more than {1e3 * seat_within:.3g} mm from the scalp, up "
                   f"to {1e3 * gap.max():.3g} mm, and stay: --seat-within moves them")


def _lead_out(groom, points, surface, report):
    """Turn edges that enter the head, from root to tip. Lengths stay, and what follows a turned
    edge keeps its shape."""
    before, starts, counts = points.copy(), groom.starts(), groom.counts
    arc, turned = np.zeros(len(counts)), np.zeros(len(counts), bool)
    # A vertex is at most the length of an edge nearer to the surface than the vertex before.
    bound = np.zeros(len(counts))
    for i in range(1, int(counts.max())):
        alive = np.flatnonzero(counts > i)
        at = starts[alive] + i
        edge = before[at] - before[at - 1]
        length = np.linalg.norm(edge, axis=1)
        arc[alive] += length
        bound[alive] -= length
        # Next to the root the margin is small, because the root lies on the scalp.
        margin = np.minimum(MARGIN, 0.25 * arc[alive])
        points[at] = np.where(turned[alive, None], points[at - 1] + edge, before[at])
        near = bound[alive] < margin
        distance, _, _ = surface.distance(points[at[near]])
        bound[alive[near]] = distance
        limit = np.where(turned[alive[near]], margin[near], -SEATED)
        enter = np.flatnonzero(near)[distance < limit]
        if len(enter):
            points[at[enter]] = _turn_out(points[at[enter] - 1], edge[enter], length[enter],
                                          margin[enter], surface)
            turned[alive[enter]] = True
            bound[alive[enter]] = 0
    if turned.any():
        moved = np.linalg.norm(points - before, axis=1)
        report.say(f"{turned.sum()} strands ran inside the head and are led out, with vertices "
                   f"moved by at most {1e3 * moved.max():.3g} mm")


def _turn_out(origin, edge, length, margin, surface):
    """Return the ends of edges from `origin`, turned as little as keeps them out of the head."""
    end, left = origin + edge, np.arange(len(origin))
    for turn in range(TURNS):
        distance, closest, normal = surface.distance(end[left])
        inside = distance < margin[left] * 0.99
        left, closest, normal = left[inside], closest[inside], normal[inside]
        if len(left) == 0:
            break
        # A turned edge is shorter than the way to its aim, so later turns aim farther out.
        along = closest + normal * (margin[left] * (1 + turn))[:, None] - origin[left]
        size = np.linalg.norm(along, axis=1, keepdims=True)
        # An edge straight into the head has no direction to turn to, so the normal is one.
        along = np.where(size > 1e-12, along / np.maximum(size, 1e-12), normal)
        end[left] = origin[left] + along * length[left, None]
    return end


def find_bones(groom, mesh, surface):
    """Return the four joints and weights of the root of each strand."""
    triangle, weights = surface.closest(groom.points[groom.starts()])
    corners = mesh.triangles[triangle]
    count = len(mesh.joint_names)
    joints = mesh.joints[corners].reshape(len(corners), -1)
    values = (mesh.weights[corners] * weights[:, :, None]).reshape(len(corners), -1)
    # The first of the places of a joint gets the sum of its weights, the others get 0.
    keys = (np.arange(len(corners))[:, None] * count + joints).ravel()
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    sums = np.bincount(place, values.ravel())
    total = np.zeros(len(keys))
    total[first] = sums
    joints, values = keep_influences(joints, total.reshape(joints.shape))
    return joints, values / np.maximum(values.sum(axis=1, keepdims=True), 1e-30)
