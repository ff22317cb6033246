// passes.inl - every pass: its name in code, its name in reports, its features, and its definitions
// and stages under glsl/. A stage after NAME? exists only in programs compiled with NAME. A stage
// after !NAME? exists only in programs compiled without NAME. The enums, the compiler, the tests
// and `make glsl` read this table.
#ifndef FEATURE
#define FEATURE(name, define)
#endif
#ifndef PASS
#define PASS(name, label, category, features, stages)
#endif
#ifndef CATEGORY
#define CATEGORY(name, label)
#endif

// Categories of passes in reports, in their order: name in code, name in reports. Passes that draw
// depth or opacity count as DEPTH or OPACITY, whatever their category.
CATEGORY(RESET, "reset")
CATEGORY(ROTATE_STATE, "rotate_state")
CATEGORY(UNPACK_POSITIONS, "unpack_positions")
CATEGORY(SKIN_SCALP, "skin_scalp")
CATEGORY(ROOT_TRANSFORMS, "root_transforms")
CATEGORY(WIND, "wind")
CATEGORY(HAIR_GRID, "hair_grid")
CATEGORY(ACTIVITY, "activity")
CATEGORY(DIAGNOSE, "diagnose")
CATEGORY(IMPULSES, "impulses")
CATEGORY(SOLVE, "solve")
CATEGORY(TARGETS, "targets")
CATEGORY(SMOOTH, "smooth")
CATEGORY(BIND_FOLLOWERS, "bind_followers")
CATEGORY(FIELD, "field")
CATEGORY(HIT, "hit")
CATEGORY(REPAIR, "repair")
CATEGORY(EXPAND, "expand")
CATEGORY(SELF_SHADOW, "self_shadow")
CATEGORY(OCCLUSION, "occlusion")
CATEGORY(SCAN_STRANDS, "scan_strands")
CATEGORY(COMPACT_STRANDS, "compact_strands")
CATEGORY(GUIDES, "guides")
CATEGORY(AIR, "air")
CATEGORY(COLLIDERS, "colliders")
CATEGORY(DEPTH, "depth")
CATEGORY(OPACITY, "opacity")
CATEGORY(COLOR, "color")

// Optional features of programs. A program contains only the features that its scene needs.
// Programs are made when first needed, with any combination of features.
FEATURE(ROD, "HAIR_ROD") // Guides are rods, with frames.
FEATURE(WIND, "HAIR_WIND") // Wind blows.
FEATURE(PINNED, "HAIR_PINNED") // Vertices are pinned.
FEATURE(SKINNED, "HAIR_SKINNED") // Roots move with a skinned scalp.
FEATURE(TARGETS, "HAIR_TARGETS") // Guides are blended with targets.
FEATURE(GROUP_DAMPING, "HAIR_GROUP_DAMPING") // Groups of guides have damping of their own.
FEATURE(HAIR_GRID, "HAIR_GRID") // The hair-hair grid acts on guides.
// One thread per guide. Otherwise one work group per guide.
FEATURE(THREAD_PER_GUIDE, "HAIR_THREAD_PER_GUIDE")
FEATURE(PASS1, "HAIR_PASS1") // Only the solver's own method.
FEATURE(PASS2, "HAIR_PASS2") // Only guides at which PASS1 failed.
FEATURE(MIXED, "HAIR_MIXED") // Rotations and forces of segments are the unknowns of guides.
FEATURE(COLLIDERS, "HAIR_COLLIDERS") // Colliders are near. Without COLLIDER_GRID there are few.
FEATURE(COLLIDER_GRID, "HAIR_COLLIDER_GRID") // Any number of colliders.

