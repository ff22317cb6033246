"""The shared libraries, errors and the log.

The declarations come from the headers, by make_cdef.py, when the wheel is made. No struct is described a
second time here.
"""

import logging
import pathlib
import threading

import cffi

FOLDER = pathlib.Path(__file__).parent
LOG = logging.getLogger("libhair")

ffi = cffi.FFI()
ffi.cdef((FOLDER / "libhair.cdef").read_text("utf-8"))
hair = ffi.dlopen(str(FOLDER / "libhair.so"))
_egl = []
_thread = threading.local()


class HairError(Exception):
    """A call of the library that has failed. The text is the sentence of the library's log."""


class HairArgumentError(HairError, ValueError):
    """A value is outside its documented range."""


class HairMemoryError(HairError, MemoryError):
    """Memory is refused, by the system, the driver or a limit."""


class HairOpenGLError(HairError):
    """No OpenGL context is current, or the driver has failed."""


class HairFileError(HairError):
    """Bytes are unreadable, or not in the format that they claim."""


class HairVersionError(HairError):
    """The headers of the package and the shared library differ."""


class HairContextLostError(HairOpenGLError):
    """The driver has lost the OpenGL context."""


ERRORS = {
    hair.HAIR_ERROR_ARGUMENT: HairArgumentError,
    hair.HAIR_ERROR_MEMORY: HairMemoryError,
    hair.HAIR_ERROR_OPENGL: HairOpenGLError,
    hair.HAIR_ERROR_FILE: HairFileError,
    hair.HAIR_ERROR_VERSION: HairVersionError,
    hair.HAIR_ERROR_CONTEXT_LOST: HairContextLostError,
}


@ffi.callback("void(hair_log_level, const char*, void*)")
def _log(level, sentence, _user):
    text = ffi.string(sentence).decode("utf-8", "replace")
    if level == hair.HAIR_LOG_ERROR:
        _errors().append(text)
    LOG.log(logging.WARNING if level == hair.HAIR_LOG_WARNING else logging.DEBUG, "%s", text)


host = ffi.new("hair_host*")
host.log = _log


def _errors():
    if not hasattr(_thread, "errors"):
        _thread.errors = []
    return _thread.errors


def egl():
    """Return libhair_egl. The library is loaded on first use, because it needs libEGL of the system."""
    if not _egl:
        _egl.append(ffi.dlopen(str(FOLDER / "libhair_egl.so")))
    return _egl[0]


_loader_ffi = cffi.FFI()
_loader_ffi.cdef("""
    void* eglGetCurrentContext(void);
    void* glXGetCurrentContext(void);
    void* glXGetProcAddressARB(const char*);
""")


def current_loader():
    """Return a function that finds functions of the current OpenGL context by name, or None for one of EGL.

    Hosts make their contexts by EGL or by GLX. The libraries of both exist wherever a host uses them.
    """
    try:
        if _loader_ffi.dlopen("libEGL.so.1").eglGetCurrentContext():
            return None
        glx = _loader_ffi.dlopen("libGL.so.1")
    except OSError:
        return None
    return glx.glXGetProcAddressARB if glx.glXGetCurrentContext() else None


def call(function, *arguments):
    """Call a function that returns a hair_result. Raise the error that the result stands for."""
    errors = _errors()
    errors.clear()
    result = function(*arguments)
    if result != hair.HAIR_OK:
        text = errors[0] if errors else ffi.string(hair.hair_result_string(result)).decode()
        raise ERRORS.get(result, HairError)(text)


def new_desc(name):
    """Return a new struct with all defaults, by the function name_init of the library."""
    desc = ffi.new(name + "*")
    size = ffi.sizeof(name)
    init = getattr(hair, name + "_init")
    takes_header = ffi.typeof(init).args[1] is ffi.typeof("hair_struct_header")
    init(desc, ffi.new("hair_struct_header*", [size, hair.HAIR_VERSION])[0] if takes_header else size)
    return desc


def to_dict(struct):
    """Return the numbers of a struct as a dict. Pointers and the header are left out."""
    out = {}
    for name, field in ffi.typeof(struct).fields:
        of_pointers = field.type.kind == "array" and field.type.item.kind == "pointer"
        if name == "header" or field.type.kind == "pointer" or of_pointers:
            continue
        value = getattr(struct, name)
        if field.type.kind == "struct":
            value = to_dict(value)
        elif field.type.kind == "array":
            value = tuple(value)
        out[name] = value
    return out
