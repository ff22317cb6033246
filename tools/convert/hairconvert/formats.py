"""The table of formats, and reading and writing through it."""

import dataclasses
import importlib
import os

import numpy as np

from hairconvert.binary import load
from hairconvert.groom import (Attribute, Motion, check_counts, clean, place, resample, reverse,
                               select, unplace)
from hairconvert.report import InputError, MissingPackage, UsageError, find_reason



@dataclasses.dataclass
class Format:
    """A file format by the endings of its names."""

    name: str
    endings: tuple
    reader: str  # module with read()
    writer: str = ""  # module with write(), empty if the format is only read
    from_path: bool = False  # read() takes a path instead of bytes
    unit: float = 1.0  # metres of one unit, if the file does not tell
    keeps_motion: bool = False
    keeps_scalp: bool = False


FORMATS = [
    Format(".hair", (".hair",), "hairfile", "hairfile"),
    Format(".groom", (".groom",), "groomfile", "groomfile", keeps_scalp=True),
    Format(".tfx", (".tfx",), "tfx", "tfx"),
    Format(".data", (".data",), "usc", "usc"),
    Format("OBJ", (".obj",), "obj", "obj"),
    Format("USD", (".usda", ".usdc", ".usd"), "usd_read", "usd_write", from_path=True, keeps_motion=True),
    Format("Alembic", (".abc",), "alembic_read", "alembic_write", from_path=True, unit=0.01,
           keeps_motion=True),
    Format("dump", (".dump",), "dump", from_path=True),
    Format("USDZ", (".usdz",), "usd_read", from_path=True),
]


def find_format(path, to_write=False):
    """Return the format of a file by the ending of its name."""
    for f in FORMATS:
        if str(path).lower().endswith(f.endings) and (f.writer or not to_write):
            return f
    endings = [e for f in FORMATS if f.writer or not to_write for e in f.endings]
    raise UsageError(f"the name {path} does not end in one of {', '.join(endings)}")


def _load_module(f, name):
    """Import a format when it is needed, because packages of some formats may be missing."""
    try:
        return importlib.import_module(f"hairconvert.{name}")
    except ImportError as error:
        raise MissingPackage(f"{f.name} needs the Python module {error.name}, which is missing: "
                             "make convert installs its package") from None


def read_groom(path, options, report):
    """Return the groom of a file, in metres with +y up, after the options of the input."""
    f = find_format(path)
    module = _load_module(f, f.reader)
    if not os.path.isfile(path):
        raise InputError("there is no such file")
    groom = refuse_errors(module.read, path if f.from_path else load(path), options, report)
    check_counts(len(groom.counts), len(groom.points))
    if groom.motion:
        read = groom.motion.read
        groom.motion = Motion(groom.motion.times, lambda i: refuse_errors(read, i))
    groom = clean(groom, report)
    groom = place(groom, options.scale or groom.unit or f.unit, options.up or groom.up or "y")
    if options.tip_first:
        groom = reverse(groom)
    groom = _take(groom, options.take, report)
    return resample(groom, options.vertices) if options.vertices else groom


def refuse_errors(call, *arguments):
    """Turn the many kinds of errors that packages raise for malformed files into one."""
    try:
        return call(*arguments)
    except (InputError, UsageError, MemoryError):
        raise
    except Exception as error:
        raise InputError(f"the file cannot be read: {find_reason(error)}") from error


def _take(groom, what, report):
    """Return the guides or the strands between guides, if the groom distinguishes both."""
    guide = groom.values("guide", "strand") if "guide" in groom.attributes else None
    if what == "all" or guide is None:
        return groom
    keep = guide.astype(bool) if what == "guides" else ~guide.astype(bool)
    if not keep.any():
        raise InputError(f"there are no {what} among the {len(keep)} strands")
    if not keep.all():
        report.say(f"{(~keep).sum()} strands are left out, because --take selects {what}")
    return select(groom, keep)


def write_groom(groom, path, name, options, report):
    """Write a groom to a path in the format of the final name."""
    f = find_format(name, to_write=True)
    module = _load_module(f, f.writer)
    if options.width and "width" not in groom.attributes:
        groom.attributes["width"] = Attribute("groom", np.array([options.width], np.float32))
    if groom.motion and not f.keeps_motion:
        report.lose(f"the motion of {len(groom.motion)} frames",
                    f"a {f.name} file holds one pose: --frame chooses the pose")
    if groom.scalp and not f.keeps_scalp and not getattr(options, "scalp", None):
        report.lose("the scalp", f"a {f.name} file holds strands only: hair-convert scalp writes it")
    scale, up = options.output_scale or f.unit, options.output_up or "y"
    module.write(unplace(groom, scale, up), path, options, report)
