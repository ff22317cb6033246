// groom.c - public calls on grooms.
#include "lib/api/api.h"

#include <stdio.h>

hair_result hair_check_groom_arrays(const hair_host* host, const hair_groom_desc* desc)
{
    if (!desc->positions) return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.positions is NULL");
    if (!desc->strand_vertices)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.strand_vertices is NULL");
    if (!desc->scalp_positions) {
        if (desc->scalp_vertex_count || desc->scalp_triangle_count || desc->scalp_triangles ||
            desc->scalp_density || desc->scalp_uvs)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_positions is NULL but other scalp fields are not");
        return HAIR_OK;
    }
    if (!desc->scalp_triangles)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.scalp_triangles is NULL");
    if (desc->scalp_vertex_count < 3 || desc->scalp_triangle_count < 1)
        return hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "hair_groom_desc has a scalp of %u vertices and %u triangles, not of 3 and 1 or more",
            desc->scalp_vertex_count, desc->scalp_triangle_count);
    return HAIR_OK;
}

// Copy a map set, and name its place in the sentences of the log.
static hair_result copy_map_set(const hair_host* host, const hair_map_set* set, int i, hair_map_set* own)
{
    char name[48];
    struct hair_schema schema = hair_schema_of_hair_map_set();
    HAIR_TRY(hair_check_header(host, schema.name, set->header));
    snprintf(name, sizeof name, "hair_groom_desc.map_sets[%d]", i);
    schema.name = name;
    return hair_schema_copy_in(host, set, own, schema);
}

hair_result hair_copy_map_sets(const hair_host* host, hair_groom_desc* desc, hair_map_set own[HAIR_MAP_SETS])
{
    for (int i = 0; i < HAIR_MAP_SETS; ++i) {
        if (!desc->map_sets[i]) continue;
        if (i && !desc->map_sets[i - 1])
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.map_sets[%d] is NULL but [%d] is not", i - 1, i);
        if (!desc->scalp_positions)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_positions is NULL but map_sets[%d] is not", i);
        HAIR_TRY(copy_map_set(host, desc->map_sets[i], i, &own[i]));
        desc->map_sets[i] = &own[i];
    }
    return HAIR_OK;
}

// Copy an attribute, and name its place in the sentences of the log.
static hair_result copy_attribute(const hair_host* host, const hair_strand_attribute* attribute, uint32_t i,
                                  hair_strand_attribute* own)
{
    char name[48];
    struct hair_schema schema = hair_schema_of_hair_strand_attribute();
    HAIR_TRY(hair_check_header(host, schema.name, attribute->header));
    snprintf(name, sizeof name, "hair_groom_desc.strand_attributes[%u]", i);
    schema.name = name;
    return hair_schema_copy_in(host, attribute, own, schema);
}

hair_result hair_copy_attributes(const hair_host* host, hair_groom_desc* desc,
                                 hair_strand_attribute own[HAIR_MAX_ATTRIBUTES])
{
    const hair_strand_attribute* attributes = desc->strand_attributes;
    HAIR_ASSERT(desc->strand_attribute_count <= HAIR_MAX_ATTRIBUTES);
    if (desc->strand_attribute_count && !attributes)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.strand_attributes is NULL but strand_attribute_count is %u",
                         desc->strand_attribute_count);
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) {
        // Attributes are as far apart as the caller's struct is long.
        const void* at = (const char*)attributes + i * (size_t)attributes->header.size;
        HAIR_TRY(copy_attribute(host, at, i, &own[i]));
        if (own[i].map.source != HAIR_MAP_SOURCE_NONE && !desc->scalp_positions)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_positions is NULL but strand_attributes[%u].map is not",
                             i);
    }
    desc->strand_attributes = own;
    return HAIR_OK;
}

