// mixed_step.glsl - a substep of the mixed scheme: Newton's method on turns and forces, contact within it.
//
// One step of Newton's method with the exact second derivatives is enough in usual motion. Where a block is not positive, or
// a segment would turn far, Gauss and Newton's convex derivatives take its place, and no segment turns by more than MAX_TURN.
#define CLOSE_TURN 0.03  // rad: what a Newton step this small leaves is about its square.
#define MAX_ROUNDS 10u   // Newton steps of an attempt, those that are not trusted counted; and of all in a substep
#ifdef HAIR_THREAD_PER_GUIDE // A software rasteriser leaves loops that go round too often: see lib/sim/rounds.c.
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS_BY_THREAD(HAIR_GUIDE_THREADS)
#else
#define MAX_ROUNDS_IN_ALL HAIR_MIXED_STEPS
#endif
#define LENGTH_ERROR 2e-4 // What contact may leave of a segment's length, relative.

#define FREEZE_FROM 3u   // Newton steps after which contacts stay as they are: see try_frozen().

OWN(vec4, plane);      // `touch` of a contact that stays
OWN(float, plane_friction);
OWN(vec3, plane_move); // the displacement that it allowed
bool guarded;  // A Newton step was not trusted in this substep.
uint rounds_in_all;
#define FEWEST_ROUNDS 4u // of every attempt

uint most_turn;  // of this thread's segments, squared, as bits
bool finite;     // The last attempt, failed or not, came to something finite.
bool touching; // Some vertex can touch a solid in this substep.

bool is_touching()
{
    bool any = false;
    if (SOLIDS) {
        EACH(guide_count) { any = any || (i < guide_count && own(reachable) != BITS(0u)); }
        any = any_of(bvec2(any, false)).x;
    }
    return any;
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

// Find which displacements the contacts allow that were found last, as planes that do not change any more. So Newton's
// method comes to an end where a vertex goes to and fro over an edge.
void try_frozen(bool first)
{
    EACH(guide_count) {
        if (first) {
            own(plane)          = own(touch);
            own(plane_move)     = GET(moved);
            own(plane_friction) = own(touch).w == STICKS ? own(slip).w : length(own(slip).xyz);
        }
        vec3  to = own(plane_move), n = own(plane).xyz, d = own(wanted);
        float depth = dot(n, to - d), kind = own(plane).w;
        own(touch) = own(plane);
        own(slip)  = vec4(0.0);
        if (kind == GLIDES) d = to + dot(n, d - to) * n;
        if (kind == SLIDES || kind == STICKS) {
            vec3 way = d - own(surface);
            bool sticks;
            last_found = of_force * own(reaction_found);
            last_held  = of_force * own(reaction);
            vec3 grip  = gripped(own(plane_friction), n, way - dot(way, n) * n, sticks, own(slip));
            own(touch) = vec4(n, sticks ? STICKS : SLIDES);
            d += depth * n - grip;
            if (depth <= 0.0) {
                d          = own(wanted);
                own(touch) = own(slip) = vec4(0.0);
            }
        }
        own(reaction_found) = (d - own(wanted)) / of_force;
        PUT(moved, d);
    }
}

// Return whether the solution turns a segment too far or is not finite, and whether it turns one by more than CLOSE_TURN.
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

// Replace `wanted` of every vertex by `start` and the sum of all before it.
void sum_along(vec3 start)
{
#ifdef HAIR_THREAD_PER_GUIDE
    for (uint k = 0u; k < guide_count; ++k) {
        vec3 v    = wanted[k];
        wanted[k] = start;
        start += v;
    }
#else
    vec3 sum = lane + 1u < guide_count ? wanted : vec3(0.0);
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        lend(sum);
        vec3 more = lent_by(lane - reach); // Read by all threads, as shuffles want it.
        sum += lane >= reach ? more : vec3(0.0);
    }
    lend(sum);
    vec3 before = lent_by(lane - 1u);
    wanted = start + (lane > 0u ? before : vec3(0.0));
#endif
}

