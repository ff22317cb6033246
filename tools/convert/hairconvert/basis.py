"""Curves of USD and Alembic as polylines.

Each new vertex is a weighted sum of up to four control points of its curve, so that the same sums
serve positions, motion and attributes.
"""

import numpy as np

from hairconvert.groom import check_counts

LINEAR, BEZIER, BSPLINE, CATMULL_ROM = "linear", "bezier", "bspline", "catmullRom"
NONPERIODIC, PERIODIC, PINNED = "nonperiodic", "periodic", "pinned"

# Rows are powers of t from 0 on, columns are control points. See the page "UsdGeomBasisCurves" of
# the USD documentation.
MATRICES = {
    BEZIER: np.array([[1, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]], float),
    BSPLINE: np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6,
    CATMULL_ROM: np.array([[0, 2, 0, 0], [-1, 0, 1, 0], [2, -5, 4, -1], [-1, 3, -3, 1]]) / 2,
}
SAMPLES = (1, 2, 4, 8, 16)
FINE = 32  # edges per segment of the polyline that stands for the curve
TOLERANCE = 1e-3  # distance of a polyline from its curve, in lengths of the strand
TRIED_STRANDS = 1000


def count_segments(basis, wrap, counts):
    """Return the number of segments of each curve, 0 for curves with too few control points."""
    n = np.asarray(counts, np.int64)
    if basis == LINEAR:
        segments = n if wrap == PERIODIC else n - 1
        return np.where(n >= 2, segments, 0)
    step = 3 if basis == BEZIER else 1
    if wrap == PERIODIC:
        return np.where(n >= 3, n // step, 0)
    if wrap == PINNED and basis != BEZIER:
        return np.where(n >= 2, n - 1, 0)
    return np.where(n >= 4, (n - 4) // step + 1, 0)


def count_varying(basis, wrap, counts):
    """Return the number of varying values of each curve."""
    segments = count_segments(basis, wrap, counts)
    if wrap == PERIODIC:
        return segments
    return np.where(segments > 0, segments + 1, np.asarray(counts) if basis == LINEAR else 0)


class Sampler:
    """The sums that turn curves into polylines with `samples` edges per segment."""

    def __init__(self, basis, wrap, counts, samples=1):
        counts = np.asarray(counts, np.int64)
        segments = count_segments(basis, wrap, counts)
        if basis == LINEAR:
            samples = 1
        self.sizes = counts
        self.varying_sizes = count_varying(basis, wrap, counts)
        self.counts = np.where(segments > 0, segments * samples + 1, 0)
        curve = np.repeat(np.arange(len(counts)), self.counts)
        within = np.arange(self.counts.sum()) - (np.cumsum(self.counts) - self.counts)[curve]
        segment = np.minimum(within // samples, segments[curve] - 1)
        t = within / samples - segment
        n = counts[curve]
        first = (np.cumsum(counts) - counts)[curve]
        self.indices, self.weights = _find_sums(basis, wrap, segment, t, n, first)
        varying = self.varying_sizes[curve]
        begin = (np.cumsum(self.varying_sizes) - self.varying_sizes)[curve]
        self.varying_indices = np.stack([begin + segment, begin + (segment + 1) % varying], axis=1)
        self.varying_weights = np.stack([1 - t, t], axis=1)

    def sample(self, values):
        """Return values per control point at the vertices of the polylines."""
        return _blend(values, self.indices, self.weights)

    def sample_varying(self, values):
        """Return varying values at the vertices of the polylines."""
        return _blend(values, self.varying_indices, self.varying_weights)


def _find_sums(basis, wrap, segment, t, n, first):
    """Return indices and weights of the control points of each sample."""
    if basis == LINEAR:
        local = np.stack([segment, segment + 1], axis=1)
        return first[:, None] + local % n[:, None], np.stack([1 - t, t], axis=1)
    powers = np.stack([np.ones_like(t), t, t * t, t * t * t], axis=1)
    weights = powers @ MATRICES[basis]
    step = 3 if basis == BEZIER else 1
    local = (step * segment)[:, None] + np.arange(4)[None, :]
    if wrap == PINNED and basis != BEZIER:
        local -= 1
        _pin(local, weights, n)
        return first[:, None] + np.clip(local, 0, n[:, None] - 1), weights
    # A periodic bspline or Catmull-Rom curve begins at its second control point.
    return first[:, None] + local % n[:, None], weights


def _pin(local, weights, n):
    """Replace the control points before the first and after the last, 2 P0 - P1, by P0 and P1."""
    before, after = local[:, 0] < 0, local[:, 3] >= n
    w = np.where(before, weights[:, 0], 0)
    weights[:, 1] += 2 * w
    weights[:, 2] -= w
    weights[before, 0] = 0
    w = np.where(after, weights[:, 3], 0)
    weights[:, 2] += 2 * w
    weights[:, 1] -= w
    weights[after, 3] = 0


def _blend(values, indices, weights):
    """Return weighted sums of rows. Values that cannot be blended come from the largest weight."""
    if values.dtype.kind != "f":
        best = np.argmax(weights, axis=1)
        return values[indices[np.arange(len(indices)), best]]
    shape = (-1, *[1] * (values.ndim - 1))
    out = np.zeros((len(indices), *values.shape[1:]))
    for k in range(indices.shape[1]):
        out += values[indices[:, k]] * weights[:, k].reshape(shape)
    return out.astype(values.dtype, copy=False)


def choose_samples(basis, wrap, counts, points):
    """Return the least number of edges per segment within TOLERANCE, and the distance from the
    curve in lengths of the strand. Catmull-Rom curves go through their vertices and keep them."""
    counts = np.asarray(counts, np.int64)[:TRIED_STRANDS]
    points = points[:counts.sum()]
    fine = Sampler(basis, wrap, counts, FINE)
    if len(fine.indices) == 0 or not np.isfinite(points).all():
        return 1, 0.0
    curve = fine.sample(points)
    starts = np.cumsum(fine.counts) - fine.counts
    steps = np.zeros(len(curve))
    steps[1:] = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    used = fine.counts > 0
    steps[starts[used]] = 0
    length = np.zeros(len(counts))
    length[used] = np.add.reduceat(steps, starts[used])
    length = np.repeat(np.maximum(length, 1e-30), fine.counts)
    within = np.arange(len(curve)) - np.repeat(starts, fine.counts)
    for samples in SAMPLES:
        skip = FINE // samples
        before = np.arange(len(curve)) - within % skip
        after = np.minimum(before + skip, len(curve) - 1)
        t = ((within % skip) / skip)[:, None]
        chord = curve[before] * (1 - t) + curve[after] * t
        error = float((np.linalg.norm(curve - chord, axis=1) / length).max())
        if error <= TOLERANCE or basis == CATMULL_ROM:
            break
    return samples, error


def make_sampler(basis, wrap, counts, points, samples, report):
    """Return the sampler of curves, or None for polylines. `samples` is None to choose them."""
    if basis == LINEAR and wrap != PERIODIC:
        return None
    if basis != LINEAR:
        told = ""
        if not samples:
            samples, error = choose_samples(basis, wrap, counts, points)
            told = f", at most {error:.2g} of a strand's length beside the curve"
        report.say(f"{basis} curves become polylines of {samples} edges per segment{told}")
    if wrap == PERIODIC:
        report.say("periodic curves are opened where they begin")
    samples = samples if basis != LINEAR else 1
    check_counts(len(counts), int(count_segments(basis, wrap, counts).sum() * samples))
    return Sampler(basis, wrap, counts, samples)


def turn(attributes, matrix):
    """Apply a transform to directions, and its mean scale to widths."""
    linear = matrix[:3, :3]
    for name, a in attributes.items():
        if a.role in ("vector", "normal") and a.values.shape[1:] == (3,):
            by = np.linalg.pinv(linear).T if a.role == "normal" else linear
            a.values = a.values @ by
        elif a.role == "point" and a.values.shape[1:] == (3,):
            a.values = a.values @ linear + matrix[3, :3]
        elif name == "width":
            a.values = a.values * np.cbrt(abs(np.linalg.det(linear)))
