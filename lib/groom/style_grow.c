// style_grow.c - guides of the built-in haircuts, walked from root to tip.
//
// A walk turns its direction by a pull (the comb near the root, gravity further on) and is pushed out of the
// bust to a clearance that grows along the strand: hair that comes from higher up lies over hair from below.
#include "lib/groom/style_grow.h"
#include "lib/groom/style_body.h"

#define PI 3.14159265f
#define CUSHION 0.020f // Height above the clearance from which on hair turns along the bust. m.
#define STRIDE 0.002f  // Of a walk, m: a tenth of the sharpest bend here.

// How the hair of one root runs.
struct walk {
    hair_vec3 comb;         // tangent to the skull at the root
    float     rise;         // share of the root's direction that is the skull's normal
    float     clearance;    // from the bust, far from the root, m
    float     lift;         // distance over which it is reached, m
    float     gravity;      // turn towards down, 1/m, far from the root
    float     hold;         // distance over which the comb gives way to gravity, m
    float     press;        // share of what it is above the clearance that a step removes
    float     inward;       // turn towards the neck near the tip, 1/m
    float     inward_below; // height from which on, m
    float     split;        // turn to the front or the back of the shoulder, 1/m
    float     floor;        // height that the hair is cut at, m
    float     face;         // distance kept from the face, m
    float     most;         // length, m
};

static float smooth(float from, float to, float x)
{
    float t = fminf(fmaxf((x - from) / (to - from), 0), 1);
    return t * t * (3 - 2 * t);
}

static float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

static float lattice(int x, int y, int z, uint32_t seed)
{
    uint32_t h = hair_hash(seed ^ hair_hash((uint32_t)x ^ hair_hash((uint32_t)y ^ hair_hash((uint32_t)z))));
    return (float)(h >> 8) * (2.0f / 16777216.0f) - 1;
}

// Value noise in [-1, 1] that changes over `scale` metres: neighbouring roots get near values.
static float noise(hair_vec3 p, float scale, uint32_t seed)
{
    hair_vec3 q = hair_scale(p, 1 / scale);
    hair_vec3 f = {floorf(q.x), floorf(q.y), floorf(q.z)};
    float     u = smooth(0, 1, q.x - f.x), v = smooth(0, 1, q.y - f.y), w = smooth(0, 1, q.z - f.z);
    int       x = (int)f.x, y = (int)f.y, z = (int)f.z;
    float     sum = 0;
    for (int i = 0; i < 8; ++i) {
        int a = i & 1, b = i >> 1 & 1, c = i >> 2;
        sum += (a ? u : 1 - u) * (b ? v : 1 - v) * (c ? w : 1 - w) * lattice(x + a, y + b, z + c, seed);
    }
    return sum;
}

static hair_vec3 tangential(hair_vec3 v, hair_vec3 normal)
{
    return hair_sub(v, hair_scale(normal, hair_dot(v, normal)));
}

static void add_point(struct hair_course* course, hair_vec3 p)
{
    if (course->count > 0) {
        float step = hair_distance(p, course->point[course->count - 1]);
        if (step < 1e-6f || course->count == HAIR_COURSE_POINTS) return;
        course->length += step;
    }
    course->point[course->count++] = p;
}

// Parted hair ----------------------------------------------------------------------------------------------

struct hair_parting hair_style_parting(hair_style style)
{
    switch (style) {
    case HAIR_STYLE_LONG: return (struct hair_parting){1, 0.004f, 0.002f, -0.040f};
    case HAIR_STYLE_CURLY: return (struct hair_parting){1, -0.012f, -0.006f, -0.035f};
    case HAIR_STYLE_BOB: return (struct hair_parting){1, 0.026f, 0.014f, -0.040f};
    case HAIR_STYLE_SHORT: return (struct hair_parting){1, 0.034f, 0.024f, -0.030f};
    default: return (struct hair_parting){0};
    }
}

