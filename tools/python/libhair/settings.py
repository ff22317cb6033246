"""Structs of settings, whose members are read and written by name.

hair_describe() of the library lists the members. The values pass through hair_set_member() and
hair_get_member(), which check ranges.
"""

import dataclasses

import numpy as np

from ._native import call, ffi, hair, host, new_desc
from .arrays import matrix

_members = {}


@dataclasses.dataclass(frozen=True)
class Member:
    """A member of a struct, as the library describes it."""

    name: str
    group: str
    unit: str
    about: str
    type: str  # float, uint, uint64, bool, enum, texture or pointer
    layout: str  # scalar, vector, color, curve, matrix or array
    offset: int
    size: int
    count: int
    elements: tuple
    defaults: tuple
    min: float
    max: float
    slider_min: float
    slider_max: float
    is_logarithmic: bool
    has_auto: bool
    choices: tuple


def _lower(enum, value, prefix):
    return ffi.typeof(enum).elements[value].removeprefix(prefix).lower()


def _text(pointer):
    return ffi.string(pointer).decode()


def _member(c):
    elements = () if c.elements == ffi.NULL else tuple(_text(c.elements[i]) for i in range(c.count))
    choices = () if c.choices == ffi.NULL else tuple(_text(c.choices[i]) for i in range(c.choice_count))
    defaults = () if c.defaults == ffi.NULL else tuple(c.defaults[0 : c.count])
    return Member(
        name=_text(c.name), group=_text(c.group), unit=_text(c.unit), about=_text(c.about),
        type=_lower("hair_member_type", c.type, "HAIR_MEMBER_"),
        layout=_lower("hair_member_layout", c.layout, "HAIR_LAYOUT_"),
        offset=c.offset, size=c.size, count=c.count, elements=elements, defaults=defaults,
        min=c.min, max=c.max, slider_min=c.slider_min, slider_max=c.slider_max,
        is_logarithmic=c.is_logarithmic, has_auto=c.has_auto, choices=choices,
    )  # fmt: skip


def describe(kind):
    """Return the members of a struct by name, in their order."""
    if kind not in _members:
        size = ffi.sizeof("hair_member")
        out = ffi.new("hair_member[]", hair.hair_describe(kind, ffi.NULL, 0, size))
        hair.hair_describe(kind, out, len(out), size)
        _members[kind] = {member.name: member for member in map(_member, out)}
    return _members[kind]


def _to_text(value):
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if hasattr(value, "tolist"):
        return _to_text(value.tolist())
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_to_text, value))
    if isinstance(value, int):
        return str(value)
    return repr(float(value))


def _from_text(member, text):
    parse = {"float": float, "bool": lambda t: t in ("true", "on", "1"), "enum": str}.get(member.type, int)
    values = tuple(parse(part.strip()) for part in text.split(","))
    return values if len(values) > 1 else values[0]


class Group:
    """The members of a struct whose names begin with that of a group, such as look.strand."""

    def __init__(self, struct, prefix):
        object.__setattr__(self, "_struct", struct)
        object.__setattr__(self, "_prefix", prefix)

    def __getattr__(self, name):
        return self._struct._find(self._prefix + name)

    def __setattr__(self, name, value):
        self._struct[self._prefix + name] = value

    def __dir__(self):
        return [name[len(self._prefix) :] for name in self._struct if name.startswith(self._prefix)]