// Few guides, which have registers to cache what they read, since they wait for memory.
FEATURE(FEW_GUIDES, "HAIR_FEW_GUIDES")
FEATURE(BODIES, "HAIR_BODIES") // Some colliders are not capsules.
FEATURE(MESHES, "HAIR_MESHES") // Some colliders are collision meshes.
FEATURE(DEFORMING, "HAIR_DEFORMING") // Some colliders are bodies that deform.
FEATURE(NUMBERS, "HAIR_NUMBERS") // The field has the numbers of colliders.
FEATURE(IMPULSES, "HAIR_IMPULSES") // The impulses of colliders are recorded.
FEATURE(HITS, "HAIR_HITS") // Some followers are inside colliders.
FEATURE(DEPTH, "HAIR_DEPTH") // Depth without colour.
FEATURE(FIBRES, "HAIR_FIBRES") // HAIR_SHADING_FIBRES. Otherwise HAIR_SHADING_LINES.
FEATURE(LINES, "HAIR_LINES") // Lines. Otherwise ribbons.
FEATURE(STYLED, "HAIR_STYLED") // The look kinks, curls or cuts followers.
FEATURE(LENGTHS, "HAIR_LENGTHS") // Followers have been cut.
FEATURE(GROUP_LOOKS, "HAIR_GROUP_LOOKS") // Groups of strands have factors of the look.
FEATURE(STRAND_FACTORS, "HAIR_STRAND_FACTORS") // Single strands have factors of the look.
FEATURE(ROOT_UV, "HAIR_ROOT_UV") // Strands have colours or positions on the scalp of their own.
FEATURE(GROOM_COLORS, "HAIR_GROOM_COLORS") // Strands have the groom's colours.
FEATURE(IDS, "HAIR_IDS") // Numbers in place of colour.
FEATURE(MOTION, "HAIR_MOTION") // Velocities, in place of colour without MOTION_OUTPUT.
FEATURE(MOTION_OUTPUT, "HAIR_MOTION_OUTPUT") // Velocities beside colour.
FEATURE(ALPHA_COVERAGE, "HAIR_ALPHA_COVERAGE") // Strands cover fractions of pixels.
FEATURE(OPAQUE_SHADOWS, "HAIR_OPAQUE_SHADOWS") // Opaque geometry blocks lights.
FEATURE(BATCH, "HAIR_BATCH") // Segments of many heads are rasterised together.
FEATURE(SHADED, "HAIR_SHADED") // A compute pass has shaded the vertices.
// Strands may be wider to compensate for strands that are left out.
FEATURE(WIDENED, "HAIR_WIDENED")
FEATURE(OCCLUSION, "HAIR_OCCLUSION") // Occlusion culling may have hidden patches.

// Sizes of work groups with one work group per guide and one thread per vertex. In a group of 256
// threads for a guide of 32 vertices most threads would be idle.
#define SIZES HAIR_GL_SIZES
#define WITH(name) HAIR_GL_WITH(name)
#define STRAND_FEATURES \
    SIZES | WITH(WIND) | WITH(PINNED) | WITH(SKINNED) | WITH(HAIR_GRID) | WITH(THREAD_PER_GUIDE) | \
        WITH(COLLIDERS) | WITH(COLLIDER_GRID) | WITH(BODIES) | WITH(MESHES) | WITH(DEFORMING) | \
        WITH(FEW_GUIDES) | WITH(GROUP_DAMPING)
#define RECORDED_FEATURES STRAND_FEATURES | WITH(IMPULSES)
// The shape of followers.
#define STYLE_FEATURES WITH(STYLED) | WITH(LENGTHS) | WITH(GROUP_LOOKS) | WITH(STRAND_FACTORS)
#define DRAW_FEATURES \
    WITH(DEPTH) | WITH(FIBRES) | WITH(LINES) | STYLE_FEATURES | WITH(ROOT_UV) | \
        WITH(GROOM_COLORS) | WITH(IDS) | WITH(OPAQUE_SHADOWS) | WITH(ALPHA_COVERAGE) | WITH(WIDENED)
#define STAGE_FEATURES \
    WITH(DEPTH) | WITH(FIBRES) | STYLE_FEATURES | WITH(ROOT_UV) | WITH(GROOM_COLORS) | \
        WITH(OPAQUE_SHADOWS) | WITH(WIDENED) | WITH(HITS)
#define RASTER_FEATURES WITH(DEPTH) | WITH(ALPHA_COVERAGE) | WITH(BATCH)
#define DRAW_STAGES " !HAIR_LINES?draw/ribbon.geom !HAIR_DEPTH?draw/strand.frag HAIR_DEPTH?draw/depth.frag"

