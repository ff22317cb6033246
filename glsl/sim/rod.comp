// rod.comp - the solvers of an inextensible rod: all substeps of a step for every guide.
//
// HAIR_SOLVER names the method that is tried first; of guides whose bending SHAKE cannot bear at that substep BDF2, in
// the programs that have HAIR_STIFF. A substep that it leaves stretched or not finite is done again by implicit Euler, and that failing by follow-the-leader, which cannot; a guide that is not finite even so goes
// back to its rest pose. What this takes is counted in health[].
#version 450 core
#include "sim/rod.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "sim/bending.glsl"
#include "sim/predict.glsl"
#include "sim/lengths.glsl"

#define STRUCK 0.1   // m/s: a contact that takes more than this away is an impact

// Of the speed that following the leader makes. It makes more than there was: a strand that keeps it all flails, so that
// the method of its solver fails again, for ever.
#define LEADER_KEEPS (HAIR_SOLVER == LEADER ? 1.0 : 0.5)

vec3 root_at_rest, root_then;

void load()
{
    float rescale = params.rescale;
    known = params.rescale == 1.0 ? state[guide_first].position.w : min(state[guide_first].position.w, 1.0);
#ifdef HAIR_STIFF
    float taken = rod[guide_first].segment.w;
    own_method  = taken == 2.0 ? EULER : taken == 1.0 ? BACK : SHAKE;
#endif
    EACH(guide_count) {
        uint      at         = guide_first + i;
        vec3      from_root  = rest[at].position.xyz - root_at_rest;
        // What is held is where the scalp has it, wherever it was when it was not.
        PUT(place, i, rod[at].segment.y > 0.0 ? state[at].position.xyz - root_then : vec3(0.0));
        own(displacement)    = state[at].displacement.xyz * rescale;
        rest_length[i]       = rod[at].segment.x;
        slack[i]             = rod[at].segment.y;
        own(aim)             = vec4(from_root, rod[at].segment.z);
        own(strain)          = rod[at].strain;
        if (CURVED) own(section) = material[at];
#ifdef HAIR_CROWD
        own(push)            = texelFetch(push_texture, int(at)).xyz;
#endif
#ifdef KEEPS_RATES
        own(rate)            = known < 2.0 ? own(displacement) : history[at].rate.xyz;
        own(rate_before)     = history[at].rate_before.xyz;
#endif
        if (i == 0u) loose[0] = loose[1] = loose[2] = broken[0] = broken[1] = broken[2] = 0u;
    }
    MEET;
    heavy = slack[guide_count - 1u] * guide_length < 1.0;
}

void store()
{
    EACH(guide_count) {
        uint at                = guide_first + i;
        state[at].position     = vec4(root_now + GET(place, i), known);
        state[at].displacement = vec4(own(displacement), 0.0);
        if (CURVED) material[at] = own(section);
#ifdef KEEPS_RATES
        history[at].rate        = vec4(own(rate), 0.0);
        history[at].rate_before = vec4(own(rate_before), 0.0);
#endif
    }
}

void count_in(uint what)
{
#ifdef HAIR_THREAD_PER_GUIDE
    atomicAdd(health[what], 1u);
#else
    if (gl_LocalInvocationID.x == 0u) atomicAdd(health[what], 1u);
#endif
}

#ifdef KEEPS_RATES
// An impact ends what was, and so does what sticks. Of what slides on, only the part that the contact stops: along the
// surface BDF2 would else do with 4/9 of every force.
void forget(uint i, vec3 d)
{
    vec3 lost   = own(displacement) - d;
    bool struck = length(lost - pass_on(touch[i], lost)) > STRUCK * params.gravity.w;
    bool ends   = struck || touch[i].w == STICKS;
    own(rate)        = ends ? d : d + pass_on(touch[i], own(rate) - d);
    own(rate_before) = ends ? d : d + pass_on(touch[i], own(rate_before) - d);
}
#endif

