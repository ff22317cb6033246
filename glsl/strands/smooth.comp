// smooth.comp - smoothed guides, once per step: buffers of position, length and frame that all
// drawing code reads (Tariq 2010). One work group per guide, params.smooth_vertices samples at
// equal distances.
//
// The curve is a cubic Hermite spline through the vertices. Its tangents are those of the parabola
// through three neighbours, so segments of unequal length cause no overshoot. The drawn state lies
// between the start and the end of the last substep. Both are taken in the head's own frame and
// placed under the current pose of the head, so that roots never leave the scalp.
//
// The frame at the root is that of the scalp, and not that of the first segment. Followers hang on
// it, so their roots and shapes do not turn with the first segment of guide 0.
#version 450 core
#include "sim/buffers.glsl"
layout(local_size_x = HAIR_GUIDE_THREADS) in;
#include "strands/frames.glsl"
#include "strands/packed_frame.glsl"
#include "sim/root_transforms.glsl"

shared vec3  vertex[HAIR_GUIDE_THREADS];
shared float from_root[HAIR_GUIDE_THREADS];
#ifdef HAIR_TARGETS
#include "strands/blend_pose.glsl"
#endif

// Compute distances from the root, by an inclusive scan of segment lengths.
void sum_lengths(uint i, uint count)
{
    float l = i > 0u && i < count ? distance(vertex[i], vertex[i - 1u]) : 0.0;
    synchronise();
    from_root[i] = l;
    for (uint reach = 1u; reach < count; reach *= 2u) {
        synchronise();
        float before = i >= reach ? from_root[i - reach] : 0.0;
        synchronise();
        from_root[i] += before;
    }
    synchronise();
}

// Return the derivative by length at vertex j.
vec3 slope(uint j, uint count)
{
    if (j == 0u) return segment_direction[0];
    if (j + 1u >= count) return segment_direction[count - 2u];
    float before = from_root[j] - from_root[j - 1u];
    float after  = from_root[j + 1u] - from_root[j];
    return (segment_direction[j - 1u] * after + segment_direction[j] * before) / max(before + after, 1e-12);
}

uint find_segment(float s, uint count)
{
    uint low = 0u, high = count - 1u;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (from_root[middle] <= s)
            low = middle;
        else
            high = middle;
    }
    return low;
}

void main()
{
    uint g = hair_group();
    if (g >= params.guides) return;
    uint i     = gl_LocalInvocationID.x;
    uint count = guide[g].count;
    uint own   = guide[g].first + min(i, count - 1u);

    vec3 after   = state[own].position.xyz;
    vec3 before  = after - state[own].displacement.xyz + params.last_displacement.xyz;
    before       = rotate(quat_conjugate(params.rotation_before), before);
    after        = rotate(quat_conjugate(params.rotation_after), after);
    vec4 scalp   = params.rotation_now;
#ifdef HAIR_SKINNED
    vec3 root = rest[guide[g].first].position.xyz;
    root_transform now  = root_transform_of(g, HAIR_ROOT_TRANSFORM_END);
    before    = carry(now, root, carry_back(root_transform_of(g, HAIR_ROOT_TRANSFORM_BEFORE), root, before));
    after     = carry(now, root, carry_back(root_transform_of(g, HAIR_ROOT_TRANSFORM_AFTER), root, after));
    scalp     = quat_multiply(scalp, now.turn);
#endif
    vec3 in_head = mix(before, after, params.alpha);
#ifdef HAIR_TARGETS
    in_head = blend_pose(i, own, count, in_head);
#endif
    vertex[i]    = rotate(params.rotation_now, in_head);
    synchronise();
    vec3 link = i + 1u < count ? vertex[i + 1u] - vertex[i] : vec3(0.0);
    vec4 root_frame = quat_multiply(scalp, guide[g].root_frame);
    carry_frames(i, count - 1u, direction_or(link, vec3(0.0, 1.0, 0.0)), root_frame);
    sum_lengths(i, count);

    // A guide that has been cut is smoothed over its length in the groom, and goes on straight.
    float tip     = from_root[count - 1u];
    float cut_off = rest[guide[g].first + count - 1u].position.w;
    float total   = tip * (1.0 + cut_off / guide[g].arc_length);
    for (uint k = i; k < params.smooth_vertices; k += HAIR_GUIDE_THREADS) {
        float s      = total * float(k) / float(params.smooth_vertices - 1u);
        uint  j      = find_segment(s, count);
        float l      = max(from_root[j + 1u] - from_root[j], 1e-12);
        float w      = clamp((s - from_root[j]) / l, 0.0, 1.0);
        vec3  m0     = slope(j, count) * l;
        vec3  m1     = slope(j + 1u, count) * l;
        vec3  chord  = vertex[j + 1u] - vertex[j];
        vec3  bend0  = m0 - chord, bend1 = m1 - chord;
        // Hermite form as the chord plus the deviation from it, because floats then keep the small
        // part.
        vec3  point   = vertex[j] + w * chord + w * (1.0 - w) * ((1.0 - w) * bend0 - w * bend1);
        vec3  tangent = chord + (1.0 - w) * (1.0 - 3.0 * w) * bend0 - w * (2.0 - 3.0 * w) * bend1;
        tangent       = direction_or(tangent, segment_direction[j]);
        if (cut_off > 0.0) point += max(s - tip, 0.0) * tangent;
        float rest_length = rest[guide[g].first + j].position.w;

        uint to             = g * params.smooth_vertices + k;
        smooth_position[to] = vec4(point, s);
        vec4 turned         = quat_multiply(quat_between(segment_direction[j], tangent), scan_frame[j]);
        vec4 frame          = k == 0u ? root_frame : turned;
        smooth_frame[to]    = pack_frame(frame, l / max(rest_length, 1e-12) - 1.0);
    }
}