PASS(VOXELISE, "field/voxelise", FIELD, WITH(NUMBERS), "field/voxelise.comp")
PASS(VOXELISE_MESHES, "field/voxelise_meshes", FIELD, WITH(NUMBERS), "HAIR_MESHES=1 field/voxelise.comp")
PASS(BODY_UNPACK, "field/body_unpack", FIELD, 0, "field/body_unpack.comp")
PASS(BODY_MOVED, "field/body_moved", FIELD, 0, "field/body_moved.comp")
PASS(BODY_REACH, "field/body_reach", FIELD, 0, "field/body_reach.comp")
PASS(BODY_SCATTER, "field/body_scatter", FIELD, 0, "field/body_scatter.comp")
PASS(BODY_LINE_FIRST, "field/body_line_first", FIELD, 0, "HAIR_AXIS=0 HAIR_FIRST=1 field/body_line.comp")
PASS(BODY_LINE_X, "field/body_line_x", FIELD, 0, "HAIR_AXIS=0 field/body_line.comp")
PASS(BODY_LINE_Y, "field/body_line_y", FIELD, 0, "HAIR_AXIS=1 field/body_line.comp")
PASS(BODY_LINE_Z, "field/body_line_z", FIELD, 0, "HAIR_AXIS=2 field/body_line.comp")
PASS(BODY_LINE_LAST, "field/body_line_last", FIELD, 0, "HAIR_AXIS=2 HAIR_LAST=1 field/body_line.comp")
PASS(FLUID_FACE_FRACTIONS, "wind/face_fractions", WIND, 0, "HAIR_FLUID=1 wind/face_fractions.comp")
PASS(FLUID_COARSEN, "wind/coarsen", WIND, 0, "HAIR_FLUID=1 wind/coarsen.comp")
PASS(FLUID_CLEAR, "wind/clear", WIND, 0, "HAIR_FLUID=1 sim/hair_grid_clear.comp")
PASS(FLUID_SPLAT, "wind/splat", WIND, 0, "HAIR_FLUID=1 sim/hair_grid_splat.comp")
PASS(FLUID_POROUS, "wind/porous", WIND, 0, "HAIR_FLUID=1 wind/porous.comp")
PASS(FLUID_ADVECT, "wind/advect", WIND, 0, "HAIR_FLUID=1 wind/advect.comp")
PASS(FLUID_MACCORMACK_CORRECT, "wind/maccormack_correct", WIND, 0,
     "HAIR_FLUID=1 wind/maccormack_correct.comp")
PASS(FLUID_DIVERGENCE, "wind/divergence", WIND, 0, "HAIR_FLUID=1 wind/divergence.comp")
PASS(FLUID_SMOOTH, "wind/smooth", WIND, 0, "HAIR_FLUID=1 wind/smooth.comp")
PASS(FLUID_JACOBI, "wind/jacobi", WIND, 0, "HAIR_FLUID=1 wind/jacobi.comp")
PASS(FLUID_RESTRICT, "wind/restrict", WIND, 0, "HAIR_FLUID=1 wind/restrict.comp")
PASS(FLUID_COARSE_SOLVE, "wind/coarse_solve", WIND, 0, "HAIR_FLUID=1 wind/coarse_solve.comp")
PASS(FLUID_PROLONG, "wind/prolong", WIND, 0, "HAIR_FLUID=1 wind/prolong.comp")
PASS(FLUID_PROJECT, "wind/project", WIND, 0, "HAIR_FLUID=1 wind/project.comp")
PASS(FLUID_EXPORT_VELOCITY, "wind/export_velocity", WIND, 0, "HAIR_FLUID=1 wind/export_velocity.comp")
PASS(RESET, "sim/reset", RESET, WITH(ROD) | WITH(SKINNED) | WITH(MIXED), "sim/reset.comp")
PASS(ROTATE_STATE, "sim/rotate_state", ROTATE_STATE, WITH(ROD) | WITH(MIXED), "sim/rotate_state.comp")
PASS(SKIN_SCALP, "sim/skin_scalp", SKIN_SCALP, 0, "HAIR_SKINNED=1 sim/skin_scalp.comp")
PASS(UNPACK_POSITIONS, "sim/unpack_positions", UNPACK_POSITIONS, 0,
     "HAIR_SKINNED=1 sim/unpack_positions.comp")
