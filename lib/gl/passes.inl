// passes.inl - every shader program: its name in code, its name in reports, what it defines, its stages
// under glsl/.
// Read by the enum, the compiler loop, the timers, the OpenGL labels and the tests.
//
// A pass with a work group per guide and a thread per vertex is four programs, one after the other, for guides of up
// to 32, 64, 128 and 256 vertices: a group of 256 threads on guides of 32 would wait for those that do nothing.
#define GUIDE_PASS(name, label, stages) \
    PASS(name##_32, label "_32", "HAIR_GUIDE_THREADS=32 " stages) \
    PASS(name##_64, label "_64", "HAIR_GUIDE_THREADS=64 " stages) \
    PASS(name##_128, label "_128", "HAIR_GUIDE_THREADS=128 " stages) \
    PASS(name##_256, label "_256", "HAIR_GUIDE_THREADS=256 " stages)

// A solver of rods is 320 such passes, for hair with and without what it can do without: solids, few or any number of them,
// and among them bodies, those that are no capsules; curved or flat strands; the crowd of other hair; ties; roots that ride
// on a skinned scalp; wind; and by a work group or a thread per guide.
#define ROD_PASS_OF(name, label, defines) \
    GUIDE_PASS(name, label, defines "sim/rod.comp") \
    GUIDE_PASS(name##_SOLIDS, label "_solids", defines "HAIR_SOLIDS=1 sim/rod.comp") \
    GUIDE_PASS(name##_BODIES, label "_bodies", defines "HAIR_SOLIDS=1 HAIR_BODIES=1 sim/rod.comp") \
    GUIDE_PASS(name##_ANY, label "_any", defines "HAIR_SOLIDS=1 HAIR_ANY=1 sim/rod.comp") \
    GUIDE_PASS(name##_ANY_BODIES, label "_any_bodies", defines "HAIR_SOLIDS=1 HAIR_ANY=1 HAIR_BODIES=1 sim/rod.comp") \
    GUIDE_PASS(name##_CURVED, label "_curved", defines "HAIR_CURVED=1 sim/rod.comp") \
    GUIDE_PASS(name##_CURVED_SOLIDS, label "_curved_solids", defines "HAIR_CURVED=1 HAIR_SOLIDS=1 sim/rod.comp") \
    GUIDE_PASS(name##_CURVED_BODIES, label "_curved_bodies", defines "HAIR_CURVED=1 HAIR_SOLIDS=1 HAIR_BODIES=1 sim/rod.comp") \
    GUIDE_PASS(name##_CURVED_ANY, label "_curved_any", defines "HAIR_CURVED=1 HAIR_SOLIDS=1 HAIR_ANY=1 sim/rod.comp") \
    GUIDE_PASS(name##_CURVED_ANY_BODIES, label "_curved_any_bodies", defines "HAIR_CURVED=1 HAIR_SOLIDS=1 HAIR_ANY=1 HAIR_BODIES=1 sim/rod.comp")
#define ROD_PASS_BY(name, label, defines) \
    ROD_PASS_OF(name, label, defines) \
    ROD_PASS_OF(name##_THREAD, label "_thread", "HAIR_THREAD_PER_GUIDE=1 " defines)
#define ROD_PASS_IN(name, label, defines) \
    ROD_PASS_BY(name, label, defines) \
    ROD_PASS_BY(name##_CROWD, label "_crowd", "HAIR_CROWD=1 " defines)
#define ROD_PASS_HELD(name, label, defines) \
    ROD_PASS_IN(name, label, defines) \
    ROD_PASS_IN(name##_TIED, label "_tied", "HAIR_TIED=1 " defines) \
    ROD_PASS_IN(name##_SKINNED, label "_skinned", "HAIR_SKINNED=1 " defines) \
    ROD_PASS_IN(name##_TIED_SKINNED, label "_tied_skinned", "HAIR_SKINNED=1 HAIR_TIED=1 " defines)
#define ROD_PASS(name, label, defines) \
    ROD_PASS_HELD(name, label, defines) \
    ROD_PASS_HELD(name##_WIND, label "_wind", "HAIR_WIND=1 " defines)

// A pass that evaluates followers is two programs: as they go, and where the look kinks, curls or cuts them. The second is
// made when a look first does.
#define FOLLOWER_PASS(name, label, stages) \
    PASS(name, label, stages) \
    PASS(name##_STYLED, label "_styled", "HAIR_STYLED=1 " stages)

// Strands: as ribbons or lines, in colour or depth only, their colour that of lines or of fibres.
#define DRAW_PASS(name, label, stages) \
    FOLLOWER_PASS(name##_RIBBONS, "draw/" label "_ribbons", stages " draw/ribbon.geom draw/strand.frag") \
    FOLLOWER_PASS(name##_LINES, "draw/" label "_lines", stages " draw/strand.frag") \
    FOLLOWER_PASS(name##_DEPTH_RIBBONS, "draw/" label "_depth_ribbons", stages " draw/ribbon.geom draw/depth.frag") \
    FOLLOWER_PASS(name##_DEPTH_LINES, "draw/" label "_depth_lines", stages " draw/depth.frag") \
    FOLLOWER_PASS(name##_FIBRES_RIBBONS, "draw/" label "_fibres_ribbons", "HAIR_FIBRES=1 " stages " draw/ribbon.geom draw/strand.frag") \
    FOLLOWER_PASS(name##_FIBRES_LINES, "draw/" label "_fibres_lines", "HAIR_FIBRES=1 " stages " draw/strand.frag")

PASS(VOXELISE, "field/voxelise", "field/voxelise.comp")
PASS(VOXELISE_FORMS, "field/voxelise_forms", "HAIR_FORMS=1 field/voxelise.comp")
PASS(FLUID_OPEN, "wind/open", "HAIR_FLUID=1 wind/open.comp")
PASS(FLUID_COARSEN, "wind/coarsen", "HAIR_FLUID=1 wind/coarsen.comp")
PASS(FLUID_CLEAR, "wind/clear", "HAIR_FLUID=1 sim/crowd_clear.comp")
PASS(FLUID_SPLAT, "wind/splat", "HAIR_FLUID=1 sim/crowd_splat.comp")
PASS(FLUID_POROUS, "wind/porous", "HAIR_FLUID=1 wind/porous.comp")
PASS(FLUID_ADVECT, "wind/advect", "HAIR_FLUID=1 wind/advect.comp")
PASS(FLUID_CORRECT, "wind/correct", "HAIR_FLUID=1 wind/correct.comp")
PASS(FLUID_DIVERGENCE, "wind/divergence", "HAIR_FLUID=1 wind/divergence.comp")
PASS(FLUID_SMOOTH, "wind/smooth", "HAIR_FLUID=1 wind/smooth.comp")
PASS(FLUID_JACOBI, "wind/jacobi", "HAIR_FLUID=1 wind/jacobi.comp")
PASS(FLUID_RESTRICT, "wind/restrict", "HAIR_FLUID=1 wind/restrict.comp")
PASS(FLUID_BOTTOM, "wind/bottom", "HAIR_FLUID=1 wind/bottom.comp")
PASS(FLUID_PROLONG, "wind/prolong", "HAIR_FLUID=1 wind/prolong.comp")
PASS(FLUID_PROJECT, "wind/project", "HAIR_FLUID=1 wind/project.comp")
PASS(FLUID_PUBLISH, "wind/publish", "HAIR_FLUID=1 wind/publish.comp")
PASS(RESET, "sim/reset", "sim/reset.comp")
PASS(TURN, "sim/turn", "sim/turn.comp")
PASS(RESET_ROD, "sim/reset_rod", "HAIR_ROD=1 sim/reset.comp")
PASS(TURN_ROD, "sim/turn_rod", "HAIR_ROD=1 sim/turn.comp")
PASS(RESET_SKINNED, "sim/reset_skinned", "HAIR_SKINNED=1 sim/reset.comp")
PASS(RESET_ROD_SKINNED, "sim/reset_rod_skinned", "HAIR_SKINNED=1 HAIR_ROD=1 sim/reset.comp")
PASS(SCALP, "sim/scalp", "HAIR_SKINNED=1 sim/scalp.comp")
PASS(RIDE, "sim/ride", "HAIR_SKINNED=1 sim/ride.comp")
PASS(SEAT, "interpolate/seat", "HAIR_SKINNED=1 interpolate/seat.comp")
PASS(STIR, "sim/stir", "sim/stir.comp")
PASS(CROWD_CLEAR, "sim/crowd_clear", "HAIR_CROWD=1 sim/crowd_clear.comp")
PASS(CROWD_SPLAT, "sim/crowd_splat", "HAIR_CROWD=1 sim/crowd_splat.comp")
PASS(CROWD_GATHER, "sim/crowd_gather", "HAIR_CROWD=1 sim/crowd_gather.comp")
ROD_PASS(DIRECT, "sim/direct", "HAIR_SOLVER=1 ")
ROD_PASS(ACCURATE, "sim/accurate", "HAIR_SOLVER=0 ")
ROD_PASS(ACCURATE_STIFF, "sim/accurate_stiff", "HAIR_SOLVER=0 HAIR_STIFF=1 ")
ROD_PASS(FOLLOW, "sim/follow", "HAIR_SOLVER=3 ")
GUIDE_PASS(REDBLACK, "sim/redblack", "sim/redblack.comp")
GUIDE_PASS(REDBLACK_SKINNED, "sim/redblack_skinned", "HAIR_SKINNED=1 sim/redblack.comp")
// Redblack by transform feedback, in the order of HAIR_PHASE.
PASS(FEEDBACK_INTEGRATE, "sim/feedback_integrate", "HAIR_PHASE=0 sim/feedback.vert")
PASS(FEEDBACK_ANGULAR, "sim/feedback_angular", "HAIR_PHASE=1 sim/feedback.vert")
PASS(FEEDBACK_RED, "sim/feedback_red", "HAIR_PHASE=2 sim/feedback.vert")
PASS(FEEDBACK_BLACK, "sim/feedback_black", "HAIR_PHASE=3 sim/feedback.vert")
PASS(FEEDBACK_BEND_RED, "sim/feedback_bend_red", "HAIR_PHASE=4 sim/feedback.vert")
PASS(FEEDBACK_BEND_BLACK, "sim/feedback_bend_black", "HAIR_PHASE=5 sim/feedback.vert")
PASS(FEEDBACK_COLLIDE, "sim/feedback_collide", "HAIR_PHASE=6 sim/feedback.vert")
PASS(FEEDBACK_END, "sim/feedback_end", "HAIR_PHASE=7 sim/feedback.vert")
GUIDE_PASS(SMOOTH_SKINNED, "interpolate/smooth_skinned", "HAIR_SKINNED=1 interpolate/smooth.comp")
GUIDE_PASS(SMOOTH, "interpolate/smooth", "interpolate/smooth.comp")
FOLLOWER_PASS(EXPAND, "interpolate/expand", "HAIR_STORED=1 interpolate/expand.comp")
DRAW_PASS(TESSELLATED, "tessellated", "draw/patch.vert draw/patch.tesc draw/strand.tese")
PASS(COUNT, "draw/count", "HAIR_LISTED=1 draw/count.comp")
PASS(LIST, "draw/list", "HAIR_LISTED=1 draw/list.comp")
PASS(BUCKET, "draw/bucket", "HAIR_LISTED=1 HAIR_EXPANDED=1 draw/bucket.comp")
PASS(BUCKETS, "draw/buckets", "HAIR_LISTED=1 draw/buckets.comp")
PASS(PLACE, "draw/place", "HAIR_LISTED=1 HAIR_EXPANDED=1 HAIR_PLACES=1 draw/bucket.comp")
DRAW_PASS(INSTANCED, "instanced", "HAIR_LISTED=1 draw/strand.vert")
DRAW_PASS(EXPANDED, "expanded", "HAIR_LISTED=1 HAIR_EXPANDED=1 draw/strand.vert")
PASS(LIGHT_BOX, "draw/light_box", "draw/light_box.comp")
PASS(LIGHT_FILL, "draw/light_fill", "draw/light_fill.comp")
PASS(LIGHT_NODES, "draw/light_nodes", "draw/light_nodes.comp")
PASS(LIGHT_NODES_SOLIDS, "draw/light_nodes_solids", "HAIR_SOLIDS=1 draw/light_nodes.comp")
PASS(LIGHT, "draw/light", "draw/light.comp")
PASS(LIGHT_SOLIDS, "draw/light_solids", "HAIR_SOLIDS=1 draw/light.comp")
PASS(SOLIDS, "draw/solids", "HAIR_FORMS=1 draw/solids.vert draw/solids.frag")
PASS(SLICE, "draw/slice", "draw/slice.vert draw/slice.frag")
// The same where followers have met solids: made when they first do.
FOLLOWER_PASS(EXPAND_HITS, "interpolate/expand_hits", "HAIR_STORED=1 HAIR_HITS=1 interpolate/expand.comp")
DRAW_PASS(TESSELLATED_HITS, "tessellated_hits", "HAIR_HITS=1 draw/patch.vert draw/patch.tesc draw/strand.tese")
DRAW_PASS(INSTANCED_HITS, "instanced_hits", "HAIR_LISTED=1 HAIR_HITS=1 draw/strand.vert")
FOLLOWER_PASS(HIT, "interpolate/hit", "HAIR_FINDS_HITS=1 interpolate/hit.comp")
FOLLOWER_PASS(HIT_GROUP, "interpolate/hit_group", "HAIR_FINDS_HITS=1 HAIR_STORED=1 HAIR_GROUP_PER_FOLLOWER=1 interpolate/hit.comp")
FOLLOWER_PASS(PREPASS, "interpolate/hit_prepass", "HAIR_FINDS_HITS=1 HAIR_EVERY_FOLLOWER=1 draw/patch.vert draw/patch.tesc interpolate/hit.tese interpolate/hit.frag")
PASS(PREPASS_HIT, "interpolate/hit_gather", "HAIR_FINDS_HITS=1 HAIR_PREPASS=1 interpolate/hit.comp")
FOLLOWER_PASS(REPAIR, "interpolate/repair", "HAIR_FINDS_HITS=1 interpolate/repair.comp")
PASS(GUIDES, "draw/guides", "draw/guides.vert draw/guides.frag")

#undef DRAW_PASS
#undef FOLLOWER_PASS
#undef ROD_PASS
#undef ROD_PASS_HELD
#undef ROD_PASS_IN
#undef ROD_PASS_BY
#undef ROD_PASS_OF
#undef GUIDE_PASS
