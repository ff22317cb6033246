// contact_find.glsl - a search for the colliders that a vertex can touch in a substep, among any
// number.
#include "sim/contact_cache.glsl"

void find_root()
{
    uvec2 list = cell_members(root_now);
    sunk       = 0.0;
    if (root_is_free) return;
    for (uint n = list.x + lane; n < min(list.y, list.x + uint(HAIR_CELL_COLLIDERS)); n += lanes) {
        uint member = cell_entry(n), k = member & HAIR_ENTRY_NUMBER;
        vec4 ball   = BALL(k);
        if (length(root_now - ball.xyz) < ball.w + params.collision_margin)
            sunk = max(sunk, root_depth_in(k, (member & HAIR_ENTRY_WALKED) != 0u));
    }
    sunk = group_max(sunk);
}

// Return whether the lists of vertex i are still valid for a way of length `far` around `middle`.
// Either nothing is touched on the way, or the listed colliders near the vertex suffice.
bool has_listed(uint i, vec3 middle, float far)
{
    float off = length(middle - local(listed_near).xyz) + 0.5 * far;
    return has_lists && off <= max(local(listed_near).w, min(local(clear), params.cells_slack));
}

void find_colliders(vec3 head_moved)
{
    bool lacks = false;
    FOR_VERTICES(guide_count) {
        vec3  way = local(wanted) - head_moved, position = root_now + GET(place) + local(wanted) - root_moved;
        float far = length(way);
        local(met)  = uvec2(0u);
        lacks     = lacks || (local(slack) > 0.0 && !has_listed(i, halfway(position, way, far), far));
    }
    if (group_any(bvec2(lacks, false)).x) {
        find_root();
        FOR_VERTICES(guide_count) {
            vec3 way = local(wanted) - head_moved,
                 position = root_now + GET(place) + local(wanted) - root_moved;
            float far = length(way);
            if (!has_lists) local(reachable) = uvec2(0u);
            if (local(slack) > 0.0 && !has_listed(i, halfway(position, way, far), far)) {
                list_colliders(i, halfway(position, way, far), far);
                cache_close(i);
            }
        }
        has_lists = true;
    }
#ifdef HAIR_FEW_GUIDES
    FOR_VERTICES(guide_count) {
        if (local(reachable) != uvec2(0u)) advance_cached(root_now - root_moved + head_moved + GET(place));
    }
#endif
}

// Return the colliders that are enough to test on the way from `start` to `end`.
uvec2 enough(uint i, vec3 start, vec3 end)
{
    vec4  near = local(listed_near);
    float far  = max(length(start - near.xyz), length(end - near.xyz));
    return far < local(clear) ? uvec2(0u) : far <= near.w ? local(close) : local(reachable);
}
