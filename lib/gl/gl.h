// gl.h - all of OpenGL that the other rooms need: the host's functions, programs, buffers, state, timers.
#ifndef HAIR_GL_GL_H
#define HAIR_GL_GL_H

#include <GL/glcorearb.h>

#include "lib/base/host.h"
#include "glsl/shared.h"

// The rows of passes.inl, which are passes that are compiled with nothing beside.
enum hair_gl_row {
#define PASS(name, label, features, stages) HAIR_GL_##name,
#include "lib/gl/passes.inl"
    HAIR_GL_ROWS
};

enum hair_gl_feature {
#define FEATURE(name, define) HAIR_GL_FEATURE_##name,
#include "lib/gl/passes.inl"
    HAIR_GL_FEATURES
};

// A pass: its row in the lowest bits, the size of its work groups, and a bit for each feature that it is compiled with.
typedef uint64_t hair_gl_pass;
#define HAIR_GL_ROW_BITS 8
#define HAIR_GL_SIZE(n) ((hair_gl_pass)(n) << HAIR_GL_ROW_BITS) // 0 to 3: 32, 64, 128 or 256 threads
#define HAIR_GL_SIZES HAIR_GL_SIZE(3)
#define HAIR_GL_THREADS(pass) (32u << (((pass)&HAIR_GL_SIZES) >> HAIR_GL_ROW_BITS))
#define HAIR_GL_BIT(feature) ((hair_gl_pass)1 << (HAIR_GL_ROW_BITS + 2 + (feature)))
#define HAIR_GL_WITH(feature) HAIR_GL_BIT(HAIR_GL_FEATURE_##feature)

#define HAIR_GL_UNITS (HAIR_UNIT_HIDDEN + 1)

#define HAIR_GL_TIMER_DEPTH 4 // Runs of a pass that may be under way while the next is timed.

struct hair_gl_timer {
    GLuint query[HAIR_GL_TIMER_DEPTH][2]; // start and end of a run
    uint32_t begun, read; // runs
    float ms; // of the last run read,
    double total; // and of all
};

// What a draw or a dispatch changes, to be put back. See state.c.
struct hair_gl_saved {
    GLint program, vertex_array, patch_vertices, active_texture, cull, restarts;
    GLint draw_indirect, dispatch_indirect;
    GLint texture[HAIR_GL_UNITS], sampler[HAIR_GL_UNITS];
    GLint image[HAIR_IMAGE_SOLID + 1][6]; // name, level, layered, layer, access, format
    GLuint storage[HAIR_BIND_REDUCTION + 1], uniform[HAIR_BIND_FIELD + 1];
    GLintptr storage_first[HAIR_BIND_REDUCTION + 1], uniform_first[HAIR_BIND_FIELD + 1];
    GLsizeiptr storage_size[HAIR_BIND_REDUCTION + 1], uniform_size[HAIR_BIND_FIELD + 1];
};

// Of all that a program is made of, twice hashed.
struct hair_gl_key {
    uint64_t hash, check;
};

// What has been needed of a pass.
struct hair_gl_program {
    hair_gl_pass pass;
    GLuint program; // 0: none of ours
    GLuint begun; // that the driver compiles beside what we do; 0: none
    struct hair_gl_key key; // of what is begun, for the host's cache
    struct hair_gl_timer timer;
    char label[128];
};

// The host's own shading, and the programs that it has been needed in.
struct hair_gl_own {
    hair_gl_pass pass;
    GLuint program;
};

struct hair_gl_shader {
    char* label;
    char* text;
    int pixels; // shades pixels, not vertices
    uint32_t made; // as hair_gl.made was
    struct hair_gl_own* own;
    uint32_t count, room;
};

struct hair_gl_ledger;

// Of buffers and textures. Bytes.
struct hair_gl_memory {
    uint64_t bytes, most, limit; // in use; that have been; that may be, 0: any
};

struct hair_gl {
    hair_host host;
    hair_gl_state promise;
    char* glsl_dir; // NULL: the text built in
    hair_cache cache; // get NULL: there is none
    struct hair_gl_memory memory;
    int timings;
    int software; // the driver is a software rasteriser
    int subgroup; // work groups of 32 threads are one
    GLint units; // of a GPU, each with subgroups of its own; 0: not known
    int long_atomics; // of 64 bits, in storage buffers
    uint32_t made; // how often all programs have been compiled
    int ahead; // programs that are needed are begun, not waited for
    uint32_t unready; // of those
    int parallel; // the driver compiles in threads of its own
    struct hair_gl_program** program; // what has been needed
    uint32_t programs, room;
    struct hair_gl_ledger* ledger; // of the instance that is at work; NULL: nobody asks
    GLuint vertex_array; // empty: every vertex comes from its number
    GLuint shadow_sampler;
    uint32_t max_draw_vertices; // that one tessellated draw may generate; UINT32_MAX: any number
    int lines_level; // which outer level holds the number of isolines: 0, or 1 on a driver that swaps
    struct hair_gl_saved saved;
#define FUNCTION(type, name, parameters) type(APIENTRY* name) parameters;
#include "lib/gl/functions.inl"
#undef FUNCTION
};

