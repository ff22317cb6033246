"""Pictures and strands of hair-capture."""

import json
import os
import subprocess
from types import SimpleNamespace

from hairconvert import dump as dumps


def draw(program, case, size, folder, strands=False):
    """Draw a case into an EXR file. Return its path, and that of a dump of the strands or None."""
    scene = os.path.join(folder, f"{case.name}.json")
    picture = os.path.join(folder, f"{case.name}.exr")
    dump = os.path.join(folder, f"{case.haircut}.dump") if strands else None
    with open(scene, "w", encoding="utf-8") as file:
        json.dump(case.scene(size), file, indent=1)
    command = [program, scene, "--frames", "0:1", "-o", picture, "--quiet"]
    if dump:
        command += ["--dump-followers", dump]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode:
        raise RuntimeError(f"{case.name}: hair-capture failed: {done.stderr.strip()}")
    return picture, dump


def read_strands(path):
    """Return the positions of a dump as an array of strands, vertices and coordinates, m."""
    groom = dumps.read(path, SimpleNamespace(frame=None), None)
    return groom.points.reshape(groom.strand_count(), -1, 3)
