// load_vertex.glsl - load the part of a vertex that all solvers of rods need.

// Set vertex i from its state and its constants. The displacement is rescaled to the length of this
// step's substeps. `pulled` means that the rest pose pulls.
void load_vertex(uint i, hair_state was, vec4 segment, bool pulled)
{
    segment *= i < guide_count ? 1.0 : 0.0;
    // A held root is where the scalp places it, wherever it was while it was free.
    bool moves = segment.y > 0.0 || (PINNED && i > 0u && i < guide_count);
    PUT(place, moves ? was.position.xyz - root_then : vec3(0.0));
    local(displacement) = was.displacement.xyz * params.rescale;
    local(rest_length)  = segment.x;
    local(slack)        = segment.y;
    local(aim)          = vec4(pulled ? rest_from_root(i) : vec3(0.0), segment.z);
#ifdef HAIR_PINNED
    load_pin(i);
#endif
#ifdef HAIR_GRID
    local(hair_acceleration) =
        texelFetch(acceleration_texture, int(guide_first + min(i, guide_count - 1u))).xyz;
#endif
}
