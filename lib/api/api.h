// api.h - the structs behind the opaque handles.
#ifndef HAIR_API_API_H
#define HAIR_API_API_H

#include "lib/api/budget.h"
#include "lib/asset/strands.h"
#include "lib/base/schema.h"
#include "lib/draw/draw.h"
#include "lib/field/body_grid.h"
#include "lib/field/field.h"
#include "lib/gl/frame_profiler.h"
#include "lib/strands/nearby_vertices.h"

// Instance or shader in the list of its context. It is the first member of its struct.
struct hair_context_member {
    struct hair_context_member *prev, *next;
    // Function that frees everything that the struct owns, but not the struct.
    void (*empty)(struct hair_context_member* member);
};

struct hair_context {
    hair_host host;
    hair_context_desc desc; // of the creation. The memory behind its pointers may be gone.
    struct hair_gl gl;
    struct hair_budget budget; // disabled unless hair_set_budget() sets one
    struct hair_fastest fastest; // render paths that HAIR_RENDER_PATH_AUTO selects
    struct hair_sdf_pool sdf_pool; // shared by the fields of all instances
    struct hair_batch batch; // small heads of lists that are drawn together
    struct hair_context_member* members; // all that own something, newest first
    uint32_t holder_count; // the application, until it destroys the context, and all members
    bool is_dead; // true once its OpenGL objects and those of its members are gone
};

struct hair_body {
    struct hair_context_member member;
    hair_context* context;
    hair_body_desc desc; // of the creation, without arrays
    hair_collision_mesh* mesh;
    uint32_t* triangles;
    float *position, *next; // last array in voxels from the first node, and memory for the next
    bool is_from_buffer; // true if a buffer has been given since
    struct hair_body_grid grid;
};

struct hair_shader {
    struct hair_context_member member;
    hair_context* context;
    struct hair_gl_shader gl;
};

// Requests of a frame, in addition to the work that ran.
struct hair_frame_requests {
    int asleep;
    // Number of views in colour, in depth only and of opacity. `unseen` counts those that show no
    // hair.
    uint32_t views[3], unseen[3];
    int strand_list, vertex_cache; // 1 if a view needs the strand list, or the vertex cache
    int occlusion; // 1 if a view uses occlusion culling
};

// Settings of hair_desc that an instance is created with.
struct hair_creation {
    hair_thread_mapping thread_mapping;
    bool uses_prepass; // true if a prepass finds followers inside colliders
    float field_voxel; // m
};

// Size of the voxels of an instance's field, which is coarser where all views are far away.
struct hair_field_detail {
    float voxel; // m, in full detail
    uint32_t doublings; // number of times that it is doubled
    uint32_t spare_views; // number of views in sequence that need fewer voxels
};

// Frames in which an instance is stepped, and guides that are simulated then.
struct hair_pace {
    // Minima of hair_sim.interval and of the stride of guides that views want since the last step.
    // 0 without views.
    uint32_t wanted_interval, wanted_stride;
    double pending; // Time that the next step advances by in addition to its own, s.
    struct hair_pose head; // Head at the end of `pending`.
};

struct hair_instance {
    struct hair_context_member member;
    hair_context* context;
    char label[64];
    double max_dt; // s
    struct hair_creation creation; // settings that cannot change
    hair_groom* groom; // a reference
    hair_group_look* group_looks; // of HAIR_MAX_STRAND_GROUPS groups. NULL until one is set.
    int has_slowed; // 1 if dt has exceeded max_dt and the log has said so
    struct hair_rods_softened told; // state of softened guides that was logged last
    uint32_t told_pending; // number of programs that hair_precompile() has last waited for
    int has_left_out; // 1 if guides pass through some colliders and the log has said so
    hair_vec3 bounds[2]; // bounds of the hair in the head's frame, without pins
    hair_look look; // look of the application, before its wetness is applied
    float longest; // maximum length of a strand with its stretch, m
    struct hair_sim sim;
    struct hair_geometry geometry;
    struct hair_lighting lighting;
    struct hair_renderer renderer;
    struct hair_collider_field field;
    struct hair_field_detail field_detail;
    struct hair_gl_profiler profiler;
    struct hair_gl_owner memory; // memory of buffers and textures by category
    struct hair_frame_requests requests[HAIR_GL_FRAMES]; // per frame of the ledger
    struct hair_budget_part budget; // of the budget of the context
    struct hair_pace pace;
    bool is_listed; // true while a list that has the instance is checked
};

