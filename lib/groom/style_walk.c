// style_walk.c - the way of a guide of a built-in haircut around the bust.
#include "lib/groom/style_walk.h"
#include "lib/groom/style_body.h"

#include <stdbool.h>

// Height above the clearance below which hair turns along the bust, m.
#define CUSHION 0.020f
#define STRIDE HAIR_STYLE_PATH_STRIDE

// Return 1 in front of the ridge of a shoulder and -1 behind it, with a smooth transition. Hair
// that comes down on the ridge slides off to that side. The value fades away from the ridge.
static float split_at_shoulder(const struct hair_style_walk* walk, hair_vec3 p)
{
    float off = (p.z - walk->ridge) / 0.020f;
    return fminf(fmaxf(off, -1), 1) * hair_smooth(4.0f, 1.5f, fabsf(off)) * hair_smooth(1.60f, 1.55f, p.y) *
           hair_smooth(1.37f, 1.42f, p.y);
}

static hair_vec3 pull(const struct hair_style_walk* walk, hair_vec3 p, float s)
{
    float fraction = 1 - expf(-s / walk->hold);
    hair_vec3 v = hair_v3(0, -walk->gravity * fraction, 0);
    v.z += walk->split * split_at_shoulder(walk, p);
    if (p.y < walk->inward_below) {
        hair_vec3 in = hair_normalize(hair_v3(-p.x, 0, -0.02f - p.z), hair_v3(0, 0, -1));
        v = hair_add(v, hair_scale(in, walk->inward));
    }
    return v;
}

// Turn hair before it meets a shoulder, so that it bends without a kink.
static hair_vec3 cushion(hair_vec3 d, hair_vec3 normal, float over)
{
    float into = -hair_dot(d, normal), near = 1 - over / CUSHION;
    return into > 0 ? hair_normalize(hair_add(d, hair_scale(normal, into * near * 70 * STRIDE)), d) : d;
}

// Return the next point, outside the bust and the face. The normal is computed only near the
// clearance, because most of a long hair hangs free.
static hair_vec3 step_clear_of_bust(const struct hair_style_walk* walk, hair_vec3 p, hair_vec3 d, float s)
{
    float wanted = walk->clearance * (1 - expf(-s / walk->lift));
    float over = hair_body_distance(p) - wanted;
    hair_vec3 normal = {0, 0, 0};
    if (over < CUSHION || walk->press > 0) normal = hair_body_normal(p);
    if (over > 0 && over < CUSHION) d = cushion(d, normal, over);
    p = hair_add(p, hair_scale(d, STRIDE));
    over = hair_body_distance(p) - wanted;
    if (over < 0)
        p = hair_add(p, hair_scale(normal, fminf(-over, 0.8f * STRIDE)));
    else
        p = hair_sub(p, hair_scale(normal, walk->press * over));

    over = hair_face_distance(p) - walk->face * (1 - expf(-s / 0.03f));
    if (over < 0) p = hair_add(p, hair_scale(hair_face_normal(p), fminf(-over, 0.8f * STRIDE)));
    return p;
}

// Return whether a point is over the face, below the fringe.
static bool is_below_fringe(const struct hair_style_walk* walk, hair_vec3 p)
{
    return p.y < walk->fringe && p.z > 0.035f && fabsf(p.x) < 0.056f;
}

void hair_style_trace(const struct hair_style_walk* walk, hair_vec3 root, struct hair_style_path* path)
{
    hair_vec3 p = root, normal = hair_skull_normal(root);
    hair_vec3 d = hair_normalize(hair_lerp(walk->comb, normal, walk->rise), normal);
    path->count = 0, path->length = 0;
    hair_style_path_add(path, p);
    while (path->length < walk->max && path->count < HAIR_STYLE_PATH_POINTS && p.y > walk->floor &&
           !is_below_fringe(walk, p)) {
        hair_vec3 last = p;
        d = hair_normalize(hair_add(d, hair_scale(pull(walk, p, path->length), STRIDE)), d);
        p = step_clear_of_bust(walk, p, d, path->length);
        d = hair_normalize(hair_sub(p, last), d);
        hair_style_path_add(path, p);
    }
}

void hair_style_trace_to(struct hair_style_walk* walk, hair_vec3 root, float length,
                         struct hair_style_path* path)
{
    walk->max = length;
    walk->floor = -INFINITY;
    hair_style_trace(walk, root, path);
    hair_style_path_trim(path, length);
}

void hair_style_trace_cut(struct hair_style_walk* walk, hair_vec3 root, float scale, float min,
                          struct hair_style_path* path)
{
    walk->max = 0.6f;
    hair_style_trace(walk, root, path);
    if (scale == 1 && path->length >= min) return;
    hair_style_trace_to(walk, root, fmaxf(path->length, min) * scale, path);
}
