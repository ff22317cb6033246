/// hair.h - strand hair in real time: simulated by OpenGL compute, drawn by tessellation.
///
/// A hair_groom is the haircut: immutable, no GPU, shared by any number of heads. A hair_context is the
/// library's hold on one OpenGL context. A hair_instance is one head of living hair: a groom in a context. A
/// hair_collision_mesh is the shape of a collider that no simpler shape describes: immutable and shared as well.
///
///   Words      strand: one hair. guide: a strand that is simulated. follower: a strand made while drawing,
///              by interpolation. root, tip: first and last vertex of a strand. scalp: the surface that
///              roots sit on. collider: a body hair collides with. field: how far the nearest of them is, as a
///              3D texture. step: one call of hair_step, made of substeps.
///   Units      metres, kilograms, seconds, radians. Right-handed; +y is up in the built-in haircuts only.
///              Matrices are 16 floats, column-major. Colours are linear, Rec. 709 primaries.
///   Ownership  Arrays and strings passed in are copied before the call returns. X_create is undone by
///              X_destroy, which takes NULL. A groom or a collision mesh may be destroyed while instances use it. A
///              context is destroyed after its instances.
///   Errors     A fallible call returns a hair_result. Anything but HAIR_OK leaves the object as it was and
///              sends one sentence to hair_host.log. Nothing throws, exits or prints.
///   Threads    No globals. A context and its instances belong to one thread at a time; different contexts,
///              and calls marked [any thread], run in parallel.
///   OpenGL     Calls marked [GL] need the context's OpenGL context current on the calling thread. They use
///              4.5 core, leave the error flag alone, and keep the promise of hair_gl_state.
#ifndef HAIR_HAIR_H
#define HAIR_HAIR_H

#include <stddef.h>
#include <stdint.h>

#define HAIR_VERSION_MAJOR 0 ///< A change that can break a caller.
#define HAIR_VERSION_MINOR 2 ///< A change that only adds.
#define HAIR_VERSION_PATCH 0 ///< A change that only repairs.
#define HAIR_VERSION (HAIR_VERSION_MAJOR * 10000u + HAIR_VERSION_MINOR * 100u + HAIR_VERSION_PATCH)

// HAIR_SHARED: the caller links the shared library. HAIR_BUILD_SHARED: the library is making it.
// The static library exports nothing, so a program that links it does not pass its symbols on.
#if defined(_WIN32) && defined(HAIR_BUILD_SHARED)
#define HAIR_EXPORT __declspec(dllexport)
#elif defined(_WIN32) && defined(HAIR_SHARED)
#define HAIR_EXPORT __declspec(dllimport)
#elif defined(HAIR_BUILD_SHARED)
#define HAIR_EXPORT __attribute__((visibility("default")))
#else
#define HAIR_EXPORT
#endif
#ifdef __cplusplus
#define HAIR_API extern "C" HAIR_EXPORT
#else
#define HAIR_API HAIR_EXPORT
#endif

typedef struct hair_groom hair_groom;
typedef struct hair_collision_mesh hair_collision_mesh;
typedef struct hair_context hair_context;
typedef struct hair_instance hair_instance;
typedef struct hair_shader hair_shader;

typedef enum hair_result {
    HAIR_OK = 0,
    HAIR_ERROR_ARGUMENT, ///< A value outside its documented range; the log names it.
    HAIR_ERROR_MEMORY, ///< hair_host.alloc or the driver refused.
    HAIR_ERROR_OPENGL, ///< No context current, older than 4.5, or a shader it would not compile.
    HAIR_ERROR_FILE, ///< Unreadable, or not in the format it claims; the log has the byte offset.
    HAIR_ERROR_VERSION ///< Compiled against another major version, or no default function was used.
} hair_result;

HAIR_API uint32_t hair_version(void); ///< The library's HAIR_VERSION. [any thread]
HAIR_API const char* hair_result_string(hair_result result); ///< Static text, never NULL. [any thread]

typedef enum hair_log_level { HAIR_LOG_ERROR = 0, HAIR_LOG_WARNING, HAIR_LOG_INFO } hair_log_level;

/// What the program lends the library. Called on the thread that called the library.
typedef struct hair_host {
    void* (*alloc)(size_t size, size_t align, void* user); ///< NULL, with free: the C library's.
    void (*free)(void* memory, size_t size, void* user); ///< size is what alloc was asked for.
    void (*log)(hair_log_level level, const char* sentence, void* user); ///< NULL: silence.
    void* user; ///< Given back in every call.
} hair_host;

/// Every desc begins with `header`, which its default function fills in where the caller is compiled: fields
/// can then be added at the end without breaking it. Always start from the defaults:
///     hair_desc desc = hair_desc_default();
typedef struct hair_struct_header {
    uint32_t size, version;
} hair_struct_header;

#define HAIR_DESC(T)                                                                                         \
    HAIR_API void T##_init(T* desc, hair_struct_header header);                                              \
    static inline T T##_default(void)                                                                        \
    {                                                                                                        \
        T desc;                                                                                              \
        hair_struct_header header = {(uint32_t)sizeof desc, HAIR_VERSION};                                   \
        T##_init(&desc, header);                                                                             \
        return desc;                                                                                         \
    }

// Grooms: no GPU, [any thread] ------------------------------------------------------------------------------

typedef enum hair_up { HAIR_UP_Y = 0, HAIR_UP_Z, HAIR_UP_X } hair_up;

/// How foreign strands become the library's: in metres, +y up, root first, fit to simulate.
typedef struct hair_import {
    hair_struct_header header;
    float scale; ///< Metres per unit of the positions. [1e-6, 1e6]. Default 1.
    hair_up up; ///< The axis that points up in them; turned to +y. Default HAIR_UP_Y.
    uint32_t tip_first; ///< 1: strands run from tip to root. [0, 1]. Default 0.
    float keep_fraction; ///< Share of the strands to keep, by `seed`. [1e-6, 1]. Default 1.
    uint32_t strand_vertices; ///< Vertices to resample every strand to. 0 (as they are) to 256. Default 0.
    uint32_t seed; ///< Of every random choice. Default 1.
} hair_import;
HAIR_DESC(hair_import)

/// What was wrong with foreign strands and what was done about it.
typedef struct hair_import_stats {
    uint32_t dropped_single; ///< Strands of fewer than two vertices, also after the repairs below.
    uint32_t dropped_short; ///< Strands shorter than 10 micrometres.
    uint32_t removed_nonfinite; ///< Vertices that were NaN, infinite or beyond 1e6 m.
    uint32_t removed_repeated; ///< Vertices nearer to the one before than 1e-5 of the strand's length.
    uint32_t resampled; ///< Strands of more than 256 vertices, brought down to 256.
} hair_import_stats;

typedef enum hair_strand_set {
    HAIR_STRAND_SET_FULL = 0, ///< Every hair: guides are chosen among them and the others follow those.
    HAIR_STRAND_SET_GUIDES ///< Guides only: followers are grown on the scalp, or around guides without one.
} hair_strand_set;

typedef enum hair_map_source {
    HAIR_MAP_SOURCE_NONE = 0, ///< 1 everywhere.
    HAIR_MAP_SOURCE_IMAGE, ///< Values of an image, by scalp_uvs, smoothly from one to the next.
    HAIR_MAP_SOURCE_VERTICES, ///< A value per vertex of the scalp, linear between.
    HAIR_MAP_SOURCE_TRIANGLES ///< A value per triangle of the scalp.
} hair_map_source;

/// Values all over a scalp.
typedef struct hair_map {
    hair_map_source source; ///< Default HAIR_MAP_SOURCE_NONE.
    const float* values; ///< Of an image row after row, the first row at v = 0. Required but for none.
    uint32_t width, height; ///< Of an image. [1, 16384] each.
} hair_map;

/// Which share of followers grows where, and how thick. A groom has up to four sets; what is drawn may lie between.
typedef struct hair_map_set {
    hair_struct_header header;
    hair_map density; ///< Share of the followers that are drawn. [0, 1].
    hair_map thickness; ///< Of a strand, as a multiple of the look's radius. [0, 4].
} hair_map_set;
HAIR_DESC(hair_map_set)