// functions.c, program.c, selftest.c ------------------------------------------------------------------------

// Fill the table by `get_proc`, ask the version, find out what the driver gets wrong.
hair_result hair_gl_create(struct hair_gl* gl, const hair_host* host, const hair_context_desc* desc);
void hair_gl_destroy(struct hair_gl* gl);
hair_result hair_gl_load(struct hair_gl* gl, const hair_context_desc* desc);

// The program of a pass, compiled when first needed. Whoever runs one has needed it.
hair_result hair_gl_need(struct hair_gl* gl, hair_gl_pass pass);
// The same of all rows from `first` to `last`, each with those of the `wanted` features that it may be compiled with.
hair_result hair_gl_need_rows(struct hair_gl* gl, hair_gl_pass first, hair_gl_pass last, hair_gl_pass wanted);

// From one to the other hair_gl_need has programs begun that are not there, all at once where the driver compiles beside what we
// do, else one. The second returns how many are not ready.
void hair_gl_begin_ahead(struct hair_gl* gl);
uint32_t hair_gl_end_ahead(struct hair_gl* gl);

// Compile all that have been needed again; those that fail keep the program they had, and the first failure is returned.
hair_result hair_gl_compile(struct hair_gl* gl);

// One program of stages such as "NAME=1 draw/patch.vert draw/patch.tesc", definitions first; `captured`: outputs for transform feedback, or NULL.
hair_result hair_gl_link(struct hair_gl* gl, const char* label, const char* stages, const char* captured,
                         GLuint* out);
// One of a pass, with the host's shading unless `shader` is NULL.
hair_result hair_gl_link_pass(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                              GLuint* out);
hair_result hair_gl_selftest(struct hair_gl* gl);

// shading.c: a shader of the host's, whose members are zero; programs of it, made when first needed.
hair_result hair_gl_make_shader(struct hair_gl* gl, const char* label, const char* text, int pixels,
                                struct hair_gl_shader* out);
void hair_gl_free_shader(struct hair_gl* gl, struct hair_gl_shader* shader);
hair_result hair_gl_need_own(struct hair_gl* gl, struct hair_gl_shader* shader, hair_gl_pass pass,
                             GLuint* out);

// cache.c: a program as the driver compiled it before, kept by the host.
struct hair_gl_key hair_gl_key_begin(struct hair_gl* gl);
void hair_gl_key_add(struct hair_gl_key* key, const char* text); // NULL: nothing
// 1: it was there, and `program` is what it was. 0: it is to be compiled, as if nothing had been.
int hair_gl_cached(struct hair_gl* gl, struct hair_gl_key key, GLuint program);
void hair_gl_keep(struct hair_gl* gl, struct hair_gl_key key, GLuint program);

// source.c --------------------------------------------------------------------------------------------------

#define HAIR_GL_MAX_SOURCES 48 // Files of one shader, itself included.

struct hair_gl_source {
    char* text; // To free; with every include in place.
    char file[HAIR_GL_MAX_SOURCES][48];
    uint32_t files;
};

// The text of glsl/NAME with its includes, each once, and #line directives that number the files as `file` does.
// `prefix` follows the #version line. glsl_dir NULL: the text built in.
hair_result hair_gl_read_source(const hair_host* host, const char* glsl_dir, const char* name,
                                const char* prefix, struct hair_gl_source* out);
// The same with `own`, unless it is NULL, for the text of HAIR_GL_OWN.
#define HAIR_GL_OWN "own.glsl"
hair_result hair_gl_read_source_with(const hair_host* host, const char* glsl_dir, const char* name,
                                     const char* prefix, const char* own, struct hair_gl_source* out);

// state.c ---------------------------------------------------------------------------------------------------

void hair_gl_enter(struct hair_gl* gl); // Before anything else in a [GL] call.
void hair_gl_leave(struct hair_gl* gl);

// What captures the vertices of draws and shows nothing needs a framebuffer all the same: without one every draw fails.
GLuint hair_gl_blank_framebuffer(struct hair_gl* gl);
struct hair_gl_capture {
    GLint framebuffer, feedback;
    int discard;
};
void hair_gl_begin_capture(struct hair_gl* gl, GLuint framebuffer, struct hair_gl_capture* was);
void hair_gl_end_capture(struct hair_gl* gl, const struct hair_gl_capture* was);