PASS(BLEND_TARGETS, "sim/blend_targets", TARGETS, WITH(ROD) | WITH(MIXED), "sim/blend_targets.comp")
PASS(CHANGE_LENGTHS, "sim/change_lengths", SOLVE, WITH(ROD) | WITH(MIXED), "sim/change_lengths.comp")
PASS(ROOT_TRANSFORMS, "sim/root_transforms", ROOT_TRANSFORMS, 0, "HAIR_SKINNED=1 sim/root_transforms.comp")
PASS(BIND_FOLLOWERS, "strands/bind_followers", BIND_FOLLOWERS, 0,
     "HAIR_SKINNED=1 strands/bind_followers.comp")
PASS(ACTIVITY, "sim/activity", ACTIVITY, 0, "sim/activity.comp")
PASS(MOTION_OF_GUIDES, "sim/diagnose_motion", DIAGNOSE, 0, "sim/motion.comp")
PASS(ENERGY, "sim/diagnose_energy", DIAGNOSE, WITH(MIXED), "sim/energy.comp")
PASS(SUM_IMPULSES, "sim/sum_impulses", IMPULSES, 0, "sim/sum_impulses.comp")
PASS(HAIR_GRID_CLEAR, "sim/hair_grid_clear", HAIR_GRID, 0, "HAIR_GRID=1 sim/hair_grid_clear.comp")
PASS(HAIR_GRID_SPLAT, "sim/hair_grid_splat", HAIR_GRID, 0, "HAIR_GRID=1 sim/hair_grid_splat.comp")
PASS(HAIR_GRID_MOTION, "sim/hair_grid_motion", HAIR_GRID, 0, "HAIR_GRID=1 sim/hair_grid_motion.comp")
PASS(HAIR_GRID_GATHER, "sim/hair_grid_gather", HAIR_GRID, 0, "HAIR_GRID=1 sim/hair_grid_gather.comp")
PASS(DIRECT, "sim/direct", SOLVE, RECORDED_FEATURES | WITH(PASS1) | WITH(PASS2), "HAIR_SOLVER=1 sim/rod.comp")
PASS(ACCURATE, "sim/accurate", SOLVE, RECORDED_FEATURES | WITH(PASS1) | WITH(PASS2),
     "HAIR_SOLVER=0 sim/rod.comp")
PASS(ACCURATE_STIFF, "sim/accurate_stiff", SOLVE, RECORDED_FEATURES | WITH(PASS1) | WITH(PASS2),
     "HAIR_SOLVER=0 HAIR_STIFF=1 sim/rod.comp")
PASS(MIXED_SOLVER, "sim/mixed", SOLVE, RECORDED_FEATURES, "HAIR_SOLVER=1 HAIR_MIXED=1 sim/mixed.comp")
PASS(DERIVE_BEGIN, "sim/derive_begin", SOLVE, WITH(MIXED), "HAIR_BEGIN=1 sim/derive_guides.comp")
PASS(DERIVE_GUIDES, "sim/derive_guides", SOLVE, WITH(MIXED), "sim/derive_guides.comp")
PASS(FOLLOW, "sim/follow", SOLVE, STRAND_FEATURES, "sim/follow.comp")
PASS(REDBLACK, "sim/redblack", SOLVE, SIZES | WITH(SKINNED), "sim/redblack.comp")
// Redblack by transform feedback, in the order of HAIR_PHASE.
PASS(FEEDBACK_INTEGRATE, "sim/feedback_integrate", SOLVE, 0, "HAIR_PHASE=0 sim/feedback.vert")
PASS(FEEDBACK_ANGULAR, "sim/feedback_angular", SOLVE, 0, "HAIR_PHASE=1 sim/feedback.vert")
PASS(FEEDBACK_RED, "sim/feedback_red", SOLVE, 0, "HAIR_PHASE=2 sim/feedback.vert")
PASS(FEEDBACK_BLACK, "sim/feedback_black", SOLVE, 0, "HAIR_PHASE=3 sim/feedback.vert")
PASS(FEEDBACK_BEND_RED, "sim/feedback_bend_red", SOLVE, 0, "HAIR_PHASE=4 sim/feedback.vert")
PASS(FEEDBACK_BEND_BLACK, "sim/feedback_bend_black", SOLVE, 0, "HAIR_PHASE=5 sim/feedback.vert")
PASS(FEEDBACK_COLLIDE, "sim/feedback_collide", SOLVE, 0, "HAIR_PHASE=6 sim/feedback.vert")
PASS(FEEDBACK_END, "sim/feedback_end", SOLVE, 0, "HAIR_PHASE=7 sim/feedback.vert")
PASS(SMOOTH, "strands/smooth", SMOOTH, SIZES | WITH(SKINNED) | WITH(TARGETS), "strands/smooth.comp")
PASS(GUIDE_TANGENTS, "strands/guide_tangents", SMOOTH, 0, "strands/guide_tangents.comp")
PASS(DISPLACE, "strands/displace", SMOOTH, 0, "strands/displace.comp")
PASS(EXPAND, "strands/expand", EXPAND, WITH(HITS) | STYLE_FEATURES,
     "HAIR_EVERY_FOLLOWER=1 strands/expand.comp")