typedef struct hair_groom_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    const float* positions; ///< xyz per vertex, strand after strand; `import` says the unit. Required.
    const uint32_t* strand_vertices; ///< Vertices in each strand, any number. Required.
    uint32_t strand_count; ///< [1, 4194304].
    const hair_import* import; ///< NULL: the defaults: metres, +y up, root first.
    hair_strand_set strand_set; ///< Default HAIR_STRAND_SET_FULL.
    uint32_t guide_count; ///< To choose of HAIR_STRAND_SET_FULL. 0 (one in ten, at least 64) to 262144.
    uint32_t guide_vertices; ///< Most simulated per guide; the scalp holds two. [2, 256]. Default 32.
    uint32_t follower_count; ///< To grow for HAIR_STRAND_SET_GUIDES. [0, 4194304]. Default 18000.
    float clump_radius; ///< Of what grows around a guide, no scalp given. m. [0, 1]. Default 0.01.
    const float* scalp_positions; ///< xyz per vertex, in the space of `positions`. NULL: no scalp.
    const uint32_t* scalp_triangles; ///< Three indices each, counter-clockwise from outside.
    const float* scalp_density; ///< Per scalp vertex, share of the full density. [0, 1]. NULL: 1.
    uint32_t scalp_vertex_count; ///< [0, 4194304].
    uint32_t scalp_triangle_count; ///< [0, 4194304].
    uint32_t seed; ///< Of every random choice. Default 1.
    const float* scalp_uvs; ///< uv per scalp vertex, for maps that are images. NULL: none.
    const hair_map_set* map_sets[4]; ///< Maps on the scalp, up to the first NULL. NULL: none.
    /// Per strand, in the unit of `positions`: of the mean of all that much thicker than hair_look.radius are it and what
    /// grows of it, at most 4 times. [0, 1e6]. NULL: chance has it.
    const float* strand_radii;
    /// Of strands, linear rgb; followers between guides have what lies between. See hair_look.groom_colors. [0, 1]. NULL:
    /// none. They are kept at 8 even places from root to tip.
    const float* colors;
    /// Of each strand, at even places from root to tip; 0: one per vertex.
    uint32_t color_count; ///< [0, 256]. Default 0.
} hair_groom_desc;
HAIR_DESC(hair_groom_desc)

/// Repair strands, choose guides, find rest shapes, bind or grow followers.
HAIR_API hair_result hair_groom_create(const hair_groom_desc* desc, hair_groom** out);
HAIR_API void hair_groom_destroy(hair_groom* groom);

typedef struct hair_groom_info {
    hair_struct_header header;
    uint32_t strand_count; ///< Left after the repairs.
    uint32_t guide_count;
    uint32_t guide_vertex_count; ///< In all guides together.
    uint32_t follower_count; ///< Strands drawn at full density.
    uint32_t patch_count;
    float length[3]; ///< Of the strands: least, mean, greatest. m.
    float lower[3], upper[3]; ///< Bounds of the strands at rest. m.
    hair_import_stats import_stats;
} hair_groom_info;
HAIR_DESC(hair_groom_info)

HAIR_API hair_result hair_groom_describe(const hair_groom* groom, hair_groom_info* out);

// Collision meshes: no GPU, [any thread] -------------------------------------------------------------------------------

/// The shape of a collider by a triangle mesh, kept as the distance to it at the nodes of a grid. A mesh is closed
/// when at every edge as many triangles pass one way as the other, by the positions of vertices; then it has an
/// inside. An open one is taken for a shell, and the log warns. Triangles may touch, cross and be degenerate.
typedef struct hair_collision_mesh_desc {
    hair_struct_header header;
    /// NULL: the C library's allocator, no log. Kept as long as the collision mesh is.
    const hair_host* host;
    const float* positions; ///< xyz per vertex, in the collision mesh's own space. m. [-1e6, 1e6]. Required.
    const uint32_t* triangles; ///< Three indices each, counter-clockwise from outside. Required.
    uint32_t vertex_count; ///< [1, 16777216].
    uint32_t triangle_count; ///< [1, 16777216].
    uint32_t resolution; ///< Voxels along the longest side. [8, 256]. Default 64.
    /// Their size instead, as far as 256 of them suffice.
    float voxel_size; ///< m. 0 (by resolution) to 1e6. Default 0.
    float thickness; ///< Of the shell that an open mesh is; at least 2 voxels. m. [0, 1e6]. Default 0.
    float padding; ///< Kept around the surface too, for colliders rounded by it. m. [0, 1e6]. Default 0.
} hair_collision_mesh_desc;
HAIR_DESC(hair_collision_mesh_desc)

/// Take the distance to the mesh at every node of the grid. Seconds for a fine grid or for millions of triangles.
HAIR_API hair_result hair_collision_mesh_create(const hair_collision_mesh_desc* desc,
                                                hair_collision_mesh** out);
HAIR_API void hair_collision_mesh_destroy(hair_collision_mesh* mesh);

typedef struct hair_collision_mesh_info {
    hair_struct_header header;
    uint32_t closed; ///< 1: the mesh has an inside. 0: it is a shell.
    uint32_t unused; ///< Triangles that use a vertex twice.
    uint32_t size[3]; ///< Nodes of the grid along each axis.
    float voxel_size; ///< Between two of them. m.
    float thickness; ///< Of the shell. 0 where there is none. m.
    float lower[3], upper[3]; ///< Bounds of the surface. m.
    uint64_t bytes; ///< Of memory.
} hair_collision_mesh_info;
HAIR_DESC(hair_collision_mesh_info)

HAIR_API hair_result hair_collision_mesh_describe(const hair_collision_mesh* mesh,
                                                  hair_collision_mesh_info* out);

// Context: [GL] ---------------------------------------------------------------------------------------------

typedef enum hair_gl_state {
    HAIR_GL_STATE_RESTORE = 0, ///< A [GL] call leaves all OpenGL state as it found it.
    HAIR_GL_STATE_CLOBBER ///< It may change: program, vertex array, patch vertices, culling, primitive restart,
    ///< indirect draw and dispatch buffers, storage buffers 0-7, uniform buffers 0-2, buffer textures of units 0-7,
    ///< buffer textures of units 17 and 18, 2D textures, samplers of units 12-16 and 19-23, 3D textures, samplers of units 8-11, image units 0-1.
} hair_gl_state;

/// Where a host keeps programs as its driver has compiled them, so that they need not be compiled in every run: bytes under
/// keys, in files or wherever it likes. Of what it gives back, anything that is damaged, cut off or of another driver is
/// noticed, and the program compiled and kept again. Strangers should not be able to write there: drivers believe what is
/// whole. Called while the context is used, on that thread.
typedef struct hair_cache {
    /// Copy what was put under the key, if that is no more than `capacity` bytes. Returns how many it is; 0: nothing is there.
    size_t (*get)(uint64_t key, void* bytes, size_t capacity, void* user);
    /// Keep a copy, in place of what was there; or do not.
    void (*put)(uint64_t key, const void* bytes, size_t size, void* user);
    void* user; ///< Given back in every call.
} hair_cache;

typedef struct hair_context_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    void* (*get_proc)(const char* name, void* user); ///< Finds OpenGL functions. Required.
    void* get_proc_user; ///< Given back to get_proc.
    hair_gl_state gl_state; ///< Default HAIR_GL_STATE_RESTORE.
    uint32_t timings; ///< 1: time passes, for hair_get_timings. [0, 1]. Default 0.
    const char* glsl_dir; ///< For development: glsl/ read from here. NULL: built in.
    /// Copied; get and put are required. NULL: every program is compiled.
    const hair_cache* cache; ///< Default NULL.
} hair_context_desc;
HAIR_DESC(hair_context_desc)

/// Compiles no program yet: each is compiled when something first needs it, and kept as long as the context.

HAIR_API hair_result hair_context_create(const hair_context_desc* desc, hair_context** out);
HAIR_API void hair_context_destroy(hair_context* context);

/// Compile the shaders of glsl_dir that have been needed again. One that fails to compile keeps its last good program.
HAIR_API hair_result hair_context_reload(hair_context* context);

/// OpenGL memory of a context's buffers and textures: of its instances, and what these share. Programs are not counted, nor
/// what a driver adds. Bytes.
typedef struct hair_memory {
    hair_struct_header header;
    uint64_t bytes; ///< In use now.
    uint64_t peak; ///< In use at once, since the context was created.
    uint64_t limit; ///< 0: none.
} hair_memory;
HAIR_DESC(hair_memory)

HAIR_API hair_result hair_get_memory(const hair_context* context, hair_memory* out); ///< No OpenGL.

/// From now on, what would take more than `bytes` in all is HAIR_ERROR_MEMORY, with both numbers in the log, and the call that
/// needed it does nothing: nothing is left out in silence. What is in use stays. 0, the default: no limit. No OpenGL.
HAIR_API hair_result hair_set_memory_limit(hair_context* context, uint64_t bytes);

// Instance: [GL] --------------------------------------------------------------------------------------------

typedef enum hair_solver {
    HAIR_SOLVER_DIRECT = 0, ///< Second order, exact lengths, implicit bending. Robust; the default.
    HAIR_SOLVER_ACCURATE, ///< Second order without damping of its own, finer substeps: least error.
    HAIR_SOLVER_FOLLOW, ///< Follow the leader, one pass: cheapest. Never stretches, never converges.
    HAIR_SOLVER_REDBLACK ///< Tariq 2010: Verlet, red/black constraints, `redblack.iterations` times. Stretches.
} hair_solver;

typedef enum hair_root {
    HAIR_ROOT_CLAMPED = 0, ///< Held by the scalp in place and direction.
    HAIR_ROOT_HINGED, ///< Held in place, free to turn.
    HAIR_ROOT_FREE ///< Held by nothing.
} hair_root;

