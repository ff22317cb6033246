// group_look.c - public calls that set and get the looks of groups of strands. Radii are factors in
// the buffer of followers, and colours are in the buffer of the groom's colours. The other factors
// are in a buffer per group. Followers then have their group in the last bits of their radius.
#include "lib/api/api.h"

#include <string.h>

// Buffers that depend on the looks of groups. 0 keeps the present ones.
struct group_buffers {
    struct hair_follower_buffer followers;
    struct hair_group_look_buffer groups;
    GLuint colors[2]; // Buffer and its texture.
};

// Changes between the looks of all groups.
struct group_changes {
    bool radii, colors, factors;
    bool has_factors; // True if any group has factors after the change.
};

static uint32_t group_of(const hair_groom* groom, uint32_t follower)
{
    return groom->guides[groom->followers[follower].guide0].group;
}

// Return a radius whose last bits, which change it by less than a millionth, are a group.
static float hide_group(float radius, uint32_t group)
{
    uint32_t bits;
    HAIR_ASSERT(group < HAIR_STRAND_GROUPS);
    memcpy(&bits, &radius, sizeof bits);
    bits = (bits & ~(uint32_t)(HAIR_STRAND_GROUPS - 1)) | group;
    memcpy(&radius, &bits, sizeof bits);
    return radius;
}

static hair_result make_group_followers(const hair_instance* hair, const hair_group_look* looks,
                                        bool has_factors, struct hair_follower_buffer* out)
{
    const hair_groom* groom = hair->groom;
    const hair_host* host = &hair->context->host;
    size_t size = hair_groom_follower_bytes(groom);
    struct hair_follower* followers = hair_alloc(host, size / 16, 16);
    if (!followers) return hair_fail_memory(host, "the followers of groups");
    memcpy(followers, groom->followers, size);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        float* radius = &followers[i].offset[0].w;
        uint32_t group = group_of(groom, i);
        *radius *= looks[group].radius;
        if (has_factors) *radius = hide_group(*radius, group);
    }
    hair_result result = hair_geometry_make_followers(&hair->geometry, followers, false, out);
    hair_free(host, followers);
    return result;
}

// Write the colours of a follower from root to tip.
static void write_ramp(const hair_group_look* look, uint16_t* out)
{
    for (int k = 0; k <= HAIR_CURVE_INTERVALS; ++k) {
        float t = (float)k / HAIR_CURVE_INTERVALS;
        for (int c = 0; c < 3; ++c)
            out[4 * k + c] =
                (uint16_t)(65535 * ((1 - t) * look->color.root[c] + t * look->color.tip[c]) + 0.5f);
        out[4 * k + 3] = 65535;
    }
}

static bool has_colors(const hair_group_look* looks)
{
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (looks[g].color.enabled) return true;
    return false;
}

static hair_result make_group_colors(const hair_instance* hair, const hair_group_look* looks, GLuint out[2])
{
    const hair_groom* groom = hair->groom;
    const hair_host* host = &hair->context->host;
    const size_t each = 4 * (HAIR_CURVE_INTERVALS + 1);
    if (!has_colors(looks))
        return groom->colors ? hair_lighting_make_colors(&hair->lighting, groom->info.follower_count,
                                                         groom->colors, true, out)
                             : HAIR_OK;
    uint16_t* colors = hair_alloc(host, groom->info.follower_count, each * sizeof *colors);
    if (!colors) return hair_fail_memory(host, "the colours of groups");
    if (groom->colors) memcpy(colors, groom->colors, groom->info.follower_count * each * sizeof *colors);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const hair_group_look* look = &looks[group_of(groom, i)];
        if (look->color.enabled) write_ramp(look, colors + each * i);
    }
    hair_result result =
        hair_lighting_make_colors(&hair->lighting, groom->info.follower_count, colors, false, out);
    hair_free(host, colors);
    return result;
}

static struct hair_group_factors factors_of(const hair_group_look* look)
{
    return (struct hair_group_factors){.curl_radius = look->curl.radius,
                                       .curl_turns = look->curl.frequency,
                                       .frizz = look->frizz,
                                       .clump = look->clump,
                                       .variance = look->roughness * look->roughness};
}

static bool have_equal_factors(const hair_group_look* a, const hair_group_look* b)
{
    return a->curl.radius == b->curl.radius && a->curl.frequency == b->curl.frequency &&
           a->frizz == b->frizz && a->clump == b->clump && a->roughness == b->roughness;
}

static bool has_factors(const hair_group_look* looks)
{
    const hair_group_look usual = hair_group_look_default();
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (!have_equal_factors(&looks[g], &usual)) return true;
    return false;
}

static hair_result make_group_looks(const hair_instance* hair, const hair_group_look* looks,
                                    struct hair_group_look_buffer* out)
{
    struct hair_group_factors factors[HAIR_STRAND_GROUPS];
    _Static_assert(HAIR_STRAND_GROUPS == HAIR_MAX_STRAND_GROUPS, "groups of shaders");
    for (int g = 0; g < HAIR_STRAND_GROUPS; ++g) factors[g] = factors_of(&looks[g]);
    return hair_geometry_make_group_looks(&hair->geometry, factors, out);
}

