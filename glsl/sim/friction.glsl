// friction.glsl - Coulomb friction of the mixed scheme, by springs along a surface.
//
// A vertex hangs on its surface by a spring that gives way where it pulls by more than friction bears (P. Cundall and
// O. Strack, A Discrete Numerical Model for Granular Assemblies, 1979). Its stiffness is GRIP times the inertia of the
// vertex in a substep, so that what sticks still moves a little with forces, and all forces between what sticks are
// determined. The spring begins with the force of the last substep: nothing creeps. With F that force and d the way over
// the surface, all as displacements, it takes
//
//   g = (F + GRIP d) / (1 + GRIP), at most friction times the pressure.
//
// The pressure is that of the last Newton step, or at first of the last substep, which keeps Newton's system symmetric.
// Along a chain over a round body it builds up as fast as Picard's iteration of T' = friction T.
#define GRIP 3.0

OWN(vec3, reaction);       // Reaction of solids on vertex i at the end of the last substep. m/s^2
OWN(vec3, reaction_found); // Reaction that the last Newton step found. m/s^2
vec3 last_held, last_found; // Both reactions of one vertex, as displacements

// Return the displacement that friction takes of a way over a surface. `slip` is as the variable of that name has it.
vec3 gripped(float friction, vec3 normal, vec3 way, out bool sticks, out vec4 slip)
{
    vec3  spring = (GRIP * way - (last_held - dot(last_held, normal) * normal)) / (1.0 + GRIP);
    float far = length(spring), bears = friction * max(dot(last_found, normal), 0.0);
    sticks = far <= bears;
    slip   = vec4(0.0, 0.0, 0.0, friction);
    if (sticks) return spring;
    slip = vec4(spring * (friction / far), bears / far * (GRIP / (1.0 + GRIP)));
    return spring * (bears / far);
}

// Push a displacement out of one solid by the depth, and hold it by friction.
void push_by(float factor, float depth, vec3 normal, vec3 surface, inout outcome made)
{
    bool sticks;
    vec3 held = made.grip - dot(made.grip, normal) * normal, way = made.d + held - surface;
    vec3 grip = gripped(params.friction * factor, normal, way - dot(way, normal) * normal, sticks, made.slip);
    made.d += depth * normal + held - grip;
    made.grip    = grip;
    made.surface = surface;
    made.freedom = sticks ? vec4(normal, STICKS) : left_of(made.freedom, normal);
}