/// How hair moves. Of redblack only: those in redblack; it has none of: youngs_modulus to tip_mass, drag to pressure_stiffness.
typedef struct hair_physics {
    hair_struct_header header;
    float gravity[3]; ///< m/s^2. [-1000, 1000]. Default (0, -9.81, 0).
    /// Decay rate c of the velocity v relative to the air's velocity u: dv/dt = -c (v - u). The default
    /// stands for the drag of a hair among others. With a `drag` of 0.1, the law of hair_wind lets a level
    /// hair of the default radius and density fall at v = 2.3 m/s, which is a rate of g / v = 4.3 1/s.
    /// Without wind only this rate acts, because it is much cheaper than the law.
    float damping; ///< 1/s. [0, 1000]. Default 4.
    /// Pull to the rest pose near the root, as a frequency.
    float shape_frequency_root; ///< Hz. [0, 30]. Default 4.
    float shape_frequency_tip; ///< The same at the tip; linear between. Hz. [0, 30]. Default 1.
    struct {
        /// Angular force to the rest angle with the segment before.
        float angular_hz; ///< Hz. [0, 30]. Default 8.
        float bend; ///< Angular constraint: share removed by an iteration. [0, 1]. Default 0.1.
        uint32_t iterations; ///< Of constraints in a substep. [1, 256]. Default 20.
    } redblack; ///< Used by HAIR_SOLVER_REDBLACK only.
    float collision_margin; ///< Distance kept to colliders. m. [0, 0.1]. Default 0.001.
    float youngs_modulus; ///< Young's modulus of a hair. Pa. [0, 1e12]. Default 4e9.
    float poisson_ratio; ///< Poisson's ratio: how much softer twist is than bending. [0, 0.5]. Default 0.45.
    float fiber_radius; ///< Of a section's circle of like area. m. [1e-6, 1e-3]. Default 4e-5.
    float fiber_density; ///< kg/m^3. [1, 1e5]. Default 1300.
    float flatness; ///< Short by long axis of its section. [0.03, 1]. Default 1.
    float stiffness_root; ///< Of bending and twist, as a multiple, at the root. [0, 1e4]. Default 1.
    float stiffness_tip; ///< The same at the tip; linear between. [0, 1e4]. Default 1.
    /// Fraction of gravity that the rest shape bears. 1 keeps the groom.
    float gravity_preload; ///< [0, 1]. Default 1.
    hair_root root; ///< Default HAIR_ROOT_CLAMPED.
    float tip_mass; ///< Hung on the tip, as a multiple of the strand's mass. [0, 1e4]. Default 0.
    /// Multiple of the law of hair_wind, which holds for a single hair. A lock of n hairs of diameter d that
    /// fill the fraction f of a cylinder has the diameter D = d sqrt(n / f). With the law's coefficient C,
    /// a hair of the lock has D C(Re_D) / (n d C(Re_d)) times the drag of a single hair. This is 0.1 at
    /// 2 m/s for n = 64 and f = 0.3. Use 1 for a single hair.
    float drag; ///< [0, 10]. Default 0.1.
    float friction; ///< Coulomb's coefficient with colliders, whose own multiplies it. [0, 10]. Default 0.3.
    /// Decay rate of the velocity of hair relative to the rigid motion of the hair around. Cohesion and volume keep the
    /// momentum and the angular momentum of all hair together. They do not reach hair that is off the head and farther
    /// from it than it is long.
    float cohesion; ///< 1/s. [0, 1000]. Default 0.
    /// How hair resists being denser than at rest, as a gas does, by its speed of sound squared: it is e times as
    /// dense at the foot of a height of pressure_stiffness / gravity. At most what crosses half a cell of the grid, 1 cm or
    /// more, in 1/120 s.
    float pressure_stiffness; ///< m^2/s^2. [0, 100]. Default 0.
    /// Level of detail: the share of the solver's own substeps that is made, in halves: 1, 1/2, 1/4, … They are as much
    /// longer, but none is longer than 1/60 s; steps that complete none only move on what is drawn, which is one
    /// substep behind. Of redblack, which stretches the more the fewer they are, nothing is left out.
    float substep_rate; ///< [0.0625, 1]. Default 1.
    /// Hair that is this near to where it comes to rest sleeps: hair_step then calls no OpenGL and costs next to nothing.
    /// It wakes when the head moves by a quarter of this, and when physics, wind, pins, a skinned scalp or colliders within
    /// reach change; in wind that moves of its own it stays awake. At 0 it never sleeps. It falls asleep at the same step in
    /// every run unless the GPU is behind by four steps and 0.1 s, as no GPU is whose pictures are shown: that is not waited
    /// for, and hair then falls asleep later.
    float sleep_threshold; ///< m. [0, 0.01]. Default 1e-4.
    /// The rate instead, where it is lower, of hair that has not been seen for 0.25 s: that no hair_draw showed any of, nor
    /// hair_read_positions asked for. In the step after it is seen again the rate is what it was; nothing jumps then.
    float offscreen_substep_rate; ///< [0.0625, 1]. Default 1.
} hair_physics;
HAIR_DESC(hair_physics)

typedef enum hair_preset {
    HAIR_PRESET_NATURAL = 0, ///< The defaults.
    HAIR_PRESET_FINE, ///< Thin and light: bends easily, stops soon.
    HAIR_PRESET_THICK, ///< Stiff, swings long.
    HAIR_PRESET_WET, ///< Heavy, soft, sticks to skin.
    HAIR_PRESET_FRIZZY, ///< Flat hairs that hold each other off: stiff, airy.
    HAIR_PRESET_COUNT
} hair_preset;

/// Make `physics`, which its default function has made, of a kind of hair: sets youngs_modulus, fiber_radius,
/// fiber_density, flatness, stiffness, damping and friction, and leaves the rest. [any thread]
HAIR_API hair_result hair_physics_preset(hair_physics* physics, hair_preset preset);
HAIR_API const char* hair_preset_name(hair_preset preset); ///< "natural", "fine", … NULL beyond the last.

/// What becomes of followers that come into colliders, though no guide does. Where there are no colliders in reach, nothing
/// is done and nothing paid for it.
typedef enum hair_follower_collision {
    HAIR_FOLLOWER_COLLISION_PUSH_OUT = 0, ///< Led round them, smoothly, as long as they were; the default.
    HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE, ///< Tariq 2010: below the first vertex inside, each follows its own guide alone.
    HAIR_FOLLOWER_COLLISION_NONE ///< They go through.
} hair_follower_collision;

/// A number along a strand, smooth and without going beyond its neighbours: at[i] at i/7 of the length from the root.
typedef struct hair_curve {
    float at[8];
} hair_curve;

/// The curve that goes evenly from one number to another.
static inline hair_curve hair_curve_line(float root, float tip)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = root + (tip - root) * (float)i / 7;
    return curve;
}

/// What followers between guides are made of. Those that a groom of full strands binds have one guide each.
typedef enum hair_interpolation {
    HAIR_INTERPOLATION_MIXED = 0, ///< Both of the below, by hair_look.clump along the strand.
    HAIR_INTERPOLATION_SINGLE, ///< Tariq 2010: offsets from one guide, in its frame. Locks, at worst ropes.
    HAIR_INTERPOLATION_MULTI ///< Tariq 2010: the weighted mean of three guides. Full and even.
} hair_interpolation;

typedef enum hair_curl_shape {
    HAIR_CURL_SHAPE_HELIX = 0, ///< A circle a turn.
    HAIR_CURL_SHAPE_EXAMPLE ///< curl_profile_x and curl_profile_z: see hair_look_fit_curl.
} hair_curl_shape;

/// How strands scatter light.
typedef enum hair_shading {
    HAIR_SHADING_FIBRES =
        0, ///< Marschner et al. 2003, Zinke et al. 2008: light goes through strands; the default.
    HAIR_SHADING_LINES ///< Kajiya and Kay 1989 with two highlights: cheaper, needs no table.
} hair_shading;

/// How light is found that hair leaves to itself.
typedef enum hair_self_shadow {
    /// At every vertex that is drawn, by how far it lies behind what its light's hair_shadow_map shows, times
    /// hair_look.absorption. Needs no memory, and tells little of single strands.
    HAIR_SELF_SHADOW_DEPTH = 0,
    /// Once for the vertices of all strands, which takes memory for them: by what lies along their segments in front of them
    /// in the hair_shadow_map, and by a grid of how much hair there is, which also knows about lights that have no
    /// hair_shadow_map, about the sky, and about hair_set_colliders. For views of one hair_view.frame_index it is found once.
    HAIR_SELF_SHADOW_STRANDS
} hair_self_shadow;