PASS(EXPAND_DRAWN, "strands/expand_drawn", EXPAND, WITH(HITS) | STYLE_FEATURES,
     "HAIR_POSITIONS=1 strands/expand.comp")
PASS(HIT, "strands/hit", HIT, STYLE_FEATURES, "HAIR_FINDS_HITS=1 strands/hit.comp")
PASS(HIT_GROUP, "strands/hit_group", HIT, STYLE_FEATURES,
     "HAIR_FINDS_HITS=1 HAIR_HIT_GROUP=1 strands/hit.comp")
PASS(PREPASS, "strands/hit_prepass", HIT, STYLE_FEATURES,
     "HAIR_FINDS_HITS=1 HAIR_EVERY_FOLLOWER=1 draw/patch.vert draw/patch.tesc strands/hit.tese "
     "strands/hit.frag")
PASS(PREPASS_HIT, "strands/hit_gather", HIT, 0, "HAIR_FINDS_HITS=1 HAIR_PREPASS=1 strands/hit.comp")
PASS(REPAIR, "strands/repair", REPAIR, STYLE_FEATURES,
     "HAIR_FINDS_HITS=1 HAIR_REPAIR_FOLLOWERS=HAIR_REPAIR_ALONE HAIR_REPAIR_LANES=1 strands/repair.comp")
PASS(REPAIR_GROUP, "strands/repair_group", REPAIR, STYLE_FEATURES,
     "HAIR_FINDS_HITS=1 HAIR_REPAIR_FOLLOWERS=1 HAIR_REPAIR_LANES=HAIR_REPAIR_THREADS strands/repair.comp")
PASS(PATCH_BOUNDS, "strands/patch_bounds", EXPAND, 0, "strands/patch_bounds.comp")
PASS(HIZ_REDUCE_DEPTH, "draw/hiz_reduce_depth", OCCLUSION, 0, "draw/hiz_reduce_depth.comp")
PASS(HIZ_DOWNSAMPLE, "draw/hiz_downsample", OCCLUSION, 0, "draw/hiz_downsample.comp")
PASS(GUIDE_BOUNDS, "draw/guide_bounds", OCCLUSION, 0, "draw/guide_bounds.comp")
PASS(CULL_PATCHES, "draw/cull_patches", OCCLUSION, WITH(HITS), "draw/cull_patches.comp")
PASS(TESSELLATED, "draw/tessellated", COLOR, DRAW_FEATURES | WITH(HITS) | WITH(OCCLUSION),
     "draw/patch.vert draw/patch.tesc draw/strand.tese" DRAW_STAGES)
PASS(PROCEDURAL, "draw/procedural", COLOR, DRAW_FEATURES | WITH(HITS), "draw/strand.vert" DRAW_STAGES)
PASS(CACHED, "draw/cached", COLOR, DRAW_FEATURES | WITH(MOTION) | WITH(MOTION_OUTPUT) | WITH(SHADED),
     "HAIR_VERTEX_CACHE=1 draw/strand.vert" DRAW_STAGES)
PASS(CACHED_PAIRED, "draw/cached_paired", COLOR,
     DRAW_FEATURES | WITH(MOTION) | WITH(MOTION_OUTPUT) | WITH(SHADED),
     "HAIR_VERTEX_CACHE=1 HAIR_PAIRED=1 draw/strand.vert !HAIR_DEPTH?draw/strand.frag "
     "HAIR_DEPTH?draw/depth.frag")
