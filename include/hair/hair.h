/// hair.h - strand hair in real time, simulated and drawn with OpenGL 4.5: the whole library.
///
/// Objects. A hair_groom is a haircut. It is immutable, lives on the CPU, and can be shared by any
/// number of heads. A hair_context holds the library's objects in one OpenGL context. A
/// hair_instance is the hair of one head: a groom in a context. A hair_collision_mesh is the shape
/// of a collider that no simpler shape describes. It is immutable and can be shared too. A
/// hair_body is such a shape that deforms. It belongs to a context.
///
/// Terms.
///   strand     One hair.
///   guide      A strand that is simulated.
///   follower   A strand that is interpolated between guides when hair is drawn.
///   root, tip  First and last vertex of a strand.
///   scalp      Surface that carries the roots.
///   patch      Group of neighbouring followers that is culled together.
///   collider   Rigid body that hair collides with.
///   field      Distance to the nearest collider, as a 3D texture.
///   step       One call of hair_step(). A step consists of substeps.
///
/// Units. Metres, kilograms, seconds and radians. Coordinates are right-handed. +y is up only in
/// the built-in haircuts. Matrices have 16 floats in column-major order. Colours are linear with
/// Rec. 709 primaries.
///
/// Ownership. Arrays and strings that are passed in are copied before the call returns, unless the
/// comment says otherwise. X_create() is undone by X_destroy(), which accepts NULL. A groom or a
/// collision mesh may be destroyed while instances use it. A context may be destroyed or abandoned
/// before its instances, bodies and shaders, which are orphans then. Every call on an orphan fails
/// with HAIR_ERROR_ARGUMENT. Destroying an orphan frees its memory and needs no OpenGL. Callbacks
/// of hair_host must work until the last orphan is destroyed.
///
/// Errors. A call that can fail returns a hair_result. After any result but HAIR_OK and
/// HAIR_ERROR_CONTEXT_LOST, the object is as it was, and one sentence has been sent to
/// hair_host.log of the object or the desc, if there is one. The comment of each call lists its
/// results other than HAIR_OK after "Errors:". No call throws, exits or prints.
///
/// Threads. There are no globals. A context and its instances belong to one thread at a time.
/// Different contexts may be used in parallel, and calls marked "Any thread" too.
///
/// OpenGL. The comment of each call tells its needs after "OpenGL:". "required" means that the
/// OpenGL context of the hair_context is current on the calling thread. Calls fail with
/// HAIR_ERROR_OPENGL if none or another is current, even one that shares objects with it, because
/// vertex arrays, framebuffers and queries are never shared. Destroying then frees memory, leaves
/// the OpenGL objects and logs that. Calls keep the OpenGL state as hair_gl_state says, and leave
/// the error flag alone. A call that waits for the GPU stalls until the GPU has finished the work
/// so far.
///
/// Loss. A driver may lose an OpenGL context that was created with reset notification. Calls that
/// need OpenGL then fail with HAIR_ERROR_CONTEXT_LOST, and make no OpenGL calls once one has failed
/// so. That call itself may have changed the object. hair_context_restore() brings back everything
/// in a new OpenGL context. Destroying and hair_context_abandon() work without one.
///
/// Comments of fields. The range is in brackets, and then comes the default. A field with a range
/// is checked, and a value outside it is refused with HAIR_ERROR_ARGUMENT.
#ifndef HAIR_HAIR_H
#define HAIR_HAIR_H

#include <hair/hair_base.h>
#include <hair/hair_groom.h>
#include <hair/hair_context.h>
#include <hair/hair_instance.h>
#include <hair/hair_physics.h>
#include <hair/hair_colliders.h>
#include <hair/hair_body.h>
#include <hair/hair_wind.h>
#include <hair/hair_look.h>
#include <hair/hair_targets.h>
#include <hair/hair_cut.h>
#include <hair/hair_view.h>
#include <hair/hair_diagnostics.h>
#include <hair/hair_buffers.h>
#include <hair/hair_members.h>

#endif