// Take what `moved` says for true: place, displacement and rates after a substep by `method`. A strand that is not
// finite then, or beyond any hair, goes back to its rest pose, and along with the head.
void accept(int method, vec3 head_moved)
{
    float fastest = length(root_moved) + 4.0 * params.gravity.w * sqrt(2.0 * length(params.gravity.xyz) * guide_length);
    EACH(guide_count) {
        vec3 d = GET(moved, i), kept = d;
        if (method == LEADER) { // What was drawn along may not keep that speed.
            vec3  relative = d - GET(moved, 0u);
            float speed    = length(relative);
            kept           = GET(moved, 0u) + (heavy && i + 1u == guide_count ? 1.0 : LEADER_KEEPS) * relative * (speed > fastest ? fastest / speed : 1.0);
        }
        // Rounded as store() and load() do it, so that it does not matter how many substeps a dispatch has.
        precise vec3 from_head = root_now + (GET(place, i) + (d - root_moved));
        precise vec3 from_root = from_head - root_now;
        PUT(place, i, from_root);
#ifdef KEEPS_RATES
        own(rate_before) = method == LEADER ? kept : own(rate); // It may be what was not finite.
        own(rate)        = method == BACK ? 1.5 * d - 0.5 * own(displacement) : kept;
        if (SOLIDS && touch[i].w != FREE) forget(i, d);
#endif
        own(displacement) = kept;
        if (max(bits_of(dot(from_head, from_head)), bits_of(dot(d, d))) > floatBitsToUint(FARTHEST * FARTHEST))
            broken[slot] = 1u;
        clear_next(i);
    }
    known       = own_method != SHAKE && (method == BACK || method == EULER) ? 2.0 : 1.0;
    MEET;
    if (broken[slot] == 0u) return;

    vec3 still = dot(head_moved, head_moved) < FARTHEST * FARTHEST ? head_moved : vec3(0.0);
    EACH(guide_count) {
        PUT(place, i, rotate(turn_now, own(aim).xyz));
        own(displacement) = still;
        if (CURVED) own(section) = quat_multiply(turn_now, rest[guide_first + i].frame);
#ifdef KEEPS_RATES
        own(rate) = own(rate_before) = still;
#endif
    }
    known       = 1.0;
    count_in(HAIR_HEALTH_RESET);
    MEET;
}

void main()
{
    guide_number = hair_guide_number();
    if (guide_number >= params.guides) return;
    guide_first  = guide[guide_number].first;
    guide_count  = guide[guide_number].count;
    guide_length = guide[guide_number].arc_length;
    root_at_rest = rest[guide_first].position.xyz;
    turn_now     = params.rotation_start;
    root_then    = rotate(turn_now, root_at_rest);
    root_now     = root_then;
    share_now    = params.share_start;
    slot         = 0u;
    load();

    for (uint s = 0u; s < params.substeps; ++s) {
        vec3 head_moved = params.substep[s].displacement.xyz;
        turn_then       = turn_now;
        turn_now        = params.substep[s].rotation;
        root_then       = root_now;
        root_now        = rotate(turn_now, root_at_rest);
        root_moved      = root_now - root_then + head_moved;
        share_then      = share_now;
        share_now       = params.substep[s].displacement.w;

        int method = own_method == BACK && known < 2.0 ? EULER : own_method;
        for (;; ++method) {
            predict(method);
            if (method == LEADER) {
                follow_leader(head_moved);
                break;
            }
            if (fit_lengths(method, HAIR_SOLVER == SHAKE ? 3e-4 : 9e-4, head_moved)) break;
            if (method == SHAKE) ++method; // To Euler: BDF2 needs a past that SHAKE does not keep.
            count_in(method >= EULER ? HAIR_HEALTH_FOLLOW : HAIR_HEALTH_EULER);
        }
        next_slot();
        accept(method, head_moved);
    }
    store();
}
