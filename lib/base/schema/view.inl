BEGIN(hair_lod)
FLOAT(hair_lod, strand_fraction, 1, 0, 1, 0, 1, LINEAR, "", "Maximum fraction of the strands that are drawn.")
FLOAT(hair_lod, segment_fraction, 1, 0, 1, 0, 1, LINEAR, "",
      "Maximum fraction of hair_look.strand.segments per strand.")
FLOAT(hair_lod, width_exponent, 1, 0, 2, 0, 2, LINEAR, "", "Exponent e of the width.")
BOOL(hair_lod, per_patch, true,
      "Selection by the size on the screen of each patch of strands, by the members below.")
FLOAT(hair_lod, strand_pixels, 0.25, 0.01, 100, 0.1, 4, LOG, "pixels",
      "Minimum width of a strand on the screen.")
FLOAT(hair_lod, segment_pixels, 1.5, 0.1, 1000, 1, 32, LOG, "pixels",
      "Minimum length of a segment on the screen.")
FLOAT(hair_lod, min_strand_fraction, 0.05, 0.001, 1, 0.01, 1, LOG, "",
      "Minimum fraction of the strands of a patch that are drawn.")
FLOAT(hair_lod, importance, 1, 0, 1000, 0.1, 10, LOG, "",
      "Factor of the projected size that selects the level of detail.")
FLOAT(hair_lod, occluded_importance, 1, 0, 1, 0, 1, LINEAR, "",
      "Factor of the projected size of hair behind the head, whose position is estimated from the roots.")
FLOAT(hair_lod, light_pixels, 128, 0, 10000, 0, 512, LINEAR, "pixels",
      "Size of hair at rest on the screen up to which its light is computed in every second frame only.")
FLOAT(hair_lod, motion_pixels, 0, 0, 10000, 0, 512, LINEAR, "pixels",
      "Size of hair at rest on the screen up to which only every second hair_step() moves it.")
FLOAT(hair_lod, guide_pixels, 0, 0, 10000, 0, 512, LINEAR, "pixels",
      "Size of hair at rest on the screen up to which only half of the guides are simulated.")
END
BEGIN(hair_shader_desc)
POINTER(hair_shader_desc, label, "Name in error messages, as in \"label:12: ...\".")
POINTER(hair_shader_desc, glsl, "Text of the shader, without #version.")
ENUM(hair_shader_desc, at, HAIR_SHADE_VERTICES,
      "Shader stage in which the application's shading runs.", "vertices", "pixels")
END
BEGIN(hair_light)
ENUM(hair_light, kind, HAIR_LIGHT_DIRECTIONAL, "Kind of a light.", "directional", "point", "spot")
VECTOR(hair_light, direction, 0.4, 0.8, 0.45, -1e6, 1e6, -1, 1, "",
      "Direction to the light in the world, of any length other than 0.")
VECTOR(hair_light, position, 0, 0, 0, -1e9, 1e9, -10, 10, "m", "Position of a point or spot in the world.")
COLOR(hair_light, color, 3, 3, 3, 0, 1e6, 0, 10, "", "Irradiance, linear rgb.")
FLOAT(hair_light, range, 0, 0, 1e6, 0, 100, LINEAR, "m",
      "Distance beyond which a point or spot does not shine.")
FLOAT(hair_light, source_radius, 0.05, 0.001, 1000, 0.01, 1, LOG, "m",
      "Distance below which the light of a point or spot does not increase any more.")
FLOAT(hair_light, inner_angle, 0.3, 0, 1.57, 0, 1.57, LINEAR, "radians",
      "Half angle of the cone in which a spot has full brightness.")
FLOAT(hair_light, outer_angle, 0.5, 0, 1.57, 0, 1.57, LINEAR, "radians",
      "Half angle of the cone outside which a spot does not shine.")
TEXTURE(hair_light, hair_shadow_map,
      "2D depth texture of the hair, rendered from the light with HAIR_PASS_DEPTH.")
MATRIX(hair_light, shadow_matrix, IDENTITY, "Transform from the world to the clip space of both shadow maps.")
TEXTURE(hair_light, opaque_shadow_map,
      "2D depth texture of opaque geometry, such as head, clothes and walls, rendered from the light.")
FLOAT(hair_light, opaque_bias, 0.003, 0, 1, 0, 0.02, LINEAR, "m",
      "Distance behind opaque_shadow_map up to which hair is lit.")
ENUM(hair_light, shadow_depth_range, HAIR_DEPTH_RANGE_CURRENT,
      "Range of depth in the clip space of shadow_matrix, that with which both shadow maps were drawn.",
      "current", "negative_one_to_one", "zero_to_one")
BOOL(hair_light, shadow_depth_reversed, false, "Reversed depth of both shadow maps.")
#undef GROUP
#define GROUP "hair_shadow_part"
UINT(hair_light, hair_shadow_part.layer, 0, 0, 65535, 0, 15, LINEAR, "",
      "Layer of an array, or face of a cube map in the order of OpenGL.")
