"""Contexts and hair."""

import threading

import numpy as np

from ._native import call, current_loader, egl, ffi, hair, host, new_desc, to_dict
from .arrays import floats, integers, matrix, pointer
from .settings import CLASSES

_current = threading.local()
SOURCES = {"guides": "HAIR_READ_GUIDES", "smooth": "HAIR_READ_SMOOTH", "followers": "HAIR_READ_FOLLOWERS"}


class Context:
    """The objects of the library in an OpenGL context.

    Context() makes an OpenGL context without a window, on the EGL device of an index or, for -1, on the first
    that works. Context(current=True) takes the OpenGL context of EGL or GLX that is current on this thread,
    such as that of a window. It is then up to the caller to keep that context current. `get_proc` replaces
    the search for the functions of OpenGL: it takes a name as bytes, and returns an address as an integer or
    as a pointer of cffi.

    Close a context, or use it in a with statement. Its hair is closed with it.
    """

    def __init__(self, device=-1, *, current=False, get_proc=None, **members):
        self._c = self._egl = None
        if not current:
            out = ffi.new("hair_egl**")
            call(egl().hair_egl_create, host, device, out)
            self._egl = out[0]
            _current.context = self
        desc, out = CLASSES["ContextDesc"](members), ffi.new("hair_context**")
        desc._c.host = host
        if current and get_proc is None:
            get_proc = current_loader()
        if get_proc is None:
            self.get_proc = egl().hair_egl_get_proc
        else:
            self.get_proc = ffi.callback(
                "void*(const char*, void*)", lambda name, _user: ffi.cast("void*", get_proc(ffi.string(name)) or 0)
            )
        desc._c.get_proc = self.get_proc
        try:
            call(hair.hair_context_create, desc._c, out)
        except Exception:
            self.close()
            raise
        self._c = out[0]

    @property
    def has_window(self):
        """Whether the caller has made the OpenGL context."""
        return self._egl is None

    def make_current(self):
        """Make the context without a window current on this thread, as every call of its hair does."""
        if self._c is None and self._egl is None:
            raise ValueError("the context is closed")
        if self._egl is not None and getattr(_current, "context", None) is not self:
            call(egl().hair_egl_make_current, self._egl)
            _current.context = self

    def close(self):
        """Destroy the context with all its hair."""
        if self._c is not None:
            self.make_current()
            hair.hair_context_destroy(self._c)
            self._c = None
        if self._egl is not None:
            egl().hair_egl_destroy(self._egl)
            self._egl = None
            if getattr(_current, "context", None) is self:
                _current.context = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def set_budget(self, ms):
        """Limit the GPU time of a frame to `ms`. 0 disables the limit. See hair_set_budget()."""
        call(hair.hair_set_budget, self._c, ms)

    @property
    def memory(self):
        """The numbers of hair_memory."""
        out = new_desc("hair_memory")
        self.make_current()
        call(hair.hair_get_memory, self._c, out)
        return to_dict(out[0])


