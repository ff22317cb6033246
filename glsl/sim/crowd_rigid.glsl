// crowd_rigid.glsl - the rigid motion that has the momentum and the angular momentum of what is around a node, by the
// node's weights (the velocity damping of Müller et al. 2007, of each node). To be drawn to it takes neither.

struct sums { // about the node
    float mass;
    vec3  momentum, moment, angular;
    vec3  squares, products; // of positions: xx, yy, zz; yz, zx, xy
};

struct motion {
    vec3 centre; // from the node, in cells
    vec3 speed;  // of the centre
    vec3 turn;   // angular velocity
};

// Return the inertia by mass, cells^2, that is added about each axis. A straight strand has none about its own. Sums of
// floats are off by 1e-7, and the grid's by a unit for each vertex: neither is to make much angular velocity.
float least_inertia(float units) { return 1e-5 + 16.0 / units; }

// Solve I w = l by I = L D L^T. No pivot is below the least inertia but by rounding.
vec3 solve_inertia(vec3 diagonal, vec3 products, vec3 l, float least)
{
    float xy = -products.z, xz = -products.y, yz = -products.x;
    float by_x = xy / diagonal.x, to_z = xz / diagonal.x;
    float d_y = max(diagonal.y - by_x * xy, least), e = yz - to_z * xy, by_y = e / d_y;
    float d_z = max(diagonal.z - to_z * xz - by_y * e, least);
    float y = l.y - by_x * l.x, z = l.z - to_z * l.x - by_y * y;
    vec3  w;
    w.z = z / d_z;
    w.y = y / d_y - by_y * w.z;
    w.x = l.x / diagonal.x - by_x * w.y - to_z * w.z;
    return w;
}

motion rigid_motion(sums s)
{
    float least = least_inertia(s.mass);
    vec3 c = s.moment / s.mass, v = s.momentum / s.mass;
    vec3 squares = max(s.squares / s.mass - c * c, vec3(0.0)), products = s.products / s.mass - c.yzx * c.zxy;
    vec3 inertia = squares.yzx + squares.zxy + least;
    return motion(c, v, solve_inertia(inertia, products, s.angular / s.mass - cross(c, v), least));
}

vec3 speed_at(motion m, vec3 from_node) { return m.speed + cross(m.turn, from_node - m.centre); }
