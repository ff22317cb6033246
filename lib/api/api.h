// api.h - what the opaque handles are.
#ifndef HAIR_API_API_H
#define HAIR_API_API_H

#include "lib/api/fields.h"
#include "lib/draw/draw.h"
#include "lib/field/field.h"
#include "lib/gl/ledger.h"

struct hair_context {
    hair_host host;
    struct hair_gl gl;
    struct hair_forms forms; // that instances' fields share
};

struct hair_shader {
    hair_context* context;
    struct hair_gl_shader gl;
};

// What was asked for in a frame, beside what ran.
struct hair_asked {
    int asleep;
    uint32_t views[3],
        unseen[3]; // in colour, in depth only, of opacity: of hair, and of them those that show none of it
    int listed, expanded; // by a path that takes that
    int hides; // with what may hide hair
};

struct hair_instance {
    hair_context* context;
    char label[64];
    double max_dt; // s
    int has_slowed; // dt was beyond max_dt, and the log has said so
    struct hair_rods_softened told; // how guides are softened, as the log has it
    int has_left_out; // guides pass through some solids, and the log has said so
    hair_vec3 reach[2]; // bounds of where hair can be, in the head's frame, but for ties
    float longest; // strand, as far as it may stretch. m
    struct hair_sim sim;
    struct hair_smooth smooth;
    struct hair_draw draw;
    struct hair_solid_field field;
    struct hair_gl_ledger ledger;
    struct hair_asked asked[HAIR_GL_FRAMES]; // in the frames of the ledger
};

// Bounds of where strands of a groom can be, in its space. Returns how long they may become.
float hair_find_reach(const hair_groom* groom, hair_vec3 bounds[2]);

// HAIR_ERROR_OPENGL unless a context is current: OpenGL without one does nothing, or worse.
hair_result hair_check_current(const hair_context* context);

// Rigid, and not too far.
hair_result hair_check_transform(const hair_instance* hair, const char* name, const float* transform,
                                 struct hair_pose* out);

// lent.c: textures of the host's, as far as a draw of `view` reads them.
hair_result hair_check_lent(const hair_instance* hair, const hair_view* view);

// report.c: enter the context for work that is written down; and the frame under way, after which the next begins.
void hair_enter(hair_instance* hair);
struct hair_asked* hair_asked_now(hair_instance* hair);
void hair_begin_frame(hair_instance* hair);

// The field as the last step left head and solids. [GL], with the context entered.
hair_result hair_update_field(hair_instance* hair);

#endif
