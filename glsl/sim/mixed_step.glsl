// mixed_step.glsl - a substep of the mixed scheme: Newton's method on turns and forces, contact within it.
//
// One step of Newton's method with the exact second derivatives is enough in usual motion. Where a block is
// not positive, or a segment would turn far, Gauss and Newton's convex derivatives take its place, and no
// segment turns by more than MAX_TURN.
#define CLOSE_TURN 0.03 // rad: a Newton step this small leaves about its square.
#define MAX_ROUNDS 10u  // Number of Newton steps of an attempt. Those that are not trusted count too.
#define FEWEST_ROUNDS 4u // Number of Newton steps that every attempt may take
#ifdef HAIR_THREAD_PER_GUIDE // A software rasteriser leaves loops that go round too often: see lib/sim/rounds.c.
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS_BY_THREAD(HAIR_GUIDE_THREADS)
#else
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS
#endif
#define LOOSE_FROM 3u   // Number of Newton steps after which errors of length may be larger, by the factor
#define LOOSER 10.0     // LOOSER. The next substep goes on with what is left.

bool guarded;       // A Newton step was not trusted in this substep.
uint rounds_in_all; // Number of Newton steps in this substep
uint most_turn;     // Greatest turn of this thread's segments, squared, as bits
bool finite;        // The last attempt, failed or not, came to something finite.

// Find which solids each vertex can touch in this substep.
void find_reachable(bool leads, vec3 head_moved)
{
    EACH(guide_count) { own(reaction_found) = own(reaction); }
    if (SOLIDS && !leads) {
        find_chain();
        EACH(guide_count) { own(wanted) = own(chain); }
    }
    find_solids(head_moved);
    list_reaching();
    touching = TIED;
    if (!SOLIDS) return;
    bool any = false;
    EACH(guide_count) { any = any || (i < guide_count && own(reachable) != BITS(0u)); }
    touching = any_of(bvec2(any, false)).x || TIED;
}

// Go along the solution, turning no segment by more than MAX_TURN. `far`: the whole of it would.
void apply_solution(bool far)
{
    float part = 1.0;
    if (far) {
        float most = 0.0;
        EACH(guide_count - 1u) {
            vec3 z = ROW(right_turn, i);
            most   = max(most, i + 1u < guide_count ? length(z) : 0.0);
        }
        part = MAX_TURN / max(most_of(most), MAX_TURN);
    }
    EACH(guide_count) {
        vec3  z = ROW(right_turn, i), f = ROW(right_force, i);
        bool  is_segment = i + 1u < guide_count;
        z           = is_segment ? part * z : vec3(0.0);
        own(turn)   = normalize(quat_multiply(turn_by(z), own(turn)));
        PUT(handed, is_segment ? GET(handed) + part * f : vec3(0.0));
        seen(tried) = normalize(quat_multiply(own(turn), seen(section)));
    }
    MEET;
}

// Return whether the solution turns a segment too far or is not finite, and whether it turns one by more than
// CLOSE_TURN.
bvec2 judge_solution()
{
    uint most = 0u;
    EACH(guide_count - 1u) {
        vec3 z = ROW(right_turn, i);
        if (i + 1u < guide_count) most = max(most, bits_of(dot(z, z)));
    }
    most_turn = most;
    bool far = most > floatBitsToUint(MAX_TURN * MAX_TURN) || !convex;
    return any_of(bvec2(far, most > floatBitsToUint(CLOSE_TURN * CLOSE_TURN)));
}

// Return whether the substep by `method` succeeds: BDF2, implicit Euler, or follow-the-leader, which always
// does. Where it succeeds, or has come to something finite, place_vertices() is next; not after
// follow-the-leader.
bool attempt(int method, vec3 head_moved)
{
    bool  leads = IS_LEADER(method), exact = true, done = false, fits = false;
    bvec2 judged = bvec2(true);
    predict(method);
    find_reachable(leads, head_moved);
    for (uint n = 0u; n < MAX_ROUNDS && (n < FEWEST_ROUNDS || rounds_in_all < MAX_ROUNDS_IN_ALL); ++n) {
        ++rounds_in_all;
        if (!leads) find_wanted();
        meet_solids(n, leads, head_moved);
        MEET;
        if (leads) { // What is led into a solid is turned out of it, once.
            follow_leader();
            if (n == (SOLIDS ? 1u : 0u)) return true;
            continue;
        }
        bool loose = put_rows(exact, n < LOOSE_FROM ? 1.0 : LOOSER);
        fits = done && (!touching || !any_of(bvec2(loose, false)).x);
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
    finite = most_turn < 0x7f800000u;
    return !judged.x && (!TIED || fits); // What does not fit would be stretched between what is held.
}
