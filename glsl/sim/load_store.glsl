// load_store.glsl - load a guide from the buffers that keep it between dispatches, and store it.
#include "sim/load_vertex.glsl"

void load()
{
    float rescale = params.substep_first == 0u ? params.rescale : 1.0;
    bool  pulled  = params.shape_frequency_root > 0.0 || params.shape_frequency_tip > 0.0;
    known         = rescale == 1.0 ? state[guide_first].position.w : min(state[guide_first].position.w, 1.0);
    root_is_free  = rod_segment(guide_first).y > 0.0;
    float tip     = rod_segment(guide_first + guide_count - 1u).y;
    heavy         = tip > 0.0 && tip * guide_length < 1.0;
#ifdef HAIR_STIFF
    float taken = rod_segment(guide_first).w;
    own_method  = taken == 2.0 ? EULER : taken == 1.0 ? BACK : SHAKE;
#endif
#ifdef SPLITS
    whip_part = rod_segment(guide_first + 1u).w;
#endif
    FOR_VERTICES(guide_count) {
        // Request all reads before any value is used, because a GPU waits for all of them as long
        // as for one.
        uint       at       = guide_first + min(i, guide_count - 1u);
        hair_state was      = state[at];
        vec4       segment  = rod_segment(at);
        local(strain)         = rod_strain(at);
#ifdef KEEPS_RATES
        hair_history past   = history[at];
        local(rate)           = known < 2.0 ? was.displacement.xyz * rescale : past.rate.xyz;
        spilled(rate_before) = past.rate_before.xyz;
        local(touched)        = past.rate_before.w;
#endif
#ifdef KEEPS_TENSION
        local(tension)        = was.displacement.w;
#endif
#ifdef HAIR_MIXED
        SHARED_READ(section)       = material[at];
        local(rest_real)      = segment.w;
        local(force)          = bend[3u * at].xyz;
        local(reaction)       = vec3(bend[3u * at].w, bend[3u * at + 1u].w, bend[3u * at + 2u].w);
        local(turned)         = bend[3u * at + 1u].xyz * rescale;
        local(turned_before)  = bend[3u * at + 2u].xyz;
        PUT(moved, vec3(0.0));
#endif
        load_vertex(i, was, segment, pulled);
#ifdef HAIR_IMPULSES
        load_impulses(i, at);
#endif
    }
#ifdef HAIR_MIXED
    root_is_clamped = rod_strain(guide_first).w > 0.0;
    root_ratio      = root_ratio_of(guide_number);
    GROUP_BARRIER;
    if (!are_aligned()) align_frames();
#endif
}

void store()
{
    FOR_VERTICES(guide_count) {
        if (i < guide_count) {
            uint at                = guide_first + i;
            state[at].position     = vec4(root_now + GET(place), known);
            state[at].displacement = vec4(local(displacement), 0.0);
#ifdef KEEPS_RATES
            history[at].rate         = vec4(local(rate), 0.0);
            history[at].rate_before  = vec4(spilled(rate_before), local(touched));
#endif
#ifdef KEEPS_TENSION
            state[at].displacement.w = local(tension);
#endif
#ifdef HAIR_IMPULSES
            store_impulses(i, at);
#endif
#ifdef HAIR_MIXED
            material[at]       = SHARED_READ(section);
            bend[3u * at]      = vec4(local(force), local(reaction).x);
            bend[3u * at + 1u] = vec4(local(turned), local(reaction).y);
            bend[3u * at + 2u] = vec4(local(turned_before), local(reaction).z);
#endif
        }
    }
}