/// How hair looks. What strays, kinks and curls is off where its share, curve or radius is 0, and costs nothing then. A
/// curve that is not 0 at the root takes it off the scalp.
typedef struct hair_look {
    hair_struct_header header;
    float root_color[3]; ///< Reflectance of much hair at the root. [0, 1]. Default (0.13, 0.055, 0.024).
    float tip_color[3]; ///< The same at the tip. [0, 1]. Default (0.26, 0.13, 0.06).
    float color_spread; ///< Relative spread of brightness between strands. [0, 1]. Default 0.4.
    hair_shading shading; ///< Default HAIR_SHADING_FIBRES.
    float roughness[2]; ///< Of fibres, along and round them. [0.05, 1]. Default (0.3, 0.4).
    float cuticle_tilt; ///< Of the scales of fibres, which moves highlights. Radians. [0, 0.3]. Default 0.05.
    float scattering; ///< Share of the light from other fibres that is heeded. [0, 1]. Default 1.
    float specular[2]; ///< Of lines: the white and the coloured highlight. [0, 4]. Default (0.05, 0.5).
    float gloss[2]; ///< Of lines: their exponents. [1, 1000]. Default (60, 15).
    float radius; ///< Of a drawn strand; it may stand for several. m. [1e-6, 0.01]. Default 1.5e-4.
    hair_curve taper; ///< As a share of that. [0, 4]. Default (1, 0.99, 0.96, 0.91, 0.84, 0.74, 0.63, 0.5).
    float length; ///< Share of every strand that is drawn, cut off beyond. [0.01, 1]. Default 1.
    /// The most by which strands are shorter at random, as a share.
    float length_variation; ///< [0, 1]. Default 0.
    hair_interpolation interpolation; ///< Default HAIR_INTERPOLATION_MIXED.
    hair_curve clump; ///< 0 multi, 1 single. [0, 1]. Default (0, 0, 0.07, 0.18, 0.32, 0.46, 0.56, 0.6).
    hair_curve clump_width; ///< Offsets from one guide, as a multiple. [0, 4]. Default 1.
    float tip_stray_fraction; ///< Share of the strands that stray near their tips. [0, 1]. Default 0.3.
    /// How far, in lengths.
    hair_curve tip_stray_distance; ///< [0, 1]. Default (0, 0, 0, 0, 0.001, 0.004, 0.012, 0.025).
    float stray_fraction; ///< Share of the strands that stray all along. [0, 1]. Default 0.1.
    /// How far, in lengths.
    hair_curve stray_distance; ///< [0, 1]. Default (0, 0, 0.01, 0.02, 0.02, 0.02, 0.02, 0.02).
    hair_curve frizz; ///< How far every strand kinks. m. [0, 0.1]. Default 0.
    float frizz_wavelength; ///< From one of its kinks to the next. m. [0.001, 1]. Default 0.015.
    /// Strands turn about the way they would go, in the frame that their guide carries: what they reach stays, and the
    /// strand that is drawn is longer. Turns need some eight `segments` each.
    float curl_radius; ///< Of curls or waves. m. [0, 0.1]. Default 0.
    hair_curve curl_profile; ///< Along the strand, a multiple. [0, 2]. Default (0, 0.6, 0.9, 1, 1, 1, 1, 1).
    float curl_wavelength; ///< Along the strand, of a turn. m. [0.001, 10]. Default 0.05.
    float curl_turns; ///< Beside those, turns from root to tip. [0, 100]. Default 0.
    float curl_flatness; ///< From 0, a helix, to 1, a wave in a plane. [0, 1]. Default 0.
    float curl_left_fraction; ///< Share of the guides whose strands turn to the left. [0, 1]. Default 0.
    float curl_guide_phase; ///< How far apart guides are in their turns. Turns. [0, 1]. Default 1.
    float curl_strand_phase; ///< The same of the strands of one guide. Turns. [0, 1]. Default 0.1.
    float curl_spread; ///< Relative spread of radius and length of turns. [0, 0.9]. Default 0.1.
    hair_curl_shape curl_shape; ///< Default HAIR_CURL_SHAPE_HELIX.
    /// At i/16 of a turn, across the strand, as a share of the radius.
    float curl_profile_x[16]; ///< [-1, 1]. Default 0.
    float curl_profile_z[16]; ///< The same at right angles to it. [-1, 1]. Default 0.
    float absorption; ///< Strands that light meets, of HAIR_SELF_SHADOW_DEPTH. 1/m. [0, 10000]. Default 200.
    float density; ///< Share of the followers drawn. [0, 1]. Default 1.
    uint32_t segments; ///< Line segments of a drawn strand. [1, 256]. Default 32.
    /// Of followers with colliders.
    hair_follower_collision follower_collision; ///< Default HAIR_FOLLOWER_COLLISION_PUSH_OUT.
    float map_set; ///< Of the groom's sets of maps, from 0; between two a blend. [0, 3]. Default 0.
    /// Of the colours from root_color to tip_color, at i/7 of the strand and evenly between. At most 1 comes of it.
    hair_curve tint_red; ///< Times the red. [0, 4]. Default 1.
    hair_curve tint_green; ///< Times the green. [0, 4]. Default 1.
    hair_curve tint_blue; ///< Times the blue. [0, 4]. Default 1.
    float hue_spread; ///< Relative spread of red against blue between strands. [0, 1]. Default 0.
    float roughness_spread; ///< Relative spread of roughness between strands. [0, 1]. Default 0.
    float cuticle_tilt_spread; ///< Relative spread of tilt between strands. [0, 1]. Default 0.25.
    float root_darkening; ///< Share of the colour that is lost at the root. [0, 1]. Default 0.
    float root_darkening_length; ///< Share of the strand over which it comes back. [0.001, 1]. Default 0.15.
    float streaks; ///< Share of the strands that have another colour. [0, 1]. Default 0.
    float streak_color[3]; ///< Theirs, from root to tip. [0, 1]. Default (0.6, 0.42, 0.22).
    float streak_clumping; ///< Share of strands that go by what their lock does. [0, 1]. Default 0.8.
    float sparkle; ///< Of lines: how the coloured highlight glitters along strands. [0, 1]. Default 0.
    /// Water makes hair darker and smoother, draws strands together and holds down what strays: it changes the numbers
    /// above, not how they are drawn. How wet hair moves is a preset of hair_physics.
    float wetness; ///< [0, 1]. Default 0.
    /// Share of the colours that the groom has of its own, if any, in those from root_color to tip_color. Spreads, streaks and
    /// root_darkening go on top.
    float groom_colors; ///< [0, 1]. Default 1.
    hair_self_shadow self_shadow; ///< Default HAIR_SELF_SHADOW_DEPTH.
    /// Of HAIR_SELF_SHADOW_STRANDS: cells of its grid, at least.
    float self_shadow_cell; ///< m. [0.001, 1]. Default 0.004.
} hair_look;
HAIR_DESC(hair_look)

typedef enum hair_look_preset {
    HAIR_LOOK_NATURAL = 0, ///< The defaults.
    HAIR_LOOK_STRAIGHT, ///< Sleek: hardly a strand strays.
    HAIR_LOOK_WAVY, ///< Locks in flat waves of 85 mm.
    HAIR_LOOK_CURLY, ///< Locks that turn, 24 mm wide, every 50 mm.
    HAIR_LOOK_COILY, ///< Strands that turn, 9 mm wide, every 18 mm.
    HAIR_LOOK_FRIZZY, ///< Every strand kinks its own way.
    HAIR_LOOK_SHORT, ///< A third of the length, unevenly.
    HAIR_LOOK_COUNT
} hair_look_preset;

/// Make `look`, which its default function has made, of a kind: sets what is from taper to curl_profile_z, raises segments to what
/// turns need in hair of 0.4 m, and leaves the rest. [any thread]
HAIR_API hair_result hair_look_apply_preset(hair_look* look, hair_look_preset preset);
HAIR_API const char*
hair_look_name(hair_look_preset preset); ///< "natural", "straight", … NULL beyond the last.

typedef enum hair_color {
    HAIR_COLOR_BROWN = 0, ///< The defaults.
    HAIR_COLOR_DARK_BROWN,
    HAIR_COLOR_BLACK,
    HAIR_COLOR_BLOND,
    HAIR_COLOR_RED,
    HAIR_COLOR_AUBURN,
    HAIR_COLOR_GRAY,
    HAIR_COLOR_WHITE,
    HAIR_COLOR_BLUE, ///< Dyed.
    HAIR_COLOR_COUNT
} hair_color;

/// Colour `look`: sets root_color, tip_color and color_spread. [any thread]
HAIR_API hair_result hair_look_color(hair_look* look, hair_color color);
HAIR_API const char* hair_color_name(hair_color color); ///< "brown", "dark_brown", … NULL beyond the last.

/// Curl `look` as an example does: one turn or wave of a strand, as [3, 65536] vertices of xyz, m, which is repeated. Its
/// axis runs as from its first vertex to its last, [0.001, 10] m apart; no vertex is farther from it than 0.1 m. Sets curl_shape,
/// curl_profile_x, curl_profile_z, curl_radius, curl_wavelength and curl_turns. [any thread]
HAIR_API hair_result hair_look_fit_curl(hair_look* look, const float* positions, uint32_t vertex_count);

typedef enum hair_thread_mapping {
    HAIR_THREAD_MAPPING_AUTO = 0, ///< By driver and number of guides, never by timing.
    HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, ///< A work group per guide, a thread per vertex. redblack has no other by compute.
    /// A thread per guide: fastest on software rasterisers, which may not let one thread do all for long guides among many
    /// colliders. Then a work group does, as on hardware for guides of more than 128 vertices.
    HAIR_THREAD_MAPPING_THREAD_PER_GUIDE,
    /// Of redblack, on a rigid head, for comparison: without compute shaders, as Tariq 2010 under Direct3D 10: vertices are
    /// captured by transform feedback, from one buffer into another, for every phase of every iteration. To be created and
    /// stepped without transform feedback of the host under way. hair_solver_stats.reset counts nothing.
    HAIR_THREAD_MAPPING_FEEDBACK
} hair_thread_mapping;