// buffer.c --------------------------------------------------------------------------------------------------

// A buffer of `size` bytes (at least 16) holding `data`, or zeros when NULL. 0 and an error when the driver refuses.
hair_result hair_gl_buffer(struct hair_gl* gl, const char* label, size_t size, const void* data, GLuint* out);
// The same, for a shader to read or write as storage: fails when the driver's largest block is smaller.
hair_result hair_gl_storage(struct hair_gl* gl, const char* label, size_t size, const void* data,
                            GLuint* out);

// A uniform buffer, written whole before every dispatch or draw that reads it. Each writing gives it new memory, so
// that what is under way keeps what it was given: one driver was seen to write ahead of a dispatch before it.
hair_result hair_gl_uniform(struct hair_gl* gl, const char* label, size_t size, GLuint* out);
void hair_gl_write_uniform(struct hair_gl* gl, GLuint buffer, size_t size, const void* data);
// The same where it may be of another size than it was. On failure it is of any size.
hair_result hair_gl_resize(struct hair_gl* gl, const char* label, size_t size, const void* data,
                           GLuint buffer);

// A buffer that the GPU copies into and the host reads where it is `mapped`, as long as there is the buffer: what was copied
// is there once a fence after it has been passed.
hair_result hair_gl_mapped(struct hair_gl* gl, const char* label, size_t size, GLuint* out,
                           const void** mapped);

hair_result hair_gl_buffer_texture(struct hair_gl* gl, const char* label, GLenum format, GLuint buffer,
                                   GLuint* out);

// A 3D texture without mipmaps, what is in it undefined, its outermost texels drawn out. 0 and an error when the driver
// refuses.
hair_result hair_gl_texture_3d(struct hair_gl* gl, const char* label, GLenum format, const uint32_t size[3],
                               GLenum filter, GLuint* out);
hair_result hair_gl_texture_2d(struct hair_gl* gl, const char* label, GLenum format, uint32_t width,
                               uint32_t height, GLuint* out);
// Of four floats a texel. However the host unpacks its pixels.
void hair_gl_fill_texture_3d(struct hair_gl* gl, GLuint texture, const uint32_t size[3], const void* texels);
// Memory that they have; 0 has none. A buffer texture has that of its buffer.
uint64_t hair_gl_buffer_bytes(const struct hair_gl* gl, GLuint buffer);
uint64_t hair_gl_texture_bytes(const struct hair_gl* gl, GLuint texture);
void hair_gl_free_buffer(struct hair_gl* gl, GLuint* buffer);
void hair_gl_free_buffer_texture(struct hair_gl* gl, GLuint* texture);
void hair_gl_free_texture(struct hair_gl* gl, GLuint* texture); // of two or three dimensions

// pass.c ----------------------------------------------------------------------------------------------------

// What has been needed of a pass; NULL: nothing yet.
struct hair_gl_program* hair_gl_find(const struct hair_gl* gl, hair_gl_pass pass);
// The same, without a program where there was nothing. NULL: out of memory, which is told.
struct hair_gl_program* hair_gl_know(struct hair_gl* gl, hair_gl_pass pass);
void hair_gl_free_programs(struct hair_gl* gl);

// The label of a pass's row, which is static; the whole one stands in what hair_gl_find gives.
const char* hair_gl_row_label(hair_gl_pass pass);
const char* hair_gl_row_stages(hair_gl_pass pass);
// `pass` with those of `features` that its row may be compiled with.
hair_gl_pass hair_gl_with(hair_gl_pass pass, hair_gl_pass features);
// `pass` in the smallest work groups that guides of up to `vertices` fit into.
hair_gl_pass hair_gl_pass_for(hair_gl_pass pass, uint32_t vertices);

// Bracket the commands of a pass: its program, its debug group, its timer.
void hair_gl_begin(struct hair_gl* gl, hair_gl_pass pass);
void hair_gl_end(struct hair_gl* gl, hair_gl_pass pass);

// Run a compute pass over `groups` work groups, numbered by hair_group() in GLSL, and make what it wrote visible.
void hair_gl_run(struct hair_gl* gl, hair_gl_pass pass, uint32_t groups);
void hair_gl_run_with(struct hair_gl* gl, hair_gl_pass pass, GLuint program,
                      uint32_t groups); // by a program of the host's
// The same over as many as three numbers in a buffer say, from that byte on.
void hair_gl_run_indirect(struct hair_gl* gl, hair_gl_pass pass, GLuint program, GLuint buffer, size_t at);
float hair_gl_pass_ms(struct hair_gl* gl, struct hair_gl_program* of);

#endif