// Return the displacement of a free root that leaves the guide the momentum which forces from without give it.
vec3 free_root_moved()
{
    vec3  momentum = vec3(0.0);
    float mass     = 0.0;
    EACH(guide_count) {
        float m = i < guide_count && own(slack) > 0.0 ? 1.0 / own(slack) : 0.0;
        mass += m;
        momentum += m * (GET(lever) - own(wanted));
    }
    return vec3(sum_of(momentum.x), sum_of(momentum.y), sum_of(momentum.z)) / sum_of(mass);
}

#ifdef HAIR_TIED
// Share out along each span what its held end lacks.
void close_spans()
{
    EACH(guide_count) { PUT(lever, own(slack) == 0.0 ? held_move(i) - GET(moved) : vec3(0.0)); }
    MEET;
    EACH(guide_count) {
        vec4  s = own(span);
        float far = s.z > 0.0 ? (float(i) - s.x) / max(s.y - s.x, 1.0) : 0.0;
        vec3  from = GET_AT(lever, uint(s.x)), to = GET_AT(lever, uint(s.y));
        vec3  lack = own(slack) == 0.0 ? GET(lever) : s.z > 0.0 ? mix(from, to, far) : vec3(0.0);
        PUT(moved, GET(moved) + lack);
    }
    MEET;
}
#endif

// Sum up displacements, and places after them, out of the turns.
void place_vertices()
{
    EACH(guide_count) {
        // Without the forces of segments, which cancel, and would leave what rounding makes of stiff ones.
        PUT(lever, own(reached) + (GET(moved) - own(wanted)));
        vec3 then   = along_of(seen(section));
        own(wanted) = own(rest_length) * change_by(own(turn), then);
#ifdef HAIR_TIED
        vec3 between = BETWEEN;
        own(wanted) += i + 1u < guide_count ? own(rest_length) * then - between : vec3(0.0);
#endif
    }
    vec3 root_place = GET_AT(place, 0u), start = root_is_free ? vec3(0.0) : root_moved;
    sum_along(start);
    if (root_is_free) start = free_root_moved();
    EACH(guide_count) {
        PUT(moved, own(wanted) + (root_is_free ? start : vec3(0.0)));
        own(wanted) = own(rest_length) * along_of(seen(tried));
    }
    sum_along(root_place + (start - root_moved));
    EACH(guide_count) { PUT(place, own(wanted) - (GET(moved) - root_moved)); }
    MEET;
#ifdef HAIR_TIED
    close_spans();
#endif
}

// Return whether the substep by `method` succeeds: BDF2, implicit Euler, or follow-the-leader, which always does. Where it
// succeeds, or has come to something finite, place_vertices() is next; not after follow-the-leader.
bool attempt(int method, vec3 head_moved)
{
    predict(method);
    find_solids(head_moved);
    list_reaching();
    touching = TIED || is_touching();
    EACH(guide_count) { own(reaction_found) = own(reaction); }
    bool  exact = true, done = false, fits = false, frozen = false, verifies = false;
    bvec2 judged = bvec2(true);
    for (uint n = 0u; n < MAX_ROUNDS && (n < FEWEST_ROUNDS || rounds_in_all < MAX_ROUNDS_IN_ALL); ++n) {
        ++rounds_in_all;
        if (!IS_LEADER(method)) find_wanted();
        // A step that fits frozen contacts is tried once more with those that there are.
        bool freezes = SOLIDS && n >= FREEZE_FROM && !verifies;
        if (freezes) try_frozen(!frozen);
        else try_wanted(head_moved, false);
        frozen = freezes;
        MEET;
        if (IS_LEADER(method)) { // What is led into a solid is turned out of it, once.
            follow_leader();
            if (n == (SOLIDS ? 1u : 0u)) return true;
            continue;
        }
        bool loose = put_rows(exact, LENGTH_ERROR);
        fits = done && (!touching || !any_of(bvec2(loose, false)).x);
        verifies = fits && frozen;
        if ((fits && !frozen) || (done && !has_rounds())) break;
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
