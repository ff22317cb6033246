// shadow.c - Suite `shadow`, methods of self-shadowing against counting strands ray by ray.
//
// Pictures differ only in the light that reaches strands. Methods that the library lacks are
// computed on the CPU. The suite also compares the area that hair shades on other surfaces with the
// area of stopped rays.
#include "tools/bench/picture.h"
#include "tools/bench/scatter.h"
#include "tools/bench/strand_light.h"
#include "tools/bench/studio.h"
#include "tests/reference/self_shadow.h"
#include "tools/common/camera.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 256
#define STRANDS 4500
#define SEGMENTS 24
#define RAYS 1024
#define RAYS_OF_QUICK 64
#define UNIT 24 // texture unit of the application's table

static const char* const columns[] = {
    "case", "method",   "cell",       "layers",        "ms",        "rays", "strands",  "size",  "flip",
    "psnr", "light",    "pixels",     "halves_differ", "color",     "lit",  "radiance", "error", "often",
    "bias", "bias_red", "bias_green", "bias_blue",     "bias_once", NULL};

static const char table_glsl[] =
    "layout(binding = 24) uniform samplerBuffer table;\n"
    "float own_through(hair_fragment f)\n"
    "{\n"
    "    int   each = int(draw.segments) + 1;\n"
    "    float at   = f.t * float(draw.segments), k = min(floor(at), float(draw.segments - 1u));\n"
    "    int   i    = int(f.strand) * each + int(k);\n"
    "    return mix(texelFetch(table, i).x, texelFetch(table, i + 1).x, at - k);\n"
    "}\n";
static const char library_glsl[] =
    "float own_through(hair_fragment f) { return hair_light_through(f, 0u); }\n";
static const char body_glsl[] =
    "vec4 hair_shade(hair_fragment f)\n"
    "{\n"
    "    vec3  to, light = hair_light(f, 0u, to);\n"
    "    float along = dot(to, f.tangent);\n"
    "    vec3  lit   = light * sqrt(max(1.0 - along * along, 0.0)) * own_through(f);\n"
    "    return vec4(f.color * (lit + hair_sky(f)), 1.0);\n"
    "}\n";

struct scene {
    struct bench* bench;
    struct bench_studio studio;
    struct bench_strands strands;
    struct bench_shot shot;
    hair_shader *by_table, *by_library;
    unsigned buffer, texture;
    float* light; // per vertex
    uint32_t vertices, rays;
    struct bench_picture truth;
    double mean, halves_differ;
    bool alive, refused;
};

static bool make_shader(struct scene* scene, const char* own, hair_shader** out)
{
    char text[2048];
    hair_shader_desc desc = hair_shader_desc_default();
    snprintf(text, sizeof text, "%s%s", own, body_glsl);
    desc.label = "shadow";
    desc.glsl = text;
    return !hair_shader_create(scene->bench->context, &desc, out);
}

static double mean_of(const float* values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; ++i) sum += (double)values[i];
    return sum / (double)count;
}

static bool take(struct scene* scene, hair_shader* shader, struct bench_picture* out)
{
    scene->shot.view.shader = shader;
    glNamedBufferSubData(scene->buffer, 0, (GLsizeiptr)(scene->vertices * sizeof(float)), scene->light);
    glBindTextureUnit(UNIT, scene->texture);
    bool ok = bench_picture_make(scene->studio.size, out) && bench_studio_set(&scene->studio, &scene->shot) &&
              bench_studio_draw(&scene->studio, NULL) && bench_studio_add(&scene->studio, out->rgba);
    if (ok) bench_picture_finish(out, 1, (double)scene->studio.scene.exposure);
    return ok;
}

// Compute the true light by rays, and its picture. Each half of the rays makes a picture too.
static bool find_truth(struct scene* scene)
{
    struct bench_picture halves[2] = {{0}};
    struct hair_image_error error;
    float* sum = calloc(scene->vertices, sizeof *sum);
    bool ok = sum;
    for (uint32_t i = 0; i < 2 && ok; ++i) {
        ok = bench_light_by_rays(&scene->strands, scene->rays / 2, i, scene->light) &&
             take(scene, scene->by_table, &halves[i]);
        for (size_t v = 0; ok && v < scene->vertices; ++v) sum[v] += 0.5f * scene->light[v];
    }
    if (ok) memcpy(scene->light, sum, scene->vertices * sizeof *sum);
    ok = ok && take(scene, scene->by_table, &scene->truth) && bench_picture_cover(&scene->truth) &&
         bench_picture_compare(&scene->truth, &halves[0], &halves[1], &error);
    if (ok) scene->halves_differ = error.flip;
    if (ok) scene->mean = mean_of(sum, scene->vertices);
    for (int i = 0; i < 2; ++i) bench_picture_free(&halves[i]);
    free(sum);
    return ok;
}

// Set a shot of hair alone, with one radius and one colour.
static void set_shot(struct scene* scene)
{
    hair_look* look = &scene->shot.look;
    scene->shot = bench_studio_shot(&scene->studio);
    hair_look_color(look, HAIR_COLOR_BLOND);
    look->strand.taper = hair_curve_line(1, 1);
    look->strand.segments = SEGMENTS;
    look->strand.radius = look->strand.radius * sqrtf(scene->studio.fewer);
    scene->shot.samples = 4;
    scene->shot.supersample = 2;
    scene->studio.bare = true;
}

