// hair_grid_rigid.glsl - the rigid motion of the hair around a node. It has the momentum and the
// angular momentum of this hair, by the node's weights. A pull towards it changes neither. This is
// the velocity damping of Mueller et al. (2007), applied per node.

struct sums { // Sums about the node
    float mass;
    vec3  momentum, moment, angular;
    // Sums of mass times products of coordinates: xx, yy, zz, and yz, zx, xy.
    vec3  squares, products;
};

struct motion {
    vec3 centre; // Centre of mass from the node, in cells
    vec3 speed;  // Velocity of the centre
    vec3 turn;   // Angular velocity
};

// Return the inertia per mass that is added about each axis, in cells^2. A straight strand has none
// about its own axis. Sums of floats have errors of 1e-7, and the grid's sums have errors of one
// unit per vertex. The added inertia keeps these errors from making a large angular velocity.
float min_inertia(float units) { return 1e-5 + 16.0 / units; }

// Solve I w = l by I = L D L^T. Pivots are at least `min_value`, even with rounding.
vec3 solve_inertia(vec3 diagonal, vec3 products, vec3 l, float min_value)
{
    float xy = -products.z, xz = -products.y, yz = -products.x;
    float by_x = xy / diagonal.x, to_z = xz / diagonal.x;
    float d_y = max(diagonal.y - by_x * xy, min_value), e = yz - to_z * xy, by_y = e / d_y;
    float d_z = max(diagonal.z - to_z * xz - by_y * e, min_value);
    float y = l.y - by_x * l.x, z = l.z - to_z * l.x - by_y * y;
    vec3  w;
    w.z = z / d_z;
    w.y = y / d_y - by_y * w.z;
    w.x = l.x / diagonal.x - by_x * w.y - to_z * w.z;
    return w;
}

motion rigid_motion(sums s)
{
    float min_value = min_inertia(s.mass);
    vec3 c = s.moment / s.mass, v = s.momentum / s.mass;
    vec3 squares = max(s.squares / s.mass - c * c, vec3(0.0)), products = s.products / s.mass - c.yzx * c.zxy;
    vec3 inertia = squares.yzx + squares.zxy + min_value;
    return motion(c, v, solve_inertia(inertia, products, s.angular / s.mass - cross(c, v), min_value));
}

vec3 speed_at(motion m, vec3 from_node) { return m.speed + cross(m.turn, from_node - m.centre); }
