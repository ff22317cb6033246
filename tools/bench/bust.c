// bust.c - Long hair on a moving head and shoulders.
#include "tools/bench/bust.h"
#include "tools/bench/capsules.h"
#include "tools/common/stats.h"
#include "tools/common/groom_source.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_RUNS 15

static bool make_target(struct bench_bust* bust)
{
    glCreateFramebuffers(1, &bust->target[0]);
    glCreateRenderbuffers(1, &bust->target[1]);
    glNamedRenderbufferStorage(bust->target[1], GL_RGBA8, 16, 16);
    glNamedFramebufferRenderbuffer(bust->target[0], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, bust->target[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, bust->target[0]);
    glViewport(0, 0, 16, 16);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static bool place(struct bench_bust* bust, float transform[16])
{
    float time = (float)bust->frame / BUST_FPS;
    hair_motion_at(&bust->scene.motion, time, transform);
    bust->collider_count = hair_head_rig_colliders(&bust->scene, NULL, time, transform, bust->colliders);
    return !bust->hair ||
           (!hair_set_transform(bust->hair, transform) &&
            !hair_set_colliders(bust->hair, bust->colliders, bust->collider_count, sizeof *bust->colliders));
}

static bool bring_to_life(struct bench_bust* bust, hair_hit_method hit_method)
{
    hair_groom_info info = hair_groom_info_default();
    hair_desc desc = bust->scene.settings.desc;
    desc.physics = &bust->scene.settings.physics;
    desc.look = &bust->look;
    desc.hit_method = hit_method;
    if (!place(bust, desc.transform)) return false;
    if (hair_create(bust->bench->context, bust->groom, &desc, &bust->hair)) return false;
    if (hair_groom_describe(bust->groom, &info) || !place(bust, desc.transform)) return false;
    bust->followers = info.follower_count;
    bust->guides = info.guide_count;
    for (int i = 0; i < BUST_FPS / 2; ++i)
        if (hair_step(bust->hair, 1.0f / BUST_FPS)) return false;
    uint32_t smooth;
    if (hair_read_positions(bust->hair, HAIR_READ_SMOOTH, NULL, 0, &smooth)) return false;
    bust->smooth = smooth / bust->guides;
    return make_target(bust);
}

bool bench_bust_make(struct bench* bench, uint32_t followers, uint32_t segments, hair_hit_method hit_method,
                     struct bench_bust* out)
{
    memset(out, 0, sizeof *out);
    out->bench = bench;
    snprintf(bench->sentence, sizeof bench->sentence, "the scene could not be made");
    hair_scene_default(&out->scene);
    if (!hair_scene_named(BENCH_TOOL, "demo", &out->scene)) return false;
    if (followers) out->scene.settings.groom.follower_count = followers;
    out->look = out->scene.settings.look;
    // Only interpolation and colliders may turn strands.
    out->look.strays.tip_fraction = out->look.strays.fraction = 0;
    if (segments) out->look.strand.segments = segments;
    if (!hair_groom_source_load(BENCH_TOOL, &bench->host, &out->scene, NULL, &out->groom) &&
        bring_to_life(out, hit_method))
        return true;
    bench_bust_free(out);
    return false;
}

void bench_bust_free(struct bench_bust* bust)
{
    hair_destroy(bust->hair);
    hair_groom_destroy(bust->groom);
    glDeleteFramebuffers(1, &bust->target[0]);
    glDeleteRenderbuffers(1, &bust->target[1]);
    bust->hair = NULL;
    bust->groom = NULL;
}

bool bench_bust_step(struct bench_bust* bust)
{
    float transform[16];
    ++bust->frame;
    return place(bust, transform) && !hair_step(bust->hair, 1.0f / BUST_FPS);
}

bool bench_bust_read(struct bench_bust* bust, hair_follower_collision collision, float* followers)
{
    uint32_t count = bust->followers * (bust->look.strand.segments + 1), there;
    bust->look.followers.collision = collision;
    return !hair_set_look(bust->hair, &bust->look) &&
           !hair_read_positions(bust->hair, HAIR_READ_FOLLOWERS, followers, count, &there) && there == count;
}

bool bench_bust_read_guides(struct bench_bust* bust, float* guides)
{
    uint32_t count = bust->guides * bust->smooth, there, each = bust->look.strand.segments + 1;
    float* all = malloc(3 * sizeof *all * count);
    bool ok = all && !hair_read_positions(bust->hair, HAIR_READ_SMOOTH, all, count, &there) && there == count;
    for (uint32_t i = 0; i < bust->guides * each && ok; ++i) {
        float at = (float)(i % each) / (float)(each - 1) * (float)(bust->smooth - 1);
        uint32_t k = (uint32_t)at < bust->smooth - 2 ? (uint32_t)at : bust->smooth - 2;
        float fraction = at - (float)k;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const float* a = all + 3 * (i / each * bust->smooth + k) + axis;
            guides[3 * i + axis] = a[0] + fraction * (a[3] - a[0]);
        }
    }
    free(all);
    return ok;
}

double bench_bust_distance(const struct bench_bust* bust, const float at[3])
{
    return bench_capsule_distance(bust->colliders, bust->collider_count, at);
}

// Timing ------------------------------------------------------------------------------------------

static double time_of_passes(hair_context* context)
{
    hair_timing now[BENCH_MAX_PASSES];
    uint32_t count = hair_get_timings(context, now, BENCH_MAX_PASSES);
    double ms = 0;
    for (uint32_t i = 0; i < count && i < BENCH_MAX_PASSES; ++i)
        if (strstr(now[i].pass, "strands/hit") || strstr(now[i].pass, "strands/repair"))
            ms += now[i].total_ms;
    return ms;
}

// Draw a frame with a minimum of hair. With `again` the hair is unchanged, and the hits of the
// previous call are reused.
static bool ask_for_frame(struct bench_bust* bust, bool again)
{
    hair_look look = bust->look;
    hair_view view = hair_view_default();
    view.pass = HAIR_PASS_DEPTH;
    view.primitive = HAIR_PRIMITIVE_LINES;
    // Hits are not searched for hair out of view.
    for (int k = 0; k < 3; ++k) view.projection[5 * k] = 0.01f;
    // Hits are not searched for unchanged hair, therefore alternate the density.
    bust->turn = again ? bust->turn : !bust->turn;
    look.followers.density = bust->turn ? 1e-6f : 2e-6f;
    return (again || !hair_set_look(bust->hair, &look)) && !hair_draw(bust->hair, &view);
}

static bool draw(struct bench_bust* bust, bool again, double* ms)
{
    glFinish();
    double passes = time_of_passes(bust->bench->context), start = hair_now();
    if (!ask_for_frame(bust, again)) return false;
    glFinish();
    *ms = bust->bench->software ? hair_now() - start : time_of_passes(bust->bench->context) - passes;
    return true;
}

// Draw for a while, because an idle GPU is slower at first.
static bool warm_up(struct bench_bust* bust)
{
    enum { WARM = 300, AT_ONCE = 20 }; // ms, frames
    for (double start = hair_now(); !bust->bench->software && hair_now() - start < WARM; glFinish())
        for (int i = 0; i < AT_ONCE; ++i)
            if (!ask_for_frame(bust, false)) return false;
    return true;
}

static int compare(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

bool bench_bust_time(struct bench_bust* bust, hair_follower_collision collision, double* ms, uint32_t* runs)
{
    double all[MAX_RUNS], first, second, start = 0, enough = bust->bench->options.quick ? 300 : 3000;
    bust->look.followers.collision = collision;
    *runs = 0;
    if (!warm_up(bust)) return false;
    for (int k = -2; k < MAX_RUNS; ++k) { // The first two runs compile shaders.
        if (!draw(bust, false, &first) || !draw(bust, true, &second) || bench_was_interrupted()) return false;
        if (k < 0) start = hair_now();
        if (k >= 0) all[(*runs)++] = fmax(first - second, 0);
        if (k >= 2 && hair_now() - start > enough) break;
    }
    qsort(all, *runs, sizeof *all, compare);
    *ms = all[*runs / 2];
    return true;
}