static struct group_changes find_group_changes(const hair_group_look* before, const hair_group_look* after)
{
    struct group_changes changes = {.has_factors = has_factors(after)};
    changes.radii = changes.has_factors != has_factors(before);
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) {
        const hair_group_look *a = &before[g], *b = &after[g];
        changes.radii |= a->radius != b->radius;
        changes.factors |= !have_equal_factors(a, b);
        changes.colors |= a->color.enabled != b->color.enabled ||
                          (a->color.enabled && memcmp(&a->color, &b->color, sizeof a->color) != 0);
    }
    return changes;
}

// Return whether an instance may use the followers of its groom. With a skinned scalp followers are
// written.
static bool has_followers_of_groom(const hair_instance* hair, const hair_group_look* looks,
                                   const struct group_changes* changes)
{
    bool is_same = !changes->has_factors && !hair_scalp_motion_is_on(&hair->sim);
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) is_same &= looks[g].radius == 1;
    return is_same;
}

// Make the buffers of changed looks. On failure all that have been made are in `made`.
static hair_result make_changed_buffers(const hair_instance* hair, const hair_group_look* looks,
                                        const struct group_changes* changes, struct group_buffers* made)
{
    if (changes->radii && has_followers_of_groom(hair, looks, changes))
        HAIR_TRY(
            hair_geometry_make_followers(&hair->geometry, hair->groom->followers, true, &made->followers));
    else if (changes->radii)
        HAIR_TRY(make_group_followers(hair, looks, changes->has_factors, &made->followers));
    if (changes->factors && changes->has_factors) HAIR_TRY(make_group_looks(hair, looks, &made->groups));
    return changes->colors ? make_group_colors(hair, looks, made->colors) : HAIR_OK;
}

static void free_group_buffers(struct hair_gl* gl, struct group_buffers* buffers)
{
    hair_geometry_free_followers(gl, &buffers->followers);
    hair_gl_free_buffer(gl, &buffers->groups.factors);
    hair_gl_free_array(gl, &buffers->colors[0], &buffers->colors[1]);
}

// Exchange the buffers that have been made, and free those that were there.
static void use_group_buffers(hair_instance* hair, struct group_buffers* made, const hair_group_look* looks,
                              const struct group_changes* changes)
{
    if (changes->radii) hair_geometry_swap_followers(&hair->geometry, &made->followers);
    if (changes->factors) hair_geometry_swap_group_looks(&hair->geometry, &made->groups);
    if (changes->colors) hair_lighting_swap_colors(&hair->lighting, made->colors, has_colors(looks));
    free_group_buffers(&hair->context->gl, made);
    hair_geometry_invalidate(&hair->geometry);
    hair_draw_free_reflectance(&hair->renderer);
}

hair_result hair_instance_set_group_looks(hair_instance* hair,
                                          const hair_group_look looks[HAIR_MAX_STRAND_GROUPS])
{
    const hair_host* host = &hair->context->host;
    if (!hair->group_looks) {
        hair_group_look* own = hair_alloc(host, HAIR_MAX_STRAND_GROUPS, sizeof *own);
        if (!own) return hair_fail_memory(host, "the looks of groups");
        for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) own[g] = hair_group_look_default();
        hair->group_looks = own;
    }
    struct group_buffers made = {0};
    struct group_changes changes = find_group_changes(hair->group_looks, looks);
    hair_result result = make_changed_buffers(hair, looks, &changes, &made);
    if (result) {
        free_group_buffers(&hair->context->gl, &made);
        return result;
    }
    memcpy(hair->group_looks, looks, HAIR_MAX_STRAND_GROUPS * sizeof *looks);
    if (changes.radii || changes.factors || changes.colors) use_group_buffers(hair, &made, looks, &changes);
    return HAIR_OK;
}

hair_result hair_set_group_look(hair_instance* hair, uint32_t group, const hair_group_look* look)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_group_look own, looks[HAIR_MAX_STRAND_GROUPS];
    HAIR_TRY(hair_check_group(hair, group));
    HAIR_TRY(HAIR_COPY_IN_OR_DEFAULT(&hair->context->host, hair_group_look, look, &own));
    HAIR_TRY(hair_check_current(hair->context));
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        looks[g] = hair->group_looks ? hair->group_looks[g] : hair_group_look_default();
    looks[group] = own;
    hair_enter_unprofiled(hair);
    hair_draw_forget_vertices(&hair->renderer);
    return hair_leave(hair->context, hair_instance_set_group_looks(hair, looks));
}

hair_result hair_get_group_look(const hair_instance* hair, uint32_t group, hair_group_look* out)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(hair_check_group(hair, group));
    const hair_group_look usual = hair_group_look_default();
    return HAIR_COPY_OUT(&hair->context->host, hair_group_look,
                         hair->group_looks ? &hair->group_looks[group] : &usual, out);
}
