"""Names of attributes. The model has short names, files have those of Unreal's groom schema."""

# Names in the model and in files.
SCHEMA = {
    "guide": "groom_guide",
    "group": "groom_group_id",
    "group_name": "groom_group_name",
    "root_uv": "groom_root_uv",
    "id": "groom_id",
    "color": "groom_color",
    "roughness": "groom_roughness",
    "width": "groom_width",
    "closest_guides": "groom_closest_guides",
    "guide_weights": "groom_guide_weights",
}
TO_MODEL = {theirs: ours for ours, theirs in SCHEMA.items()}
# The number of components, if a file stores them as a flat array.
COMPONENTS = {"root_uv": 2, "color": 3, "closest_guides": 3, "guide_weights": 3}
ROLES = {"color": "color", "root_uv": "uv"}
# Factors of strands of the library, by their names in the model and in files other than .groom, with
# their ranges. A .groom file has the names without "hair_".
FACTORS = {
    "hair_stiffness": (0, 100),
    "hair_damping": (0, 100),
    "hair_shape_frequency": (0, 100),
    "hair_gravity_preload": (0, 100),
    "hair_clump": (0, 1),
    "hair_curl_radius": (0, 4),
    "hair_curl_frequency": (0, 4),
    "hair_frizz": (0, 4),
    "hair_roughness": (0.2, 4),
    "hair_radius": (0, 4),
    "hair_length": (0.01, 1),
    "hair_density": (0, 1),
}
# Attributes that describe a file, not its strands.
METADATA = ("groom_version_major", "groom_version_minor", "groom_tool", "groom_properties")