/// How the first vertex of a follower that is inside a collider is found: the answer is the same.
typedef enum hair_hit_method {
    HAIR_HIT_METHOD_AUTO = 0, ///< The faster: by compute.
    HAIR_HIT_METHOD_COMPUTE, ///< Vertices are gone through up to the first.
    HAIR_HIT_METHOD_PREPASS ///< Tariq 2010: vertices are drawn as points, a texel per follower keeps the least.
} hair_hit_method;

typedef struct hair_desc {
    hair_struct_header header;
    const char* label; ///< Name in the log and in GPU debuggers. NULL: "hair".
    hair_solver solver; ///< Default HAIR_SOLVER_DIRECT.
    float substep; ///< Length of a substep. s. 0 (as the solver wants) to 0.1, from 1e-5 on. Default 0.
    hair_thread_mapping thread_mapping; ///< Of guides to GPU threads. Default HAIR_THREAD_MAPPING_AUTO.
    float max_dt; ///< Longest a step advances; beyond, time slows. s. [1e-3, 1]. Default 0.1.
    const hair_physics* physics; ///< NULL: the defaults.
    const hair_look* look; ///< NULL: the defaults.
    float transform[16]; ///< Groom to world. Rigid, by at most 1e9 m. Default identity.
    float field_voxel; ///< Side of a voxel of the field, see hair_field_info. m. [0.0005, 1]. Default 0.005.
    hair_hit_method hit_method; ///< Default HAIR_HIT_METHOD_AUTO.
    /// 1 watches the energy of guides for hair_solver_stats.gaining. It costs a dispatch in each step in which nothing drives hair.
    uint32_t diagnose; ///< [0, 1]. Default 0.
} hair_desc;
HAIR_DESC(hair_desc)

HAIR_API hair_result hair_create(hair_context* context, const hair_groom* groom, const hair_desc* desc,
                                 hair_instance** out);
HAIR_API void hair_destroy(hair_instance* hair);
HAIR_API hair_result hair_set_physics(hair_instance* hair, const hair_physics* physics);
HAIR_API hair_result hair_set_look(hair_instance* hair, const hair_look* look);

/// Move the head. The next step carries the roots there, shortest way, evenly over its substeps.
HAIR_API hair_result hair_set_transform(hair_instance* hair, const float transform[16]);

/// Skin the scalp: at the next step it is to be where these positions have the vertices of the groom's scalp, xyz every
/// `stride` bytes, a multiple of 4 in [12, 4096]. `count` is that of the groom. `to_world`: where they are given, rigid;
/// NULL: in the world. Roots ride on the triangles they sit on, evenly over the step, shifted and turned as these are.
/// The first time, hair comes from where the scalp is at rest: hair_reset places it. A scalp that is not given anew
/// goes along with the head, so give it anew with every hair_set_transform that the head's bone asks for. The field,
/// the crowd and hair_get_bounds go by the head alone, which should be where the scalp is.
HAIR_API hair_result hair_set_scalp(hair_instance* hair, const float* positions, uint32_t count,
                                    size_t stride, const float to_world[16]);

/// The same out of an OpenGL buffer, which is read at the call, on the GPU: what shaders wrote before is seen, and
/// nothing is waited for. `offset` is that of the first position, in bytes. Roots of triangles with what is not finite
/// stay as they are against the head.
HAIR_API hair_result hair_set_scalp_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset,
                                           size_t stride, const float to_world[16]);

/// How air goes around head and colliders.
typedef enum hair_wind_model {
    HAIR_WIND_AMBIENT = 0, ///< By formulas: see hair_wind.shelter. Cheap.
    /// As a fluid on a grid around the hair: with a wake, and lee behind the head. Of what the field knows.
    /// It moves on in 1/60 s, or a substep if that is longer; hair_reset and hair_teleport begin anew with the wind, and
    /// so does hair_load unless resolution and grid_size are as they were saved.
    HAIR_WIND_FLUID
} hair_wind_model;

/// How the fluid is kept from being pressed together. The defaults leave less than a thousandth of what was to be done.
typedef enum hair_projection {
    HAIR_PROJECTION_MULTIGRID = 0, ///< Cycles over ever coarser grids: the fastest by far; the default.
    HAIR_PROJECTION_RELAXATION, ///< Sweeps of Gauss and Seidel that go beyond.
    HAIR_PROJECTION_JACOBI ///< Tariq 2010: sweeps of Jacobi.
} hair_projection;

/// What blows from a place, on top of the wind. Start from hair_wind_source_default.
typedef struct hair_wind_source {
    float position[3]; ///< World. m. [-1e9, 1e9]. Default 0.
    float direction[3]; ///< Of a jet, any length. 0: it blows to all sides. [-1e6, 1e6]. Default 0.
    /// At its mouth; of a source to all sides below 0: it draws in.
    float speed; ///< m/s. [-1000, 1000]. Default 5.
    float radius; ///< Of the mouth. m. [0.001, 100]. Default 0.05.
} hair_wind_source;

static inline hair_wind_source hair_wind_source_default(void)
{
    hair_wind_source source = {{0, 0, 0}, {0, 0, 0}, 5, 0.05f};
    return source;
}

/// Air that moves. By it guides are dragged along as cylinders of hair_physics.fiber_radius in a flow: across them with a
/// coefficient of 1 + 9.75 Re^-0.744, the form of White 1991, along them as heat passes from them. Guides stand for locks,
/// whose hairs shelter each other: so hair_physics.drag is below 1. hair_physics.damping stands for the
/// drag of the same air. Across and along a guide, therefore, the greater of damping and the law acts.
typedef struct hair_wind {
    hair_struct_header header;
    hair_wind_model model; ///< Default HAIR_WIND_AMBIENT.
    float velocity[3]; ///< Of the air, in the world. m/s. [-1000, 1000]. Default 0.
    /// 1 applies the law also where no wind blows, at the cost of a wind. A level hair then falls at
    /// 0.47 m/s when hair_physics.drag is 1. 0 leaves still air to hair_physics.damping, whose default lets
    /// every hair fall at 2.45 m/s.
    uint32_t still_air; ///< [0, 1]. Default 0.
    float density; ///< Of the air. kg/m^3. [0.001, 1000]. Default 1.204.
    float viscosity; ///< Of the air, dynamic. Pa s. [1e-7, 1]. Default 1.82e-5.
    uint32_t resolution; ///< Of the fluid: cells along a side, up to a multiple of 16. [16, 128]. Default 32.
    float grid_size; ///< Of the fluid: its side. m. 0 (half as long again as the field's) to 100. Default 0.
    hair_projection projection; ///< Of the fluid. Default HAIR_PROJECTION_MULTIGRID.
    uint32_t projection_iterations; ///< Or sweeps, of that, in 1/60 s. 0 (what suffices) to 10000. Default 0.
    /// Gusts are turbulence, of the same statistics every way, that the wind carries along: von Karman's spectrum.
    /// Standard deviation of each component, as a share of the wind's speed.
    float turbulence_intensity; ///< [0, 2]. Default 0.
    /// Integral length scale: gusts are some times as long.
    float turbulence_length; ///< m. [0.1, 1000]. Default 1.
    uint32_t seed; ///< Of gusts. Default 1.
    /// How much the head, as far as its place is told from roots, and the largest colliders of up to 0.5 m around it divert
    /// wind and gusts, as balls: before them by potential flow, behind by a wake.
    float shelter; ///< [0, 1]. Default 1.
    const hair_wind_source* sources; ///< Copied. NULL: none.
    uint32_t source_count; ///< [0, 4]. Default 0.
    /// The application's own wind, on top of all this: xyz in m/s along the world's axes. Read while steps run, and 0 where
    /// it is not finite, outside, and when it has been deleted.
    uint32_t texture; ///< Of OpenGL: 3D, of floats. 0: none. Default 0.
    float texture_transform[16]; ///< World to its coordinates. Affine. Default identity.
    /// Hair slows the fluid as porous matter does: as so many strands that lie where guides are, each of which takes from
    /// air what hair_physics.drag gives to a guide. A scalp has some 100000. 0: air blows through hair as through nothing.
    uint32_t drag_strand_count; ///< [0, 10000000]. Default 0.
} hair_wind;
HAIR_DESC(hair_wind)

/// From the next step on the air moves so. NULL, or the defaults: there is no wind, and nothing is paid for it. Gusts go
/// on from where they are, whatever else of it changes; hair_reset begins them anew. redblack has no wind.
HAIR_API hair_result hair_set_wind(hair_instance* hair, const hair_wind* wind);

typedef enum hair_shape {
    HAIR_SHAPE_SPHERE = 0, ///< size[0]: radius.
    HAIR_SHAPE_CAPSULE, ///< size[0]: radius. size[1]: half the length of its axis, which is local y.
    HAIR_SHAPE_BOX, ///< size: half the lengths of its sides.
    HAIR_SHAPE_CYLINDER, ///< size[0]: radius. size[1]: half its height, along local y.
    HAIR_SHAPE_CONE, ///< size[0]: radius of its base, at local y = -size[1]. Its tip is at +size[1].
    HAIR_SHAPE_PLANE, ///< All that is below local y = 0.
    HAIR_SHAPE_MESH ///< `mesh`, `scale` times as large.
} hair_shape;

