"""Round trips of real haircuts. HAIR_CONVERT_DATA names a folder that has some."""

import os
import pathlib
import unittest

from hairconvert import tfxmesh
from hairconvert.formats import FORMATS
from tests.support import ConvertTest

FOLDER = os.environ.get("HAIR_CONVERT_DATA")


@unittest.skipUnless(FOLDER, "HAIR_CONVERT_DATA names no folder with haircuts")
class RealDataTest(ConvertTest):
    def test_round_trips(self):
        endings = tuple(e for f in FORMATS for e in f.endings)
        files = [p for p in sorted(pathlib.Path(FOLDER).rglob("*")) if p.name.endswith(endings)]
        self.assertTrue(files, f"{FOLDER} has no haircut")
        for source in files:
            groom = self.read(str(source))
            for f in FORMATS:
                if not f.writer:
                    continue
                for ending in f.endings:
                    with self.subTest(source=source.name, ending=ending):
                        path, _ = self.write(groom, "a" + ending)
                        self.assert_same_strands(groom, self.read(path))

    def test_joints_of_strands_equal_those_of_the_artist(self):
        folders = [p.parent for p in pathlib.Path(FOLDER).rglob("*.tfxbone")]
        for folder in folders:
            bones = next(folder.glob("*.tfxbone"))
            haircut, mesh = bones.with_suffix(".tfx"), next(folder.glob("*.tfxmesh"))
            status, said = self.convert("convert", haircut, self.path("a.tfx"), "--scalp", mesh,
                                        "--bones", self.path("a.tfxbone"))
            self.assertEqual(status, 0, said)
            ours, theirs = (_read_weights(p) for p in (self.path("a.tfxbone"), bones))
            error = [sum(abs(a.get(k, 0) - b.get(k, 0)) for k in a.keys() | b.keys())
                     for a, b in zip(ours, theirs, strict=True)]
            self.assertLess(sum(error) / len(error), 0.01)


def _read_weights(path):
    """Return the weight of each joint of each strand by the name of the joint."""
    with open(path, "rb") as file:
        names, joints, weights = tfxmesh.read_bones(file.read())
    return [{names[j]: w for j, w in zip(*row) if w > 1e-3}
            for row in zip(joints.tolist(), weights.tolist())]
