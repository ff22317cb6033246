// leap_parts.glsl - a substep of SHAKE, as a whole or in parts. parts.glsl explains the parts.

#ifdef HAIR_STIFF
#define MIN_PART (1.0 / 128.0)
#else
#define MIN_PART (1.0 / 32.0)
#endif

// Maximum number of loop rounds. llvmpipe leaves all loops after a fixed number of rounds, which
// lib/sim/programs.c has. A thread goes round once per vertex. A work group goes round once, and
// more often in a reduction.
#ifdef HAIR_THREAD_PER_GUIDE
#define MAX_LOOPS (params.part_rounds / uint(MAX_VERTICES))
#else
#define MAX_LOOPS (params.part_rounds / 3u)
#endif
// Rounds of one test against few colliders.
#define LOOPS_OF_LOOK (COLLIDERS ? params.colliders + 10u + 12u * uint(bitCount(params.bodies)) : 0u)
// Rounds of shortwave_error() with its sums.
#ifdef HAIR_THREAD_PER_GUIDE
#define LOOPS_OF_ERROR 4u
#else
#define LOOPS_OF_ERROR 24u
#endif
// Rounds of a part, without those of each step of lengths.
#define LOOPS_OF_PART (15u + 2u * LOOPS_OF_LOOK)
#define LOOPS_OF_STEP (10u + LOOPS_OF_LOOK)
#define LOOPS_OF_ATTEMPT (LOOPS_OF_PART + 3u * LOOPS_OF_STEP)

bool touching; // The last attempt touched a collider.

// Return whether the rest of the substep may be done in parts of this size.
bool may_split(float smaller)
{
    return !touching && smaller >= MIN_PART &&
           rounds_spent + LOOPS_OF_ATTEMPT * uint((1.0 - done) / smaller) < MAX_LOOPS;
}

// Return the size of the parts to try after a failure.
float smaller_part() { return leap_part == 1.0 ? min(whip_part, 0.5) : 0.5 * leap_part; }

// Return whether a segment turns too far and smaller parts are possible.
bool turns_far(int method)
{
    float min_cosine = leap_part < 1.0 || (known > 0.0 && known < 1.0) ? MIN_PART_COSINE : MIN_COSINE;
    bool  far = false, touches = false;
    rounds_spent += LOOPS_OF_PART + LOOPS_OF_STEP * length_steps;
    FOR_VERTICES(guide_count) {
        bool turned =
            IS_BACK(method) ? may_turn_far() && turns_in_whole(i, method) : turns_at(i, min_cosine);
        far     = far || turned;
        touches = touches || (COLLIDERS && local(met) != BITS(0u));
    }
    bvec2 found = group_any(bvec2(far, touches));
    touching    = found.y;
    return (IS_SHAKE(method) || IS_BACK(method)) && found.x && may_split(smaller_part());
}

// Maximum of shortwave_error() in a part. The change to a part of half the length turns 3/8 of the
// error into energy. In a whip of 5 s the energy then grows by less than 1 %.
#define MAX_ERROR 0.003

// Increment of the count of quiet substeps. Each change of a part's length shifts the energy of
// short waves a little. A longer part is therefore tried only after 512 quiet substeps.
#define QUIET_STEP (1.0 / 512.0)

// Place head and root at the end of a part that begins at `done`, and choose its leap. `size` is
// the fraction of the substep that the leap covers.
void place_part(float size, float end, vec3 head_moved)
{
    vec4  to   = dot(head_at_start, head_at_end) < 0.0 ? -head_at_end : head_at_end;
    vec4  head = end == 1.0 ? head_at_end : normalize(mix(head_at_start, to, end));
    float h    = params.gravity.w * size, c = guide_damping;
    leap_part  = size;
    part_keep  = size == 1.0 ? guide_keep : exp(-c * h);
    part_kick  = size == 1.0 ? guide_kick : c * h > 1e-6 ? h * (1.0 - part_keep) / c : h * h;
    place_root(head, end == 1.0 ? fraction_at_end : mix(fraction_at_start, fraction_at_end, end));
    root_moved = root_now - root_then + (end - done) * head_moved;
}

