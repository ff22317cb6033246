// cylinder.glsl - drag of air on an infinite cylinder of diameter d, per metre. u is the velocity
// of the air relative to the cylinder, with the parts u_n across it and u_t along it. rho is the
// density and nu the kinematic viscosity of the air. mu is its dynamic viscosity. Re = |u_n| d / nu
// is the Reynolds number.
//
//   F_n = rho d / 2 C(Re) |u_n| u_n,  C = 1 + 9.75 Re^-0.744
//
// The form of C is that of White 1991, "Viscous Fluid Flow". Its coefficients fit Kaplun 1957,
// Dennis and Chang 1970, Park, Kwon and Choi 1998 and Wieselsberger 1922 within a tenth, for 0.1 <
// Re < 400.
//
// The flow along a yawed cylinder does not change the flow across it (the independence principle,
// Sears 1948). The flow across carries it as it carries heat at a Prandtl number of 1. The drag
// along therefore follows the heat transfer of cylinders (Churchill and Bernstein 1977):
//
//   F_t = pi mu Nu(Re) u_t,  Nu = 0.3 + 0.62 Re^(1/2) / (1 + 0.4^(2/3))^(1/4)
#ifndef HAIR_CYLINDER_GLSL
#define HAIR_CYLINDER_GLSL

// Return the drag across and along the cylinder, divided by mu u.
vec2 drag_of(float reynolds)
{
    float across = reynolds + 9.75 * exp2(0.256 * log2(max(reynolds, 1e-12)));
    return vec2(0.5 * across, 3.14159265 * (0.3 + 0.5563 * sqrt(reynolds)));
}

#endif
