// leap_parts.glsl - a substep of SHAKE, whole or in parts: see parts.glsl.

#define MIN_PART (1.0 / 32.0)

// llvmpipe leaves all loops after so many rounds: see lib/sim/programs.c. A thread goes round for each vertex. A
// work group goes round once, and more often in a reduction.
#ifdef HAIR_THREAD_PER_GUIDE
#define MAX_LOOPS (params.part_rounds / uint(MOST))
#else
#define MAX_LOOPS (params.part_rounds / 3u)
#endif
#define LOOPS_OF_LOOK (SOLIDS ? params.solids + 10u + 12u * uint(bitCount(params.bodies)) : 0u) // at few solids
#define LOOPS_OF_PART (15u + 2u * LOOPS_OF_LOOK) // beside those of each step of lengths
#define LOOPS_OF_STEP (9u + LOOPS_OF_LOOK)
#define LOOPS_OF_ATTEMPT (LOOPS_OF_PART + 3u * LOOPS_OF_STEP)

bool touching; // a solid, in the last attempt

// Return whether the rest of the substep may be done in parts of that size.
bool may_split(float smaller)
{
    return !touching && smaller >= MIN_PART &&
           rounds_spent + LOOPS_OF_ATTEMPT * uint((1.0 - done) / smaller) < MAX_LOOPS;
}

// Return whether a segment turns too far, and smaller parts are left.
bool turns_far(int method)
{
    float min_cosine = leap_part < 1.0 || (known > 0.0 && known < 1.0) ? MIN_PART_COSINE : MIN_COSINE;
    bool  far = false, touches = false;
    rounds_spent += LOOPS_OF_PART + LOOPS_OF_STEP * length_steps;
    EACH(guide_count) {
        far     = far || turns_at(i, min_cosine);
        touches = touches || (SOLIDS && own(met) != BITS(0u));
    }
    bvec2 found = any_of(bvec2(far, touches));
    touching    = found.y;
    return IS_SHAKE(method) && found.x && may_split(0.5 * leap_part);
}

// Each change of length shifts the energy of short waves a little. A longer part is tried after 512 quiet substeps.
#define QUIET_STEP (1.0 / 512.0)

// Place head and root where a part that begins at `done` ends, and choose the leap over it. `size`: of that leap.
void place_part(float size, float end, vec3 head_moved)
{
    vec4  to   = dot(head_at_start, head_at_end) < 0.0 ? -head_at_end : head_at_end;
    vec4  head = end == 1.0 ? head_at_end : normalize(mix(head_at_start, to, end));
    float h    = params.gravity.w * size, c = params.damping;
    leap_part  = size;
    part_keep  = size == 1.0 ? params.keep : exp(-c * h);
    part_kick  = size == 1.0 ? params.kick : c * h > 1e-6 ? h * (1.0 - part_keep) / c : h * h;
    place_root(head, end == 1.0 ? fraction_at_end : mix(fraction_at_start, fraction_at_end, end));
    root_moved = root_now - root_then + (end - done) * head_moved;
}

// Begin the next part where the last one ended.
void begin_part()
{
    turn_then  = turn_now;
    root_then  = root_now;
    share_then = share_now;
}

// Do a substep in parts as long as the last one, twice as long after quiet substeps, or shorter where it must be.
void do_substep(vec3 head_moved)
{
    float size = known > 0.0 ? known_part() : 1.0, quiet = 0.0;
    if (size < 1.0) quiet = known / size - 1.0 + QUIET_STEP;
    if (quiet >= 1.0) {
        size *= 2.0;
        quiet = 0.0;
    }
    done         = 0.0;
    rounds_spent = 0u;
    touching     = false;
    while (size < 1.0 && !may_split(size)) size *= 2.0;
    float begun = size;
    for (; done < 1.0; done += leap_part) {
        if (done > 0.0) {
            begin_part();
            if (SOLIDS) next_solids();
        }
        place_part(size, done + size, head_moved);
        attempt_all(head_moved);
        size = leap_part;
    }
    if (size < begun) quiet = 0.0;
    if (known < 1.0) known *= 1.0 + quiet;
}