// Prepare the guides for the physics of instances. The solver redblack has no rods.
static hair_result prepare_rods(hair_groom* groom, const hair_physics* physics, hair_solver solver)
{
    const struct hair_rod_source source = {.host = &groom->host,
                                           .tasks = &groom->tasks,
                                           .guides = groom->guides,
                                           .rest = groom->rest,
                                           .factors = groom->guide_factors,
                                           .count = groom->info.guide_count,
                                           .vertices = groom->info.guide_vertex_count,
                                           .max_vertices = groom->max_vertices};
    if (solver == HAIR_SOLVER_REDBLACK) return HAIR_OK;
    groom->free_prepared = hair_prepared_rods_free;
    return hair_prepared_rods_create(&source, physics, solver, &groom->prepared);
}

hair_result hair_groom_create(const hair_groom_desc* desc, hair_groom** out)
{
    hair_host host = HAIR_HOST_OF(desc);
    hair_groom_desc own;
    hair_import import;
    hair_physics physics;
    hair_map_set maps[HAIR_MAP_SETS];
    hair_strand_attribute attributes[HAIR_MAX_ATTRIBUTES];
    HAIR_TRY(HAIR_COPY_IN(&host, hair_groom_desc, desc, &own));
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(&host, hair_import, own.import, &import));
    HAIR_TRY(hair_check_groom_arrays(&host, &own));
    HAIR_TRY(hair_copy_map_sets(&host, &own, maps));
    HAIR_TRY(hair_copy_attributes(&host, &own, attributes));
    if (own.physics) HAIR_TRY(HAIR_COPY_IN(&host, hair_physics, own.physics, &physics));
    if (own.tasks && !own.tasks->run)
        return hair_fail(&host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.tasks has no function run");
    if (!out) return hair_fail(&host, HAIR_ERROR_ARGUMENT, "out is NULL");
    hair_groom* groom = NULL;
    HAIR_TRY(hair_groom_build(&host, &own, &import, NULL, &groom));
    hair_result result = own.physics ? prepare_rods(groom, &physics, own.solver) : HAIR_OK;
    if (result)
        hair_groom_release(groom);
    else
        *out = groom;
    return result;
}

void hair_groom_destroy(hair_groom* groom)
{
    hair_groom_release(groom);
}

const char* hair_strand_attribute_name(hair_strand_attribute_kind kind)
{
    return (size_t)kind < HAIR_ATTRIBUTE_KINDS ? hair_attribute_name_of(kind) : NULL;
}

hair_result hair_groom_describe(const hair_groom* groom, hair_groom_info* out)
{
    if (!groom) return HAIR_ERROR_ARGUMENT;
    return HAIR_COPY_OUT(&groom->host, hair_groom_info, &groom->info, out);
}

hair_result hair_groom_get_guides(const hair_groom* groom, uint32_t* vertices, uint32_t guide_capacity,
                                  float* positions, uint32_t vertex_capacity)
{
    if (!groom) return HAIR_ERROR_ARGUMENT;
    if ((!vertices && guide_capacity) || (!positions && vertex_capacity))
        return hair_fail(&groom->host, HAIR_ERROR_ARGUMENT,
                         "vertices or positions is NULL but guide_capacity is %u and vertex_capacity is %u",
                         guide_capacity, vertex_capacity);
    const hair_groom_info* info = &groom->info;
    for (uint32_t i = 0; i < info->guide_count && i < guide_capacity; ++i)
        vertices[i] = groom->guides[i].count;
    for (uint32_t i = 0; i < info->guide_vertex_count && i < vertex_capacity; ++i) {
        hair_vec4 at = groom->rest[i].position;
        hair_store3(positions + 3 * (size_t)i, hair_v3(at.x, at.y, at.z));
    }
    return HAIR_OK;
}

hair_result hair_groom_get_groups(const hair_groom* groom, uint8_t* groups, uint32_t guide_capacity)
{
    if (!groom) return HAIR_ERROR_ARGUMENT;
    if (!groups && guide_capacity)
        return hair_fail(&groom->host, HAIR_ERROR_ARGUMENT, "groups is NULL but guide_capacity is %u",
                         guide_capacity);
    for (uint32_t i = 0; i < groom->info.guide_count && i < guide_capacity; ++i)
        groups[i] = (uint8_t)groom->guides[i].group;
    return HAIR_OK;
}