/// Start from hair_collider_default.
typedef struct hair_collider {
    hair_shape shape; ///< Default HAIR_SHAPE_SPHERE.
    float position[3]; ///< World. m. [-1e9, 1e9]. Default 0.
    float rotation[4]; ///< World. Unit quaternion, xyzw. Default identity.
    float size[3]; ///< As the shape says. m. [0, 1e6], above 0 unless it is rounded. Default 0.
    float rounding; ///< Added all round, which rounds edges. m. [0, 1e6]. Default 0.
    float scale; ///< Of a collision mesh. [1e-6, 1e6]. Default 1.
    float friction; ///< Coulomb's coefficient is this times hair_physics.friction. [0, 100]. Default 1.
    const hair_collision_mesh* mesh; ///< Of HAIR_SHAPE_MESH; held as long as the collider is. Default NULL.
    uint64_t key; ///< Tells it from others, from step to step. 0: its place does. Default 0.
} hair_collider;

static inline hair_collider hair_collider_default(void)
{
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}, 0, 1, 1, NULL, 0};
    return collider;
}

/// Replace the colliders; `stride` is sizeof(hair_collider). count in [0, 1048576]. A collider moves from where the one of
/// its key was at the last step; of those without a key the i-th from where the i-th was, so keep their order. One
/// that was not there, or had another shape, starts where it is. Guides collide with all of them, collision meshes too; of more
/// than 64 within some centimetres of a vertex with the 64 nearest there. Those of redblack collide with spheres and
/// capsules only, the 64 nearest to the head. A guide meets a collider at its vertices: a rod, or the edge of a plate,
/// that is thinner than its segments are long may come between two of them. Followers and the field know all colliders.
HAIR_API hair_result hair_set_colliders(hair_instance* hair, const hair_collider* colliders, uint32_t count,
                                        size_t stride);

typedef enum hair_pin_to {
    HAIR_PIN_HEAD = 0, ///< The head: hair that is tied back, a clip.
    HAIR_PIN_WORLD ///< The world: a hand, a hook.
} hair_pin_to;

/// A vertex of a guide that is held in place, free to turn. Start from hair_pin_default.
typedef struct hair_pin {
    uint32_t guide; ///< As hair_read_positions has them, from 0. Default 0.
    uint32_t vertex; ///< Of the guide, from 1; beyond its last: its tip. Default 4294967295.
    hair_pin_to to; ///< What holds it. Default HAIR_PIN_HEAD.
    float position[3]; ///< In groom space, or in the world. m. [-1e9, 1e9]. Default 0.
} hair_pin;

static inline hair_pin hair_pin_default(void)
{
    hair_pin pin = {0, UINT32_MAX, HAIR_PIN_HEAD, {0, 0, 0}};
    return pin;
}

/// Replace the pins; `stride` is sizeof(hair_pin). count in [0, 1048576], of different vertices; redblack has none.
/// The next step carries each vertex from where it is to its place, evenly over its substeps; one whose pin is gone
/// goes on as it moved. A guide that is tied farther off than it is long is stretched, see hair_solver_stats.overextended.
/// hair_teleport takes pins in the world along.
HAIR_API hair_result hair_set_pins(hair_instance* hair, const hair_pin* pins, uint32_t count, size_t stride);

/// A box in the world that no strand leaves on the way from the last step to where the head is, unless its root is
/// free: what is outside need not be among the colliders.
HAIR_API hair_result hair_get_bounds(const hair_instance* hair, float lower[3], float upper[3]);

/// Advance by `dt` seconds, in substeps of the desc's fixed length: the motion does not depend on the frame
/// rate, and what is drawn is interpolated to now. The same inputs on the same driver give the same bits, but for what
/// hair_physics.sleep_threshold says. No step waits for the GPU.
/// dt >= 0; 0 does nothing; beyond max_dt time slows, and the log says so once.
HAIR_API hair_result hair_step(hair_instance* hair, float dt);

/// Put every strand in its rest pose, at rest, under the current transform.
HAIR_API hair_result hair_reset(hair_instance* hair);

/// Move the head without moving the hair against it: shape and motion go along, nothing swings.
HAIR_API hair_result hair_teleport(hair_instance* hair, const float transform[16]);

/// Write all that the coming motion depends on but settings (physics, wind, look): strands, head, colliders, pins, air, how
/// far gusts have gone, the time since the last substep; of collision meshes only a mark. `size` becomes the bytes it takes, also when `capacity` is too
/// small, which is an error; NULL and a capacity of 0 only ask for it. Waits.
HAIR_API hair_result hair_save(hair_instance* hair, void* bytes, size_t capacity, size_t* size);

/// Go on from what hair_save wrote, here or elsewhere: with the same settings and inputs the same driver gives
/// the same bits. Any bytes may be given: what is no saved state is refused, and so is one of guides with other
/// numbers of vertices, of another solver or of another hair_desc.substep. Where that is 0, substeps go on as long
/// as the solver wants them with the physics that are set here. Collision meshes are those of the same content that the
/// instance's colliders have; others are not there until the colliders are set again.
HAIR_API hair_result hair_load(hair_instance* hair, const void* bytes, size_t size);

typedef enum hair_pass {
    HAIR_PASS_COLOR = 0, ///< Shaded, with depth.
    HAIR_PASS_DEPTH, ///< Depth only: shadow maps and pre-passes.
    HAIR_PASS_GUIDES, ///< Debug: simulated strands as lines, by stretch: blue -2 % to red +2 %.
    HAIR_PASS_COLLIDERS, ///< Debug: what hair collides with, shaded; and a slice of the field, see hair_slice.
    /// With depth: how far hair has moved on the screen since the frame before, see hair_view.frame_index. To a float target: x and
    /// y in viewports, to the right and up, without jitter; 0 and 1 beside. Keeps the vertices of two frames: 40 bytes each.
    HAIR_PASS_MOTION,
    /// With depth: numbers. To an unsigned integer target: 1 + strand, 1 + its guide, place along it from 0 to 65535.
    HAIR_PASS_ID,
    /// Debug: the air of the last step, if there is wind, as arrows in a hair_slice; HAIR_SLICE_NONE is HAIR_SLICE_Z here.
    /// Grey ones are as fast as the wind, blue ones slower, red ones twice as fast.
    HAIR_PASS_WIND,
    /// What hair takes of a light that it is seen from, as hair_light.shadow_matrix does, for what it falls on: the share of
    /// each texel that strands of true width cover, times hair_view.opacity, whatever size texels have; it is fit to be
    /// filtered. To a float target, R16F will do, that was cleared to 0: what lies behind has 1 - opacity of the light.
    /// Blending is set for it and put back; depth is tested as that is set, and not written. Attach the depth map of
    /// bodies, hair_light.opaque_shadow_map: then only hair before the first body counts, which is what falls on it.
    HAIR_PASS_OPACITY
} hair_pass;

/// How followers become what is drawn: the picture is the same.
typedef enum hair_render_path {
    HAIR_RENDER_PATH_TESSELLATION = 0, ///< Isolines, from one-point patches.
    HAIR_RENDER_PATH_INSTANCED, ///< No tessellator: vertices by their numbers, for the strands that are drawn.
    HAIR_RENDER_PATH_CACHED, ///< Vertices written once, for all views until hair moves: 24 bytes each; and
    ///< shaded for each view of colour before it draws them: 8 more. With a
    ///< hair_lod those of what is drawn are written for each view: 40 bytes, of
    ///< lines 24; only of HAIR_PASS_COLOR and HAIR_PASS_DEPTH and without a
    ///< shader, else as HAIR_RENDER_PATH_INSTANCED.
    /// As HAIR_RENDER_PATH_CACHED, but pixels too are made by compute, and come to the framebuffer as rectangles: for GPUs of which
    /// few units draw. Of HAIR_PASS_COLOR and HAIR_PASS_DEPTH as ribbons, by samples, without a shader that shades pixels;
    /// all else is drawn as by HAIR_RENDER_PATH_CACHED. With a hair_lod vertices are written for each view, 32 bytes. What is
    /// blended is blended once, the nearest. Depth functions other than less and greater are taken for less. Up to 16 samples;
    /// memory: 8 bytes, of depth alone 4, for each sample of the pixels that hair can be in, and half as many again.
    HAIR_RENDER_PATH_COMPUTE,
    HAIR_RENDER_PATH_AUTO ///< What was measured to be the fastest on this driver: by its name, never by timing. hair_report says
    ///< which it is.
} hair_render_path;

typedef enum hair_primitive {
    HAIR_PRIMITIVE_RIBBONS = 0, ///< Camera-facing, of true width.
    HAIR_PRIMITIVE_LINES ///< One pixel wide: the cheap setting.
} hair_primitive;

/// How pixels come to show strands that are thinner than they are.
typedef enum hair_coverage {
    HAIR_COVERAGE_MSAA = 0, ///< By their samples, which see opaque ribbons of true width; the default.
    /// Of HAIR_PASS_COLOR, for ribbons only: by the share of the pixel that they cover, whatever its samples. Segments are
    /// sorted from far to near and blended over what is there, as far as its depth lets them: draw the body before, the
    /// hair's own depth is not written. Colours are multiplied by alpha. Memory: 32 bytes for each vertex of all followers,
    /// whatever the picture's size; what lies between each other by less than 1/16384 of the hair's extent is in any order.
    HAIR_COVERAGE_ALPHA
} hair_coverage;

