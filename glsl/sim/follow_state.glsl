// follow_state.glsl - load, accept and store a guide of follow.comp.
// Value of w of a plane in material[]. No quaternion that a reset or a teleport leaves has this w.
#define IS_PLANE 2.0
#include "sim/load_vertex.glsl"

LOCAL(vec3, plane); // Normal of the contact at the end of the last substep, or 0

void load()
{
    bool pulled  = params.shape_frequency_root > 0.0 || params.shape_frequency_tip > 0.0;
    root_is_free = rod_segment(guide_first).y > 0.0;
    FOR_VERTICES(guide_count) {
        uint       at      = guide_first + min(i, guide_count - 1u);
        hair_state was     = state[at];
        vec4       segment = rod_segment(at), contact = COLLIDERS ? material[at] : vec4(0.0);
        local(plane) = contact.w == IS_PLANE ? contact.xyz : vec3(0.0);
        load_vertex(i, was, segment, pulled);
    }
}

void store()
{
    FOR_VERTICES(guide_count) {
        if (i < guide_count) {
            state[guide_first + i].position     = vec4(root_now + GET(place), 1.0);
            state[guide_first + i].displacement = vec4(local(displacement), 0.0);
            material[guide_first + i]           = vec4(local(plane), IS_PLANE);
        }
    }
}

// Accept `moved`. A strand that is not finite, or is farther away than any hair, returns to its
// rest pose and moves with the head.
void finish(vec3 head_moved)
{
    bool  lost    = false;
    float fastest =
        length(root_moved) + 4.0 * params.gravity.w * sqrt(2.0 * length(params.gravity.xyz) * guide_length);
    vec3  root_d  = GET_AT(moved, 0u);
    FOR_VERTICES(guide_count) {
        vec3  d = GET(moved), from_head = rounded(root_now + (GET(place) + (d - root_moved)));
        if (COLLIDERS) {
            vec3 n = local(touch).xyz;
            local(plane) = GET(edge);
            if (local(touch).w == SLIDES || local(touch).w == STICKS)
                d -= max(dot(d - root_moved, n), 0.0) * n;
        }
        float speed = length(d - root_d);
        PUT(place, from_head - root_now);
        local(displacement) = root_d + (d - root_d) * (speed > fastest ? fastest / speed : 1.0);
        if (i < guide_count)
            lost = lost || max(bits_of(dot(from_head, from_head)), bits_of(dot(d, d))) >
                               floatBitsToUint(FARTHEST * FARTHEST);
    }
    if (!group_any(bvec2(lost, false)).x) return;
    vec3 still = dot(head_moved, head_moved) < FARTHEST * FARTHEST ? head_moved : vec3(0.0);
    FOR_VERTICES(guide_count) {
        PUT(place, rotate(turn_now, rest_from_root(i)));
        local(displacement) = still;
        local(plane)        = vec3(0.0);
    }
    count_in(HAIR_SOLVER_STATS_RESET);
}