// Create what every room has of an instance, whose `label`, `look` and `creation` are set. On
// failure hair_instance_empty() frees what there is. [GL], with the context entered.
hair_result hair_instance_create_rooms(hair_instance* hair, const hair_groom* groom,
                                       struct hair_sim_desc* sim);
// Set the looks of all groups. [GL], with the context entered. On failure nothing has changed.
hair_result hair_instance_set_group_looks(hair_instance* hair,
                                          const hair_group_look looks[HAIR_MAX_STRAND_GROUPS]);
// Free everything that an instance owns. Function of hair_context_member.
void hair_instance_empty(struct hair_context_member* member);

// Create the buffers of a body, and compute the distances to it. On failure nothing is left.
hair_result hair_body_create_grid(hair_body* body);
// Free everything of OpenGL that a body owns. Function of hair_context_member.
void hair_body_empty(struct hair_context_member* member);

// Compute the bounds of a groom's strands in its space. Return their maximum length.
float hair_find_bounds(const hair_groom* groom, hair_vec3 bounds[2]);

// Add a member to its context, and hold the context for it. `empty` frees what the member owns.
void hair_context_add(hair_context* context, struct hair_context_member* member,
                      void (*empty)(struct hair_context_member* member));
// Log that OpenGL objects are left, if the OpenGL context is not current. Those of a lost context
// are gone.
void hair_context_tell_left(hair_context* context);
// Empty a member unless that has been done, and let go of its context. The context may be freed.
// OpenGL objects are left if the OpenGL context is not current.
void hair_context_remove(hair_context* context, struct hair_context_member* member);

// Return HAIR_ERROR_ARGUMENT if a context is NULL or dead.
hair_result hair_check_context(const hair_context* context);
// Return HAIR_ERROR_ARGUMENT if an instance is NULL or its context is dead.
hair_result hair_check_instance(const hair_instance* hair);
// Return HAIR_ERROR_OPENGL unless the OpenGL context of a context is current, and
// HAIR_ERROR_CONTEXT_LOST if the driver has lost it. OpenGL without one is undefined, and names of
// objects mean others in another one.
hair_result hair_check_current(hair_context* context);
// Return `result` at the end of work with OpenGL, or HAIR_ERROR_CONTEXT_LOST if the context was
// lost meanwhile.
hair_result hair_check_lost(hair_context* context, hair_result result);
// Leave the context, and return like hair_check_lost().
hair_result hair_leave(hair_context* context, hair_result result);

// Check that a desc has the arrays of strands, and all or nothing of a scalp.
hair_result hair_check_groom_arrays(const hair_host* host, const hair_groom_desc* desc);
// Copy the map sets of a desc into `own`, and let the desc point there. Their values are checked
// later.
hair_result hair_copy_map_sets(const hair_host* host, hair_groom_desc* desc, hair_map_set own[HAIR_MAP_SETS]);
// Copy the attributes of a desc, and let it point at the copies. Their arrays are checked later.
hair_result hair_copy_attributes(const hair_host* host, hair_groom_desc* desc,
                                 hair_strand_attribute own[HAIR_MAX_ATTRIBUTES]);

// Log how guides are softened, if this differs from the last log.
void hair_tell_softened(hair_instance* hair);
// Advance instances of a context by their pending time. Return the first failure. Instances that
// fail keep their pending time.
hair_result hair_catch_up(hair_instance* const* list, uint32_t count);
// Check that a list has instances of one context, each once.
hair_result hair_check_list(hair_instance* const* list, uint32_t count);

// Check the number of a group of strands.
hair_result hair_check_group(const hair_instance* hair, uint32_t group);

