// mixed_contact.glsl - contact and friction of the mixed scheme, as springs that are part of
// Newton's system.
//
// In a Newton step, the tangent planes of colliders take the place of the colliders. They touch the
// colliders at the chain of segments. The displacements without contact would give other planes in
// each step. These follow from the forces of stiff segments, which are wild until they are solved
// for.
//
// A vertex also has planes of colliders that are near but not touched. A Newton step may move the
// vertex onto them, or release it from a plane that must hold it in the next step. Without these
// planes, two vertices on an edge took turns, and the substep ended with one of them inside.
//
// A plane pushes by a spring of PUSH times the inertia of the vertex in a substep. A vertex that a
// segment holds inside a collider has no place to go. Rigid planes would answer with unbounded
// forces, which throw the strand about later.
//
// A spring holds a vertex on its surface. It yields where it pulls by more than friction bears (P.
// Cundall and O. Strack, A Discrete Numerical Model for Granular Assemblies, 1979). Its stiffness
// is GRIP times the inertia of the vertex in a substep. A vertex that sticks therefore still moves
// a little with forces, and all forces between such vertices are determined. The spring begins with
// the force of the last substep, so that nothing creeps. With this force F and the way d over the
// surface, both as displacements, the spring takes
//
//   g = (F + GRIP d) / (1 + GRIP), at most friction times the pressure.
//
// The pressure is taken from the last substep, which keeps Newton's system symmetric. A Newton step
// replaces the pressure where it finds a much larger or smaller one. Along a chain over a round
// body, the pressure builds up as fast as Picard's iteration of T' = friction T.
#define PUSH 1000.0
#define GRIP 3.0
#define PRESSURE_CHANGE 0.5 // Relative change of pressure that replaces it
#define PRESSED_UNTIL 4u    // Number of Newton steps that replace pressures
#define PLANE_STAYS 0.002   // Way of a vertex that leaves its planes as they are, in segments
// Number of Newton steps that find planes. Later steps keep the planes, and converge.
#define PLANES_UNTIL 4u

LOCAL(vec4, plane);          // Planes of vertex i, as `outcome` has them
LOCAL(vec4, other_plane);
LOCAL(vec3, planes_at);      // Displacement at which the planes were found
LOCAL(vec3, surface);        // Displacement of the surface at vertex i
LOCAL(float, surface_friction);
// Derivative of the displacement by the wanted displacement.
LOCAL(symmetric, freedom);
#ifdef HAIR_IMPULSES
LOCAL(vec3, pressers);       // Value of `plane_pressers` at vertex i
#endif
LOCAL(vec3, pressing);       // Reaction that friction is measured by, m/s^2

// Find the planes of colliders where the chain is. A Newton step that moves vertex i little leaves
// its planes.
void find_planes_of(uint i, bool first, vec3 head_moved)
{
    vec3  way   = local(chain) - local(planes_at);
    float stays = PLANE_STAYS * segment_length();
    if (!first && dot(way, way) < stays * stays) return;
    outcome made = allowed(i, local(chain), local(reachable), BITS(0u), head_moved, local(met));
    local(planes_at)        = local(chain);
    local(plane)            = made.plane;
    local(other_plane)      = made.other;
    local(surface)          = made.surface;
    local(surface_friction) = made.friction;
#ifdef HAIR_IMPULSES
    local(pressers)         = plane_pressers;
#endif
}

void find_planes(bool first, vec3 head_moved)
{
    FOR_VERTICES(guide_count) {
        if (first) local(plane) = local(other_plane) = vec4(0.0);
        if (!LISTS_REACHING && local(reachable) != BITS(0u)) find_planes_of(i, first, head_moved);
    }
    if (LISTS_REACHING) {
        EACH_REACHING { find_planes_of(i, first, head_moved); }
    }
}

// Replace the pressure that friction is measured by where the last Newton step found another one.
void renew_pressure(bool all)
{
    FOR_VERTICES(guide_count) {
        bool other =
            length(local(reaction_found) - local(pressing)) > PRESSURE_CHANGE * length(local(pressing));
        if (all || other) local(pressing) = local(reaction_found);
    }
}

// Return how far two planes push a vertex along their normals, by how far it is beyond each.
// `normals` is the product of both normals. A push may be negative if `may_pull` is set.
vec2 pushes_of(float normals, vec2 beyond, bool are_two, bool may_pull)
{
    const float s = 1.0 + 1.0 / PUSH;
    vec2 by = (s * beyond - normals * beyond.yx) / (s * s - normals * normals);
    if (may_pull) return by;
    if (are_two && by.x <= 0.0) by = vec2(0.0, beyond.y / s);
    else if (are_two && by.y <= 0.0) by = vec2(beyond.x / s, 0.0);
    return max(by, 0.0);
}

