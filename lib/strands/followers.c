// followers.c - inputs of every pass over the vertices of followers: parameters, bindings and
// program variants.
#include "lib/strands/geometry.h"

#include <string.h>

// Maximum iterations of a thread's loop. Mesa's software rasteriser leaves loops after 65,535.
#define MAX_ROUNDS 4096

size_t hair_geometry_count_vertices(const struct hair_geometry* geometry)
{
    return (size_t)geometry->followers * (geometry->look.strand.segments + 1);
}

uint32_t hair_geometry_chunk_count(const struct hair_geometry* geometry, double fraction)
{
    HAIR_ASSERT(fraction >= 0);
    double each = geometry->look.strand.segments + 1.0;
    double mean = fraction * geometry->followers * each / (HAIR_GROUP_SIZE * fmax(geometry->patches, 1));
    double max = geometry->max_isolines * each / ((double)HAIR_GROUP_SIZE * MAX_ROUNDS);
    return 1 + (uint32_t)fmax(mean, max);
}

double hair_geometry_max_radius(const struct hair_geometry* geometry)
{
    const hair_look* look = &geometry->look;
    return (double)(look->strand.radius * hair_curve_max(&look->strand.taper) * geometry->follower.max_width);
}

// Return the weights of the map sets. A fractional `set` blends between two neighbours.
static hair_vec4 weigh_sets(float set, uint32_t sets)
{
    float weight[HAIR_MAP_SETS] = {0}, last = sets > 1 ? (float)(sets - 1) : 0;
    float at = set < last ? set : last;
    int first = (int)at;
    HAIR_ASSERT(0 <= first && first < HAIR_MAP_SETS);
    weight[first] = 1 - (at - (float)first);
    if (first + 1 < HAIR_MAP_SETS) weight[first + 1] = at - (float)first;
    return (hair_vec4){weight[0], weight[1], weight[2], weight[3]};
}

void hair_geometry_write_params(const struct hair_geometry* geometry, struct hair_draw_params* out)
{
    const hair_look* look = &geometry->look;
    HAIR_ASSERT(look->strand.segments > 0);
    memset(out, 0, sizeof *out);
    out->radius = look->strand.radius;
    out->density = look->followers.density;
    out->segments = look->strand.segments;
    out->smooth_vertices = geometry->smooth_vertices;
    out->followers = geometry->followers;
    out->guides = geometry->guides;
    out->shape_vertices = geometry->shape_vertices;
    out->follower_collision = look->followers.collision;
    out->push_out_weight = 1;
    out->map_weights = weigh_sets(look->followers.map_set, geometry->map_sets);
    out->chunks = hair_geometry_chunk_count(geometry, 1);
    out->strand_fraction = 1;
    out->segment_fraction = 1;
    out->strand = geometry->strand_look;
    out->strand.factor_slots = geometry->factors.slots;
    out->strand.factor_count = geometry->factors.count;
    out->strand.max_offset = hair_geometry_max_offset(geometry);
}

float hair_geometry_max_offset(const struct hair_geometry* geometry)
{
    const struct hair_group_look_buffer* groups = &geometry->groups;
    const float* own = geometry->factors.max;
    float curl = groups->factors ? groups->max_curl_radius : 1,
          frizz = groups->factors ? groups->max_frizz : 1;
    hair_look look = geometry->look;
    if (!groups->factors && !geometry->factors.texture) return hair_look_max_offset(&look);
    look.curl.radius *= curl * own[HAIR_FACTOR_CURL_RADIUS];
    for (int i = 0; i <= HAIR_CURVE_INTERVALS; ++i) look.strays.frizz.at[i] *= frizz * own[HAIR_FACTOR_FRIZZ];
    return hair_look_max_offset(&look);
}

void hair_geometry_bind_group_looks(const struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    if (geometry->groups.factors)
        hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_GROUP_LOOKS, 1, &geometry->groups.factors);
}

// Bind the buffers that compute shaders read in place of textures.
static void bind_stored(struct hair_geometry* geometry)
{
    const GLuint buffers[] = {geometry->follower.buffer, geometry->smooth.buffer[1], geometry->patch};
    hair_gl_bind_buffers(geometry->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_FOLLOWER, 3, buffers);
    hair_gl_bind_buffers(geometry->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STORED_POSITION, 1,
                         &geometry->smooth.buffer[0]);
}

void hair_geometry_bind(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    GLuint textures[] = {geometry->smooth.texture[0],
                         geometry->smooth.texture[1],
                         0,
                         geometry->follower.texture,
                         geometry->patch_texture,
                         0,
                         geometry->follower_collision.hit_texture,
                         geometry->follower_collision.repair_texture};
    for (GLuint unit = 0; unit <= HAIR_UNIT_REPAIR; ++unit)
        if (textures[unit]) hair_gl_bind_texture(gl, unit, textures[unit]);
    if (hair_geometry_has_lengths(geometry))
        hair_gl_bind_texture(gl, HAIR_UNIT_LENGTH, geometry->lengths->follower_texture);
    if (geometry->factors.texture)
        hair_gl_bind_texture(gl, HAIR_UNIT_STRAND_FACTOR, geometry->factors.texture);
    bind_stored(geometry);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, 1, &geometry->params);
    hair_geometry_bind_group_looks(geometry);
}

bool hair_geometry_has_lengths(const struct hair_geometry* geometry)
{
    return geometry->lengths->follower_texture != 0;
}

hair_gl_pass hair_geometry_add_style(const struct hair_geometry* geometry, hair_gl_pass pass)
{
    if (hair_geometry_has_lengths(geometry)) pass = hair_gl_add_features(pass, HAIR_GL_WITH(LENGTHS));
    if (geometry->groups.factors) pass = hair_gl_add_features(pass, HAIR_GL_WITH(GROUP_LOOKS));
    if (geometry->factors.texture) pass = hair_gl_add_features(pass, HAIR_GL_WITH(STRAND_FACTORS));
    return hair_look_is_styled(&geometry->look) ? hair_gl_add_features(pass, HAIR_GL_WITH(STYLED)) : pass;
}

bool hair_geometry_has_hits(const struct hair_geometry* geometry)
{
    return geometry->follower_collision.active && geometry->push_out_weight > 0;
}

hair_gl_pass hair_geometry_choose_variant(const struct hair_geometry* geometry, hair_gl_pass pass)
{
    if (hair_geometry_has_hits(geometry)) pass = hair_gl_add_features(pass, HAIR_GL_WITH(HITS));
    return hair_geometry_add_style(geometry, pass);
}