// Prepare the next attempt, in smaller parts, after one by `method` has failed. Return false if no
// smaller parts are possible. `known_before` is that before the attempt.
bool splits(inout int method, float known_before, vec3 head_moved)
{
    float size = smaller_part();
    if (!(IS_SHAKE(method) || (IS_BACK(method) && leap_part == 1.0)) || !may_split(size)) return false;
#ifdef HAIR_STIFF
    known = known_before;
    if (IS_BACK(method) && known >= 1.0) {
        // The first part begins with the velocity of the start.
        FOR_VERTICES(guide_count) { local(displacement) = known < 2.0 ? local(displacement) : local(rate); }
        known = 0.0;
    }
#endif
    place_part(size, done + size, head_moved);
    method = SHAKE - 1; // The loop over methods adds 1.
    return true;
}

// Begin the next part where the last one ended.
void begin_part()
{
    turn_then  = turn_now;
    root_then  = root_now;
    fraction_then = fraction_now;
}

// Return the error of the energy by leaps over whole substeps, as a fraction of the energy.
//
// Leapfrog over a time h conserves an energy that lacks the fraction (w h)^2 / 4 of waves of
// angular frequency w. A whip's waves get shorter, and the fraction grows. The true energy grows by
// as much. Summed over all waves, it is half the bending energy of the displacement as a shape. It
// is proportional to the square of a leap's length.
float shortwave_error()
{
    FOR_VERTICES(guide_count) { PUT(handed, local(displacement)); }
    GROUP_BARRIER;
    FOR_VERTICES(guide_count) {
        vec3 turn = (AFTER_VEC3(handed) - GET(handed)) / max(local(rest_length), 1e-9);
        PUT(lever, i + 1u < guide_count ? turn : vec3(0.0));
    }
    GROUP_BARRIER;
    float error = 0.0, energy = 0.0, h = params.gravity.w;
    FOR_VERTICES(guide_count) {
        vec3 before = BEFORE_VEC3(lever), d = GET(handed) - GET_AT(handed, 0u);
        vec3 bend   = i > 0u && i + 1u < guide_count ? GET(lever) - before : vec3(0.0);
        bool moves  = i < guide_count && local(slack) > 0.0;
        error += 0.25 * local(strain).w * dot(bend, bend);
        energy += moves ? 0.5 * dot(d, d) / local(slack) : 0.0;
    }
    // Weight counts too. A guide that hardly moves thus needs no short parts.
    float by_weight = 0.25 * length(params.gravity.xyz) * guide_length * guide_length;
    error           = group_sum(error);
    return error / max(group_sum(energy) / (h * h) + by_weight, 1e-12);
}

// Do a substep in parts as long as the last one. Parts become twice as long after quiet substeps,
// and shorter where necessary.
void do_substep(vec3 head_moved)
{
    float size = known > 0.0 ? known_part() : 1.0, quiet = 0.0;
    done         = 0.0;
    rounds_spent = 0u;
    touching     = false;
    if (size < 1.0) {
        float error = shortwave_error(), longer = size < whip_part ? 2.0 * size : 1.0, last = size;
        quiet       = known / size - 1.0 + QUIET_STEP;
        if (quiet >= 1.0) size = longer * longer * error < 0.5 * MAX_ERROR ? longer : size;
        while (size * size * error > MAX_ERROR && size > MIN_PART) size *= 0.5;
        if (quiet >= 1.0 || size < last) quiet = 0.0;
        rounds_spent = LOOPS_OF_ERROR;
    }
    // A loaded state may have a part of no size.
    while (size < 1.0 && !may_split(size)) size = max(2.0 * size, MIN_PART);
    float begun = size;
    for (; done < 1.0; done += leap_part) {
        if (done > 0.0) {
            begin_part();
            if (COLLIDERS) next_colliders();
        }
        place_part(size, done + size, head_moved);
        attempt_all(head_moved);
        size = leap_part;
    }
    if (size < begun) quiet = 0.0;
    if (known < 1.0) known *= 1.0 + quiet;
}
