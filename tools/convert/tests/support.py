"""Haircuts, comparisons and the command line for tests."""

import contextlib
import io
import os
import shutil
import tempfile
import unittest

import numpy as np

from hairconvert.cli import make_parser, run
from hairconvert.formats import read_groom
from hairconvert.groom import STRAND, VERTEX, Attribute, Groom, lengths
from hairconvert.report import Report
from tests import server


def make_groom(kind="straight", strands=100, vertices=16, seed=1, uneven=False):
    """Return a haircut on a sphere, straight, curly, clumped or braided."""
    random = np.random.default_rng(seed)
    counts = random.integers(2, vertices + 1, strands) if uneven else np.full(strands, vertices)
    counts = counts.astype(np.int64)
    starts = np.cumsum(counts) - counts
    strand = np.repeat(np.arange(strands), counts)
    t = (np.arange(counts.sum()) - starts[strand]) / np.maximum(counts[strand] - 1, 1)
    out = random.normal(size=(strands, 3))
    out[:, 1] = np.abs(out[:, 1])
    out /= np.linalg.norm(out, axis=1)[:, None]
    root, length = 0.1 * out + [0, 1.6, 0], random.uniform(0.05, 0.3, strands)
    points = root[strand] + out[strand] * (t * length[strand])[:, None]
    points[:, 1] -= 0.1 * t * t
    angle = 20 * t + strand
    if kind == "curly":
        points += 0.01 * np.stack([np.cos(angle), np.sin(angle), 0 * t], axis=1)
    if kind == "braid":
        angle = 20 * t + 2 * np.pi / 3 * (strand % 3)
        points += 0.02 * np.stack([np.cos(angle), 0 * t, np.sin(2 * angle)], axis=1)
    if kind == "clumped":
        leader = starts[strand - strand % 10]
        points += t[:, None] * (points[leader] - root[strand]) * 0.5
    points = points.astype(np.float32).astype(np.float64)
    return Groom(counts, points, format="test")


def add_attributes(groom, seed=2):
    """Add every known attribute and some of a user's own."""
    random = np.random.default_rng(seed)
    s, v = len(groom.counts), len(groom.points)
    a = groom.attributes
    a["width"] = Attribute(VERTEX, random.uniform(5e-5, 1e-4, v).astype(np.float32))
    a["color"] = Attribute(VERTEX, random.uniform(0, 1, (v, 3)).astype(np.float32), "color")
    a["opacity"] = Attribute(VERTEX, random.uniform(0, 1, v).astype(np.float32))
    a["root_uv"] = Attribute(STRAND, random.uniform(0, 1, (s, 2)).astype(np.float32), "uv")
    a["group"] = Attribute(STRAND, random.integers(0, 3, s).astype(np.int32))
    a["guide"] = Attribute(STRAND, (np.arange(s) % 5 == 0).astype(np.int32))
    a["id"] = Attribute(STRAND, np.arange(s, dtype=np.int32))
    closest = 5 * random.integers(0, (s + 4) // 5, (s, 3))
    a["closest_guides"] = Attribute(STRAND, closest.astype(np.int32))
    weights = random.uniform(0.1, 1, (s, 3))
    weights /= weights.sum(axis=1)[:, None]
    a["guide_weights"] = Attribute(STRAND, weights.astype(np.float32))
    a["roughness"] = Attribute(VERTEX, random.uniform(0, 1, v).astype(np.float32))
    a["stiffness"] = Attribute(STRAND, random.uniform(0, 1, s).astype(np.float32))
    return groom


class ConvertTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        """Return a path in the folder of the test."""
        return os.path.join(self.folder, name)

    def write(self, groom, name, *options):
        """Write a groom, and return the path and the sentences of the report."""
        from hairconvert.formats import write_groom
        report, path = Report(), self.path(name)
        arguments = make_parser().parse_args(["convert", "x.hair", path, *options])
        write_groom(groom, path, path, arguments, report)
        return path, report.sentences

    def read(self, path, *options):
        """Read a groom as the command line does."""
        arguments = make_parser().parse_args(["convert", path, "x.hair", *options])
        self.report = Report()
        return read_groom(path, arguments, self.report)

    def convert(self, *arguments):
        """Run hair-convert in this process. Return the exit status and the text of stderr."""
        error, out = io.StringIO(), io.StringIO()
        with contextlib.redirect_stderr(error), contextlib.redirect_stdout(out):
            try:
                status = run(make_parser().parse_args([str(a) for a in arguments]))
            except SystemExit as end:
                status = end.code
        self.out = out.getvalue()
        return status, error.getvalue()

    def guarded(self, *arguments):
        """Run hair-convert as a user does, in a child process. Return status and stderr."""
        errors = self.path(".stderr")
        status = server.run([str(a) for a in arguments], errors)
        with open(errors, "rb") as file:
            said = file.read().decode(errors="replace")
        os.remove(errors)
        return status, said

    def assert_same_strands(self, a, b, tolerance=1e-5):
        """Compare positions, to a fraction of the length of each strand."""
        np.testing.assert_array_equal(a.counts, b.counts)
        error = np.linalg.norm(a.points - b.points, axis=1)
        allowed = np.repeat(np.maximum(lengths(a), 1e-9), a.counts) * tolerance
        # Positions have the precision of single precision numbers of their size.
        allowed = np.maximum(allowed, np.abs(a.points).max(axis=1) * 2 ** -22)
        self.assertTrue((error <= allowed).all(), f"a vertex is {(error / allowed).max():.3g} "
                        "times the tolerance away")

    def assert_same_attributes(self, a, b, names, tolerance=0.0):
        """Compare attributes at the finer of the two scopes."""
        for name in names:
            self.assertIn(name, b.attributes)
            finer = max((a.attributes[name].scope, b.attributes[name].scope),
                        key=["groom", "strand", "vertex"].index)
            x, y = a.values(name, finer), b.values(name, finer)
            if tolerance:
                np.testing.assert_allclose(y, x, rtol=tolerance, atol=tolerance, err_msg=name)
            else:
                np.testing.assert_array_equal(y, x, err_msg=name)
