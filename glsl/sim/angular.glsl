// angular.glsl - the angular force of redblack. The force pulls each segment to its rest angle with
// the previous segment.
//
// Let e be the direction of segment i-2, r its rest direction under the head, and q the least
// rotation from r to e. Let a be the rest link of segment i-1 under the head. The potential of
// vertex i is
//
//   E = (1 + e.r) / 2 * k/2 |d|^2,   d = x_(i-1) + q a - x_i
//
// Its gradient acts on all three vertices. A force on vertex i alone would feed every oscillation
// of the strand. The factor (1 + e.r) / 2 makes the gradient continuous at e = -r, where q jumps.
struct angular_moves {
    vec3 end;    // displacement of vertex i
    // Displacement of vertex i-2. Vertex i-1 moves by -end - couple.
    vec3 couple;
};

// Compute the moves of the vertices x0, x1, x2 = i-2, i-1, i. `link` and `next` are the rest links
// between them, in groom space. k is the squared frequency times the squared substep. All moves of
// a strand are made at once, and are stable at any k. Their sum has the norm 3 k w / (1 + 3/2 k w)
// < 2. The symbol w is the squared norm of the derivative of d.
angular_moves angular_force(vec4 head, vec3 x0, vec3 x1, vec3 x2, vec3 link, vec3 next, float k)
{
    float l = length(link), ratio = length(next) / l,
          weight = 1.0 + (1.0 + ratio) * (1.0 + ratio) + ratio * ratio;
    vec3  r = rotate(head, link) / l, e = direction_or(x1 - x0, r);
    vec3  arm = rotate(quat_between(r, e), rotate(head, next)), d = (x1 + arm) - x2;
    float stiffness = k / (1.0 + 1.5 * weight * k), open = 0.5 * (1.0 + dot(e, r));
    vec3  torque    = stiffness * cross(arm, d);
    vec3  turning   = open * cross(torque, e) - 0.5 * dot(torque, e) * cross(r, e);
    vec3  opening   = 0.25 * stiffness * dot(d, d) * (r - dot(e, r) * e);
    return angular_moves(open * stiffness * d, (turning + opening) / max(length(x1 - x0), 0.5 * l));
}