// Where a comb drawn from the parting goes: to the side at the forehead, ever more to the back towards the
// crown, and evenly round the back of the head behind it.
static hair_vec3 comb_from_parting(struct hair_parting parting, hair_vec3 p, float back_front,
                                   float back_crown)
{
    hair_vec3 normal = hair_skull_normal(p);
    float     along  = (HAIR_PARTING_FRONT_Z - p.z) / (HAIR_PARTING_FRONT_Z - parting.crown_z);
    float     width  = mix(0.0005f, 0.045f, smooth(0.9f, 1.5f, along)); // Over which sides change.
    float     side   = fminf(fmaxf((p.x - hair_parting_x(parting, p.z)) / width, -1), 1);
    float     back   = mix(back_front, back_crown, smooth(0, 1, along));
    float     above  = smooth(1.57f, 1.67f, p.y); // On the underside of the skull, back would be up.
    hair_vec3 v      = {side * above, -0.7f, -back * above};
    return hair_normalize(tangential(v, normal), tangential(hair_v3(0, -1, 0), normal));
}

// Hair that comes down on the ridge of a shoulder slides off to the front or to the back: 1 or -1 on either
// side of it, fading away from it.
static float split_at_shoulder(hair_vec3 p)
{
    float off = (p.z + 0.034f) / 0.020f;
    return fminf(fmaxf(off, -1), 1) * smooth(4.0f, 1.5f, fabsf(off)) * smooth(1.60f, 1.55f, p.y) *
           smooth(1.37f, 1.42f, p.y);
}

static hair_vec3 pull(const struct walk* walk, hair_vec3 p, float s)
{
    float     share = 1 - expf(-s / walk->hold);
    hair_vec3 v     = hair_v3(0, -walk->gravity * share, 0);
    v.z += walk->split * split_at_shoulder(p);
    if (p.y < walk->inward_below) {
        hair_vec3 in = hair_normalize(hair_v3(-p.x, 0, -0.02f - p.z), hair_v3(0, 0, -1));
        v            = hair_add(v, hair_scale(in, walk->inward));
    }
    return v;
}

// Turns hair that comes down on a shoulder before it meets it, so that it bends and does not break.
static hair_vec3 cushion(hair_vec3 d, hair_vec3 normal, float over)
{
    float into = -hair_dot(d, normal), near = 1 - over / CUSHION;
    return into > 0 ? hair_normalize(hair_add(d, hair_scale(normal, into * near * 70 * STRIDE)), d) : d;
}

// The normal is asked for only near the clearance: most of a long hair hangs free.
static hair_vec3 step_clear_of_bust(const struct walk* walk, hair_vec3 p, hair_vec3 d, float s)
{
    float     wanted = walk->clearance * (1 - expf(-s / walk->lift));
    float     over   = hair_body_distance(p) - wanted;
    hair_vec3 normal = {0, 0, 0};
    if (over < CUSHION || walk->press > 0) normal = hair_body_normal(p);
    if (over > 0 && over < CUSHION) d = cushion(d, normal, over);
    p    = hair_add(p, hair_scale(d, STRIDE));
    over = hair_body_distance(p) - wanted;
    if (over < 0)
        p = hair_add(p, hair_scale(normal, fminf(-over, 0.8f * STRIDE)));
    else
        p = hair_sub(p, hair_scale(normal, walk->press * over));

    over = hair_face_distance(p) - walk->face * (1 - expf(-s / 0.03f));
    if (over < 0) p = hair_add(p, hair_scale(hair_face_normal(p), fminf(-over, 0.8f * STRIDE)));
    return p;
}

static void run(const struct walk* walk, hair_vec3 root, struct hair_course* course)
{
    hair_vec3 p = root, normal = hair_skull_normal(root);
    hair_vec3 d   = hair_normalize(hair_lerp(walk->comb, normal, walk->rise), normal);
    course->count = 0, course->length = 0;
    add_point(course, p);
    while (course->length < walk->most && course->count < HAIR_COURSE_POINTS && p.y > walk->floor) {
        hair_vec3 last = p;
        d              = hair_normalize(hair_add(d, hair_scale(pull(walk, p, course->length), STRIDE)), d);
        p              = step_clear_of_bust(walk, p, d, course->length);
        d              = hair_normalize(hair_sub(p, last), d);
        add_point(course, p);
    }
}

// Walks end on a whole stride; take off what is over.
static void trim(struct hair_course* course, float most)
{
    float over = course->length - most;
    if (over <= 0 || course->count < 3) return;
    hair_vec3 *tip = &course->point[course->count - 1], *before = tip - 1;
    float      step = hair_distance(*tip, *before);
    *tip            = hair_lerp(*tip, *before, fminf(over / step, 0.99f));
    course->length -= fminf(over, 0.99f * step);
}

