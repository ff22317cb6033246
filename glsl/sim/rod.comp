// rod.comp - the solvers of an inextensible rod: all substeps of a step for every guide.
//
// HAIR_SOLVER names the method that is tried first; of guides whose bending SHAKE cannot bear at that substep BDF2, in
// the programs that have HAIR_STIFF. A substep that it leaves stretched or not finite is done again by implicit Euler,
// and that failing by follow-the-leader, which cannot; a guide that is not finite even so goes back to its rest pose.
// What this takes is counted in health[].
#version 450 core
#ifdef HAIR_SUBGROUP
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#include "sim/rod.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "sim/bending.glsl"
#include "sim/predict.glsl"
#include "sim/lengths.glsl"
#include "sim/ride.glsl"

// Where SHAKE fails a strand is kinked, and swings from vertex to vertex as no explicit method can follow: it would fail
// again and again, or flail without failing. Implicit Euler calms it, for 16 substeps: of `known`, so much for each.
#define WAIT (1.0 / 16.0)

// Of the speed that following the leader makes. It makes more than there was: a strand that keeps it all flails, so that
// the method of its solver fails again, for ever.
#define LEADER_KEEPS (HAIR_SOLVER == LEADER ? 1.0 : 0.5)

vec3 root_at_rest;

vec3 rest_from_root(uint i) { return rest[guide_first + min(i, guide_count - 1u)].position.xyz - root_at_rest; }

void load()
{
    float rescale = params.rescale;
    bool  pulled  = params.pull_root > 0.0 || params.pull_tip > 0.0;
    known         = params.rescale == 1.0 ? state[guide_first].position.w : min(state[guide_first].position.w, 1.0);
    root_is_free  = rod[guide_first].segment.y > 0.0;
    float tip     = rod[guide_first + guide_count - 1u].segment.y;
    heavy         = tip > 0.0 && tip * guide_length < 1.0;
#ifdef HAIR_STIFF
    float taken = rod[guide_first].segment.w;
    own_method  = taken == 2.0 ? EULER : taken == 1.0 ? BACK : SHAKE;
#endif
    EACH(guide_count) {
        // All that is read is asked for before any of it is looked at: a GPU waits for all of it as long as for one.
        uint       at       = guide_first + min(i, guide_count - 1u);
        hair_state was      = state[at];
        vec4       segment  = rod[at].segment;
        own(strain)         = rod[at].strain;
#ifdef KEEPS_RATES
        hair_history past   = history[at];
        own(rate)           = known < 2.0 ? was.displacement.xyz * rescale : past.rate.xyz;
        parked(rate_before) = past.rate_before.xyz;
        own(touched)        = past.rate_before.w;
        own(tension)        = was.displacement.w;
#endif
        segment *= i < guide_count ? 1.0 : 0.0;
        // A root that is held is where the scalp has it, wherever it was when it was not.
        PUT(place, segment.y > 0.0 || (TIED && i > 0u && i < guide_count) ? was.position.xyz - root_then : vec3(0.0));
        own(displacement) = was.displacement.xyz * rescale;
        own(rest_length)  = segment.x;
        own(slack)        = segment.y;
        own(aim)          = vec4(pulled ? rest_from_root(i) : vec3(0.0), segment.z);
#ifdef HAIR_TIED
        load_tie(i);
#endif
        if (CURVED) seen(section) = material[at];
#ifdef HAIR_CROWD
        own(push) = texelFetch(push_texture, int(at)).xyz;
#endif
    }
}

void store()
{
    EACH(guide_count) {
        if (i < guide_count) {
            uint at                = guide_first + i;
            state[at].position     = vec4(root_now + GET(place), known);
            state[at].displacement = vec4(own(displacement), 0.0);
            if (CURVED) material[at] = seen(section);
#ifdef KEEPS_RATES
            history[at].rate         = vec4(own(rate), 0.0);
            history[at].rate_before  = vec4(parked(rate_before), own(touched));
            state[at].displacement.w = own(tension);
#endif
        }
    }
}

void count_in(uint what)
{
    if (lane == 0u) atomicAdd(health[what], 1u);
}

// What no compiler takes for a sum whose parts it may take away again. `precise` says so too, but of all that leads there:
// then nothing in a substep is multiplied and added at once.
vec3 rounded(vec3 v)
{
    uint nothing = params.substeps >> 31;
    return uintBitsToFloat(floatBitsToUint(v) ^ nothing);
}

