// group_look.c - public calls that set and get the looks of groups of strands. Radii are factors in
// the buffer of followers, and colours are in the buffer of the groom's colours.
#include "lib/api/api.h"

#include <string.h>

// Buffers that depend on the looks of groups. 0 keeps the present ones.
struct group_buffers {
    struct hair_follower_buffer followers;
    GLuint colors[2]; // Buffer and its texture.
};

static uint32_t group_of(const hair_groom* groom, uint32_t follower)
{
    return groom->guides[groom->followers[follower].guide0].group;
}

static hair_result make_group_followers(const hair_instance* hair, const hair_group_look* looks,
                                        struct hair_follower_buffer* out)
{
    const hair_groom* groom = hair->groom;
    const hair_host* host = &hair->context->host;
    size_t size = hair_groom_follower_bytes(groom);
    struct hair_follower* followers = hair_alloc(host, size / 16, 16);
    if (!followers) return hair_fail_memory(host, "the followers of groups");
    memcpy(followers, groom->followers, size);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i)
        followers[i].offset[0].w *= looks[group_of(groom, i)].radius;
    hair_result result = hair_geometry_make_followers(&hair->geometry, size, followers, out);
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
    if (!groom->colors && !has_colors(looks)) return HAIR_OK;
    uint16_t* colors = hair_alloc(host, groom->info.follower_count, each * sizeof *colors);
    if (!colors) return hair_fail_memory(host, "the colours of groups");
    if (groom->colors) memcpy(colors, groom->colors, groom->info.follower_count * each * sizeof *colors);
    for (uint32_t i = 0; i < groom->info.follower_count; ++i) {
        const hair_group_look* look = &looks[group_of(groom, i)];
        if (look->color.enabled) write_ramp(look, colors + each * i);
    }
    hair_result result = hair_lighting_make_colors(&hair->lighting, groom->info.follower_count, colors, out);
    hair_free(host, colors);
    return result;
}

static bool have_equal_radii(const hair_group_look* a, const hair_group_look* b)
{
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (a[g].radius != b[g].radius) return false;
    return true;
}

static bool have_equal_colors(const hair_group_look* a, const hair_group_look* b)
{
    for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g)
        if (a[g].color.enabled != b[g].color.enabled ||
            (a[g].color.enabled && memcmp(&a[g].color, &b[g].color, sizeof a[g].color) != 0))
            return false;
    return true;
}

// Exchange the buffers that have been made, and free those that were there.
static void use_buffers(hair_instance* hair, struct group_buffers* made, const hair_group_look* looks,
                        bool changes_colors)
{
    struct hair_gl* gl = &hair->context->gl;
    if (made->followers.buffer) hair_geometry_swap_followers(&hair->geometry, &made->followers);
    if (changes_colors) hair_lighting_swap_colors(&hair->lighting, made->colors, has_colors(looks));
    hair_geometry_free_followers(gl, &made->followers);
    hair_gl_free_array(gl, &made->colors[0], &made->colors[1]);
    hair_geometry_invalidate(&hair->geometry);
    hair_draw_free_reflectance(&hair->renderer);
}

hair_result hair_instance_set_group_looks(hair_instance* hair,
                                          const hair_group_look looks[HAIR_MAX_STRAND_GROUPS])
{
    struct hair_gl* gl = &hair->context->gl;
    size_t size = HAIR_MAX_STRAND_GROUPS * sizeof *looks;
    if (!hair->group_looks) {
        hair_group_look* own = hair_alloc(&gl->host, HAIR_MAX_STRAND_GROUPS, sizeof *own);
        if (!own) return hair_fail_memory(&gl->host, "the looks of groups");
        for (int g = 0; g < HAIR_MAX_STRAND_GROUPS; ++g) own[g] = hair_group_look_default();
        hair->group_looks = own;
    }
    struct group_buffers made = {0};
    bool changes_colors = !have_equal_colors(looks, hair->group_looks);
    hair_result result = HAIR_OK;
    if (!have_equal_radii(looks, hair->group_looks))
        result = make_group_followers(hair, looks, &made.followers);
    if (!result && changes_colors) result = make_group_colors(hair, looks, made.colors);
    if (result) {
        hair_geometry_free_followers(gl, &made.followers);
        return result;
    }
    memcpy(hair->group_looks, looks, size);
    if (made.followers.buffer || changes_colors) use_buffers(hair, &made, looks, changes_colors);
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
