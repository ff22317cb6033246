BEGIN(hair_asset_desc)
POINTER(hair_asset_desc, host, "Callbacks.")
POINTER(hair_asset_desc, import, "Conversion of the strands.")
END
BEGIN(hair_style_desc)
POINTER(hair_style_desc, host, "Callbacks.")
ENUM(hair_style_desc, style, HAIR_STYLE_LONG,
      "Built-in haircuts, on the built-in scalp.", "long", "bob", "short", "ponytail", "curly", "afro", "fringe",
      "fade", "bun", "braid")
UINT(hair_style_desc, guide_count, 166, 16, 4096, 64, 1024, LINEAR, "",
      "Number of guides, spread evenly over the scalp.")
AUTO_UINT(hair_style_desc, strand_vertices, 0, 256, 0, 64, LINEAR, "",
      "Number of vertices per guide, at least 2.")
FLOAT(hair_style_desc, length, 1, 0.1, 4, 0.25, 2, LINEAR, "", "Multiple of the lengths of the style.")
UINT(hair_style_desc, seed, 1, 0, UINT32_MAX, 0, 100, LINEAR, "", "Seed of all random choices.")
END
