// angular.glsl - the angular force of redblack: each segment is pulled to its rest angle with the one before it.
//
// With e the direction of segment i-2, r that of its rest pose under the head, q the least rotation from r to e and
// a the rest link of segment i-1 under the head, vertex i is pulled by the potential
//
//   E = (1 + e.r) / 2 * k/2 |d|^2,   d = x_(i-1) + q a - x_i
//
// All three vertices feel its gradient. A force on vertex i alone would feed every oscillation of the strand.
// The factor (1 + e.r) / 2 makes the gradient continuous where e = -r and q jumps.
struct angular_moves {
    vec3 end;    // displacement of vertex i
    vec3 couple; // displacement of vertex i-2; vertex i-1 moves by -end - couple
};

// x0, x1, x2 are the vertices i-2, i-1, i. `link` and `next` are the rest links between them, in groom space.
// k is the squared frequency times the squared substep. The moves of a strand, all made at once, are stable at any k:
// their sum has the norm 3 k w / (1 + 3/2 k w) < 2, where w is the squared norm of d's derivative.
angular_moves angular_force(vec4 head, vec3 x0, vec3 x1, vec3 x2, vec3 link, vec3 next, float k)
{
    float l = length(link), ratio = length(next) / l, weight = 1.0 + (1.0 + ratio) * (1.0 + ratio) + ratio * ratio;
    vec3  r = rotate(head, link) / l, e = direction_or(x1 - x0, r);
    vec3  arm = rotate(quat_between(r, e), rotate(head, next)), d = (x1 + arm) - x2;
    float stiffness = k / (1.0 + 1.5 * weight * k), open = 0.5 * (1.0 + dot(e, r));
    vec3  torque    = stiffness * cross(arm, d);
    vec3  turning   = open * cross(torque, e) - 0.5 * dot(torque, e) * cross(r, e);
    vec3  opening   = 0.25 * stiffness * dot(d, d) * (r - dot(e, r) * e);
    return angular_moves(open * stiffness * d, (turning + opening) / max(length(x1 - x0), 0.5 * l));
}
