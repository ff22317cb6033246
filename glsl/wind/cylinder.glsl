// cylinder.glsl - what air does to a cylinder in it, of diameter d: by a metre, with u the air's velocity against it, n across
// and t along the cylinder, and Re = |u_n| d / nu,
//
//   F_n = rho d / 2 C(Re) |u_n| u_n,  C = 9.689 Re^-0.78 (1 + f(Re))
//
// of infinite cylinders, 0.1 < Re < 400 (Clift, Grace and Weber 1978, "Bubbles, Drops, and Particles"). What flows along a
// yawed cylinder does not change what flows across it and is carried by it, as heat is at a Prandtl number of 1 (the
// independence principle: Sears 1948), so
//
//   F_t = pi mu Nu(Re) u_t,  Nu = 0.3 + 0.62 Re^(1/2) / (1 + 0.4^(2/3))^(1/4)
//
// as heat passes from cylinders (Churchill and Bernstein 1977).
#ifndef HAIR_CYLINDER_GLSL
#define HAIR_CYLINDER_GLSL

// Across and along, by mu u.
vec2 drag_of(float reynolds)
{
    float l    = log2(max(reynolds, 1e-12)), root = exp2(0.82 * l);
    float more = max(min(0.147 * root, 0.227 * exp2(0.55 * l)), 0.0838 * root);
    return vec2(0.5 * 9.689 * exp2(0.22 * l) * (1.0 + more), 3.14159265 * (0.3 + 0.5563 * sqrt(reynolds)));
}

#endif