PASS(EXPAND_VIEW, "draw/expand_view", COLOR, STAGE_FEATURES, "draw/expand_view.comp")
PASS(EXPAND_VIEW_SIDES, "draw/expand_view_sides", COLOR, STAGE_FEATURES | WITH(LINES),
     "HAIR_SIDES=1 draw/expand_view.comp")
PASS(VIEW_CACHED, "draw/view_cached", COLOR, WITH(DEPTH) | WITH(LINES),
     "draw/view_cache.vert !HAIR_DEPTH?draw/strand.frag HAIR_DEPTH?draw/depth.frag")
PASS(RASTER_CLEAR, "draw/raster_clear", COLOR, RASTER_FEATURES, "draw/raster_clear.comp")
PASS(RASTER, "draw/raster", COLOR, RASTER_FEATURES | WITH(WIDENED), "draw/raster.comp")
PASS(COMPOSE_TILES, "draw/compose_tiles", COLOR, RASTER_FEATURES | WITH(WIDENED),
     "draw/compose_tiles.comp")
PASS(RESOLVE_TILES, "draw/resolve_tiles", COLOR, RASTER_FEATURES | WITH(MOTION_OUTPUT),
     "draw/resolve_tiles.vert draw/resolve_tiles.frag")
PASS(SHADE, "draw/shade", COLOR,
     WITH(FIBRES) | WITH(LENGTHS) | WITH(GROUP_LOOKS) | WITH(STRAND_FACTORS) | WITH(ROOT_UV) |
         WITH(GROOM_COLORS) | WITH(OPAQUE_SHADOWS),
     "HAIR_VERTEX_CACHE=1 draw/shade.comp")
PASS(REFLECTANCE, "draw/reflectance", COLOR, WITH(GROOM_COLORS) | WITH(LENGTHS),
     "HAIR_VERTEX_CACHE=1 HAIR_USER_PIXELS=1 draw/shade.comp")
PASS(SCAN_STRANDS, "draw/scan_strands", SCAN_STRANDS, WITH(OCCLUSION), "draw/scan_strands.comp")
PASS(COMPACT_STRANDS, "draw/compact_strands", COMPACT_STRANDS, WITH(OCCLUSION), "draw/compact_strands.comp")
PASS(HISTOGRAM, "draw/histogram", COLOR, 0, "draw/histogram.comp")
PASS(PREFIX_SUM, "draw/prefix_sum", COLOR, 0, "draw/prefix_sum.comp")
PASS(SCATTER, "draw/scatter", COLOR, 0, "HAIR_SCATTER=1 draw/histogram.comp")
PASS(DENSITY_CLEAR, "light/density_clear", SELF_SHADOW, 0, "light/density_clear.comp")
PASS(DENSITY_BOUNDS, "light/density_bounds", SELF_SHADOW, 0, "light/density_bounds.comp")
PASS(DENSITY_SPLAT, "light/density_splat", SELF_SHADOW, 0, "light/density_splat.comp")
PASS(NODE_TRANSMITTANCE, "light/node_transmittance", SELF_SHADOW, WITH(COLLIDERS),
     "light/node_transmittance.comp")
PASS(VERTEX_TRANSMITTANCE, "light/vertex_transmittance", SELF_SHADOW, WITH(COLLIDERS),
     "light/vertex_transmittance.comp")
PASS(VERTEX_TRANSMITTANCE_DRAWN, "light/vertex_transmittance_drawn", SELF_SHADOW,
     WITH(COLLIDERS) | STYLE_FEATURES, "HAIR_WIDENED=1 light/vertex_transmittance.comp")
PASS(COLLIDERS, "draw/colliders", COLLIDERS, 0, "HAIR_MESHES=1 draw/colliders.vert draw/colliders.frag")
PASS(SLICE, "draw/colliders_slice", COLLIDERS, 0, "draw/slice.vert draw/slice.frag")
PASS(AIR, "draw/air", AIR, 0, "draw/air.vert draw/guides.frag")
PASS(GUIDES, "draw/guides", GUIDES, 0, "draw/guides.vert draw/guides.frag")

#undef DRAW_STAGES
#undef RASTER_FEATURES
#undef STAGE_FEATURES
#undef DRAW_FEATURES
#undef STYLE_FEATURES
#undef RECORDED_FEATURES
#undef STRAND_FEATURES
#undef WITH
#undef SIZES
#undef PASS
#undef FEATURE
#undef CATEGORY
