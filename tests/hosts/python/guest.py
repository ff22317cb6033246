"""Hair in the OpenGL context of a host in Python."""

import logging
import os
import sys

import cffi
import libhair
import numpy as np

SIZE = 96
_ffi = cffi.FFI()

# These enumerants of OpenGL are integers of a host that hair may change while it draws.
STATE = {
    "CURRENT_PROGRAM": 0x8B8D, "VERTEX_ARRAY_BINDING": 0x85B5, "ARRAY_BUFFER_BINDING": 0x8894,
    "UNIFORM_BUFFER_BINDING": 0x8A28, "SHADER_STORAGE_BUFFER_BINDING": 0x90D3,
    "DRAW_INDIRECT_BUFFER_BINDING": 0x8F43, "DISPATCH_INDIRECT_BUFFER_BINDING": 0x90EF,
    "DRAW_FRAMEBUFFER_BINDING": 0x8CA6, "READ_FRAMEBUFFER_BINDING": 0x8CAA, "ACTIVE_TEXTURE": 0x84E0,
    "TEXTURE_BINDING_2D": 0x8069, "SAMPLER_BINDING": 0x8919, "VIEWPORT": 0x0BA2, "SCISSOR_BOX": 0x0C10,
    "SCISSOR_TEST": 0x0C11, "DEPTH_TEST": 0x0B71, "DEPTH_WRITEMASK": 0x0B72, "DEPTH_FUNC": 0x0B74,
    "CULL_FACE": 0x0B44, "FRONT_FACE": 0x0B46, "BLEND": 0x0BE2, "BLEND_SRC_RGB": 0x80C9,
    "BLEND_DST_RGB": 0x80C8, "BLEND_SRC_ALPHA": 0x80CB, "BLEND_DST_ALPHA": 0x80CA, "COLOR_WRITEMASK": 0x0C23,
    "PATCH_VERTICES": 0x8E72, "PRIMITIVE_RESTART": 0x8F9D, "UNPACK_ALIGNMENT": 0x0CF5, "STENCIL_TEST": 0x0B90,
    "LINE_WIDTH": 0x0B21, "MULTISAMPLE": 0x809D, "SAMPLE_ALPHA_TO_COVERAGE": 0x809E,
}  # fmt: skip


class Guest(logging.Handler):
    """Hair on a head 1.5 m above the ground, and the warnings and errors of the library."""

    def __init__(self, **context):
        super().__init__(logging.WARNING)
        self.sentences, self.changes = [], set()
        logging.getLogger("libhair").addHandler(self)
        groom = libhair.Groom(libhair.Asset.generate("long"), follower_count=4000)
        self.context = libhair.Context(current=True, **context)
        self.hair = libhair.Hair(self.context, groom, look=libhair.Look({"strand.radius": 4e-4}))
        self.get_error = self._function("glGetError", "unsigned(*)(void)")
        self._get_integers = self._function("glGetIntegerv", "void(*)(unsigned, int*)")

    def _function(self, name, kind):
        return _ffi.cast(kind, self.context.get_proc(_ffi.new("char[]", name.encode()), _ffi.NULL))

    def _state(self):
        out, values = {}, _ffi.new("int[16]")
        for name, value in STATE.items():
            self._get_integers(value, values)
            out[name] = list(values[0:4])
        return out

    def emit(self, record):
        """Keep a sentence."""
        self.sentences.append(record.getMessage())

    def draw(self, view, projection):
        """Step and draw into the host's framebuffer, which does not encode. Note state that is not restored."""
        before = self._state()
        self.hair.step(1 / 60)
        self.hair.draw(libhair.View(view=view, projection=projection, encode="srgb"))
        after = self._state()
        self.changes |= {name for name in STATE if before[name] != after[name]}

    def stop(self):
        """Destroy the hair."""
        self.hair.close()
        self.context.close()


def check(guest, before, with_hair, after):
    """Compare the host's pixels. The host hides the left half of the hair, and the rest shows hair.

    All pictures are arrays of SIZE x SIZE pixels.
    """
    half = SIZE // 2
    hidden, shown = slice(0, half - 1), slice(half + 1, SIZE)
    assert before.shape[:2] == (SIZE, SIZE), before.shape
    assert len(np.unique(before.reshape(SIZE * SIZE, -1), axis=0)) >= 2, "the host draws nothing"
    count = 0
    for picture in with_hair:
        different = (picture != before).any(axis=2)
        count = int(different[:, shown].sum())
        assert different[:, hidden].sum() == 0, f"{different[:, hidden].sum()} pixels of the host differ"
        assert count > SIZE * SIZE / 20, f"hair covers only {count} pixels"
    for picture in after:
        assert (picture == before).all(), f"{(picture != before).any(axis=2).sum()} pixels differ after hair"
    assert not guest.sentences, guest.sentences
    assert not guest.changes, f"hair leaves changed: {sorted(guest.changes)}"
    return count


def check_refusal():
    """Expect the sentence for an old context."""
    try:
        libhair.Context(current=True)
    except libhair.HairOpenGLError as error:
        assert str(error) == "the OpenGL context is version 3.3, not 4.5 or newer", str(error)
        return
    raise AssertionError("the library takes a context of OpenGL 3.3")


def missing(package):
    """Stop a program that needs a package."""
    sys.exit(f"{os.path.basename(sys.argv[0])} needs the package {package} of PyPI: make test-hosts-python installs it.")