// Take what `moved` says for true: place, displacement and rates after a substep by `method`. A strand that is not
// finite then, or beyond any hair, goes back to its rest pose, and along with the head.
void accept(int method, bool waits, vec3 head_moved)
{
    bool lost = false, struck = false;
    EACH(guide_count) {
        vec3 d = GET(moved), kept = d;
        if (IS_LEADER(method)) { // What was drawn along may not keep that speed.
            float fastest  = length(root_moved) + 4.0 * params.gravity.w * sqrt(2.0 * length(params.gravity.xyz) * guide_length);
            vec3  root_d   = GET_AT(moved, 0u), relative = d - root_d;
            float speed    = length(relative);
            float keeps    = (heavy && i + 1u == guide_count) || (TIED && own(slack) == 0.0) ? 1.0 : LEADER_KEEPS;
            kept           = root_d + keeps * relative * (speed > fastest ? fastest / speed : 1.0);
        }
        // Rounded as store() and load() do it, so that it does not matter how many substeps a dispatch has.
        vec3 from_head = rounded(root_now + (GET(place) + (d - root_moved)));
        PUT(place, from_head - root_now);
#ifdef KEEPS_RATES
        struck = struck || is_struck(i, d);
        keep_rates(i, method, d, kept);
        bool slacks  = IS_LEADER(method) || i + 1u >= guide_count || bits_of(own(tension)) >= 0x7f800000u;
        own(tension) = slacks ? 0.0 : own(tension);
#endif
        own(displacement) = kept;
        if (i < guide_count)
            lost = lost || max(bits_of(dot(from_head, from_head)), bits_of(dot(d, d))) > floatBitsToUint(FARTHEST * FARTHEST);
    }
    bvec2 found = any_of(bvec2(lost, struck));
    if (own_method == SHAKE) known = IS_SHAKE(method) ? 1.0 : waits && method == EULER ? max(known - WAIT, 1.0) : 2.0 - WAIT;
    else known = method == BACK || method == EULER ? found.y ? LEAPS_NEXT : 2.0 : 1.0;
    if (!found.x) return;

    vec3 still = dot(head_moved, head_moved) < FARTHEST * FARTHEST ? head_moved : vec3(0.0);
    EACH(guide_count) {
        PUT(place, rotate(turn_now, rest_from_root(i)));
        own(displacement) = still;
        if (CURVED) seen(section) = quat_multiply(turn_now, rest[min(guide_first + i, params.vertices - 1u)].frame);
#ifdef KEEPS_RATES
        own(rate) = parked(rate_before) = still;
        own(tension) = 0.0;
#endif
    }
    known       = 1.0;
    count_in(HAIR_HEALTH_RESET);
}

// Where the scalp has the root after a share of the step, and how it is turned.
void place_root(vec4 head, float share)
{
    turn_now  = head;
    root_now  = rotate(head, root_at_rest);
    share_now = share;
#ifdef HAIR_SKINNED
    ride r   = ride_at(guide_number, share);
    root_now = rotate(head, root_at_rest + r.shift);
    turn_now = quat_multiply(head, r.turn);
#endif
}

void main()
{
    guide_number = hair_guide_number();
    if (guide_number >= params.guides) return;
    guide_first  = guide[guide_number].first;
    guide_count  = guide[guide_number].count;
    guide_length = guide[guide_number].arc_length;
    root_at_rest = rest[guide_first].position.xyz;
    clamp_at_rest = rotate(guide[guide_number].root_frame, vec3(0.0, 1.0, 0.0));
    place_root(params.rotation_start, params.share_start);
    root_then = root_now;
#ifdef HAIR_TIED
    head_now  = params.rotation_start;
#endif
    load();
    if (SOLIDS) begin_solids();

    for (uint s = 0u; s < params.substeps; ++s) {
        vec3 head_moved = params.substep[s].displacement.xyz;
#ifdef HAIR_WIND
        substep_number  = s;
#endif
        turn_then       = turn_now;
        root_then       = root_now;
        share_then      = share_now;
#ifdef HAIR_TIED
        head_then       = head_now;
        head_now        = params.substep[s].rotation;
#endif
        place_root(params.substep[s].rotation, params.substep[s].displacement.w);
        root_moved = root_now - root_then + head_moved;

        grant_rounds();
        if (SOLIDS) next_solids();
        bool waits = own_method == SHAKE && known > 1.0;
        int method = waits || (own_method == BACK && known < LEAPS_NEXT) ? EULER : own_method;
        for (;; ++method) {
            predict(method);
            find_solids(head_moved);
            list_reaching();
            if (fit_lengths(method, HAIR_SOLVER == SHAKE ? 3e-4 : 9e-4, head_moved)) break;
#ifdef KEEPS_RATES
            EACH(guide_count) { own(tension) = 0.0; } // This one was led to nothing.
#endif
            if (IS_SHAKE(method)) ++method; // To Euler: BDF2 needs a past that SHAKE does not keep.
            count_in(method >= EULER ? HAIR_HEALTH_FOLLOW : HAIR_HEALTH_EULER);
        }
#ifdef HAIR_TIED
        if (any_of(bvec2(taut, false)).x) count_in(HAIR_HEALTH_TAUT);
#endif
        accept(method, waits, head_moved);
    }
    store();
}
