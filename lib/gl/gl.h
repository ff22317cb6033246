// gl.h - everything about OpenGL that other folders need: functions, programs, buffers, state and
// timers.
#ifndef HAIR_GL_GL_H
#define HAIR_GL_GL_H

// The calling convention of OpenGL on Windows, without which glcorearb.h includes windows.h. That
// header defines macros such as near and far.
#if defined(_WIN32) && !defined(APIENTRY)
#define APIENTRY __stdcall
#endif
#include <GL/glcorearb.h>

#include <stdbool.h>

#include "lib/base/host.h"
#include "lib/gl/draw_state.h"
#include "glsl/shared.h"

// Rows of passes.inl. A row is also the pass without any feature.
enum hair_gl_row {
#define PASS(name, label, category, features, stages) HAIR_GL_##name,
#include "lib/gl/passes.inl"
    HAIR_GL_ROWS
};

enum hair_gl_feature {
#define FEATURE(name, define) HAIR_GL_FEATURE_##name,
#include "lib/gl/passes.inl"
    HAIR_GL_FEATURES
};

// Category of a pass in reports.
typedef enum hair_gl_category {
#define CATEGORY(name, label) HAIR_GL_CATEGORY_##name,
#include "lib/gl/passes.inl"
    HAIR_GL_CATEGORIES,
    HAIR_GL_NO_CATEGORY = HAIR_GL_CATEGORIES // Memory that no report counts.
} hair_gl_category;

// Identifier of a pass. It holds the row in the lowest bits, the size of the work groups, and a bit
// for each feature.
typedef uint64_t hair_gl_pass;
#define HAIR_GL_ROW_BITS 8
// Size code n, 0 to 3, for 32, 64, 128 or 256 threads.
#define HAIR_GL_SIZE(n) ((hair_gl_pass)(n) << HAIR_GL_ROW_BITS)
#define HAIR_GL_SIZES HAIR_GL_SIZE(3)
#define HAIR_GL_THREADS(pass) (32u << (((pass)&HAIR_GL_SIZES) >> HAIR_GL_ROW_BITS))
#define HAIR_GL_BIT(feature) ((hair_gl_pass)1 << (HAIR_GL_ROW_BITS + 2 + (feature)))
#define HAIR_GL_WITH(feature) HAIR_GL_BIT(HAIR_GL_FEATURE_##feature)

#define HAIR_GL_UNITS (HAIR_UNIT_STRAND_FACTOR + 1)

#define HAIR_GL_DISPATCH_MS 1.9 // hair_gl.dispatch_ms, ms. The limit is 2 ms.
// hair_gl.draw_vertices. A GPU takes less than 2 ms for them. `hair-bench dispatch` measures draws.
#define HAIR_GL_DRAW_VERTICES (1u << 17)
#define HAIR_GL_SPARE_USES 60 // Uses that memory of much more than they need is kept for.
#define HAIR_GL_TIMER_DEPTH 4 // Runs of a pass that may be in flight while the next is timed.

struct hair_gl_timer {
    GLuint query[HAIR_GL_TIMER_DEPTH][2]; // Start and end of each run.
    uint32_t begun, read; // Numbers of runs begun and read.
    float ms; // Duration of the last run read, in ms.
    double total; // Duration of all runs read, in ms.
};

#define HAIR_GL_SAVED_SLOTS (HAIR_BIND_REDUCTION + 1) // HAIR_BIND_FIELD is no greater.

// Buffers of the application at binding slots. `slots` has a bit for each that is saved.
struct hair_gl_saved_slots {
    uint32_t slots;
    GLuint buffer[HAIR_GL_SAVED_SLOTS];
    GLintptr first[HAIR_GL_SAVED_SLOTS];
    GLsizeiptr size[HAIR_GL_SAVED_SLOTS];
};

// State that draws and dispatches change and restore. See state.c.
struct hair_gl_saved {
    GLint program, vertex_array, patch_vertices, active_texture, cull, restarts;
    GLint draw_indirect, dispatch_indirect;
    bool is_feedback_aside; // True if transform feedback of the application is active.
    GLint feedback, feedback_paused; // Its object, and whether the application has paused it.
    uint32_t units, images; // Texture and image units that are saved, one bit each.
    GLint texture[HAIR_GL_UNITS], sampler[HAIR_GL_UNITS];
    // Name, level, layered, layer, access and format of each image unit.
    GLint image[HAIR_IMAGE_COLLIDER + 1][6];
    struct hair_gl_saved_slots storage, uniform;
};