class Hair:
    """The simulated hair of one head. `members` are those of Desc.

    A transform is a 4x4 matrix of numpy from the groom to the world, for column vectors. Close hair, or use
    it in a with statement.
    """

    def __init__(self, context, groom, *, look=None, physics=None, transform=None, **members):
        desc, out = CLASSES["Desc"](members), ffi.new("hair_instance**")
        if look is not None:
            desc._point("look", look._c)
        if physics is not None:
            desc._point("physics", physics._c)
        if transform is not None:
            desc.transform = transform
        context.make_current()
        call(hair.hair_create, context._c, groom._c, desc._c, out)
        self._c, self.context, self._kept = out[0], context, []

    def _call(self, function, *arguments):
        if self._c is None or self.context._c is None:
            raise ValueError("the hair is closed")
        self.context.make_current()
        call(function, self._c, *arguments)

    def close(self):
        """Destroy the hair."""
        if self._c is not None:
            if self.context._c is not None:
                self.context.make_current()
            hair.hair_destroy(self._c)
            self._c = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def step(self, dt):
        """Advance the simulation by a time in s."""
        self._call(hair.hair_step, dt)

    def reset(self):
        """Put every strand at rest under the current transform."""
        self._call(hair.hair_reset)

    @property
    def transform(self):
        """The pose of the head. Setting it moves the head in the next step."""
        out = ffi.new("float[16]")
        self._call(hair.hair_get_transform, out)
        return np.array(list(out), dtype=np.float32).reshape(4, 4).T

    @transform.setter
    def transform(self, transform):
        self._call(hair.hair_set_transform, pointer("float", matrix(transform)))

    def teleport(self, transform):
        """Move the head together with the hair."""
        self._call(hair.hair_teleport, pointer("float", matrix(transform)))

    def set_scalp(self, positions, to_world=None):
        """Set the positions of the scalp's vertices. None places them in the world."""
        points = floats(positions, 3, "positions")
        space = ffi.NULL if to_world is None else pointer("float", matrix(to_world))
        self._call(hair.hair_set_scalp, pointer("float", points), len(points), 12, space)

    def set_scalp_weights(self, joints, weights, joint_count):
        """Give each vertex of the scalp four joints and their weights, as rows. None removes the joints."""
        if joints is None:
            self._call(hair.hair_set_scalp_weights, ffi.NULL, ffi.NULL, 0, 0)
            return
        indices, own = integers(joints, "joints"), floats(weights, 4, "weights")
        if indices.size != own.size:
            raise ValueError(f"joints has {indices.size} numbers, and weights has {own.size}")
        if indices.size and indices.max() > 0xFFFF:
            raise ValueError("joints must be integers from 0 to 65535")
        indices = indices.astype(np.uint16)
        self._call(hair.hair_set_scalp_weights, pointer("uint16_t", indices), pointer("float", own),
                   len(own), joint_count)

    def set_scalp_joints(self, matrices, to_world=None):
        """Skin the scalp by a 4x4 matrix per joint. None places the joints in the world."""
        own = np.ascontiguousarray([matrix(one) for one in matrices], dtype=np.float32)
        space = ffi.NULL if to_world is None else pointer("float", matrix(to_world))
        self._call(hair.hair_set_scalp_joints, pointer("float", own), len(own), space)

    def _get(self, title, function):
        out = CLASSES[title]()
        self._call(function, out._c)
        return out

    @property
    def look(self):
        """A copy of the look. Setting it changes the hair."""
        return self._get("Look", hair.hair_get_look)

    @look.setter
    def look(self, look):
        self._call(hair.hair_set_look, look._c)

    @property
    def physics(self):
        """A copy of the physics. Setting it changes the hair."""
        return self._get("Physics", hair.hair_get_physics)

    @physics.setter
    def physics(self, physics):
        self._call(hair.hair_set_physics, physics._c)

    def group_look(self, group):
        """Return a copy of the look of a group of strands."""
        out = CLASSES["GroupLook"]()
        self._call(hair.hair_get_group_look, group, out._c)
        return out

    def set_group_look(self, group, look):
        """Set the look of a group of strands. None selects the defaults."""
        self._call(hair.hair_set_group_look, group, ffi.NULL if look is None else look._c)

    def group_physics(self, group):
        """Return a copy of the physics of a group of strands."""
        out = CLASSES["Physics"]()
        self._call(hair.hair_get_group_physics, group, out._c)
        return out

    def set_group_physics(self, group, physics):
        """Set the physics of a group of strands. None gives the group those of the hair."""
        self._call(hair.hair_set_group_physics, group, ffi.NULL if physics is None else physics._c)

    @property
    def wind(self):
        """A copy of the wind, without its sources. Setting it changes the hair. None disables it."""
        out = self._get("Wind", hair.hair_get_wind)
        out._c.sources, out._c.source_count = ffi.NULL, 0
        return out

    @wind.setter
    def wind(self, wind):
        self.set_wind(wind)

    def set_wind(self, wind, sources=()):
        """Set the wind with local sources, which are of WindSource."""
        if wind is not None:
            wind = wind.copy()
            wind._point("sources", _structs("hair_wind_source", sources))
            wind._c.source_count = len(sources)
        self._call(hair.hair_set_wind, ffi.NULL if wind is None else wind._c)

    def set_colliders(self, colliders):
        """Replace the colliders, which are of Collider. set_mesh() gives a collider a mesh."""
        array = _structs("hair_collider", colliders)
        self._call(hair.hair_set_colliders, array, len(colliders), ffi.sizeof("hair_collider"))

    def set_pins(self, pins):
        """Replace the pins, which are of Pin."""
        self._call(hair.hair_set_pins, _structs("hair_pin", pins), len(pins), ffi.sizeof("hair_pin"))

    def lengths(self, count, first=0):
        """Return the fractions of their lengths that `count` guides have."""
        out = np.empty(count, dtype=np.float32)
        self._call(hair.hair_get_lengths, first, count, pointer("float", out))
        return out

    def set_lengths(self, fractions, first=0):
        """Cut guides from `first` on to fractions of their lengths in the groom, or let them grow to these."""
        own = floats(fractions, 1, "fractions")
        self._call(hair.hair_set_lengths, first, len(own), pointer("float", own))

    def cut(self, shape=None, /, *, pieces=False, **members):
        """Cut strands where they first meet a shape, which is a CutDesc or its members.

        Return the numbers of cut strands and guides and the lost length as a dict, and what falls off as Hair
        of free strands. The latter is None without `pieces`, or if nothing falls off.
        """
        desc = CLASSES["CutDesc"]() if shape is None else shape.copy()
        desc.update(members)
        info, out = new_desc("hair_cut_info"), ffi.new("hair_instance**")
        self._call(hair.hair_cut, desc._c, info, out if pieces else ffi.NULL)
        fallen = None
        if out[0] != ffi.NULL:
            fallen = Hair.__new__(Hair)
            fallen._c, fallen.context, fallen._kept = out[0], self.context, []
        return to_dict(info[0]), fallen

    @property
    def bounds(self):
        """The lower and the upper corner of the hair in the world."""
        lower, upper = ffi.new("float[3]"), ffi.new("float[3]")
        self._call(hair.hair_get_bounds, lower, upper)
        return np.array([list(lower), list(upper)], dtype=np.float32)

    def read(self, source="guides"):
        """Return the positions of "guides", "smooth" guides or "followers", a row xyz for each vertex.

        Followers have look.strand.segments + 1 vertices each.
        """
        if source not in SOURCES:
            raise ValueError(f"the source is {source!r}, not one of {', '.join(SOURCES)}")
        kind, count = getattr(hair, SOURCES[source]), ffi.new("uint32_t*")
        self._call(hair.hair_read_positions, kind, ffi.NULL, 0, count)
        out = np.empty((count[0], 3), dtype=np.float32)
        self._call(hair.hair_read_positions, kind, pointer("float", out), count[0], count)
        return out

    @property
    def solver_stats(self):
        """The numbers of hair_solver_stats."""
        out = new_desc("hair_solver_stats")
        self._call(hair.hair_get_solver_stats, out)
        return to_dict(out[0])

    def save(self):
        """Return the state of the motion as bytes."""
        size = ffi.new("size_t*")
        self._call(hair.hair_save, ffi.NULL, 0, size)
        out = ffi.new("char[]", size[0])
        self._call(hair.hair_save, out, size[0], size)
        return bytes(ffi.buffer(out, size[0]))

    def load(self, state):
        """Restore a state of save()."""
        state = bytes(state)
        self._call(hair.hair_load, state, len(state))

    def draw(self, view, lights=None, lod=None):
        """Draw into the bound framebuffer and viewport, with View, a list of Light, and Lod."""
        self._call(hair.hair_draw, _with(view, lights, lod)._c)