// Return the part of a displacement that one or two planes take away. Stiffer springs make the part
// a projection.
symmetric taken_by(vec3 n, vec3 m, bool both)
{
    const float s = 1.0 + 1.0 / PUSH;
    float c = dot(n, m);
    symmetric across = outer(n);
    if (both) across = plus(across, minus(outer(m), times(c / s, twice_mixed(n, m))));
    return times(s / (s * s - c * c), across);
}

// Note how planes and friction push vertex i.
void note_pushes(uint i, vec3 by_plane, vec3 by_other, vec3 by_friction)
{
#ifdef HAIR_IMPULSES
    presser = local(pressers).x;
    if (by_plane != vec3(0.0)) note_push(by_plane, by_plane);
    presser = local(pressers).y;
    if (by_other != vec3(0.0)) note_push(by_other, by_other);
    presser = local(pressers).z;
    if (by_friction != vec3(0.0)) note_push(by_friction, vec3(0.0));
#endif
    keep_pushes(i);
}

// Return a plane if vertex i presses it by the chain and the last reaction.
vec4 pressed_plane(uint i, vec4 p)
{
    vec3 pressed = of_force * local(reaction_found);
    vec3 deeper  = local(chain) - min(1.0, near_distance() / max(length(pressed), 1e-9)) * pressed;
    return dot(p.xyz, deeper) < p.w ? p : vec4(0.0);
}

// Find the displacement that planes leave of the wanted one at vertex i. In the `first` Newton
// step, the wanted displacement follows from forces that are not solved for yet. Only the chain
// tells whether the vertex presses and sticks.
void hold_vertex(uint i, bool first)
{
    vec4  p = first ? pressed_plane(i, local(plane)) : local(plane);
    vec4  q = first ? pressed_plane(i, local(other_plane)) : local(other_plane);
    vec3  n = p.xyz, m = q.xyz, d = local(wanted);
    vec2  beyond = vec2(p.w - dot(n, d), q.w - dot(m, d));
    vec2  by = pushes_of(dot(n, m), beyond, m != vec3(0.0), first);
    vec3  push = by.x * n + by.y * m;
    local(reaction_found) = vec3(0.0);
    clear_pushes(i);
    if (by == vec2(0.0)) return;
    vec3 by_plane = by.x * n, by_other = by.y * m;
    bool both = by.x != 0.0 && by.y != 0.0;
    n = by.x != 0.0 ? n : m;
    m = both ? m : vec3(0.0);

    vec3      along = both ? normalize(cross(n, m)) : vec3(0.0);
    symmetric one = multiple_of_one(1.0), over = both ? outer(along) : minus(one, outer(n));
    symmetric gives = times(GRIP / (1.0 + GRIP), over);
    vec3      held = of_force * times(over, local(reaction));
    vec3      pressure = of_force * (local(pressing) - times(over, local(pressing)));
    float     bears = dot(pressure, n + m) > 0.0 ? local(surface_friction) * length(pressure) : 0.0;
    vec3      by_want = times(gives, d - local(surface)) - held / (1.0 + GRIP);
    vec3      spring = first ? GRIP * times(over, local(chain) - local(surface)) - held : by_want;
    float     far = max(length(spring), 1e-30);
    bool      sticks = far <= bears;
    if (!sticks) {
        float part = first || both ? 0.0 : bears / far;
        gives      = times(part, minus(gives, times(GRIP / (1.0 + GRIP), outer(spring / far))));
        by_want    = (bears / far) * spring;
    }
    PUT(moved, d + push - by_want);
    note_pushes(i, by_plane, by_other, -by_want);
    local(reaction_found) = (push - by_want) / of_force;
    local(freedom)        = minus(minus(one, taken_by(n, m, both)), gives);
    local(touch)          = sticks || !both ? vec4(n, sticks ? STICKS : SLIDES) : vec4(along, GLIDES);
}

// Find the displacements that planes leave.
void hold_vertices(bool first)
{
    FOR_VERTICES(guide_count) {
        PUT(moved, local(wanted));
        if (!COLLIDERS) continue;
        local(touch) = vec4(0.0);
        clear_pushes(i);
        if (local(reachable) == BITS(0u)) local(reaction_found) = vec3(0.0);
        else if (!LISTS_REACHING) hold_vertex(i, first);
    }
    if (COLLIDERS && LISTS_REACHING) {
        EACH_REACHING { hold_vertex(i, first); }
    }
}

// Find the displacements that colliders allow in a Newton step.
void resolve_contact(uint n, bool leads, vec3 head_moved)
{
    if (COLLIDERS && touching) {
        if (leads) FOR_VERTICES(guide_count) { local(chain) = local(wanted); }
        else if (n > 0u && n < PLANES_UNTIL) find_chain();
        if (leads || n < PLANES_UNTIL) find_planes(leads || n == 0u, head_moved);
        if (n < PRESSED_UNTIL) renew_pressure(n == 0u);
    }
    hold_vertices(n == 0u && !leads);
}
