"""The commands of the tutorial that need hair-convert, but not Blender."""

import os
import subprocess

from tests.support import ConvertTest

RUN = os.path.join(os.path.dirname(__file__), "..", "tutorial", "run.sh")


class TutorialTest(ConvertTest):
    def test_commands_make_scalp_film_and_motion(self):
        tool = os.environ.get("HAIR_GROOM")
        if not tool:
            self.fail("HAIR_GROOM does not name the program hair-groom")
        done = subprocess.run(["sh", RUN, os.path.dirname(tool), self.folder, "sh", "convert"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("scalp.obj", "head.png", "shake.mp4", "shake.usdc", "shake.abc"):
            self.assertTrue(os.path.getsize(self.path(name)), name)
        groom = self.read(self.path("shake.usdc"))
        self.assertEqual(len(groom.motion), 4)
        self.assertEqual(set(groom.values("group", "strand")), {0, 1})
