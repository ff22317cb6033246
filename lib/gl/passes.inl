// passes.inl - every pass: its name in code, its name in reports, its features, and its definitions
// and stages under glsl/. A stage after NAME? exists only in programs compiled with NAME. A stage
// after !NAME? exists only in programs compiled without NAME. The enums, the compiler, the tests
// and `make glsl` read this table.
#ifndef FEATURE
#define FEATURE(name, define)
#endif
#ifndef PASS
#define PASS(name, label, features, stages)
#endif

// Optional features of programs. A program contains only the features that its scene needs.
// Programs are made when first needed, with any combination of features.
FEATURE(ROD, "HAIR_ROD")                 // Guides are rods, with frames.
FEATURE(WIND, "HAIR_WIND") // Wind blows.
FEATURE(PINNED, "HAIR_PINNED")               // Vertices are pinned.
FEATURE(SKINNED, "HAIR_SKINNED")         // Roots move with a skinned scalp.
FEATURE(CROWD, "HAIR_CROWD")             // The hair-hair grid acts on guides.
// One thread per guide. Otherwise one work group per guide.
FEATURE(THREAD, "HAIR_THREAD_PER_GUIDE")
FEATURE(FIRST, "HAIR_FIRST")             // Only the solver's own method.
FEATURE(LISTED, "HAIR_LISTED")           // Only guides at which FIRST failed.
FEATURE(MIXED, "HAIR_MIXED") // Rotations and forces of segments are the unknowns of guides.
FEATURE(COLLIDERS, "HAIR_COLLIDERS")           // Colliders are near. Without ANY there are few.
FEATURE(ANY, "HAIR_ANY")                 // Any number of colliders.

// Few guides, which have registers to cache what they read, since they wait for memory.
FEATURE(FEW, "HAIR_FEW_GUIDES")
FEATURE(BODIES, "HAIR_BODIES")           // Some colliders are not capsules.
FEATURE(HITS, "HAIR_HITS")               // Some followers are inside colliders.
FEATURE(DEPTH, "HAIR_DEPTH")             // Depth without colour.
FEATURE(FIBRES, "HAIR_FIBRES")           // HAIR_SHADING_FIBRES. Otherwise HAIR_SHADING_LINES.
FEATURE(LINES, "HAIR_LINES")             // Lines. Otherwise ribbons.
FEATURE(STYLED, "HAIR_STYLED")           // The look kinks, curls or cuts followers.
FEATURE(TINTED, "HAIR_TINTED") // Strands have colours or positions on the scalp of their own.
FEATURE(PAINTED, "HAIR_PAINTED")         // Strands have the groom's colours.
FEATURE(IDS, "HAIR_IDS")                 // Numbers in place of colour.
FEATURE(MOTION, "HAIR_MOTION")           // Velocities in place of colour.
FEATURE(SHARES, "HAIR_SHARES")           // Strands cover fractions of pixels.
FEATURE(BLOCKED, "HAIR_BLOCKED")         // Opaque geometry blocks lights.
FEATURE(SHADED, "HAIR_SHADED")           // A compute pass has shaded the vertices.
// Strands may be wider to compensate for strands that are left out.
FEATURE(WIDENED, "HAIR_WIDENED")
FEATURE(HIDDEN, "HAIR_HIDDEN")           // Occlusion culling may have hidden patches.

// Sizes of work groups with one work group per guide and one thread per vertex. In a group of 256
// threads for a guide of 32 vertices most threads would be idle.
#define SIZES HAIR_GL_SIZES
#define WITH(name) HAIR_GL_WITH(name)
#define STRAND_FEATURES \
    SIZES | WITH(WIND) | WITH(PINNED) | WITH(SKINNED) | WITH(CROWD) | WITH(THREAD) | WITH(COLLIDERS) | WITH(ANY) | WITH(BODIES) | \
        WITH(FEW)
