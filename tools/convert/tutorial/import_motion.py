"""Import simulated hair into Blender without a window, and draw a frame.

    python import_motion.py HAIR.usdc FRAME PICTURE.png
"""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import make_groom


def main(path, frame, picture):
    """Import the hair through the add-on."""
    make_groom.blender_addon.register()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if bpy.ops.hair.import_cache(filepath=path) != {"FINISHED"}:
        return 1
    bpy.context.scene.frame_set(int(frame))
    make_groom.render(picture)
    return 0


if __name__ == "__main__":
    RESULT = main(*sys.argv[1:4])
    sys.stdout.flush()
    os._exit(RESULT)  # Blender as a module can hang at the end of Python.
