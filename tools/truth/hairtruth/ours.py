"""Pictures and strands of hair-capture."""

import json
import os
import subprocess

import numpy as np

HEADER = np.dtype([("name", "S8"), ("version", "<u4"), ("strands", "<u4"), ("vertices", "<u4"),
                   ("frames", "<u4"), ("first", "<u4"), ("followers", "<u4"), ("fps", "<f8")])


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
    header = np.fromfile(path, HEADER, 1)[0]
    if header["name"] != b"HAIRDUMP" or header["version"] != 1:
        raise RuntimeError(f"{path} is no dump of version 1")
    shape = (int(header["strands"]), int(header["vertices"]), 3)
    return np.fromfile(path, "<f4", int(np.prod(shape)), offset=HEADER.itemsize).reshape(shape)
