// cylinder.glsl - what air does to a cylinder in it, of diameter d: by a metre, with u the air's velocity against it, n across
// and t along the cylinder, and Re = |u_n| d / nu,
//
//   F_n = rho d / 2 C(Re) |u_n| u_n,  C = 1 + 9.75 Re^-0.744
//
// of infinite cylinders: the form of White 1991, "Viscous Fluid Flow", with what fits Kaplun 1957, Dennis and Chang 1970, Park,
// Kwon and Choi 1998 and Wieselsberger 1922 within a tenth, 0.1 < Re < 400. What flows along a
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
    float across = reynolds + 9.75 * exp2(0.256 * log2(max(reynolds, 1e-12)));
    return vec2(0.5 * across, 3.14159265 * (0.3 + 0.5563 * sqrt(reynolds)));
}

#endif
