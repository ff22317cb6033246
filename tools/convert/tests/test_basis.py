"""Curves of every basis and wrap, against other formulas of the same curves."""

import unittest

import numpy as np

from hairconvert.basis import (BEZIER, BSPLINE, CATMULL_ROM, LINEAR, NONPERIODIC, PERIODIC, PINNED,
                               Sampler, choose_samples, count_segments, count_varying)


def de_casteljau(p, t):
    """Return a point of a Bezier segment."""
    p = p.copy()
    while len(p) > 1:
        p = p[:-1] * (1 - t) + p[1:] * t
    return p[0]


def de_boor(p, t):
    """Return a point of a segment of a uniform cubic B-spline, by the recursion of de Boor."""
    d, knots = p.copy(), np.arange(-2.0, 4.0)
    for r in range(1, 4):
        for j in range(3, r - 1, -1):
            low, high = knots[j - 1], knots[j + 3 - r]
            a = (t - low) / (high - low)
            d[j] = (1 - a) * d[j - 1] + a * d[j]
    return d[3]


def barry_goldman(p, t):
    """Return a point of a segment of a uniform Catmull-Rom curve, by the pyramid of Barry and
    Goldman."""
    t += 1
    a = [(k + 1 - t) * p[k] + (t - k) * p[k + 1] for k in range(3)]
    b = [((k + 2 - t) * a[k] + (t - k) * a[k + 1]) / 2 for k in range(2)]
    return (2 - t) * b[0] + (t - 1) * b[1]


CURVES = {BEZIER: (de_casteljau, 3), BSPLINE: (de_boor, 1), CATMULL_ROM: (barry_goldman, 1)}


class SamplerTest(unittest.TestCase):
    def setUp(self):
        self.points = np.random.default_rng(5).normal(size=(200, 3))

    def check(self, basis, wrap, counts, controls_of):
        """Compare each sample with a curve through the four control points of its segment."""
        formula = CURVES[basis][0]
        sampler = Sampler(basis, wrap, counts, 4)
        got, at, first = sampler.sample(self.points[:sum(counts)]), 0, 0
        for n in counts:
            p = self.points[first:first + n]
            for s, controls in enumerate(controls_of(p)):
                for k in range(4):
                    np.testing.assert_allclose(got[at], formula(controls, k / 4), atol=1e-12,
                                               err_msg=f"{basis} {wrap} segment {s}")
                    at += 1
            np.testing.assert_allclose(got[at], formula(controls, 1.0), atol=1e-12)
            at, first = at + 1, first + n
        self.assertEqual(at, len(got))

    def test_nonperiodic(self):
        for basis, (_, step) in CURVES.items():
            counts = [4, 7, 10]
            self.check(basis, NONPERIODIC, counts,
                       lambda p: [p[i:i + 4] for i in range(0, len(p) - 3, step)])

    def test_periodic(self):
        for basis, (_, step) in CURVES.items():
            self.check(basis, PERIODIC, [3, 6, 9], lambda p: [
                np.take(p, range(i, i + 4), axis=0, mode="wrap") for i in range(0, len(p), step)])

    def test_pinned(self):
        def controls(p):
            p = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
            return [p[i:i + 4] for i in range(len(p) - 3)]
        for basis in (BSPLINE, CATMULL_ROM):
            self.check(basis, PINNED, [2, 3, 4, 9], controls)

    def test_pinned_curves_end_at_their_control_points(self):
        for basis in (BSPLINE, CATMULL_ROM):
            got = Sampler(basis, PINNED, [5], 3).sample(self.points[:5])
            np.testing.assert_allclose(got[[0, -1]], self.points[[0, 4]], atol=1e-14)

    def test_catmull_rom_goes_through_every_vertex_exactly(self):
        got = Sampler(CATMULL_ROM, PINNED, [5, 9], 1).sample(self.points[:14])
        np.testing.assert_array_equal(got, self.points[:14])

    def test_periodic_linear_is_closed(self):
        got = Sampler(LINEAR, PERIODIC, [4], 1).sample(self.points[:4])
        np.testing.assert_array_equal(got, self.points[[0, 1, 2, 3, 0]])

    def test_curves_with_too_few_points_have_no_samples(self):
        self.assertEqual(count_segments(BEZIER, NONPERIODIC, [0, 1, 3, 4, 6, 7]).tolist(),
                         [0, 0, 0, 1, 1, 2])
        sampler = Sampler(BSPLINE, NONPERIODIC, [3, 4, 0], 2)
        self.assertEqual(sampler.counts.tolist(), [0, 3, 0])
        sampler.sample(self.points[:7])

    def test_varying_values_change_linearly_in_a_segment(self):
        for basis, wrap, n in ((BEZIER, NONPERIODIC, 7), (BSPLINE, PINNED, 3),
                               (CATMULL_ROM, NONPERIODIC, 5), (BEZIER, PINNED, 7)):
            self.assertEqual(count_varying(basis, wrap, [n]).tolist(), [3])
            got = Sampler(basis, wrap, [n], 2).sample_varying(np.array([1.0, 3.0, 9.0]))
            np.testing.assert_allclose(got, [1, 2, 3, 6, 9])

    def test_whole_numbers_are_not_blended(self):
        got = Sampler(BSPLINE, PINNED, [2], 4).sample(np.array([5, 9]))
        self.assertEqual(set(got.tolist()), {5, 9})

    def test_samples_suffice_for_the_tolerance(self):
        straight = np.linspace(0, 1, 8)[:, None] * np.ones(3)
        samples, error = choose_samples(BSPLINE, PINNED, [8], straight)
        self.assertEqual(samples, 1)
        self.assertLess(error, 1e-12)
        samples, error = choose_samples(BEZIER, NONPERIODIC, [7] * 20, self.points[:140])
        self.assertGreater(samples, 4)
        self.assertLess(error, 1e-2)
        self.assertGreater(error, 1e-6)
        samples, error = choose_samples(CATMULL_ROM, PINNED, [7] * 20, self.points[:140])
        self.assertEqual(samples, 1)
        self.assertGreater(error, 1e-3)
