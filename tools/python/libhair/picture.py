"""Pictures of hair as arrays, and PNG files of them."""

import math
import struct
import zlib

import numpy as np

from ._native import ffi
from .settings import CLASSES

COLOR, DEPTH, MULTISAMPLED = 0x8C43, 0x81A6, 0x8D41  # GL_SRGB8_ALPHA8, GL_DEPTH_COMPONENT24, GL_RENDERBUFFER
READ, DRAW, BOTH = 0x8CA8, 0x8CA9, 0x8D40
FUNCTIONS = {
    "GetIntegerv": "void(*)(unsigned, int*)",
    "CreateFramebuffers": "void(*)(int, unsigned*)",
    "CreateRenderbuffers": "void(*)(int, unsigned*)",
    "DeleteFramebuffers": "void(*)(int, const unsigned*)",
    "DeleteRenderbuffers": "void(*)(int, const unsigned*)",
    "NamedRenderbufferStorageMultisample": "void(*)(unsigned, int, unsigned, int, int)",
    "NamedFramebufferRenderbuffer": "void(*)(unsigned, unsigned, unsigned, unsigned)",
    "BindFramebuffer": "void(*)(unsigned, unsigned)",
    "BlitNamedFramebuffer": "void(*)(unsigned, unsigned, int, int, int, int, int, int, int, int, unsigned, unsigned)",
    "Viewport": "void(*)(int, int, int, int)",
    "Enable": "void(*)(unsigned)",
    "ClearColor": "void(*)(float, float, float, float)",
    "Clear": "void(*)(unsigned)",
    "PixelStorei": "void(*)(unsigned, int)",
    "ReadPixels": "void(*)(int, int, int, int, unsigned, unsigned, void*)",
}


class _GL:
    """The functions of OpenGL that a picture needs."""

    def __init__(self, context):
        for name, kind in FUNCTIONS.items():
            address = context.get_proc(ffi.new("char[]", b"gl" + name.encode()), ffi.NULL)
            setattr(self, name, ffi.cast(kind, address))

    def check_limit(self, name, value, limit):
        """Raise an error for a value that is not in [1, limit], or for samples not in [0, limit]."""
        most, least = ffi.new("int*"), 0 if name == "samples" else 1
        self.GetIntegerv(limit, most)
        if not least <= value <= most[0]:
            raise ValueError(f"{name} is {value}, not in [{least}, {most[0]}]")


class _Target:
    """A framebuffer with a color and a depth attachment, bound while the with statement runs."""

    def __init__(self, gl, width, height, samples):
        self.gl, self.names = gl, ffi.new("unsigned[3]")
        gl.CreateFramebuffers(1, self.names)
        gl.CreateRenderbuffers(2, self.names + 1)
        for i, (format, attachment) in enumerate(((COLOR, 0x8CE0), (DEPTH, 0x8D00)), 1):
            gl.NamedRenderbufferStorageMultisample(self.names[i], samples, format, width, height)
            gl.NamedFramebufferRenderbuffer(self.names[0], attachment, MULTISAMPLED, self.names[i])

    def __enter__(self):
        self.gl.BindFramebuffer(BOTH, self.names[0])
        return self

    def __exit__(self, *_):
        self.gl.BindFramebuffer(BOTH, 0)
        self.gl.DeleteRenderbuffers(2, self.names + 1)
        self.gl.DeleteFramebuffers(1, self.names)


def look_at(eye, target, up=(0, 1, 0)):
    """Return the matrix from the world to a view, for column vectors."""
    eye = np.asarray(eye, dtype=float)
    back = eye - np.asarray(target, dtype=float)
    back /= np.linalg.norm(back)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    out = np.eye(4)
    out[:3, :3] = right, np.cross(back, right), back
    out[:3, 3] = -out[:3, :3] @ eye
    return out


def perspective(angle, aspect, near=0.05, far=50.0):
    """Return a projection by the vertical field of view in radians."""
    scale = 1 / math.tan(angle / 2)
    out = np.diag([scale / aspect, scale, (far + near) / (near - far), 0])
    out[2, 3], out[3, 2] = 2 * far * near / (near - far), -1
    return out


def render(hairs, eye, target, size=(640, 480), *, angle=0.5, samples=4, background=(0.16, 0.19, 0.24, 1),
           lights=None, view=None, lod=None):  # fmt: skip
    """Draw hair of one context without a window, and return sRGB pixels, rows from the top, as rgba of 8 bits.

    `background` is linear. `view` is a View whose matrices are replaced.
    """
    context, (width, height) = hairs[0].context, size
    if context.has_window:
        raise ValueError("render() needs a context of Context(), which has no window")
    context.make_current()
    gl = _GL(context)
    for name, value, limit in (("width", width, 0x84E8), ("height", height, 0x84E8), ("samples", samples, 0x8D57)):
        gl.check_limit(name, value, limit)
    view = CLASSES["View"]() if view is None else view.copy()
    view.view, view.projection = look_at(eye, target), perspective(angle, width / height)
    pixels = np.empty((height, width, 4), dtype=np.uint8)
    with _Target(gl, width, height, 0) as resolved:
        with _Target(gl, width, height, samples) as target:
            gl.Viewport(0, 0, width, height)
            gl.Enable(0x0B71)  # GL_DEPTH_TEST
            gl.Enable(0x8DB9)  # GL_FRAMEBUFFER_SRGB
            gl.ClearColor(*map(float, background))
            gl.Clear(0x4100)
            for hair in hairs:
                hair.draw(view, lights, lod)
            corners = (0, 0, width, height) * 2
            gl.BlitNamedFramebuffer(target.names[0], resolved.names[0], *corners, 0x4000, 0x2600)
        gl.BindFramebuffer(READ, resolved.names[0])
        gl.PixelStorei(0x0D05, 1)
        gl.ReadPixels(0, 0, width, height, 0x1908, 0x1401, ffi.from_buffer(pixels))
    return pixels[::-1].copy()


def write_png(path, pixels):
    """Write an array of height x width x 3 or 4 values of 8 bits as a PNG file."""
    pixels = np.ascontiguousarray(pixels)
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise ValueError(f"pixels are {pixels.dtype} of the shape {pixels.shape}, not uint8 of height x width x 3 or 4")
    height, width, channels = pixels.shape
    rows = np.zeros((height, 1 + width * channels), dtype=np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6 if channels == 4 else 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))