PAIR(hair_light, hair_shadow_part.offset, 0, 0, "x", "y", 0, 1, 0, 1, LINEAR, "",
      "Lower left corner of a rectangle of an atlas, as a fraction of the texture.")
PAIR(hair_light, hair_shadow_part.size, 1, 1, "x", "y", 1e-4, 1, 1e-4, 1, LINEAR, "",
      "Width and height of the rectangle, as fractions of the texture.")
#undef GROUP
#define GROUP "opaque_shadow_part"
UINT(hair_light, opaque_shadow_part.layer, 0, 0, 65535, 0, 15, LINEAR, "",
      "Layer of an array, or face of a cube map in the order of OpenGL.")
PAIR(hair_light, opaque_shadow_part.offset, 0, 0, "x", "y", 0, 1, 0, 1, LINEAR, "",
      "Lower left corner of a rectangle of an atlas, as a fraction of the texture.")
PAIR(hair_light, opaque_shadow_part.size, 1, 1, "x", "y", 1e-4, 1, 1e-4, 1, LINEAR, "",
      "Width and height of the rectangle, as fractions of the texture.")
#undef GROUP
#define GROUP ""
END
BEGIN(hair_view)
ENUM(hair_view, pass, HAIR_PASS_COLOR,
      "Output of a draw.", "color", "depth", "guides", "colliders", "motion", "id", "wind", "opacity")
ENUM(hair_view, render_path, HAIR_RENDER_PATH_AUTO,
      "Way in which followers become pixels.", "tessellation", "cached", "compute", "auto", "procedural")
ENUM(hair_view, primitive, HAIR_PRIMITIVE_RIBBONS, "Primitive that strands are drawn as.", "ribbons", "lines")
MATRIX(hair_view, view, IDENTITY, "World to view.")
MATRIX(hair_view, projection, IDENTITY, "View to clip space, without jitter.")
POINTER(hair_view, lights, "Lights, light_count of them.")
UINT(hair_view, light_count, 1, 0, 16, 0, 4, LINEAR, "", "Number of lights.")
COLOR(hair_view, ambient, 0.35, 0.35, 0.35, 0, 1e6, 0, 2, "",
      "Irradiance of uniform surroundings, linear rgb.")
POINTER(hair_view, sky,
      "Radiance of the surroundings, added to `ambient`, as 9 spherical harmonics of rgb each.")
ENUM(hair_view, slice, HAIR_SLICE_NONE,
      "Slice of HAIR_PASS_COLLIDERS and HAIR_PASS_WIND.", "none", "x", "y", "z")
FLOAT(hair_view, slice_at, 0.5, 0, 1, 0, 1, LINEAR, "",
      "Position of the slice along its axis, as a fraction of the field's box.")
POINTER(hair_view, lod, "Level of detail.")
POINTER(hair_view, shader, "Shader of HAIR_PASS_COLOR, from the context of the instance.")
ENUM(hair_view, coverage, HAIR_COVERAGE_MSAA,
      "Antialiasing of strands that are thinner than a pixel.", "msaa", "alpha")
FLOAT(hair_view, opacity, 1, 0, 1, 0, 1, LINEAR, "",
      "Opacity of the covered area, for HAIR_COVERAGE_ALPHA and HAIR_PASS_OPACITY.")
PAIR(hair_view, jitter, 0, 0, "x", "y", -64, 64, -0.5, 0.5, LINEAR, "pixels",
      "Displacement of the image to the right and up, for temporal antialiasing.")
UINT(hair_view, frame_index, 0, 0, UINT32_MAX, 0, UINT32_MAX, LINEAR, "",
      "Number of the frame, for motion vectors and HAIR_SELF_SHADOW_STRANDS.")
MATRIX(hair_view, prev_view, IDENTITY, "`view` of the previous frame.")
MATRIX(hair_view, prev_projection, IDENTITY, "`projection` of the previous frame.")
TEXTURE(hair_view, color_texture,
      "2D texture of linear colours, sampled at the root's hair_groom_desc.scalp_uvs with the texture's "
      "own filter.")
TEXTURE(hair_view, occluder_depth, "2D depth texture of your opaque geometry, for occlusion culling.")
MATRIX(hair_view, occluder_matrix, ZEROS,
      "Transform from the world to the clip space of occluder_depth, which may be that of the previous "
      "frame.")
ENUM(hair_view, encode, HAIR_ENCODING_LINEAR, "Encoding of what HAIR_PASS_COLOR writes.", "linear", "srgb")
BOOL(hair_view, motion_output, false,
     "Motion vectors as a second output of HAIR_PASS_COLOR, into draw buffer 1, which has floats like the "
     "target of HAIR_PASS_MOTION.")
END
BEGIN(hair_buffers)
UINT(hair_buffers, attributes, HAIR_ATTRIBUTE_POSITION, 0, 127, 0, 127, LINEAR, "",
      "Attributes to provide, bits of hair_attribute.")
UINT(hair_buffers, frame_index, 0, 0, UINT32_MAX, 0, UINT32_MAX, LINEAR, "",
      "Number of the frame.")
END