// Two hashes of everything that a program is made from.
struct hair_gl_key {
    uint64_t hash, check;
};

// Program of a pass, with its timer.
struct hair_gl_program {
    hair_gl_pass pass;
    GLuint program; // 0 if there is no built-in program yet.
    GLuint begun; // Program that the driver compiles asynchronously. 0 if there is none.
    struct hair_gl_key key; // Cache key of `begun`.
    bool is_warm; // True once the program has run. See warm_up.c.
    uint32_t asked; // Number of the last asynchronous round that needed the program.
    struct hair_gl_timer timer;
    uint32_t max_groups; // Work groups in a dispatch of a GPU. 0 until the pass runs.
    uint32_t max_groups_of_threads; // Limit by the number of threads. 0 until limited.
    double ms_per_group; // Time of a group of a software rasteriser in the last run, ms.
    char label[128];
};

// Program of a pass with the application's shading.
struct hair_gl_user_program {
    hair_gl_pass pass;
    GLuint program;
};

struct hair_gl_shader {
    char* label;
    char* text;
    int pixels; // Nonzero if it shades pixels instead of vertices.
    uint32_t program_generation; // Value of hair_gl.program_generation at compilation.
    struct hair_gl_user_program* programs;
    uint32_t count, room;
};

// Binding slots and units of a program, one bit each.
struct hair_gl_inputs {
    GLuint program;
    uint32_t storage, uniform, textures, images;
};

struct hair_gl_profiler;
struct hair_gl_recorder;
struct hair_gl_allocation;

// Memory of buffers and textures, in bytes.
struct hair_gl_memory {
    uint64_t bytes, peak, limit; // In use, peak, and limit. A limit of 0 allows any amount.
    struct hair_gl_allocation* allocations; // Buffers and textures. Defined in memory.c.
    uint32_t count, room;
};

// Memory of the buffers and textures of an instance by category, in bytes.
struct hair_gl_owner {
    uint64_t bytes[HAIR_GL_CATEGORIES];
};

struct hair_gl {
    hair_host host;
    hair_gl_state state_policy;
    char* glsl_dir; // NULL selects the built-in sources.
    hair_cache cache; // NULL `get` disables the cache.
    struct hair_gl_memory memory;
    int timings;
    int software; // Nonzero if the driver is a software rasteriser.
    bool compiles_late; // True if the driver compiles machine code when a program first runs.
    int subgroup; // Nonzero if a work group of 32 threads is one subgroup.
    double dispatch_ms; // Maximum expected time of a solver's dispatch on a GPU. See time_budget.c.
    GLint units; // Number of multiprocessors of the GPU. 0 if unknown.
    GLint max_storage_bytes; // Maximum size of a storage buffer.
    GLint max_buffer_texels; // Maximum texels of a buffer texture.
    int long_atomics; // Nonzero if storage buffers support 64-bit atomics.
    uint32_t program_generation; // Number of times that all programs have been compiled.
    int async; // Nonzero if needed programs are compiled asynchronously.
    uint32_t round; // Number of rounds from hair_gl_begin_async() to hair_gl_end_async() so far.
    uint32_t pending; // Number of asynchronous programs that are not ready.
    uint32_t work; // Number of programs that this round has begun, finished, loaded or run.
    double round_start; // Time of the start of this round, ms.
    int parallel; // Nonzero if the driver compiles in its own threads.
    // Function that sets the number of these threads, or NULL.
    void(APIENTRY* max_compiler_threads)(GLuint count);
    uint32_t compiled; // Number of programs that the driver has compiled.
    struct hair_gl_program** program; // Programs of all passes needed so far.
    uint32_t programs, room;
    struct hair_gl_profiler* profiler; // Profiler of the active instance. NULL disables it.
    struct hair_gl_owner* owner; // Owner of what is created. NULL if it is no instance.
    GLuint vertex_array; // Empty, because shaders compute every vertex from its number.
    GLuint shadow_sampler[2]; // Reads 1 outside a texture, or 0 for maps of reversed depth.
    // Function of the window system that returns the current context, and its result at creation.
    void*(APIENTRY* get_current)(void);
    void* own_context;
    // Buffer that exists only in this context, if there is no such function. Another context may
    // have a buffer of the same name, but hardly of the same odd size.
    GLuint own_buffer;
    GLint own_size;
    bool is_lost; // True once the driver has said that the OpenGL context is lost.
    // Transform feedback object that is bound in place of one that is active. 0 until needed.
    GLuint idle_feedback;
    // Maximum vertices that the driver handles in one tessellated draw. UINT32_MAX if unlimited.
    uint32_t max_draw_vertices;
    uint32_t draw_vertices; // Maximum vertices of a draw, because of its time.
    // Outer tessellation level that holds the number of isolines, 0. It is 1 on a driver that swaps
    // the levels.
    int lines_level;
    bool records; // True if a GPU profits from passes of several instances side by side.
    struct hair_gl_recorder* recorder; // Commands of several instances. NULL until first needed.
    struct hair_gl_inputs* inputs; // Inputs of programs in lists of instances.
    uint32_t inputs_count, inputs_room;
    struct hair_gl_saved saved;
    struct hair_gl_draw_state draw_state; // Read by each call that draws or prepares a draw.
#define FUNCTION(type, name, parameters) type(APIENTRY* name) parameters;
#include "lib/gl/functions.inl"
#undef FUNCTION
};

