/// hair.h - strand hair in real time: simulated by OpenGL compute, drawn by tessellation.
///
/// A hair_groom is the haircut: immutable, no GPU, shared by any number of heads. A hair_context is the
/// library's hold on one OpenGL context. A hair_instance is one head of living hair: a groom in a context. A
/// hair_collision_mesh is the shape of a collider that no simpler shape describes: immutable and shared as well.
///
///   Words      strand: one hair. guide: a strand that is simulated. follower: a strand made while drawing,
///              by interpolation. root, tip: first and last vertex of a strand. scalp: the surface that
///              roots sit on. collider: a body hair collides with. field: how far the nearest of them is, as a
///              3D texture. step: one call of hair_step, made of substeps.
///   Units      metres, kilograms, seconds, radians. Right-handed; +y is up in the built-in haircuts only.
///              Matrices are 16 floats, column-major. Colours are linear, Rec. 709 primaries.
///   Ownership  Arrays and strings passed in are copied before the call returns. X_create is undone by
///              X_destroy, which takes NULL. A groom or a collision mesh may be destroyed while instances use it. A
///              context is destroyed after its instances.
///   Errors     A fallible call returns a hair_result. Anything but HAIR_OK leaves the object as it was and
///              sends one sentence to hair_host.log. Nothing throws, exits or prints.
///   Threads    No globals. A context and its instances belong to one thread at a time; different contexts,
///              and calls marked [any thread], run in parallel.
///   OpenGL     Calls marked [GL] need the context's OpenGL context current on the calling thread. They use
///              4.5 core, leave the error flag alone, and keep the promise of hair_gl_state.
#ifndef HAIR_HAIR_H
#define HAIR_HAIR_H

#include <hair/hair_base.h>
#include <hair/hair_groom.h>
#include <hair/hair_context.h>
#include <hair/hair_look.h>
#include <hair/hair_physics.h>
#include <hair/hair_instance.h>
#include <hair/hair_view.h>
#include <hair/hair_diagnostics.h>

#endif
