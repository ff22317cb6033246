// blend_pose.glsl - the drawn pose of a guide between its simulation and its targets.
//
// A segment has a direction and a length between those of its two poses. Positions are sums of
// segments from the root on. A strand that is halfway between two poses is therefore not shorter
// than they are. Near the weight 1 the sum tends to the target itself, so that no error adds up.
#include "sim/targets.glsl"

// Weight from which positions tend to the targets themselves.
#define SUM_ENDS 0.9

// Return vertex i in the head's frame. `own` is the index of the vertex among all guides. The whole
// work group calls this function. It uses vertex[] and from_root[].
vec3 blend_pose(uint i, uint own, uint count, vec3 simulated)
{
    vec3  to     = target_in_head(own);
    if (i + 1u >= count && is_cut(own)) to = cut_point(own, target_in_head(own - 1u), to);
    float weight = target[own].w;
    if (!is_near(to)) {
        to     = simulated;
        weight = 0.0;
    }
    synchronise();
    vertex[i]    = simulated;
    from_root[i] = weight;
    synchronise();
    uint  before   = max(i, 1u) - 1u;
    vec3  link     = simulated - vertex[before];
    float fraction = 0.5 * (weight + from_root[before]);
    synchronise();
    vertex[i] = to;
    synchronise();
    vec3 goal = to - vertex[before], change = weight * (to - simulated);
    if (i > 0u) {
        float len = mix(length(link), length(goal), fraction);
        change    = len * direction_or(mix(link, goal, fraction), direction_or(link, vec3(0.0))) - link;
        if (fraction <= 0.0 || i >= count) change = vec3(0.0);
    }
    // Add the changes of all segments up to the vertex, by an inclusive scan.
    synchronise();
    vertex[i] = change;
    for (uint reach = 1u; reach < count; reach *= 2u) {
        synchronise();
        vec3 sum = i >= reach ? vertex[i - reach] : vec3(0.0);
        synchronise();
        vertex[i] += sum;
    }
    vec3 at = simulated + vertex[i];
    synchronise();
    return mix(at, to, clamp((weight - SUM_ENDS) / (1.0 - SUM_ENDS), 0.0, 1.0));
}