// functions.c, program.c, driver_quirks.c ---------------------------------------------------------

// Load the functions, check the version and test for driver bugs.
hair_result hair_gl_create(struct hair_gl* gl, const hair_host* host, const hair_context_desc* desc);
void hair_gl_destroy(struct hair_gl* gl);
// Return whether the OpenGL context of hair_gl_create() is current.
bool hair_gl_is_current(const struct hair_gl* gl);
// Ask the driver whether the OpenGL context is lost, and note that. Return whether it is. A context
// without reset notification never is.
bool hair_gl_find_loss(struct hair_gl* gl);
// Make every later deletion of an OpenGL object do nothing. Freeing then calls no OpenGL.
void hair_gl_ignore_deletions(struct hair_gl* gl);
// Copy the functions that delete OpenGL objects.
void hair_gl_copy_deletions(const struct hair_gl* from, struct hair_gl* to);
hair_result hair_gl_load(struct hair_gl* gl, const hair_context_desc* desc);

// Compile the program of a pass unless it exists. Every pass needs this before it runs.
hair_result hair_gl_ensure_program(struct hair_gl* gl, hair_gl_pass pass);
// Apply hair_gl_ensure_program() to all rows from `first` to `last`, each with the `wanted`
// features that the row supports.
hair_result hair_gl_ensure_programs(struct hair_gl* gl, hair_gl_pass first, hair_gl_pass last,
                                    hair_gl_pass wanted);

// Maximum work on programs in a round of asynchronous compilation. A program is begun, finished,
// loaded or run. The first number is for GPUs whose driver compiles in parallel.
#define HAIR_GL_PARALLEL_WORK 4
#define HAIR_GL_SERIAL_WORK 1

// Make hair_gl_ensure_program() compile asynchronously until hair_gl_end_async(). A round does a
// limited amount of work, and leaves the rest to the next.
void hair_gl_begin_async(struct hair_gl* gl);
// Stop asynchronous compilation. Return the number of programs that are not ready.
uint32_t hair_gl_end_async(struct hair_gl* gl);

// Run a compute program once on nothing, because software rasterisers compile machine code when a
// program first runs. Other programs and drivers need no such run. Defined in warm_up.c.
void hair_gl_warm_up(struct hair_gl* gl, struct hair_gl_program* own);

// Compile all needed programs again. Programs that fail keep their old version. Return the first
// failure.
hair_result hair_gl_compile(struct hair_gl* gl);

// Link a program from definitions and stages, such as "NAME=1 draw/patch.vert draw/patch.tesc".
// `captured` names the outputs for transform feedback. NULL captures none.
hair_result hair_gl_link(struct hair_gl* gl, const char* label, const char* stages, const char* captured,
                         GLuint* out);
// Link the program of a pass, with the application's shading unless `shader` is NULL.
hair_result hair_gl_link_pass(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                              GLuint* out);
hair_result hair_gl_find_driver_quirks(struct hair_gl* gl);