#define DRAW_FEATURES \
    WITH(DEPTH) | WITH(FIBRES) | WITH(LINES) | WITH(STYLED) | WITH(TINTED) | WITH(PAINTED) | WITH(IDS) | WITH(BLOCKED) | \
        WITH(SHARES) | WITH(WIDENED)
#define STAGE_FEATURES \
    WITH(DEPTH) | WITH(FIBRES) | WITH(STYLED) | WITH(TINTED) | WITH(PAINTED) | WITH(BLOCKED) | WITH(WIDENED) | WITH(HITS)
#define DRAW_STAGES " !HAIR_LINES?draw/ribbon.geom !HAIR_DEPTH?draw/strand.frag HAIR_DEPTH?draw/depth.frag"

PASS(VOXELISE, "field/voxelise", 0, "field/voxelise.comp")
PASS(VOXELISE_FORMS, "field/voxelise_forms", 0, "HAIR_FORMS=1 field/voxelise.comp")
PASS(FLUID_OPEN, "wind/open", 0, "HAIR_FLUID=1 wind/open.comp")
PASS(FLUID_COARSEN, "wind/coarsen", 0, "HAIR_FLUID=1 wind/coarsen.comp")
PASS(FLUID_CLEAR, "wind/clear", 0, "HAIR_FLUID=1 sim/crowd_clear.comp")
PASS(FLUID_SPLAT, "wind/splat", 0, "HAIR_FLUID=1 sim/crowd_splat.comp")
PASS(FLUID_POROUS, "wind/porous", 0, "HAIR_FLUID=1 wind/porous.comp")
PASS(FLUID_ADVECT, "wind/advect", 0, "HAIR_FLUID=1 wind/advect.comp")
PASS(FLUID_CORRECT, "wind/correct", 0, "HAIR_FLUID=1 wind/correct.comp")
PASS(FLUID_DIVERGENCE, "wind/divergence", 0, "HAIR_FLUID=1 wind/divergence.comp")
PASS(FLUID_SMOOTH, "wind/smooth", 0, "HAIR_FLUID=1 wind/smooth.comp")
PASS(FLUID_JACOBI, "wind/jacobi", 0, "HAIR_FLUID=1 wind/jacobi.comp")
PASS(FLUID_RESTRICT, "wind/restrict", 0, "HAIR_FLUID=1 wind/restrict.comp")
PASS(FLUID_BOTTOM, "wind/bottom", 0, "HAIR_FLUID=1 wind/bottom.comp")
PASS(FLUID_PROLONG, "wind/prolong", 0, "HAIR_FLUID=1 wind/prolong.comp")
PASS(FLUID_PROJECT, "wind/project", 0, "HAIR_FLUID=1 wind/project.comp")
PASS(FLUID_PUBLISH, "wind/publish", 0, "HAIR_FLUID=1 wind/publish.comp")
PASS(RESET, "sim/reset", WITH(ROD) | WITH(SKINNED) | WITH(MIXED), "sim/reset.comp")
PASS(TURN, "sim/turn", WITH(ROD) | WITH(MIXED), "sim/turn.comp")
PASS(SCALP, "sim/scalp", 0, "HAIR_SKINNED=1 sim/scalp.comp")
PASS(RIDE, "sim/ride", 0, "HAIR_SKINNED=1 sim/ride.comp")
PASS(SEAT, "interpolate/seat", 0, "HAIR_SKINNED=1 interpolate/seat.comp")
PASS(STIR, "sim/stir", 0, "sim/stir.comp")
PASS(MOTION_OF_GUIDES, "sim/diagnose_motion", 0, "sim/motion.comp")
PASS(ENERGY, "sim/diagnose_energy", WITH(MIXED), "sim/energy.comp")
PASS(CROWD_CLEAR, "sim/crowd_clear", 0, "HAIR_CROWD=1 sim/crowd_clear.comp")
PASS(CROWD_SPLAT, "sim/crowd_splat", 0, "HAIR_CROWD=1 sim/crowd_splat.comp")
PASS(CROWD_GATHER, "sim/crowd_gather", 0, "HAIR_CROWD=1 sim/crowd_gather.comp")
PASS(DIRECT, "sim/direct", STRAND_FEATURES | WITH(FIRST) | WITH(LISTED), "HAIR_SOLVER=1 sim/rod.comp")
PASS(ACCURATE, "sim/accurate", STRAND_FEATURES | WITH(FIRST) | WITH(LISTED), "HAIR_SOLVER=0 sim/rod.comp")
PASS(ACCURATE_STIFF, "sim/accurate_stiff", STRAND_FEATURES, "HAIR_SOLVER=0 HAIR_STIFF=1 sim/rod.comp")
PASS(MIXED_SOLVER, "sim/mixed", STRAND_FEATURES, "HAIR_SOLVER=1 HAIR_MIXED=1 sim/mixed.comp")
PASS(FOLLOW, "sim/follow", STRAND_FEATURES, "sim/follow.comp")
PASS(REDBLACK, "sim/redblack", SIZES | WITH(SKINNED), "sim/redblack.comp")
// Redblack by transform feedback, in the order of HAIR_PHASE.
PASS(FEEDBACK_INTEGRATE, "sim/feedback_integrate", 0, "HAIR_PHASE=0 sim/feedback.vert")
PASS(FEEDBACK_ANGULAR, "sim/feedback_angular", 0, "HAIR_PHASE=1 sim/feedback.vert")
PASS(FEEDBACK_RED, "sim/feedback_red", 0, "HAIR_PHASE=2 sim/feedback.vert")
PASS(FEEDBACK_BLACK, "sim/feedback_black", 0, "HAIR_PHASE=3 sim/feedback.vert")
PASS(FEEDBACK_BEND_RED, "sim/feedback_bend_red", 0, "HAIR_PHASE=4 sim/feedback.vert")
PASS(FEEDBACK_BEND_BLACK, "sim/feedback_bend_black", 0, "HAIR_PHASE=5 sim/feedback.vert")
PASS(FEEDBACK_COLLIDE, "sim/feedback_collide", 0, "HAIR_PHASE=6 sim/feedback.vert")
PASS(FEEDBACK_END, "sim/feedback_end", 0, "HAIR_PHASE=7 sim/feedback.vert")
PASS(SMOOTH, "interpolate/smooth", SIZES | WITH(SKINNED), "interpolate/smooth.comp")
PASS(EXPAND, "interpolate/expand", WITH(HITS) | WITH(STYLED), "HAIR_STORED=1 interpolate/expand.comp")
PASS(HIT, "interpolate/hit", WITH(STYLED), "HAIR_FINDS_HITS=1 interpolate/hit.comp")
PASS(HIT_GROUP, "interpolate/hit_group", WITH(STYLED), "HAIR_FINDS_HITS=1 HAIR_STORED=1 HAIR_HIT_GROUP=1 interpolate/hit.comp")
PASS(PREPASS, "interpolate/hit_prepass", WITH(STYLED), "HAIR_FINDS_HITS=1 HAIR_EVERY_FOLLOWER=1 draw/patch.vert draw/patch.tesc interpolate/hit.tese interpolate/hit.frag")
PASS(PREPASS_HIT, "interpolate/hit_gather", 0, "HAIR_FINDS_HITS=1 HAIR_PREPASS=1 interpolate/hit.comp")
PASS(REPAIR, "interpolate/repair", WITH(STYLED), "HAIR_FINDS_HITS=1 interpolate/repair.comp")
PASS(HIDE_FIRST, "draw/hide_first", 0, "draw/hide_first.comp")
PASS(HIDE_NEXT, "draw/hide_next", 0, "draw/hide_next.comp")
PASS(HIDE_GUIDES, "draw/hide_guides", 0, "draw/hide_guides.comp")
PASS(HIDE_PATCHES, "draw/hide_patches", WITH(HITS), "draw/hide_patches.comp")
PASS(TESSELLATED, "draw/tessellated", DRAW_FEATURES | WITH(HITS) | WITH(HIDDEN), "draw/patch.vert draw/patch.tesc draw/strand.tese" DRAW_STAGES)
PASS(INSTANCED, "draw/instanced", DRAW_FEATURES | WITH(HITS), "HAIR_LISTED=1 draw/strand.vert" DRAW_STAGES)
PASS(EXPANDED, "draw/expanded", DRAW_FEATURES | WITH(MOTION) | WITH(SHADED), "HAIR_LISTED=1 HAIR_EXPANDED=1 draw/strand.vert" DRAW_STAGES)
PASS(PAIRED, "draw/expanded_paired", DRAW_FEATURES | WITH(MOTION) | WITH(SHADED), "HAIR_LISTED=1 HAIR_EXPANDED=1 HAIR_PAIRED=1 draw/strand.vert !HAIR_DEPTH?draw/strand.frag HAIR_DEPTH?draw/depth.frag")
PASS(STAGE, "draw/stage", STAGE_FEATURES, "HAIR_LISTED=1 draw/stage.comp")
PASS(STAGE_SIDES, "draw/stage_sides", STAGE_FEATURES | WITH(LINES), "HAIR_LISTED=1 HAIR_SIDES=1 draw/stage.comp")
PASS(STAGED, "draw/staged", WITH(DEPTH) | WITH(LINES), "draw/staged.vert !HAIR_DEPTH?draw/strand.frag HAIR_DEPTH?draw/depth.frag")
PASS(RASTER_CLEAR, "draw/raster_clear", WITH(DEPTH), "draw/raster_clear.comp")
PASS(RASTER, "draw/raster", WITH(DEPTH) | WITH(WIDENED), "HAIR_EXPANDED=1 draw/raster.comp")
PASS(COMPOSE, "draw/compose", WITH(DEPTH) | WITH(WIDENED), "HAIR_EXPANDED=1 draw/compose.vert draw/compose.frag")
PASS(SHADE, "draw/shade", WITH(FIBRES) | WITH(TINTED) | WITH(PAINTED) | WITH(BLOCKED), "HAIR_EXPANDED=1 draw/shade.comp")
PASS(COUNT, "draw/count", WITH(HIDDEN), "HAIR_LISTED=1 draw/count.comp")
PASS(LIST, "draw/list", WITH(HIDDEN), "HAIR_LISTED=1 draw/list.comp")
PASS(BUCKET, "draw/bucket", 0, "HAIR_LISTED=1 HAIR_EXPANDED=1 draw/bucket.comp")
PASS(BUCKETS, "draw/buckets", 0, "HAIR_LISTED=1 draw/buckets.comp")
PASS(PLACE, "draw/place", 0, "HAIR_LISTED=1 HAIR_EXPANDED=1 HAIR_PLACES=1 draw/bucket.comp")
PASS(LIGHT_BOX, "draw/light_box", 0, "draw/light_box.comp")
PASS(LIGHT_FILL, "draw/light_fill", 0, "draw/light_fill.comp")
PASS(LIGHT_NODES, "draw/light_nodes", WITH(COLLIDERS), "draw/light_nodes.comp")
PASS(LIGHT, "draw/light", WITH(COLLIDERS), "draw/light.comp")
PASS(COLLIDERS, "draw/colliders", 0, "HAIR_FORMS=1 draw/colliders.vert draw/colliders.frag")
PASS(SLICE, "draw/colliders_slice", 0, "draw/slice.vert draw/slice.frag")
PASS(AIR, "draw/air", 0, "draw/air.vert draw/guides.frag")
PASS(GUIDES, "draw/guides", 0, "draw/guides.vert draw/guides.frag")

#undef DRAW_STAGES
#undef STAGE_FEATURES
#undef DRAW_FEATURES
#undef STRAND_FEATURES
#undef WITH
#undef SIZES
#undef PASS
#undef FEATURE