/// A slice through the field, at right angles to one of the head's axes. The colliders before it are cut away.
/// Blue is outside, red inside, white the surface; a line for every voxel from it.
typedef enum hair_slice { HAIR_SLICE_NONE = 0, HAIR_SLICE_X, HAIR_SLICE_Y, HAIR_SLICE_Z } hair_slice;

/// Level of detail: how much of the hair is drawn. Of the strands that are left out those that are drawn make up the
/// width, so that they cover as much, and move inwards among their neighbours as far as they reach out farther to either side;
/// lines, which have no width, cannot. All changes continuously. HAIR_SELF_SHADOW_STRANDS finds
/// light for what is drawn only. Dynamic, its cells are no smaller than 2 pixels, and followers are led round colliders as far as 5 mm
/// are more than a pixel, in full where they are 2: where no view shows that, it is not found out either.
typedef struct hair_lod {
    hair_struct_header header;
    float strand_fraction; ///< Share of the strands that is drawn, at most. [0, 1]. Default 1.
    float segment_fraction; ///< Share of hair_look.segments that they have, at most. [0, 1]. Default 1.
    float width_exponent; ///< Strands are 1 / share to this power as wide. [0, 2]. Default 1.
    uint32_t per_patch; ///< 1: by patch, as follows. 0: alike everywhere, as above. [0, 1]. Default 1.
    /// Strands that would be thinner on the screen than this are drawn so wide, and as many fewer. Pixels.
    float strand_pixels; ///< [0.01, 100]. Default 0.25.
    float segment_pixels; ///< Length of a segment on the screen, likewise. [0.1, 1000]. Default 4.
    /// Share of the strands of a patch that is left, at least.
    float min_strand_fraction; ///< [0.001, 1]. Default 0.05.
    float importance; ///< Hair is taken for as many times as large as it appears. [0, 1000]. Default 1.
    /// The same for hair that a head hides whose place is told from its roots. Below 1 what the head is certain to hide
    /// is not drawn: then the head must be. What is not in view never is.
    float occluded_importance; ///< [0, 1]. Default 1.
} hair_lod;
HAIR_DESC(hair_lod)

/// Where the host's own shading runs.
typedef enum hair_shade_at {
    HAIR_SHADE_VERTICES = 0, ///< Of strands, as ours: cheap. Pixels get what lies between.
    HAIR_SHADE_PIXELS ///< In the fragment shader, whose other outputs it may declare and write.
} hair_shade_at;

/// Shading of the host's own: GLSL 4.50 that has
///     vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f) + 0.1 * f.color, 1.0); }
/// and whatever that needs: uniform buffers from binding 8 on, textures from unit 24 on and, of pixels, storage buffers from
/// binding 8 on, which the host binds. It returns light towards the eye and, of pixels, alpha. It may call
///     vec3 hair_shade_ours(hair_fragment f)            what would be without it
///     vec3 hair_world(hair_fragment f)                 where it is in the world, m
///     uint hair_lights()                               of the view
///     vec3 hair_light(hair_fragment f, uint i, out vec3 to)  the i-th's irradiance without shadow; to: its direction
///     float hair_light_through(hair_fragment f, uint i)      share of it that comes through hair and bodies
///     vec3 hair_sky(hair_fragment f)                   irradiance of the surroundings
/// A hair_fragment has: vec3 position (from the head's origin, m, world axes), tangent, to_eye (unit); float t (0 root, 1
/// tip), random (the strand's own, [0, 1)), across (a ribbon, -1 to 1; 0 at vertices); vec3 color (reflectance); vec2 uv (of
/// the root on the scalp; 0 where the groom has none); uint strand, lock (its guide), seed. The rest of the library's names
/// are in sight too and may change: give your own a prefix. What is not finite or below 0 becomes 0.
typedef struct hair_shader_desc {
    hair_struct_header header;
    const char* label; ///< In errors, before the line: "label:12: …". NULL: "shader".
    const char* glsl; ///< Its text, without #version. Required.
    hair_shade_at at; ///< Default HAIR_SHADE_VERTICES.
} hair_shader_desc;
HAIR_DESC(hair_shader_desc)

/// A text that does not compile is HAIR_ERROR_OPENGL, its first error in the log. Programs are made as views need them.
HAIR_API hair_result hair_shader_create(hair_context* context, const hair_shader_desc* desc,
                                        hair_shader** out);
HAIR_API void hair_shader_destroy(hair_shader* shader); ///< Before its context.

typedef enum hair_light_kind {
    HAIR_LIGHT_DIRECTIONAL = 0, ///< So far away that all of its light comes from one side: the sun.
    HAIR_LIGHT_POINT, ///< A lamp that shines everywhere.
    HAIR_LIGHT_SPOT ///< One that shines into a cone.
} hair_light_kind;

typedef struct hair_light {
    hair_struct_header header;
    hair_light_kind kind; ///< Default HAIR_LIGHT_DIRECTIONAL.
    /// Towards the light: from anywhere, or of a spot from the middle of what it shines at. Any length. World.
    float direction[3]; ///< [-1e6, 1e6]. Default (0.4, 0.8, 0.45).
    float position[3]; ///< Of a point or spot. World. m. [-1e9, 1e9]. Default 0.
    float color[3]; ///< Its irradiance; of a point or spot that 1 m away. [0, 1e6]. Default 3.
    float range; ///< Of a point or spot: farther it does not shine. m. 0 (any) to 1e6. Default 0.
    float source_radius; ///< Of a point or spot: nearer it gets no brighter. m. [0.001, 1000]. Default 0.05.
    /// Of a spot: half of the angle of its full brightness.
    float inner_angle; ///< Radians. [0, 1.57]. Default 0.3.
    /// And beyond which it does not shine: above inner_angle.
    float outer_angle; ///< Radians. [0, 1.57]. Default 0.5.
    /// Of OpenGL: 2D, depth of hair seen from the light, as HAIR_PASS_DEPTH draws it: what hair lets through of it. Bodies in
    /// it take no more than hair would there. 0: none. One or both textures of up to 4 lights.
    uint32_t hair_shadow_map;
    /// World to clip space of both; orthographic or, of points and spots, in perspective. Depth grows away from the light.
    float shadow_matrix[16]; ///< Default identity.
    uint32_t opaque_shadow_map; ///< The same of what lets no light through: a head, clothes, walls. 0: none.
    float opaque_bias; ///< Hair no farther than this behind what that shows is lit. m. [0, 1]. Default 0.003.
} hair_light;
HAIR_DESC(hair_light)

typedef struct hair_view {
    hair_struct_header header;
    hair_pass pass; ///< Default HAIR_PASS_COLOR.
    hair_render_path render_path; ///< Default HAIR_RENDER_PATH_TESSELLATION.
    hair_primitive primitive; ///< Default HAIR_PRIMITIVE_RIBBONS.
    float view[16]; ///< World to view. Default identity.
    float projection[16]; ///< View to clip. Reversed, infinite depth are fine. Default identity.
    const hair_light* lights; ///< light_count of them. NULL: each as hair_light_default() has it.
    uint32_t light_count; ///< [0, 16]. Default 1.
    float ambient[3]; ///< Irradiance of surroundings that are the same on all sides. [0, 1e6]. Default 0.35.
    /// Radiance of the surroundings beside that, as 9 spherical harmonics of r, g, b each, up to order 2 and as Ramamoorthi
    /// and Hanrahan 2001 order and scale them, over world axes: 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2. Each in
    /// [-1e6, 1e6]. NULL: none.
    const float* sky;
    hair_slice slice; ///< Of HAIR_PASS_COLLIDERS, HAIR_PASS_WIND. Default HAIR_SLICE_NONE.
    float slice_at; ///< Where, as a share of the field's box. [0, 1]. Default 0.5.
    const hair_lod* lod; ///< NULL: all is drawn.
    hair_shader* shader; ///< Of HAIR_PASS_COLOR. NULL: as hair_look.shading says.
    hair_coverage coverage; ///< Default HAIR_COVERAGE_MSAA.
    float opacity; ///< Of HAIR_COVERAGE_ALPHA, HAIR_PASS_OPACITY: of what strands cover. [0, 1]. Default 1.
    float jitter[2]; ///< By which the picture is moved right and up. Pixels. [-64, 64]. Default 0.
    /// Of HAIR_PASS_MOTION. Draws of one number share the frame before, which is the last of another number in which hair was
    /// drawn so: number frames, and it is right for several views, whatever was stepped between. 0: each draw is a frame.
    /// Where there was none, after hair_reset or hair_load, or with another number of segments, hair has stood still;
    /// hair_teleport takes along where it was.
    uint32_t frame_index; ///< Also of HAIR_SELF_SHADOW_STRANDS. Default 0.
    float prev_view[16]; ///< View of the frame before. Default identity.
    float prev_projection[16]; ///< And its projection, without jitter. Default identity.
    /// Of OpenGL: 2D, linear colours that those of strands are multiplied by, where hair_groom_desc.scalp_uvs have their
    /// roots, as the texture itself filters them. 0, or a groom without uvs: none.
    uint32_t color_texture;
    /// Of OpenGL: 2D, depth of what you have drawn that is opaque, as that may be bound to be drawn to as well: patches of strands
    /// that are wholly behind it are not drawn, by any path. Of any size; all of it is what the viewport is. What is behind says
    /// glDepthFunc: reversed depth is fine, by one that is neither less nor greater nothing is hidden. glDepthRange and
    /// glClipControl are as they were when it was drawn. Not of HAIR_PASS_GUIDES, _COLLIDERS and _WIND. 0: none.
    uint32_t occluder_depth;
    /// World to clip space of that, as of the frame before: what since has come out from behind something is drawn a frame late,
    /// and what was not in that picture is drawn. All 0: the view's own, projection times view. Default 0.
    float occluder_matrix[16];
} hair_view;
HAIR_DESC(hair_view)

