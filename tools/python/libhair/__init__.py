"""Strand hair, simulated and drawn by libhair.

    import libhair
    with libhair.Context() as context:
        groom = libhair.Groom(libhair.Asset.generate("long"))
        hair = libhair.Hair(context, groom, look=libhair.Look({"strand.radius": 2e-4}))
        hair.step(1 / 60)
        libhair.write_png("hair.png", libhair.render([hair], (0, 1.6, 1.2), (0, 1.55, 0)))

Settings are classes with the members of the structs of libhair: Look, Physics, Wind, View and so on. Help on
a class, such as help(libhair.Look), lists the members. A refused value raises HairError with the library's
sentence. Warnings go to the logger "libhair".
"""

from ._native import (
    HairArgumentError,
    HairContextLostError,
    HairError,
    HairFileError,
    HairMemoryError,
    HairOpenGLError,
    HairVersionError,
    hair as _hair,
)
from .haircut import Asset, CollisionMesh, Groom
from .objects import Context, Hair, draw_list, set_mesh, step_list
from .picture import look_at, perspective, render, write_png
from .settings import CLASSES as _CLASSES, Member, Settings

globals().update(_CLASSES)
__version__ = "{0}.{1}.{2}".format(*(_hair.hair_version() // d % 100 for d in (10000, 100, 1)))
__all__ = [
    "Asset", "CollisionMesh", "Context", "Groom", "Hair", "Member", "Settings", "draw_list", "set_mesh", "step_list",
    "look_at", "perspective", "render", "write_png",
    "HairError", "HairArgumentError", "HairContextLostError", "HairFileError", "HairMemoryError",
    "HairOpenGLError", "HairVersionError", *_CLASSES,
]  # fmt: skip