class Settings:
    """A struct with all defaults, and then with the given members.

    Names are those of hair_set_member(): look["strand.radius"], look["gravity.y"] or look["taper[3]"].
    The attribute look.strand.radius is the same member. A tuple sets all elements of a member. A matrix is a
    4x4 array for column vectors.
    """

    _kind = None

    def __init__(self, members=None, /, **more):
        object.__setattr__(self, "_c", new_desc(_text(hair.hair_struct_name(self._kind))))
        object.__setattr__(self, "_kept", [])
        self.update(members or {}, **more)

    @classmethod
    def members(cls):
        """Return the descriptions of the members, in their order."""
        return list(describe(cls._kind).values())

    def _sized(self):
        return self._kind, self._c, ffi.sizeof(self._c[0])

    def _field(self, name):
        struct = self._c[0]
        *groups, last = name.split(".")
        for group in groups:
            struct = getattr(struct, group)
        return struct, last

    def __getitem__(self, name):
        member = describe(self._kind).get(name)
        if member and member.type == "texture":
            return getattr(*self._field(name))
        text = ffi.new("char[512]")
        call(hair.hair_get_member, host, *self._sized(), name.encode(), text, 512, ffi.NULL)
        # The name of an element begins with that of its member.
        while member is None:
            name = name[: max(name.rfind("."), name.rfind("["))]
            member = describe(self._kind).get(name)
        value = _from_text(member, _text(text))
        if member.layout == "matrix" and isinstance(value, tuple):
            return np.array(value, dtype=np.float32).reshape(4, 4).T
        return value

    def __setitem__(self, name, value):
        member = describe(self._kind).get(name)
        if member and member.type == "texture":
            setattr(*self._field(name), int(value))
            return
        if member and member.layout == "matrix":
            value = matrix(value).ravel()
        call(hair.hair_set_member, host, *self._sized(), name.encode(), _to_text(value).encode())

    def __iter__(self):
        return iter(describe(self._kind))

    def _find(self, name):
        members = describe(self._kind)
        if name in members:
            return self[name]
        if any(member.startswith(name + ".") for member in members):
            return Group(self, name + ".")
        raise AttributeError(f"{type(self).__name__} has no member {name}")

    def __getattr__(self, name):
        return self._find(name)

    def __setattr__(self, name, value):
        self[name] = value

    def __dir__(self):
        return sorted({*super().__dir__(), *(name.split(".")[0] for name in self)})

    def update(self, members=(), /, **more):
        """Set several members: look.update({"strand.radius": 3e-4}) or physics.update(damping=2)."""
        for name, value in {**dict(members), **more}.items():
            self[name] = value

    def copy(self):
        """Return a copy."""
        out = type(self)()
        out._assign(self._c[0])
        out._kept.extend(self._kept)
        return out

    def _assign(self, struct):
        ffi.buffer(self._c)[:] = ffi.buffer(ffi.addressof(struct))

    def _point(self, name, pointer):
        """Set a pointer of the struct, and keep its target."""
        setattr(*self._field(name), pointer)
        self._kept.append(pointer)

    def to_json(self, base=None):
        """Return the members as JSON. Those that are equal in `base` are left out."""
        sized = (host, *self._sized(), base._c if base is not None else ffi.NULL)
        length = ffi.new("size_t*")
        call(hair.hair_write_json, *sized, ffi.NULL, 0, length)
        text = ffi.new("char[]", length[0] + 1)
        call(hair.hair_write_json, *sized, text, length[0] + 1, length)
        return _text(text)

    def from_json(self, text):
        """Set the members that a JSON object names. Nothing is changed if the object is refused."""
        text = text.encode() if isinstance(text, str) else bytes(text)
        call(hair.hair_read_json, host, *self._sized(), text, len(text))

    def __repr__(self):
        return f"{type(self).__name__}({self.to_json(type(self)())})"


def _make_classes():
    """Return a class for each struct of hair_struct, such as Look for hair_look."""
    out = {}
    for kind in range(hair.HAIR_STRUCT_COUNT):
        name = _text(hair.hair_struct_name(kind))
        title = name.removeprefix("hair_").title().replace("_", "")
        about = f"The settings of {name}.\n\n" + "\n".join(
            f"{member.name}: {member.about}" for member in describe(kind).values()
        )
        out[title] = type(title, (Settings,), {"_kind": kind, "__doc__": about, "__module__": "libhair"})
    return out


CLASSES = _make_classes()
