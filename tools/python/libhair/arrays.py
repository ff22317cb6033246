"""Arrays of numpy as arrays of the library, and back."""

import numpy as np

from ._native import ffi


def floats(values, width, name):
    """Return values as an array of rows of floats."""
    out = np.ascontiguousarray(values, dtype=np.float32)
    if out.size % width:
        raise ValueError(f"{name} has {out.size} numbers, which is no multiple of {width}")
    return out.reshape(-1, width)


def integers(values, name):
    """Return values as an array of unsigned integers of 32 bits."""
    out = np.asarray(values)
    if out.size and (out.dtype.kind not in "iu" or out.min() < 0 or out.max() > 0xFFFFFFFF):
        raise ValueError(f"{name} must be integers from 0 to 4294967295")
    return np.ascontiguousarray(out, dtype=np.uint32).ravel()


def small_integers(values, count, name):
    """Return `count` values as an array of unsigned integers of 8 bits."""
    out = integers(values, name)
    if len(out) != count or (count and out.max() > 255):
        raise ValueError(f"{name} must be {count} integers from 0 to 255")
    return out.astype(np.uint8)


def pointer(kind, array):
    return ffi.cast(kind + "*", ffi.from_buffer(array))


def matrix(transform):
    """Return a matrix of numpy, which has rows first, as the column-major array of the library."""
    out = np.asarray(transform, dtype=np.float32)
    if out.shape != (4, 4):
        raise ValueError(f"a transform is a 4x4 matrix, and this array has the shape {out.shape}")
    return np.ascontiguousarray(out.T)


def array(pointer, count, width, dtype):
    """Return a copy of an array of the library, or None for NULL."""
    if pointer == ffi.NULL:
        return None
    data = np.frombuffer(ffi.buffer(pointer, count * width * np.dtype(dtype).itemsize), dtype).copy()
    return data.reshape(count, width) if width > 1 else data
