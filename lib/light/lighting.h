// lighting.h - light on strands: fibre lobes, lights, self-shadow and colours of strands.
#ifndef HAIR_LIGHT_LIGHTING_H
#define HAIR_LIGHT_LIGHTING_H

#include "lib/light/fibre.h"
#include "lib/light/self_shadow.h"
#include "lib/strands/geometry.h"

#include <stdbool.h>

// Texture of the table in fibre.h, created on demand for the fibre parameters requested last.
struct hair_fibres {
    GLuint texture;
    struct hair_fibre params;
};

struct hair_lighting {
    struct hair_gl* gl;
    struct hair_fibres fibres;
    struct hair_self_shadow_state self_shadow;
    // Colours of the groom and of groups. 0 if there are none.
    GLuint groom_color, groom_color_texture;
    bool has_groom_colors, has_group_colors;
    float groom_order; // of guides at rest, see hair_lighting_order()
    float groom_length; // mean length of guides, m
    // 2D views of layers of the application's shadow maps, until hair_lighting_unbind().
    GLuint map_view[2 * HAIR_SHADOW_MAPS];
    GLsizei map_views;
};

hair_result hair_lighting_create(struct hair_lighting* lighting, struct hair_gl* gl,
                                 const struct hair_groom* groom);
void hair_lighting_destroy(struct hair_lighting* lighting);
// Make a buffer of colours, with its texture, as of hair_groom.colors. Alpha is 65535 for the
// colours of a group, and otherwise 0. If `is_shared`, the colours are those of the groom.
hair_result hair_lighting_make_colors(const struct hair_lighting* lighting, uint32_t followers,
                                      const uint16_t* colors, bool is_shared, GLuint out[2]);
// Exchange the buffer of colours and its texture. `has_group_colors` is true if groups have some.
void hair_lighting_swap_colors(struct hair_lighting* lighting, GLuint colors[2], bool has_group_colors);
// Return whether strands have colours of the groom or of groups with a look.
bool hair_lighting_has_strand_colors(const struct hair_lighting* lighting, const hair_look* look);
// Write the parameters of shading. NULL `view` writes only those of the look.
void hair_lighting_write_params(const struct hair_lighting* lighting, const hair_look* look,
                                const struct hair_pose* head, const hair_view* view,
                                struct hair_draw_params* out);
// Bind the textures that only the colour pass reads.
void hair_lighting_bind(struct hair_lighting* lighting, const hair_look* look, const hair_view* view);

// Create or update the fibre table for a look. Defined in fibres.c.
hair_result hair_lighting_ensure_fibres(struct hair_lighting* lighting, const hair_look* look);
void hair_lighting_free_fibres(struct hair_lighting* lighting);

// Functions of order.c.

// Measure the guides at rest for hair_lighting_order().
void hair_lighting_measure_groom(struct hair_lighting* lighting, const struct hair_groom* groom);
// Return how parallel strands are: 1 for straight hair, and 0 for curls. The estimate is from the
// guides at rest, and the curls and the frizz of the look.
float hair_lighting_order(const struct hair_lighting* lighting, const hair_look* look);
// Compute the mean square of the slope that a look's curls show to an eye, and their phase by
// length along a strand, radians/m. The mean is weighted by the cosine of the slope.
void hair_lighting_find_curl(const struct hair_lighting* lighting, const hair_look* look, float* slope,
                             float* rate);

// Shadow maps of one light of a view. `light` is the index of the light. `shadow` is the hair
// shadow map, and `body` the opaque shadow map. 0 means no map.
struct hair_light_maps {
    uint32_t light;
    GLuint shadow, body;
};

// Functions of lights.c.

// Write the parameters of lights.
void hair_lighting_write_lights(struct hair_gl* gl, const hair_look* look, const struct hair_pose* head,
                                const hair_view* view, struct hair_draw_params* out);
// Write the lights of `view` that have shadow maps, in order. Return their number.
uint32_t hair_view_maps(const hair_view* view, struct hair_light_maps out[HAIR_SHADOW_MAPS]);
// Return whether a light of the colour pass has an opaque shadow map.
bool hair_lighting_is_blocked(const hair_view* view);
// Delete what hair_lighting_bind() made for a view.
void hair_lighting_unbind(struct hair_lighting* lighting);
// Bind the application's shadow maps to their texture units.
void hair_lighting_bind_shadow_maps(struct hair_lighting* lighting, const hair_view* view);

// Functions of self_shadow.c.

// Return the number of light values per vertex, or 0 without self-shadowing.
uint32_t hair_lighting_value_count(const hair_look* look, const hair_view* view);
// Create a density grid of at least `nodes` nodes with `each` light values. Hair far away needs few
// nodes, so a grid that is much larger for many views is made anew.
hair_result hair_lighting_ensure_grid(struct hair_lighting* lighting, uint32_t nodes, uint32_t each);
// Compute the light that reaches each vertex in `view`, which requests self-shadowing. `drawn` are
// the parameters of the view, and `params` those of the grid. With `is_part`, only the vertices
// that the view draws are written to the vertex cache. The programs must be compiled.
hair_result hair_lighting_update_self_shadow(struct hair_lighting* lighting, struct hair_geometry* geometry,
                                             const hair_view* view, const struct hair_draw_params* params,
                                             const struct hair_draw_params* drawn, bool is_part);
void hair_lighting_free_self_shadow(struct hair_lighting* lighting);

// Functions of strand_color.c.

// Replace color.root and color.tip by what they are with the pigment of the look. Wetness comes
// after it.
void hair_look_apply_pigment(hair_look* look);
// Apply the wetness of a look to its other settings.
void hair_look_apply_wetness(hair_look* look);
// Write the colours of strands.
void hair_look_write_tint(const hair_look* look, struct hair_tint* out);

#endif
