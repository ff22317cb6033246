// stored.glsl - load a guide from the buffers that keep it between dispatches, and store it.
#include "sim/load_vertex.glsl"

void load()
{
    float rescale = params.substep_first == 0u ? params.rescale : 1.0;
    bool  pulled  = params.shape_frequency_root > 0.0 || params.shape_frequency_tip > 0.0;
    known         = rescale == 1.0 ? state[guide_first].position.w : min(state[guide_first].position.w, 1.0);
    root_is_free  = rod[guide_first].segment.y > 0.0;
    float tip     = rod[guide_first + guide_count - 1u].segment.y;
    heavy         = tip > 0.0 && tip * guide_length < 1.0;
#ifdef HAIR_STIFF
    float taken = rod[guide_first].segment.w;
    own_method  = taken == 2.0 ? EULER : taken == 1.0 ? BACK : SHAKE;
#endif
    EACH(guide_count) {
        // Request all reads before any value is used, because a GPU waits for all of them as long
        // as for one.
        uint       at       = guide_first + min(i, guide_count - 1u);
        hair_state was      = state[at];
        vec4       segment  = rod[at].segment;
        own(strain)         = rod[at].strain;
#ifdef KEEPS_RATES
        hair_history past   = history[at];
        own(rate)           = known < 2.0 ? was.displacement.xyz * rescale : past.rate.xyz;
        parked(rate_before) = past.rate_before.xyz;
        own(touched)        = past.rate_before.w;
#endif
#ifdef KEEPS_TENSION
        own(tension)        = was.displacement.w;
#endif
#ifdef HAIR_MIXED
        seen(section)       = material[at];
        own(rest_real)      = segment.w;
        own(force)          = bend[3u * at].xyz;
        own(reaction)       = vec3(bend[3u * at].w, bend[3u * at + 1u].w, bend[3u * at + 2u].w);
        own(turned)         = bend[3u * at + 1u].xyz * rescale;
        own(turned_before)  = bend[3u * at + 2u].xyz;
        PUT(moved, vec3(0.0));
#endif
        load_vertex(i, was, segment, pulled);
    }
#ifdef HAIR_MIXED
    root_is_clamped = rod[guide_first].strain.w > 0.0;
    MEET;
    if (!are_aligned()) align_frames();
#endif
}

void store()
{
    EACH(guide_count) {
        if (i < guide_count) {
            uint at                = guide_first + i;
            state[at].position     = vec4(root_now + GET(place), known);
            state[at].displacement = vec4(own(displacement), 0.0);
#ifdef KEEPS_RATES
            history[at].rate         = vec4(own(rate), 0.0);
            history[at].rate_before  = vec4(parked(rate_before), own(touched));
#endif
#ifdef KEEPS_TENSION
            state[at].displacement.w = own(tension);
#endif
#ifdef HAIR_MIXED
            material[at]       = seen(section);
            bend[3u * at]      = vec4(own(force), own(reaction).x);
            bend[3u * at + 1u] = vec4(own(turned), own(reaction).y);
            bend[3u * at + 2u] = vec4(own(turned_before), own(reaction).z);
#endif
        }
    }
}
