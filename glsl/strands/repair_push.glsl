// repair_push.glsl - the displacement that brings vertices of a follower out of colliders, along
// the gradient of the distance field. A round finds for each vertex inside the smallest change of
// control points that brings the vertex to the surface. Where these differ, control points take
// their mean, weighted by the influence on the vertex (Lee, Wolberg and Shin 1997, "Scattered Data
// Interpolation with Multilevel B-Splines"). Rounds end when all vertices are outside.
#include "field.glsl"
#include "strands/repair.glsl"
#include "workgroup.glsl"

#define ROUNDS 10u        // Rounds between updates of the length.
#define NEAR_ENOUGH 2e-5  // Depth that a vertex may keep, m.
// Factor of the mean of changes. A mean of equal steps for all vertices goes 1.14 times as far.
#define CAUTION 0.88

// Values of all followers of the work group. AT(i) is the place of vertex i of the own follower,
// and OF(c) that of control point c.
#define OF(c) ((c) * HAIR_REPAIR_FOLLOWERS + follower_of_group)
#if HAIR_REPAIR_LANES > 1
#define AT(i) (follower_of_group * (HAIR_REPAIR_SAMPLES + 1) + (i))
#define WAIT() synchronise()
#else
#define AT(i) ((i) * HAIR_REPAIR_FOLLOWERS + follower_of_group)
#define WAIT()
#endif
#define LANES HAIR_REPAIR_LANES
int follower_of_group = int(gl_LocalInvocationID.x) / LANES;
int lane              = int(gl_LocalInvocationID.x) % LANES;

shared vec4  control[HAIR_REPAIR_CONTROLS * HAIR_REPAIR_FOLLOWERS];
shared float vertex[3 * (HAIR_REPAIR_SAMPLES + 1) * HAIR_REPAIR_FOLLOWERS];
#if HAIR_REPAIR_LANES > 1
shared vec4 pushes[(HAIR_REPAIR_SAMPLES + 1) * HAIR_REPAIR_FOLLOWERS];
// Four weights of each pushed vertex, by weights_at().
shared float weights[4 * (HAIR_REPAIR_SAMPLES + 1) * HAIR_REPAIR_FOLLOWERS];
shared uint pushed[2]; // 1 if a vertex is pushed in an even or an odd round.
#endif
// PARTS sums of contributions to each control point, of every PARTS-th vertex. In a work group of
// one follower, each is by another thread.
#define PARTS 3
shared vec4 sums[PARTS * HAIR_REPAIR_CONTROLS * HAIR_REPAIR_FOLLOWERS];

vec4 repair_control(int first, int i) { return control[i * HAIR_REPAIR_FOLLOWERS + first]; }

vec3 vertex_at(int i)
{
    return vec3(vertex[3 * AT(i)], vertex[3 * AT(i) + 1], vertex[3 * AT(i) + 2]);
}

void keep_vertex(int i, vec3 p)
{
    vertex[3 * AT(i)] = p.x, vertex[3 * AT(i) + 1] = p.y, vertex[3 * AT(i) + 2] = p.z;
}

// Return the weights of control points k - 1 to k + 2 at t, which may change.
vec4 weights_at(float t, out int k)
{
    float x;
    k           = spline_place(t, x);
    vec4 weight = spline(x);
    if (k == 0) weight = vec4(0.0, 0.0, weight.z - weight.x, weight.w);
    if (k == 1) weight.x = 0.0;
    return weight;
}

// Return the step that brings vertex i out of colliders, divided by the sum of squared weights. w
// is 1, or 0 if the vertex is outside.
vec4 find_push(int i, float t, float margin)
{
    int   k;
    vec3  p = vertex_at(i) + repair_at(follower_of_group, t).away;
    float short_of = margin - field_distance(p);
    if (!(short_of > NEAR_ENOUGH)) return vec4(0.0);
    vec4 weight = weights_at(t, k);
    vec3 out_   = direction_or(field_gradient(p), vec3(0.0, 1.0, 0.0));
    return vec4(short_of / max(dot(weight, weight), 1e-4) * out_, 1.0);
}

// Return what a push contributes to the mean of a control point with a weight: the weighted change,
// and its weight.
vec4 contribute(float weight, vec4 push) { return weight * weight * vec4(weight * push.xyz, push.w); }

void move(int c)
{
    vec4 sum = vec4(0.0);
    for (int i = 0; i < PARTS; ++i) sum += sums[PARTS * OF(c) + i];
    if (sum.w > 0.0) control[OF(c)].xyz += CAUTION / sum.w * sum.xyz;
}

#if HAIR_REPAIR_LANES > 1
// Return a part of the contributions to control point c. Only vertices in the four intervals that
// the control point influences have any.
vec4 sum_of(int c, int part, int samples, float slide)
{
    float each = float(samples) / (slide * float(HAIR_REPAIR_INTERVALS)); // Vertices per interval.
    int   from = max(int(float(c - 2) * each), 1);
    int   to   = c + 2 < HAIR_REPAIR_INTERVALS ? min(int(float(c + 2) * each) + 1, samples) : samples;
    vec4  sum  = vec4(0.0);
    for (int i = from + (part + PARTS - from % PARTS) % PARTS; i <= to; i += PARTS) {
        vec4 push = pushes[AT(i)];
        if (push.w == 0.0) continue;
        float x;
        int   j = c + 1 - spline_place(slide * float(i) / float(samples), x);
        if (0 <= j && j < 4) sum += contribute(weights[4 * AT(i) + j], push);
    }
    return sum;
}

bool push_once(uint round, int samples, float slide, float margin)
{
    for (int i = 1 + lane; i <= samples; i += LANES) {
        float t = slide * float(i) / float(samples);
        vec4  push = find_push(i, t, margin);
        pushes[AT(i)] = push;
        if (push.w > 0.0) {
            int  k;
            vec4 weight = weights_at(t, k);
            for (int j = 0; j < 4; ++j) weights[4 * AT(i) + j] = weight[j];
            pushed[round & 1u] = 1u;
        }
    }
    synchronise();
    bool any_ = pushed[round & 1u] != 0u;
    if (gl_LocalInvocationID.x == 0u) pushed[~round & 1u] = 0u;
    if (!any_) return false;
    int c = 1 + lane / PARTS, part = lane % PARTS;
    if (c < HAIR_REPAIR_CONTROLS) sums[PARTS * OF(c) + part] = sum_of(c, part, samples, slide);
    synchronise();
    if (c < HAIR_REPAIR_CONTROLS && part == 0) move(c);
    synchronise();
    return true;
}
#else
bool push_once(uint round, int samples, float slide, float margin)
{
    bool any_ = false;
    for (int c = 0; c < HAIR_REPAIR_CONTROLS; ++c)
        for (int i = 0; i < PARTS; ++i) sums[PARTS * OF(c) + i] = vec4(0.0);
    for (int i = 1; i <= samples; ++i) {
        int   k;
        float t = slide * float(i) / float(samples);
        vec4  push = find_push(i, t, margin), weight = weights_at(t, k);
        if (push.w == 0.0) continue;
        any_ = true;
        for (int j = k == 0 ? 2 : 0; j < 4; ++j)
            sums[PARTS * OF(k - 1 + j) + i % PARTS] += contribute(weight[j], push);
    }
    for (int c = 1; c < HAIR_REPAIR_CONTROLS; ++c) move(c);
    return any_;
}
#endif

void push_out(int samples, float slide, float margin)
{
    for (uint round = 0u; round < ROUNDS; ++round)
        if (!push_once(round, samples, slide, margin)) return;
}
