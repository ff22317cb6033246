// mixed_step.glsl - a substep of the mixed scheme, by Newton's method on turns and forces. Contact
// is part of it.
//
// One step of Newton's method with the exact second derivatives is enough in usual motion. Gauss
// and Newton's convex derivatives replace these if a block is not positive, or if a segment would
// turn far. Then no segment turns by more than MAX_TURN.
// Turn of a Newton step below which the remaining error is about its square, rad.
#define CLOSE_TURN 0.03
// Number of Newton steps of an attempt. Steps that are not trusted count too.
#define MAX_ROUNDS 10u
#define MIN_ROUNDS 4u // Number of Newton steps that every attempt may take
// A software rasteriser leaves loops that go round too often. See lib/sim/loop_budget.c.
#ifdef HAIR_THREAD_PER_GUIDE
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS_BY_THREAD(HAIR_GUIDE_THREADS)
#else
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS
#endif
#define LOOSE_FROM 3u   // Number of Newton steps after which larger errors of length are accepted
#define LOOSER 10.0     // Factor of these errors. The next substep continues with the rest.

bool guarded;       // A Newton step was not trusted in this substep.
uint rounds_in_all; // Number of Newton steps in this substep
uint max_turn;     // Greatest squared turn of this thread's segments, as bits
bool finite;        // The result of the last attempt is finite, even if the attempt failed.

// Find the colliders that each vertex can touch in this substep.
void find_reachable(bool leads, vec3 head_moved)
{
    FOR_VERTICES(guide_count) { local(reaction_found) = local(reaction); }
    if (COLLIDERS && !leads) {
        find_chain();
        FOR_VERTICES(guide_count) { local(wanted) = local(chain); }
    }
    find_colliders(head_moved);
    list_reaching();
    touching = PINNED;
    if (!COLLIDERS) return;
    bool any = false;
    FOR_VERTICES(guide_count) { any = any || (i < guide_count && local(reachable) != BITS(0u)); }
    touching = group_any(bvec2(any, false)).x || PINNED;
}

// Apply the solution, and turn no segment by more than MAX_TURN. `far` means that the whole
// solution would.
void apply_solution(bool far)
{
    float part = 1.0;
    if (far) {
        float max_value = 0.0;
        FOR_VERTICES(guide_count - 1u) {
            vec3 z = ROW(right_turn, i);
            max_value   = max(max_value, i + 1u < guide_count ? length(z) : 0.0);
        }
        part = MAX_TURN / max(group_max(max_value), MAX_TURN);
    }
    FOR_VERTICES(guide_count) {
        vec3  z = ROW(right_turn, i), f = ROW(right_force, i);
        bool  is_segment = i + 1u < guide_count;
        z           = is_segment ? part * z : vec3(0.0);
        local(turn)   = normalize(quat_multiply(turn_by(z), local(turn)));
        PUT(handed, is_segment ? GET(handed) + part * f : vec3(0.0));
        SHARED_READ(tried) = normalize(quat_multiply(local(turn), SHARED_READ(section)));
    }
    GROUP_BARRIER;
}

// Return whether the solution is not finite or turns a segment too far, and whether it turns one by
// more than CLOSE_TURN.
bvec2 judge_solution()
{
    uint max_value = 0u;
    FOR_VERTICES(guide_count - 1u) {
        vec3 z = ROW(right_turn, i);
        if (i + 1u < guide_count) max_value = max(max_value, bits_of(dot(z, z)));
    }
    max_turn = max_value;
    bool far = max_value > floatBitsToUint(MAX_TURN * MAX_TURN) || !convex;
    return group_any(bvec2(far, max_value > floatBitsToUint(CLOSE_TURN * CLOSE_TURN)));
}

// Do the substep by `method`: BDF2, implicit Euler, or follow-the-leader. Return whether it
// succeeds. Follow-the-leader always does. Unless `method` is follow-the-leader, place_vertices()
// must follow if the attempt succeeds, or if its result is finite.
bool attempt(int method, vec3 head_moved)
{
    bool  leads = IS_LEADER(method), exact = true, done = false, fits = false;
    bvec2 judged = bvec2(true);
    predict(method);
    find_reachable(leads, head_moved);
    for (uint n = 0u; n < MAX_ROUNDS && (n < MIN_ROUNDS || rounds_in_all < MAX_ROUNDS_IN_ALL); ++n) {
        ++rounds_in_all;
        if (!leads) find_wanted();
        resolve_contact(n, leads, head_moved);
        GROUP_BARRIER;
        // Vertices that are drawn into colliders are pushed out once.
        if (leads) {
            follow_leader();
            if (n == (COLLIDERS ? 1u : 0u)) return true;
            continue;
        }
        bool loose = put_rows(exact, n < LOOSE_FROM ? 1.0 : LOOSER);
        fits = done && (!touching || !group_any(bvec2(loose, false)).x);
        if (fits || (done && !has_rounds())) break;
        solve_system(exact);
        judged = judge_solution();
        if (judged.x && exact) {
            exact = false;
            guarded = true;
            continue;
        }
        apply_solution(judged.x);
        done  = !judged.y;
        if (done && !touching) break;
    }
    finite = max_turn < 0x7f800000u;
    // A solution that does not fit would stretch the strand between held vertices.
    return !judged.x && (!PINNED || fits);
}