// Check that a transform is rigid and not too far from the origin. Convert it to a pose.
hair_result hair_check_transform(const hair_instance* hair, const char* name, const float* transform,
                                 struct hair_pose* out);

// Check how positions are passed, and that OpenGL is current. Convert their space to a pose.
hair_result hair_check_positions(hair_instance* hair, size_t stride, const float* to_world,
                                 struct hair_pose* space);
// Return the positions packed. Return NULL and set `result` if memory for `what` runs out or a
// position is invalid.
float* hair_copy_positions(const hair_instance* hair, const char* what, const float* positions,
                           uint32_t count, size_t stride, hair_result* result);
// Check a buffer of `count` positions. `from` receives the aligned offset at which it is bound, and
// `size` the bytes from there.
hair_result hair_check_position_buffer(const hair_context* context, const char* label, const char* what,
                                       uint32_t buffer, size_t offset, size_t stride, uint32_t count,
                                       size_t* from, size_t* size);

// Functions of pace.c.

struct hair_view_copy;
// Note how large hair is in a view, and what the view would need to give up nothing.
void hair_pace_note_size(hair_instance* hair, const struct hair_view_copy* copy);
// Let the next step wait if its turn has not come. Return false if the step is due.
bool hair_pace_wait(hair_instance* hair, double time);
// Return the pose of the head with which hair is drawn.
const struct hair_pose* hair_shown_head(const hair_instance* hair);

// A view of the application, and the structs that it points to, checked and copied.
struct hair_view_copy {
    hair_view view;
    bool has_lod; // true if the application has set a hair_lod
    hair_lod lod;
    hair_light light[HAIR_LIGHTS];
};
hair_result hair_copy_view(const hair_instance* hair, const hair_view* view, struct hair_view_copy* out);
// Reduce the level of detail of a view by the budget of the context.
void hair_reduce_view(const hair_instance* hair, struct hair_view_copy* copy);
// Make the plan of a view, which must be validated. Defined in draw.c.
void hair_make_plan(const hair_instance* hair, const hair_view* view, struct hair_draw_plan* out);

// Check the textures that the application passes to a view, as far as a draw of `view` reads them.
hair_result hair_check_view_textures(const hair_instance* hair, const hair_view* view);

// Enter the context for work that the ledger records.
void hair_enter(hair_instance* hair);
// Enter the context for work that the ledger records, and that counts towards the budget of the
// context. OpenGL must be current.
void hair_enter_frame(hair_instance* hair);
// Leave the context after hair_enter_frame(). Return like hair_leave().
hair_result hair_leave_frame(hair_context* context, hair_result result);
// Enter the context for work of an instance that the ledger does not record. Memory is recorded.
void hair_enter_unprofiled(hair_instance* hair);
// Return the requests of the current frame.
struct hair_frame_requests* hair_current_requests(hair_instance* hair);
// End the current frame and begin the next.
void hair_begin_frame(hair_instance* hair);

// Update the field, in full detail, to the head and colliders of the last step. [GL], with the
// context entered.
hair_result hair_update_field(hair_instance* hair);
// Choose the size of voxels for the view that is drawn next, before follower collision is needed.
void hair_choose_field_detail(hair_instance* hair);
// Update the field as hair_update_field() does, but in the detail that was chosen last.
hair_result hair_update_view_field(hair_instance* hair);
// Update the field for a step that ends with the head at `head`. What views and reads have written
// does not change what is written.
hair_result hair_update_field_for_step(hair_instance* hair, const struct hair_pose* head);

// Read the vertices of followers near a shape in full detail. Their positions and the shape are
// from hair_sim.head_at_last_step. The caller frees the arrays, also on failure. Defined in view.c.
hair_result hair_read_nearby_vertices(hair_instance* hair, const struct hair_cutter* cutter,
                                      struct hair_nearby_vertices* out);

// Find followers inside colliders and push them out before they are drawn or read, unless nobody
// can see this. Colliders block the light of a density grid in any case. Defined in draw.c.
hair_result hair_update_follower_collision(hair_instance* hair);

#endif
