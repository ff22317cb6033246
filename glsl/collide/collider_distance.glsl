// collider_distance.glsl - the exact signed distance to the surface of a shape in its own
// space, without rounding, and the unit gradient. lib/collide/distance.c has the same functions for
// the CPU.
// Values of hair_shape.
#define SHAPE_SPHERE 0u
#define SHAPE_CAPSULE 1u
#define SHAPE_BOX 2u
#define SHAPE_CYLINDER 3u
#define SHAPE_CONE 4u
#define SHAPE_PLANE 5u
#define SHAPE_ELLIPSOID 7u

float box_distance(vec3 size, vec3 p, out vec3 gradient)
{
    vec3 q = abs(p) - size, beyond = max(q, 0.0),
         side = vec3(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0, p.z < 0.0 ? -1.0 : 1.0);
    float away = length(beyond), deepest = max(q.x, max(q.y, q.z));
    vec3 face = q.x == deepest   ? vec3(1.0, 0.0, 0.0)
                : q.y == deepest ? vec3(0.0, 1.0, 0.0)
                                 : vec3(0.0, 0.0, 1.0);
    gradient   = side * (away > 1e-12 ? beyond / away : face);
    return away + min(deepest, 0.0);
}

// Return the vector from the nearest point of the segment (a, b) to p.
vec2 from_segment(vec2 p, vec2 a, vec2 b)
{
    vec2 d = b - a;
    return p - a - clamp(dot(p - a, d) / max(dot(d, d), 1e-30), 0.0, 1.0) * d;
}

// Distances to shapes of revolution about the y axis, in the half-plane (distance from the axis,
// height).
float cylinder_distance(vec2 size, vec2 p, out vec2 gradient)
{
    vec2  q = vec2(p.x, abs(p.y)) - size, beyond = max(q, 0.0);
    float away = length(beyond), deepest = max(q.x, q.y);
    gradient   = away > 1e-12 ? beyond / away : q.x >= q.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    gradient.y = p.y < 0.0 ? -gradient.y : gradient.y;
    return away + min(deepest, 0.0);
}

float cone_distance(vec2 size, vec2 p, out vec2 gradient)
{
    vec2  base = from_segment(p, vec2(0.0, -size.y), vec2(size.x, -size.y));
    vec2  side = from_segment(p, vec2(size.x, -size.y), vec2(0.0, size.y));
    vec2  flank = normalize(vec2(2.0 * size.y, size.x) + vec2(1e-30, 0.0));
    bool  within = p.y > -size.y && dot(p - vec2(0.0, size.y), flank) < 0.0;
    vec2  away = dot(base, base) <= dot(side, side) ? base : side;
    float far = length(away), outwards = within ? -1.0 : 1.0;
    gradient = far > 1e-12 ? outwards / far * away : flank;
    return outwards * far;
}

// Return the distance to an ellipsoid by Newton's method, as lib/collide/distance.c explains.
float ellipsoid_distance(vec3 size, vec3 p, out vec3 gradient)
{
    float longest = max(max(size.x, size.y), max(size.z, 1e-9));
    vec3  r = max(size / longest, 1.0 / 256.0), at = max(abs(p) / longest, 1e-6 * r), way = r * at;
    float shortest = min(r.x, min(r.y, r.z));
    vec3  beyond = (r - shortest) * (r + shortest), start = way - beyond;
    float s = max(start.x, max(start.y, start.z));
    for (int i = 0; i < 9; ++i) {
        vec3  q = way / (s + beyond), squares = q * q;
        float square = squares.x + squares.y + squares.z;
        s += square * (sqrt(square) - 1.0) / dot(squares, 1.0 / (s + beyond));
    }
    vec3 q = way / (s + beyond), normal = normalize(q / r);
    gradient = mix(normal, -normal, lessThan(p, vec3(0.0)));
    return longest * dot(normal, at - r * normalize(q));
}

// Return the distance to a cylinder or cone.
float revolved_distance(uint shape, vec2 size, vec3 p, out vec3 gradient)
{
    float around = length(p.xz);
    vec2  slope, radial = around > 1e-12 ? p.xz / around : vec2(1.0, 0.0);
    float distance = shape == SHAPE_CONE ? cone_distance(size, vec2(around, p.y), slope)
                                         : cylinder_distance(size, vec2(around, p.y), slope);
    gradient       = vec3(slope.x * radial.x, slope.y, slope.x * radial.y);
    return distance;
}

// Return the distance to a sphere, or to a capsule whose axis has half the length `size.y`.
float capsule_distance(bool capsule, vec3 size, vec3 p, out vec3 gradient)
{
    vec3  axis = vec3(0.0, capsule ? clamp(p.y, -size.y, size.y) : 0.0, 0.0);
    float away = length(p - axis);
    gradient   = away > 1e-12 ? (p - axis) / away : capsule ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    return away - size.x;
}

// The only return at the end saves a fifth of a driver's time to compile sim/mixed.comp.
float shape_distance(uint shape, vec3 size, vec3 p, out vec3 gradient)
{
    float distance = p.y;
    gradient       = vec3(0.0, 1.0, 0.0);
    if (shape <= SHAPE_CAPSULE)
        distance = capsule_distance(shape == SHAPE_CAPSULE, size, p, gradient);
    else if (shape == SHAPE_BOX)
        distance = box_distance(size, p, gradient);
    else if (shape == SHAPE_ELLIPSOID)
        distance = ellipsoid_distance(size, p, gradient);
    else if (shape < SHAPE_PLANE)
        distance = revolved_distance(shape, size.xy, p, gradient);
    return distance;
}

float shape_distance(uint shape, vec3 size, vec3 p)
{
    vec3 gradient;
    return shape_distance(shape, size, p, gradient);
}
