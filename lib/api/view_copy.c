// view_copy.c - the view of an application, checked and copied.
#include "lib/api/api.h"

#include <math.h>

#define PARALLEL 1e-3 // Maximum sine of the angle that rounding may leave.

// Return whether depth clearly grows towards a directional light. `towards` is its gradient times
// the direction, and `square` its squared length.
static bool is_opposite(const hair_light* light, double towards, double square)
{
    double length = (double)hair_length(hair_load3(light->direction));
    return towards > 0.5 * length * sqrt(square);
}

// Return whether a light's matrix is orthographic, or in perspective with a depth that grows away
// from the light. An orthographic matrix of a directional light must not have the opposite depth.
// Reversed depth z counts as 1 - z. The depth in perspective must be z = a - b / w, with b above 0,
// in front of the light. Clip space then has a w that grows away from the light, and its depth is
// a w - b.
static int is_seen_from_light(const hair_light* light)
{
    const float* m = light->shadow_matrix;
    double zz = 0, zw = 0, ww = 0, z[4], towards = 0;
    for (int i = 0; i < 4; ++i) {
        double own = (double)m[4 * i + 2], w = (double)m[4 * i + 3];
        z[i] = light->shadow_depth_reversed ? w - own : own;
        if (i == 3) break;
        zz += z[i] * z[i];
        zw += z[i] * w;
        ww += w * w;
        towards += z[i] * (double)light->direction[i];
    }
    if (ww == 0)
        return m[15] == 1 && !(light->kind == HAIR_LIGHT_DIRECTIONAL && is_opposite(light, towards, zz));
    if (light->kind == HAIR_LIGHT_DIRECTIONAL) return 0;
    double a = zw / ww;
    return zw > 0 && zz * ww - zw * zw <= PARALLEL * PARALLEL * zz * ww && a * (double)m[15] > z[3];
}

// Check that the rectangle of a map ends in the texture.
static hair_result check_part(const hair_instance* hair, uint32_t light, const char* name,
                              const float offset[2], const float size[2])
{
    for (int k = 0; k < 2; ++k)
        if (!(offset[k] + size[k] <= 1.0001f))
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: hair_view.lights[%u].%s ends at %g, beyond the texture, which ends at 1",
                             hair->label, light, name, (double)(offset[k] + size[k]));
    return HAIR_OK;
}

static hair_result check_light(const hair_instance* hair, const hair_light* light, uint32_t i)
{
    const hair_host* host = &hair->context->host;
    if (light->kind != HAIR_LIGHT_POINT && !(hair_length(hair_load3(light->direction)) > 1e-12f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.lights[%u].direction has no direction",
                         hair->label, i);
    if (light->kind == HAIR_LIGHT_SPOT && !(light->inner_angle < light->outer_angle))
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: hair_view.lights[%u].inner_angle is %g, not below its outer_angle, %g",
                         hair->label, i, (double)light->inner_angle, (double)light->outer_angle);
    if (light->hair_shadow_map)
        HAIR_TRY(check_part(hair, i, "hair_shadow_part", light->hair_shadow_part.offset,
                            light->hair_shadow_part.size));
    if (light->opaque_shadow_map)
        HAIR_TRY(check_part(hair, i, "opaque_shadow_part", light->opaque_shadow_part.offset,
                            light->opaque_shadow_part.size));
    if (!(light->hair_shadow_map || light->opaque_shadow_map) || is_seen_from_light(light)) return HAIR_OK;
    return hair_fail(
        host, HAIR_ERROR_ARGUMENT, "%s: hair_view.lights[%u].shadow_matrix is %s", hair->label, i,
        light->kind == HAIR_LIGHT_DIRECTIONAL
            ? "not orthographic with the last row (0, 0, 0, 1) and depth that grows away from the light"
            : "neither orthographic nor in perspective, with depth that grows away from the light");
}

// Copy and check the lights. They are as far apart as the caller's struct is long.
static hair_result copy_lights(const hair_instance* hair, hair_view* view, hair_light light[HAIR_LIGHTS])
{
    const hair_host* host = &hair->context->host;
    hair_light usual = hair_light_default();
    const char* at = (const char*)view->lights;
    size_t stride = at ? view->lights->header.size : 0;
    HAIR_ASSERT(view->light_count <= HAIR_LIGHTS);
    uint32_t shadows = 0;
    for (uint32_t i = 0; i < view->light_count; ++i) {
        HAIR_TRY(HAIR_COPY_IN(host, hair_light, at ? at + i * stride : (const char*)&usual, &light[i]));
        HAIR_TRY(check_light(hair, &light[i], i));
        shadows += light[i].hair_shadow_map || light[i].opaque_shadow_map;
    }
    view->lights = light;
    if (shadows > HAIR_SHADOW_MAPS)
        return hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "%s: %u of hair_view.lights have a hair_shadow_map or a opaque_shadow_map, not at most %d",
            hair->label, shadows, HAIR_SHADOW_MAPS);
    return HAIR_OK;
}

static hair_result check_sky(const hair_instance* hair, const float* sky)
{
    for (int i = 0; sky && i < 27; ++i)
        if (!(sky[i] >= -1e6f && sky[i] <= 1e6f))
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: hair_view.sky[%d] is %g, not in [-1e6, 1e6]", hair->label, i,
                             (double)sky[i]);
    return HAIR_OK;
}

hair_result hair_copy_view(const hair_instance* hair, const hair_view* view, struct hair_view_copy* out)
{
    const hair_host* host = &hair->context->host;
    hair_view* own = &out->view;
    HAIR_TRY(HAIR_COPY_IN(host, hair_view, view, own));
    out->has_lod = own->lod != NULL;
    if (own->lod) {
        HAIR_TRY(HAIR_COPY_IN(host, hair_lod, own->lod, &out->lod));
        own->lod = &out->lod;
    }
    if (own->shader && own->shader->context != hair->context)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_view.shader is of another context",
                         hair->label);
    HAIR_TRY(copy_lights(hair, own, out->light));
    return check_sky(hair, own->sky);
}

void hair_reduce_view(const hair_instance* hair, struct hair_view_copy* copy)
{
    const struct hair_budget* budget = &hair->context->budget;
    hair_view* view = &copy->view;
    if (!budget->ms || view->pass == HAIR_PASS_GUIDES || view->pass == HAIR_PASS_COLLIDERS ||
        view->pass == HAIR_PASS_WIND)
        return;
    view->lod = &copy->lod;
    if (!copy->has_lod) {
        copy->lod = hair_lod_default();
        copy->lod.importance = budget->importance;
        copy->lod.light_pixels = 0; // The budget alone decides.
        return;
    }
    float factor = fminf(budget->importance, 1);
    copy->lod.importance *= factor;
    if (copy->lod.per_patch) return;
    copy->lod.strand_fraction *= fmaxf(factor, copy->lod.min_strand_fraction);
    copy->lod.segment_fraction *= factor;
}