/// Have all programs compiled that hair_step and a hair_draw of `view` would run with what is set now, so that no frame waits for
/// them: call it while something else is shown until *ready is 1, also before colliders, wind or another look are first set on hair
/// that is on the screen. Drivers with KHR_parallel_shader_compile compile all at once beside what you do, and no call
/// waits; others compile one program a call, as a shader of yours is anywhere. view NULL: only what steps run. On
/// failure *ready is as it was.
HAIR_API hair_result hair_precompile(hair_instance* hair, const hair_view* view, uint32_t* ready);

/// Draw into the bound framebuffer and viewport, with the depth function that is set. An incomplete framebuffer
/// is HAIR_ERROR_OPENGL.
HAIR_API hair_result hair_draw(hair_instance* hair, const hair_view* view);

// Looking inside: [GL] --------------------------------------------------------------------------------------

typedef enum hair_read_source {
    HAIR_READ_GUIDES = 0, ///< Vertices of the guides where the last substep left them.
    HAIR_READ_SMOOTH, ///< Vertices of the guides as drawn: smoothed, interpolated to now.
    HAIR_READ_FOLLOWERS ///< Vertices of all followers as drawn: look.segments + 1 each.
} hair_read_source;

/// Copy positions, xyz each, world, of at most `capacity` vertices. `count` becomes how many there are. Waits.
HAIR_API hair_result hair_read_positions(hair_instance* hair, hair_read_source source, float* positions,
                                         uint32_t capacity, uint32_t* count);

/// What went wrong since the instance was created, and how it was borne.
typedef struct hair_solver_stats {
    hair_struct_header header;
    uint32_t euler_fallbacks; ///< Times that a substep of a straight guide was redone by implicit Euler.
    /// Times that a substep, or a part of one, was redone by follow-the-leader after that.
    uint32_t follow_fallbacks;
    uint32_t reset; ///< Times that a guide was put back in its rest pose: it was not finite.
    /// Guides made stiffer to hold their groom against gravity, as `gravity_preload` asks.
    uint32_t stiffened;
    float max_stiffening; ///< Greatest multiple of the stiffness at any vertex of these guides. At most 3.
    float substep; ///< Length of a substep. s.
    /// Times that a guide was stretched in a substep: what holds it was too far apart.
    uint32_t overextended;
    uint32_t sagging; ///< Guides that three times their stiffness does not hold: they sag from the groom.
    float farthest_sag; ///< Greatest distance from the groom at which a vertex of these guides rests. m.
    uint32_t parts; ///< Times that a substep of a guide that is curved, fine or heavy was redone in parts.
    /// Guides whose stiffness is reduced to what single precision can solve at this substep.
    uint32_t softened;
    float softest; ///< Least factor of the stiffness at any vertex of these guides. 1: none is softened.
    /// Guides that still move at 2 cm/s though damping had the time to calm any hair: see below.
    uint32_t restless;
    float fastest; ///< Greatest speed of a guide vertex relative to the head, over the last substep. m/s.
    /// Times that the energy of a guide grew in 0.25 s, with hair_desc.diagnose: see below.
    uint32_t gaining;
    /// Guides with a segment whose length is off by more than 1 % after the last substep.
    uint32_t overstretched;
    float stretch; ///< Greatest relative error of a segment's length after the last substep.
} hair_solver_stats;
HAIR_DESC(hair_solver_stats)

/// Report how the simulation fares. Waits for the GPU.
///
/// `restless` and `gaining` look at hair that nothing drives: the head rests, no wind blows, no collider within reach moves,
/// and no setting changes. `restless` allows 17 s / damping, and 18 s for every metre of a guide's length, and looks at guides
/// that are held at the root. `gaining` counts under the solvers direct and accurate. There the energy of motion, gravity,
/// bending, twist and the pull to the rest pose may not grow, and falls by at least half of what damping takes. It looks
/// neither at hair with cohesion or pressure_stiffness nor at a skinned scalp.
HAIR_API hair_result hair_get_solver_stats(hair_instance* hair, hair_solver_stats* out);

/// The field: how far the nearest collider is, in a box in the head's frame around the hair at rest and a quarter of the
/// longest strand beyond it. Along its longest side are 32 to 256 voxels, of the side that hair_desc asks for as far as
/// that allows. Exact at the middles of voxels for every shape but collision meshes, between them to be interpolated.
typedef struct hair_field_info {
    hair_struct_header header;
    /// Of OpenGL: 3D, R16F. m, below 0 inside. 0: no collider reaches into the box.
    uint32_t distance_texture;
    /// 3D, R32UI: which of hair_set_colliders is nearest; 4294967295: none near. Or 0.
    uint32_t collider_texture;
    uint32_t size[3]; ///< Voxels along the head's x, y and z.
    float voxel; ///< Side of one. m.
    float far; ///< Of colliders farther than this it says so and no more; and so of all beyond the box. m.
    float transform[16]; ///< World to texture coordinates: the box is [0, 1]^3.
} hair_field_info;
HAIR_DESC(hair_field_info)

/// Bring the field up to date with the colliders and the head of the last step, for shaders of the host to read. Only what
/// moved is written. The textures are the library's, and as they are until the next call for this instance.
HAIR_API hair_result hair_get_field(hair_instance* hair, hair_field_info* out);

typedef struct hair_timing {
    const char* pass; ///< Its label and features, as "sim/direct_curved_32". As long as the context.
    float ms; ///< GPU time of its last finished run. 0 before there is one.
    uint32_t runs; ///< Since the context was created.
    double total_ms; ///< GPU time of its finished runs together, but for more than four at once.
} hair_timing;

/// GPU time of every pass that something has needed yet, if the context was created with `timings`. Never waits. Returns how
/// many passes there are; writes at most `capacity`. What was there once stays in its place.
HAIR_API uint32_t hair_get_timings(hair_context* context, hair_timing* out, uint32_t capacity);

/// Why work was done or not.
typedef enum hair_skip_reason {
    HAIR_SKIP_REASON_NONE = 0, ///< It was.
    HAIR_SKIP_REASON_ASLEEP, ///< Hair is at rest, as hair_physics.sleep_threshold has it.
    HAIR_SKIP_REASON_UNCHANGED, ///< What it makes is there and still holds.
    HAIR_SKIP_REASON_OUT_OF_VIEW, ///< No view showed any of the hair.
    HAIR_SKIP_REASON_NONE_NEAR, ///< No collider is near the hair.
    HAIR_SKIP_REASON_NOT_WANTED, ///< Settings ask for none of it: no wind, no cohesion, a rigid head, another path.
    HAIR_SKIP_REASON_NOT_DUE, ///< Its time has not come: no substep fell due, hair is in motion.
    HAIR_SKIP_REASON_NOT_CALLED ///< No call asked for it.
} hair_skip_reason;

HAIR_API const char*
hair_skip_reason_string(hair_skip_reason reason); ///< Static text, NULL beyond the last. [any thread]

/// One kind of work of an instance in a frame, which lasts from one hair_step to the next.
typedef struct hair_report_row {
    const char* stage; ///< Static text: "solve", "smooth", "color", …
    const char* pass; ///< The last pass that ran for it, as in hair_timing. NULL: none did.
    hair_skip_reason skip_reason;
    uint32_t runs; ///< Of passes.
    float ms; ///< GPU time, from the first of passes that follow each other to the last. 0 without timings.
    uint64_t bytes; ///< OpenGL memory that it has.
} hair_report_row;

typedef struct hair_report_info {
    hair_struct_header header;
    uint32_t frame; ///< Counted from 1. 0: none is finished, and there are no rows.
    uint32_t age; ///< Frames that have begun since.
    float ms; ///< Of all rows.
    uint64_t bytes; ///< Of all rows; what instances share is not among them.
} hair_report_info;
HAIR_DESC(hair_report_info)

/// What became of all work in the newest frame that the GPU is done with; without hair_context_desc.timings, in the
/// newest there is. `wait` 1: in the newest, waiting for it. `count` becomes how many rows there are, of which at most
/// `capacity`, `stride` = sizeof(hair_report_row) apart, are written.
HAIR_API hair_result hair_report(hair_instance* hair, uint32_t wait, hair_report_info* info,
                                 hair_report_row* rows, size_t stride, uint32_t capacity, uint32_t* count);

#endif