static void run_to(struct walk* walk, hair_vec3 root, float length, struct hair_course* course)
{
    walk->most  = length;
    walk->floor = -INFINITY;
    run(walk, root, course);
    trim(course, length);
}

// A cut at a height gives every root its own length; `scale` then lengthens or shortens that.
static void run_cut(struct walk* walk, hair_vec3 root, float scale, float least, struct hair_course* course)
{
    walk->most = 0.6f;
    run(walk, root, course);
    if (scale == 1 && course->length >= least) return;
    run_to(walk, root, fmaxf(course->length, least) * scale, course);
}

// 0 at the hairline of nape and sides, 1 at the crown: how far up in the layers of hair a root is.
static float layer(hair_vec3 root)
{
    return smooth(1.55f, 1.72f, root.y);
}

// 1 in front of the ears, 0 behind.
static float frontness(hair_vec3 root)
{
    return smooth(-0.012f, 0.030f, root.z);
}

// Curls and waves ------------------------------------------------------------------------------------------

struct curl {
    float radius, pitch; // m
    float start, full;   // distance from the root where it begins, and where the radius is reached, m
    float phase;         // radians
    float flat;          // 1: a helix; 0: a wave in one plane
};

// Lay a helix round a course, in a frame carried along it without twist, clear of the bust.
static void wind(struct hair_course* course, const struct curl* curl)
{
    hair_vec3 tangent = hair_normalize(hair_sub(course->point[1], course->point[0]), hair_v3(0, -1, 0));
    hair_vec3 across =
        hair_normalize(tangential(hair_skull_normal(course->point[0]), tangent), hair_perpendicular(tangent));
    uint32_t count = course->count;
    float    s = 0, angle = curl->phase;
    course->count = 1, course->length = 0;
    hair_vec3 last = course->point[0];
    for (uint32_t i = 1; i < count; ++i) {
        hair_vec3 p    = course->point[i];
        float     step = hair_distance(p, last);
        hair_vec3 next = hair_normalize(hair_sub(p, last), tangent);
        across =
            hair_normalize(tangential(hair_rotate(hair_quat_between(tangent, next), across), next), across);
        tangent = next, last = p;
        s += step;
        angle += 2 * PI * step / curl->pitch;
        float     radius = curl->radius * smooth(curl->start, curl->full, s);
        hair_vec3 along  = hair_scale(hair_cross(tangent, across), curl->flat * radius * sinf(angle));
        hair_vec3 q      = hair_add(p, hair_add(hair_scale(across, radius * cosf(angle)), along));
        float     inside = hair_body_distance(q);
        if (inside < 0.002f) q = hair_add(q, hair_scale(hair_body_normal(q), fminf(0.002f - inside, radius)));
        add_point(course, q);
    }
}

// Styles ---------------------------------------------------------------------------------------------------

static void grow_long(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    float       front = frontness(root), high = layer(root);
    struct walk walk = {
        .comb         = comb_from_parting(hair_style_parting(HAIR_STYLE_LONG), root, 0.30f, 1.1f),
        .rise         = 0.16f,
        .clearance    = mix(0.004f, 0.014f, high) + 0.002f * noise(root, 0.03f, seed),
        .lift         = 0.06f,
        .gravity      = 45,
        .hold         = 0.04f,
        .split        = 25,
        .floor        = mix(1.30f, 1.335f, front) + 0.008f * noise(root, 0.02f, seed + 1),
        .face         = 0.010f,
        .inward_below = 0,
    };
    run_cut(&walk, root, scale, 0.03f, course);
    struct curl wave = {
        0.011f, 0.105f, 0.07f * scale, 0.38f * scale, 1.5f * PI * noise(root, 0.06f, seed + 2), 0.5f};
    wind(course, &wave);
}

static void grow_bob(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    float       high = layer(root);
    float       cut  = mix(1.528f, 1.500f, smooth(-0.07f, 0.04f, root.z));
    struct walk walk = {
        .comb         = comb_from_parting(hair_style_parting(HAIR_STYLE_BOB), root, 0.40f, 1.0f),
        .rise         = 0.22f,
        .clearance    = mix(0.005f, 0.017f, high) + 0.001f * noise(root, 0.03f, seed),
        .lift         = 0.045f,
        .gravity      = 40,
        .hold         = 0.04f,
        .inward       = 22,
        .inward_below = cut + 0.045f,
        .floor        = cut + 0.003f * noise(root, 0.02f, seed + 1),
        .face         = 0.008f,
    };
    run_cut(&walk, root, scale, 0.03f, course);
}