def _with(view, lights, lod):
    """Return a copy of a view with lights and a level of detail."""
    view = view.copy()
    if lights is not None:
        view._point("lights", _structs("hair_light", lights))
        view._c.light_count = len(lights)
    if lod is not None:
        view._point("lod", lod._c)
    return view


def _list_of(hairs):
    hairs = list(hairs)
    for one in hairs:
        if one._c is None or one.context._c is None:
            raise ValueError("the hair is closed")
    if hairs:
        hairs[0].context.make_current()
    return ffi.new("hair_instance*[]", [one._c for one in hairs]), len(hairs)


def step_list(hairs, dt):
    """Advance all hair of a list by a time in s. A GPU computes them side by side."""
    call(hair.hair_step_list, *_list_of(hairs), dt)


def draw_list(hairs, view, lights=None, lod=None):
    """Draw all hair of a list in their order, as Hair.draw() draws one."""
    call(hair.hair_draw_list, *_list_of(hairs), _with(view, lights, lod)._c)


def set_mesh(collider, mesh):
    """Give a Collider the shape of a CollisionMesh."""
    collider["shape"] = "mesh"
    collider._point("mesh", mesh._c)


def _structs(name, settings):
    """Return structs of settings as one array."""
    array = ffi.new(name + "[]", len(settings))
    for i, one in enumerate(settings):
        array[i] = one._c[0]
    return array
