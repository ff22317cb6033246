"""The cases: haircuts, colours and lights, and the scene files of hair-capture for them."""

import math
from dataclasses import dataclass

SIZE = 512
# Roughness along and around a fibre, and tilt of its scales in rad. Mitsuba 3.9 crashes with less
# roughness along the fibre, because exp(-2 / variance) of transmitted light underflows.
ALONG, AROUND, TILT = 0.32, 0.4, 0.05
REFRACTION = 1.55
ELEVATION = math.radians(25)  # of the sun
EYE, TARGET, FIELD_OF_VIEW = (0.0, 1.55, 1.6), (0.0, 1.5, 0.0), 22.0
SUN = 3.0  # irradiance of the sun
SKY = 1.5  # irradiance of the sky
LAMPS = (  # position, m, and intensity
    ((0.9, 2.1, 1.2), (3.2, 3.0, 2.7)),
    ((-1.2, 1.7, 0.7), (1.0, 1.1, 1.3)),
    ((0.3, 2.2, -1.3), (2.0, 2.0, 2.0)),
)

COLORS = {  # reflectance of dense hair, linear rgb
    "blond": (0.72, 0.55, 0.31),
    "brown": (0.26, 0.13, 0.06),
    "red": (0.34, 0.095, 0.028),
    "black": (0.018, 0.0163, 0.017),
    "white": (0.9, 0.89, 0.86),
}
AZIMUTHS = (0, 45, 90, 135, 180)  # of the sun, from the eye, degrees


@dataclass(frozen=True)
class Haircut:
    """A haircut of hair-capture, and its strands."""

    look: str
    segments: int  # of a strand
    strands: int
    radius: float  # of a strand, m


HAIRCUTS = {
    "straight": Haircut("natural", 24, 36000, 8e-5),
    "wavy": Haircut("wavy", 48, 18000, 1.1e-4),
    "curly": Haircut("curly", 64, 15000, 1.2e-4),
}


@dataclass(frozen=True)
class Light:
    """The light of a case: the sun of an azimuth, three lamps or a uniform sky."""

    name: str
    azimuth: float = 0.0

    def suns(self):
        """Return unit directions to suns and their irradiances."""
        if self.name != "sun":
            return []
        turn, across = math.radians(self.azimuth), math.cos(ELEVATION)
        way = (math.sin(turn) * across, math.sin(ELEVATION), math.cos(turn) * across)
        return [(way, (SUN, SUN, SUN))]

    def lamps(self):
        return LAMPS if self.name == "lamps" else ()

    def sky(self):
        return SKY if self.name == "sky" else 0.0


@dataclass(frozen=True)
class Case:
    haircut: str
    color: str
    light: Light

    @property
    def name(self):
        light = self.light.name + (f"{self.light.azimuth:g}" if self.light.name == "sun" else "")
        return f"{self.haircut}-{self.color}-{light}"

    @property
    def reflectance(self):
        return COLORS[self.color]

    def scene(self, size=SIZE):
        """Return the scene of hair-capture. Nothing but hair is in it."""
        haircut = HAIRCUTS[self.haircut]
        settings = {
            "look": haircut.look, "strand.segments": haircut.segments,
            "strand.radius": haircut.radius, "strand.taper": 1,
            "followers": haircut.strands, "color.spread": 0, "color.hue_spread": 0,
            "shading.roughness.along": ALONG, "shading.roughness.round": AROUND,
            "shading.cuticle_tilt": TILT, "shading.cuticle_tilt_spread": 0,
            "self_shadow.method": "strands",
        }
        for end in ("root", "tip"):
            for channel, value in zip("rgb", self.reflectance):
                settings[f"color.{end}.{channel}"] = value
        lights = [{"direction": list(way), "color": list(color), "shadow": True}
                  for way, color in self.light.suns()]
        lights += [{"kind": "point", "position": list(at), "color": list(color), "shadow": True}
                   for at, color in self.light.lamps()]
        first = {"direction": [0, 0, 1], "color": [0, 0, 0]}
        if self.light.name == "sun":
            first = {key: lights[0][key] for key in ("direction", "color")}
            lights = []
        first["ambient"] = [self.light.sky()] * 3
        return {
            "style": "long", "head": False, "colliders": [], "motion": "still", "settle": 0.2,
            "show": "hair", "size": [size, size], "exposure": 1, "light": first, "lights": lights,
            "camera": {"eye": list(EYE), "target": list(TARGET), "fov": FIELD_OF_VIEW},
            "background": {"centre": [0, 0, 0], "edge": [0, 0, 0]}, "settings": settings,
        }


def all_cases():
    """Return every case, with the sun, three lamps and the sky."""
    lights = [Light("sun", azimuth) for azimuth in AZIMUTHS] + [Light("lamps"), Light("sky")]
    return [Case(haircut, color, light) for haircut in HAIRCUTS for color in COLORS
            for light in lights]


def absorption(reflectance):
    """Return the absorption per radius of hair with a reflectance (Chiang et al. 2016, eq. 9)."""
    b = AROUND
    d = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + 0.245 * b))))
    return [(math.log(value) / d) ** 2 for value in reflectance]
