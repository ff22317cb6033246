// shared.h - constants, binding slots and struct layouts that C, C++ and GLSL share, by subject.
//
// Members are 4-byte scalars, hair_vec4, hair_mat4, or arrays of structs of these. The size of a
// struct is a multiple of 16 bytes. With these rules std430, std140, C and C++ give the same layout
// without padding. A vec3 must never be used here, because it is aligned as a vec4 but takes 12
// bytes. The asserts of HAIR_SIZE and tests/gpu/layout_test.c check the rules.
//
// A file uses names of the files before it, and includes none. Everything includes this file.
#ifndef HAIR_SHARED_H
#define HAIR_SHARED_H

#include "shared/types.h"
#include "shared/slots.h"
#include "shared/units.h"
#include "shared/limits.h"
#include "shared/groom.h"
#include "shared/collide.h"
#include "shared/field.h"
#include "shared/wind.h"
#include "shared/sim.h"
#include "shared/strands.h"
#include "shared/light.h"
#include "shared/draw.h"

#endif