static bool read_strands(struct scene* scene)
{
    float to[3];
    uint32_t count = scene->studio.info.follower_count * (SEGMENTS + 1);
    float* positions = malloc(3 * sizeof *positions * count);
    hair_light_direction(&scene->studio.scene, to);
    hair_set_colliders(scene->studio.hair, NULL, 0, 0); // Rays hit no colliders.
    bool ok =
        positions && bench_studio_set(&scene->studio, &scene->shot) &&
        !hair_read_positions(scene->studio.hair, HAIR_READ_FOLLOWERS, positions, count, &scene->vertices) &&
        bench_strands_make(positions, scene->studio.info.follower_count, SEGMENTS + 1,
                           scene->shot.look.strand.radius, to, &scene->strands);
    free(positions);
    scene->light = malloc((scene->vertices + 1) * sizeof(float));
    return ok && scene->light;
}

static bool ensure(struct scene* scene)
{
    if (scene->alive || scene->refused) return scene->alive;
    uint32_t strands = scene->bench->options.strands, size = scene->bench->options.size;
    struct bench_studio_desc desc = {
        .scene = "still", .size = size ? size : SIZE, .followers = strands ? strands : STRANDS};
    scene->rays = scene->bench->options.quick ? RAYS_OF_QUICK : RAYS;
    scene->refused = !bench_studio_make(scene->bench, &desc, &scene->studio);
    if (scene->refused) return false;
    set_shot(scene);
    scene->alive = read_strands(scene) && make_shader(scene, table_glsl, &scene->by_table) &&
                   make_shader(scene, library_glsl, &scene->by_library);
    if (scene->alive) {
        glCreateBuffers(1, &scene->buffer);
        glNamedBufferStorage(scene->buffer, (GLsizeiptr)(scene->vertices * sizeof(float)), NULL,
                             GL_DYNAMIC_STORAGE_BIT);
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &scene->texture);
        glTextureBuffer(scene->texture, GL_R32F, scene->buffer);
    }
    scene->alive = scene->alive && find_truth(scene);
    scene->refused = !scene->alive;
    return scene->alive;
}

static bool by_none(struct scene* scene, const float* with)
{
    (void)with;
    for (size_t v = 0; v < scene->vertices; ++v) scene->light[v] = (float)scene->mean;
    return true;
}
static bool by_layers(struct scene* scene, const float* with)
{
    return bench_light_by_layers(&scene->strands, with[0], (uint32_t)with[1], with[2], 2, scene->light);
}

static const struct method {
    const char* name;
    bool (*find)(struct scene* scene, const float* with); // NULL uses the library's method
    float with[3];
    uint32_t count; // number of layers
    hair_self_shadow shadow; // setting of the library
    bool unmapped;
} methods[] = {{"depth", NULL, {0}, 0, HAIR_SELF_SHADOW_DEPTH, false},
               {"strands", NULL, {0.004f}, 0, HAIR_SELF_SHADOW_STRANDS, false},
               {"grid", NULL, {0.012f}, 0, HAIR_SELF_SHADOW_STRANDS, true},
               {"grid", NULL, {0.008f}, 0, HAIR_SELF_SHADOW_STRANDS, true},
               {"grid", NULL, {0.004f}, 0, HAIR_SELF_SHADOW_STRANDS, true},
               {"mean", by_none, {0}, 0, HAIR_SELF_SHADOW_DEPTH, false},
               {"layers", by_layers, {0.001f, 4, 0.005f}, 4, HAIR_SELF_SHADOW_DEPTH, false},
               {"layers", by_layers, {0.001f, 8, 0.002f}, 8, HAIR_SELF_SHADOW_DEPTH, false},
               {"layers", by_layers, {0.002f, 8, 0.002f}, 8, HAIR_SELF_SHADOW_DEPTH, false}};

// Return the time of finding the light and drawing, the minimum of a few runs, because other load
// lengthens times.
static double time_of(struct scene* scene)
{
    double best = 1e9, ms = 0;
    for (int i = 0; i < 3 && bench_studio_draw(&scene->studio, &ms); ++i) best = fmin(best, ms);
    return best;
}