// Initialize a shader of the application, whose members must be zero. Defined in user_shader.c.
hair_result hair_gl_create_shader(struct hair_gl* gl, const char* label, const char* text, int pixels,
                                  struct hair_gl_shader* out);
void hair_gl_free_shader(struct hair_gl* gl, struct hair_gl_shader* shader);
// Delete the programs of a shader. Each is compiled again when it is needed.
void hair_gl_free_shader_programs(struct hair_gl* gl, struct hair_gl_shader* shader);
// Find or compile the program of a pass with the application's shading.
hair_result hair_gl_ensure_user_program(struct hair_gl* gl, struct hair_gl_shader* shader, hair_gl_pass pass,
                                        GLuint* out);

// Return a cache key that identifies the driver. Defined in cache.c.
struct hair_gl_key hair_gl_key_begin(struct hair_gl* gl);
// Add a text to the key. NULL adds nothing.
void hair_gl_key_add(struct hair_gl_key* key, const char* text);
// Load a program from the cache. Return false if the program must be compiled.
bool hair_gl_cache_load(struct hair_gl* gl, struct hair_gl_key key, GLuint program);
// Store a compiled program in the cache.
void hair_gl_cache_store(struct hair_gl* gl, struct hair_gl_key key, GLuint program);

// inputs.c ----------------------------------------------------------------------------------------

// Return the slots and units of a program, or NULL without memory. They are queried once.
const struct hair_gl_inputs* hair_gl_find_inputs(struct hair_gl* gl, GLuint program);
// Delete a program, and forget its slots and units.
void hair_gl_delete_program(struct hair_gl* gl, GLuint program);

// source.c ----------------------------------------------------------------------------------------

#define HAIR_GL_MAX_SOURCES 80 // Maximum number of files of one shader, itself included.

struct hair_gl_source {
    char* text; // Text with all includes in place. The caller frees it.
    char file[HAIR_GL_MAX_SOURCES][48];
    uint32_t files;
};

// Read glsl/NAME and insert each included file once. #line directives number the files in the order
// of `file`. `prefix` follows the #version line. NULL `glsl_dir` selects the built-in sources.
hair_result hair_gl_read_source(const hair_host* host, const char* glsl_dir, const char* name,
                                const char* prefix, struct hair_gl_source* out);
// Name of the file that a shader of the application replaces.
#define HAIR_GL_USER_SHADER "light/user_shader.glsl"
// Read like hair_gl_read_source(), but use `own` as the text of HAIR_GL_USER_SHADER unless it is
// NULL.
hair_result hair_gl_read_source_with(const hair_host* host, const char* glsl_dir, const char* name,
                                     const char* prefix, const char* own, struct hair_gl_source* out);

// shader_log.c ------------------------------------------------------------------------------------

#define HAIR_GL_MAX_INFO_LOG 2048 // Maximum bytes of a driver's message that are logged.

// Report a compiler message about a stage with the names of files. Its first line is an error, and
// the other lines are information. An error in the text of the application has the label `own` and
// the text's lines. NULL `own` means that there is no such text.
hair_result hair_gl_report_compile(struct hair_gl* gl, const struct hair_gl_source* source, const char* own,
                                   const char* name, const char* message);
// Report a linker message about the program `label` in the same way.
hair_result hair_gl_report_link(struct hair_gl* gl, const char* own, const char* label, const char* message);

// state.c -----------------------------------------------------------------------------------------

// Save the application's state. Call this before anything else in a [GL] call.
void hair_gl_enter(struct hair_gl* gl);
// Enter for work of one instance. `owner` owns the memory that is allocated until
// hair_gl_leave(), and `profiler` counts the passes. NULL `profiler` counts none.
void hair_gl_enter_for(struct hair_gl* gl, struct hair_gl_owner* owner, struct hair_gl_profiler* profiler);
// Set the owner and the profiler of what follows, between hair_gl_enter_for() and hair_gl_leave().
void hair_gl_set_owner(struct hair_gl* gl, struct hair_gl_owner* owner, struct hair_gl_profiler* profiler);
// Restore the application's state. Nothing is owned or counted from then on.
void hair_gl_leave(struct hair_gl* gl);