static void grow_short(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    float       top  = smooth(1.625f, 1.705f, root.y);
    struct walk walk = {
        .comb      = comb_from_parting(hair_style_parting(HAIR_STYLE_SHORT), root, 0.25f, 1.3f),
        .rise      = mix(0.25f, 0.32f, top),
        .clearance = mix(0.005f, 0.013f, top) + 0.003f * noise(root, 0.025f, seed),
        .lift      = 0.02f,
        .gravity   = 8,
        .hold      = 0.04f,
        .press     = 0.03f,
    };
    float length = mix(0.026f, 0.068f, top) * (1 + 0.12f * noise(root, 0.02f, seed + 1));
    run_to(&walk, root, scale * length, course);
}

static void grow_curly(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    float       high = layer(root);
    struct walk walk = {
        .comb      = comb_from_parting(hair_style_parting(HAIR_STYLE_CURLY), root, 0.2f, 1.0f),
        .rise      = 0.22f,
        .clearance = mix(0.014f, 0.030f, high) + 0.006f * noise(root, 0.03f, seed),
        .lift      = 0.06f,
        .gravity   = 40,
        .hold      = 0.04f,
        .split     = 15,
        .floor     = 1.405f + 0.02f * noise(root, 0.025f, seed + 1),
        .face      = 0.018f,
    };
    run_cut(&walk, root, scale, 0.04f, course);
    struct curl curl = {.radius = 0.0100f + 0.0025f * noise(root, 0.04f, seed + 2),
                        .pitch  = 0.028f * (1 + 0.12f * noise(root, 0.05f, seed + 4)),
                        .start  = 0.008f,
                        .full   = 0.07f,
                        .phase  = 2 * PI * noise(root, 0.05f, seed + 3),
                        .flat   = 1};
    wind(course, &curl);
}

// From the root outwards to a sphere, in a tight helix.
static void grow_afro(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    const hair_vec3 center = {0, 1.648f, -0.014f};
    const float     radius = 0.163f;
    hair_vec3       normal = hair_skull_normal(root);
    hair_vec3       out    = hair_normalize(hair_sub(root, center), normal);
    hair_vec3       tip = hair_add(center, hair_scale(out, radius * (1 + 0.03f * noise(root, 0.02f, seed))));
    // Scaled about the root; the way there starts along the normal.
    tip               = hair_lerp(root, tip, scale);
    hair_vec3 control = hair_add(root, hair_scale(normal, 0.4f * hair_distance(root, tip)));
    uint32_t  count   = 600;
    course->count = 0, course->length = 0;
    for (uint32_t i = 0; i <= count; ++i) {
        float t = (float)i / (float)count;
        add_point(course, hair_lerp(hair_lerp(root, control, t), hair_lerp(control, tip, t), t));
    }
    struct curl curl = {0.0042f, 0.0125f, 0.002f, 0.025f, 2 * PI * noise(root, 0.045f, seed + 1), 1};
    wind(course, &curl);
}

// Ponytail -------------------------------------------------------------------------------------------------

#define TIE_RADIUS 0.011f
#define TAIL_LENGTH 0.28f

static const hair_vec3 tie      = {0, 1.672f, -0.106f};
static const hair_vec3 tie_axis = {0, 0.243f, -0.970f}; // out of the head, unit

static void comb_to_tie(hair_vec3 root, struct hair_course* course)
{
    hair_vec3 under = hair_skull_point(hair_skull_unit(tie));
    hair_vec3 p = root, normal = hair_skull_normal(root);
    hair_vec3 d = hair_normalize(hair_lerp(tangential(hair_sub(under, root), normal), normal, 0.02f), normal);
    add_point(course, p);
    while (hair_distance(p, under) > 0.034f && course->length < 0.5f) {
        hair_vec3 last = p;
        normal         = hair_skull_normal(p);
        hair_vec3 to   = hair_normalize(tangential(hair_sub(under, p), normal), d);
        d              = hair_normalize(hair_lerp(d, to, 0.15f), to);
        p              = hair_add(p, hair_scale(d, STRIDE));
        float height   = hair_body_distance(p);
        float wanted   = (0.003f + 0.03f * course->length) * (1 - expf(-course->length / 0.015f));
        p = hair_add(p, hair_scale(hair_body_normal(p), fmaxf(fminf(wanted - height, STRIDE), -STRIDE)));
        d = hair_normalize(hair_sub(p, last), d);
        add_point(course, p);
    }
}