static bool look(struct scene* scene, const struct method* method)
{
    struct bench_picture picture = {0};
    struct hair_image_error error;
    scene->shot.look.self_shadow.method = method->shadow;
    scene->shot.unmapped = method->unmapped;
    if (method->shadow == HAIR_SELF_SHADOW_STRANDS) scene->shot.look.self_shadow.cell = method->with[0];
    bool ok = (!method->find || method->find(scene, method->with)) &&
              take(scene, method->find ? scene->by_table : scene->by_library, &picture) &&
              bench_picture_compare(&scene->truth, &scene->truth, &picture, &error);
    if (ok) {
        json_t* row = bench_rows_add(&scene->bench->rows);
        bench_set_text(row, "case", "long");
        bench_set_text(row, "method", method->name);
        if (method->with[0] > 0) bench_set_number(row, "cell", (double)method->with[0]);
        if (method->count) bench_set_count(row, "layers", method->count);
        if (!method->find) bench_set_number(row, "ms", time_of(scene));
        bench_set_count(row, "rays", scene->rays);
        bench_set_count(row, "strands", scene->studio.info.follower_count);
        bench_set_count(row, "size", scene->studio.size);
        bench_set_number(row, "flip", error.flip);
        bench_set_number(row, "psnr", error.psnr);
        if (method->find)
            bench_set_number(row, "light", mean_of(scene->light, scene->vertices) / scene->mean);
        bench_set_count(row, "pixels", error.pixels);
        bench_set_number(row, "halves_differ", scene->halves_differ);
    }
    bench_picture_free(&picture);
    return ok;
}

#define SHADE_RAYS 8192 // per side

// Compute the area that hair shades, in m^2 perpendicular to the light, by rays.
static bool shade_by_rays(const struct scene* scene, double* area)
{
    const struct bench_strands* s = &scene->strands;
    double r = (double)s->radius;
    struct hair_reference_rays rays = {.count = SHADE_RAYS, .stopped = calloc(SHADE_RAYS, SHADE_RAYS)};
    if (!rays.stopped) return false;
    for (int k = 0; k < 2; ++k) {
        rays.lower[k] = (double)s->lower[k] - r;
        rays.side = fmax(rays.side, (double)(s->upper[k] - s->lower[k]) + 2 * r);
    }
    for (uint32_t v = 0; v < s->count * s->each; ++v) {
        const float* p = s->seen + 3 * (size_t)v;
        double a[2] = {(double)p[0], (double)p[1]}, b[2];
        if (v % s->each == s->each - 1) continue;
        b[0] = (double)p[3], b[1] = (double)p[4];
        hair_reference_stop(&rays, a, b, r, r);
    }
    *area = hair_reference_stopped(&rays, 0, 0, 1) * rays.side * rays.side;
    free(rays.stopped);
    return true;
}

// Compute the shaded area by an opacity map of `size` texels per side.
static bool shade_by_map(struct scene* scene, GLsizei size, double* area)
{
    struct bench_studio* studio = &scene->studio;
    struct hair_matrices light;
    hair_view view = hair_view_default();
    float none = 0, *texels = malloc((size_t)size * (size_t)size * sizeof *texels);
    double texel = 2 * (double)studio->reach / size;
    GLuint framebuffer, texture;
    hair_light_matrices(&studio->scene, studio->transform, studio->reach, &light);
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_R16F, size, size);
    glClearTexImage(texture, 0, GL_RED, GL_FLOAT, &none);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size, size);
    glDisable(GL_DEPTH_TEST);
    view.pass = HAIR_PASS_OPACITY;
    memcpy(view.view, light.view, sizeof view.view);
    memcpy(view.projection, light.projection, sizeof view.projection);
    bool ok = texels && !hair_draw(studio->hair, &view);
    if (ok) glGetTextureImage(texture, 0, GL_RED, GL_FLOAT, size * size * (GLsizei)sizeof *texels, texels);
    if (ok) *area = mean_of(texels, (size_t)size * (size_t)size) * size * size * texel * texel;
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    free(texels);
    return ok;
}

static bool look_at_body(struct scene* scene, GLsizei size)
{
    double expected, area;
    if (!shade_by_rays(scene, &expected) || !shade_by_map(scene, size, &area)) return false;
    json_t* row = bench_rows_add(&scene->bench->rows);
    bench_set_text(row, "case", "body");
    bench_set_text(row, "method", "opacity");
    bench_set_number(row, "cell", 2 * (double)scene->studio.reach / size);
    bench_set_count(row, "strands", scene->studio.info.follower_count);
    bench_set_count(row, "size", (uint32_t)size);
    bench_set_number(row, "error", area / expected - 1);
    return true;
}

static void measure_body(struct scene* scene)
{
    for (GLsizei size = 128; size <= 2048; size *= 4)
        if (bench_begin(scene->bench, "body", "opacity") && (!ensure(scene) || !look_at_body(scene, size)))
            bench_refuse(scene->bench, "body", "opacity");
}

static void run_suite(struct bench* bench)
{
    struct scene scene = {.bench = bench};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; ++i)
        if (bench_begin(bench, "long", methods[i].name) && (!ensure(&scene) || !look(&scene, &methods[i])))
            bench_refuse(bench, "long", methods[i].name);
    measure_body(&scene);
    bench_picture_free(&scene.truth);
    bench_strands_free(&scene.strands);
    free(scene.light);
    if (scene.texture) glDeleteTextures(1, &scene.texture);
    if (scene.buffer) glDeleteBuffers(1, &scene.buffer);
    hair_shader_destroy(scene.by_table);
    hair_shader_destroy(scene.by_library);
    if (scene.studio.bench) bench_studio_free(&scene.studio);
    bench_measure_scatter(bench);
}

const struct bench_suite bench_shadow = {
    "shadow", "the light that hair leaves to itself, against counting strands", columns, run_suite};
