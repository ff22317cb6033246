"""Round trips of real haircuts. HAIR_CONVERT_DATA names a folder that has some."""

import os
import pathlib
import unittest

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