// Save the buffers, textures and images of the application at slots and units, unless that has been
// done since hair_gl_enter(). Call these before anything is bound there.
void hair_gl_save_slots(struct hair_gl* gl, GLenum target, GLuint first, GLsizei count);
void hair_gl_save_units(struct hair_gl* gl, GLuint first, GLsizei count);
void hair_gl_save_image(struct hair_gl* gl, GLuint unit);
void hair_gl_save_all_slots(struct hair_gl* gl); // All but texture units.

// Unbind everything that the library may delete, before it deletes it within a [GL] call.
void hair_gl_unbind(struct hair_gl* gl);

// Unbind the query buffer of the application, which would receive the results of queries. Return
// its name for hair_gl_end_query_reads().
GLint hair_gl_begin_query_reads(struct hair_gl* gl);
void hair_gl_end_query_reads(struct hair_gl* gl, GLint buffer);

// Count the uses in sequence that need much less than there is. Return whether there were so many
// that memory is to be made anew, smaller.
static inline bool hair_gl_count_spare(uint32_t* uses, bool is_spare)
{
    *uses = is_spare ? *uses + 1 : 0;
    return *uses > HAIR_GL_SPARE_USES;
}

// texture_target.c --------------------------------------------------------------------------------

// Return the target of a texture of the application, or 0 if there is no such texture. All state is
// as before. The error flag is not touched.
GLenum hair_gl_find_texture_target(const struct hair_gl* gl, GLuint texture);

// pass_table.c ------------------------------------------------------------------------------------

// Return the label of a pass's row, a static string. hair_gl_find() gives the full label.
const char* hair_gl_row_label(hair_gl_pass pass);
const char* hair_gl_row_stages(hair_gl_pass pass);
hair_gl_category hair_gl_row_category(hair_gl_pass pass);
// Return `pass` with those of `features` that its row supports.
hair_gl_pass hair_gl_add_features(hair_gl_pass pass, hair_gl_pass features);
// Return `pass` with the smallest work groups that hold guides of up to `vertices`.
hair_gl_pass hair_gl_pass_for(hair_gl_pass pass, uint32_t vertices);
// Write the full label of a pass, such as "sim/direct_wind_curved_32".
void hair_gl_write_label(hair_gl_pass pass, char* out, size_t size);

// pass.c ------------------------------------------------------------------------------------------

// Return the entry of a pass. NULL means that the pass has not been needed.
struct hair_gl_program* hair_gl_find(const struct hair_gl* gl, hair_gl_pass pass);
// Return the entry of a pass, and add one without a program if there is none. NULL means out of
// memory, which is logged.
struct hair_gl_program* hair_gl_get_or_add(struct hair_gl* gl, hair_gl_pass pass);
void hair_gl_free_programs(struct hair_gl* gl);

// Begin the commands of a pass: bind its program, open its debug group and start its timer.
void hair_gl_begin(struct hair_gl* gl, hair_gl_pass pass);
// End the commands of a pass.
void hair_gl_end(struct hair_gl* gl, hair_gl_pass pass);

// Run a compute pass over `groups` work groups, and make its writes visible. hair_group() in GLSL
// returns the number of a group.
void hair_gl_run(struct hair_gl* gl, hair_gl_pass pass, uint32_t groups);
// Let each dispatch of a pass on a GPU have at most `max` work groups.
void hair_gl_limit_groups(struct hair_gl* gl, hair_gl_pass pass, uint32_t max);
// Run the work groups from `first` up to, not including, `end`, of all `groups` of a pass.
void hair_gl_run_part(struct hair_gl* gl, hair_gl_pass pass, uint32_t first, uint32_t end, uint32_t groups);
// Run a compute pass by a program with the application's shading.
void hair_gl_run_with(struct hair_gl* gl, hair_gl_pass pass, GLuint program, uint32_t groups);
// Run a compute pass with the group counts from three numbers at the byte offset `at` of a buffer.
// A software rasteriser waits for the numbers, so that the pass can be divided.
void hair_gl_run_indirect(struct hair_gl* gl, hair_gl_pass pass, GLuint program, GLuint buffer, size_t at);
// Return the wall time, ms.
double hair_gl_now(void);
// Return the duration of the last finished run of a pass, in ms.
float hair_gl_pass_ms(struct hair_gl* gl, struct hair_gl_program* of);

#endif
