"""Bounded reading of binary files."""

import os

import numpy as np

from hairconvert.report import InputError


MAX_FILE = 1 << 34  # bytes


def load(path):
    """Return the bytes of a file."""
    if os.path.getsize(path) > MAX_FILE:
        raise InputError(f"the file is larger than {MAX_FILE} bytes")
    with open(path, "rb") as file:
        return file.read()


class Bytes:
    """The content of a file. Every access is checked against its size."""

    def __init__(self, data):
        self.data = data

    def __len__(self):
        return len(self.data)

    def array(self, what, at, count, dtype):
        """Return `count` numbers from byte `at` on, or refuse the file."""
        dtype = np.dtype(dtype)
        end = at + count * dtype.itemsize
        if count < 0 or at < 0 or end > len(self.data):
            raise InputError(f"the {what} from byte {at} to {end} exceed the file of "
                             f"{len(self.data)} bytes")
        return np.frombuffer(self.data, dtype, count, at)

    def number(self, what, at, dtype="<u4"):
        """Return one number at a byte."""
        return self.array(what, at, 1, dtype)[0].item()


def to_linear(srgb):
    """Return linear colours of sRGB colours."""
    srgb = np.asarray(srgb, np.float64)
    high = np.power((np.maximum(srgb, 0.04045) + 0.055) / 1.055, 2.4)
    return np.where(srgb <= 0.04045, srgb / 12.92, high)


def to_srgb(linear):
    """Return sRGB colours of linear colours."""
    linear = np.asarray(linear, np.float64)
    high = 1.055 * np.power(np.maximum(linear, 0.0031308), 1 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, linear * 12.92, high)