// A cubic from the end of the course through the tie (Hermite form).
static void gather(hair_vec3 through, hair_vec3 normal, struct hair_course* course)
{
    hair_vec3 a    = course->point[course->count - 1];
    hair_vec3 from = course->count > 1 ? hair_sub(a, course->point[course->count - 2]) : normal;
    float     size = hair_distance(a, through);
    from           = hair_scale(hair_normalize(from, normal), size);
    hair_vec3 to   = hair_scale(tie_axis, size);
    for (int i = 1; i <= 40; ++i) {
        float     t = (float)i / 40, u = 1 - t;
        hair_vec3 p = hair_add(hair_scale(a, u * u * (1 + 2 * t)), hair_scale(through, t * t * (3 - 2 * t)));
        p           = hair_add(p, hair_add(hair_scale(from, t * u * u), hair_scale(to, -t * t * u)));
        add_point(course, p);
    }
}

// All hairs share the tail's middle line and keep their place around it; the tail swells, then tapers.
static void fall(hair_vec3 offset, float length, struct hair_course* course)
{
    hair_vec3 p = tie, d = tie_axis;
    for (float s = 0; s < length && course->count < HAIR_COURSE_POINTS; s += STRIDE) {
        hair_vec3 next   = hair_normalize(hair_add(d, hair_v3(0, -24 * STRIDE, 0)), d);
        float     height = hair_body_distance(p);
        if (height < 0.03f)
            next =
                hair_normalize(hair_add(next, hair_scale(hair_body_normal(p), (0.03f - height) * 4)), next);
        offset      = hair_rotate(hair_quat_between(d, next), offset);
        d           = next;
        p           = hair_add(p, hair_scale(d, STRIDE));
        float t     = s / length;
        float swell = 1 + 1.5f * smooth(0, 0.30f, t) - 1.7f * smooth(0.35f, 1.0f, t);
        add_point(course, hair_add(p, hair_scale(offset, swell)));
    }
}

static void grow_ponytail(hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    hair_vec3 normal = hair_skull_normal(root);
    course->count = 0, course->length = 0;
    comb_to_tie(root, course);
    // Hair from far away comes in over hair from near by: its place in the tie is further from the middle.
    hair_vec3 side = hair_sub(course->point[course->count - 1], tie);
    float     away = fminf(hair_distance(root, tie) / 0.22f, 1);
    hair_vec3 offset =
        hair_scale(hair_normalize(tangential(side, tie_axis), hair_v3(0, 1, 0)), TIE_RADIUS * away);
    gather(hair_add(tie, offset), normal, course);
    fall(offset, scale * TAIL_LENGTH * (1 + 0.08f * noise(root, 0.02f, seed)), course);
    struct curl wave = {
        0.004f, 0.12f, course->length - 0.2f * scale, course->length, PI * noise(root, 0.1f, seed + 1), 0.5f};
    wind(course, &wave);
}

// ----------------------------------------------------------------------------------------------------------

uint32_t hair_style_vertices(hair_style style)
{
    return style == HAIR_STYLE_CURLY || style == HAIR_STYLE_AFRO ? 64 : 32;
}

void hair_style_grow(hair_style style, hair_vec3 root, float scale, uint32_t seed, struct hair_course* course)
{
    seed = hair_hash(seed + 101u);
    switch (style) {
    case HAIR_STYLE_LONG: grow_long(root, scale, seed, course); break;
    case HAIR_STYLE_BOB: grow_bob(root, scale, seed, course); break;
    case HAIR_STYLE_SHORT: grow_short(root, scale, seed, course); break;
    case HAIR_STYLE_PONYTAIL: grow_ponytail(root, scale, seed, course); break;
    case HAIR_STYLE_CURLY: grow_curly(root, scale, seed, course); break;
    default: grow_afro(root, scale, seed, course); break;
    }
}
