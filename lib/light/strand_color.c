// strand_color.c - colours of strands for shaders, and the effect of pigment and water on a look.
#include "lib/light/fibre.h"
#include "lib/light/lighting.h"

#define WET_POWER(wet) (1 + 0.7f * (wet)) // Exponent that darkens colours.

void hair_look_write_tint(const hair_look* look, struct hair_tint* out)
{
    for (int i = 0; i <= HAIR_CURVE_INTERVALS; ++i) {
        float t = (float)i / HAIR_CURVE_INTERVALS, c[3];
        float by[3] = {look->color.tint_red.at[i], look->color.tint_green.at[i], look->color.tint_blue.at[i]};
        for (int k = 0; k < 3; ++k)
            c[k] = fminf(by[k] * (look->color.root[k] + t * (look->color.tip[k] - look->color.root[k])), 1);
        out->ramp[i] = (hair_vec4){c[0], c[1], c[2], 0};
    }
    out->streak = (hair_vec4){look->color.streak_color[0], look->color.streak_color[1],
                              look->color.streak_color[2], look->color.streaks};
    out->brightness = look->color.spread;
    out->hue = look->color.hue_spread;
    out->roughness = look->shading.roughness_spread;
    out->tilt = look->shading.cuticle_tilt_spread;
    out->root_darkening = look->color.root_darkening;
    HAIR_ASSERT(look->color.root_darkening_length > 0);
    out->root_recovery = 1 / look->color.root_darkening_length;
    out->streak_clumping = look->color.streak_clumping;
    out->sparkle = look->shading.sparkle;
    out->groom_color = look->color.groom_colors;
    out->groom_color_power = WET_POWER(look->wetness);
}

// Blend a colour with that of dense hair with `left` of the pigment, and all of the dye.
static void blend_pigment(const hair_look* look, float left, float color[3])
{
    // Absorption per radius and unit of pigment, red to blue (d'Eon et al. 2011).
    static const float eumelanin[3] = {0.419f, 0.697f, 1.37f}, pheomelanin[3] = {0.187f, 0.4f, 1.05f};
    float d = hair_fibre_darkening(look->shading.roughness[1]);
    for (int k = 0; k < 3; ++k) {
        float dye = logf(fmaxf(look->pigment.dye[k], 0.001f)) / d;
        float melanin = look->pigment.eumelanin * eumelanin[k] + look->pigment.pheomelanin * pheomelanin[k];
        float own = expf(-d * sqrtf(left * melanin + dye * dye));
        color[k] += look->pigment.weight * (own - color[k]);
    }
}

void hair_look_apply_pigment(hair_look* look)
{
    if (!(look->pigment.weight > 0)) return;
    blend_pigment(look, 1, look->color.root);
    blend_pigment(look, look->pigment.tip_fraction, look->color.tip);
    look->pigment.weight = 0;
}

// Darken a colour. A film of water reflects light back into the fibre, which absorbs it more often.
// The film is also smoother than the scales.
static void darken(float color[3], float power)
{
    for (int k = 0; k < 3; ++k) color[k] = powf(color[k], power);
}

static void draw_together(hair_look* look, float wet)
{
    static const float clumped[8] = {0, 0.3f, 0.6f, 0.8f, 0.9f, 0.95f, 0.97f, 0.98f};
    for (int i = 0; i <= HAIR_CURVE_INTERVALS; ++i) {
        float width = 1 - 0.65f * clumped[i];
        look->clump.weight.at[i] += wet * fmaxf(clumped[i] - look->clump.weight.at[i], 0);
        look->clump.width.at[i] *= 1 + wet * (width - 1);
        look->strays.frizz.at[i] *= 1 - 0.8f * wet;
    }
    look->strays.tip_fraction *= 1 - 0.8f * wet;
    look->strays.fraction *= 1 - 0.8f * wet;
}

void hair_look_apply_wetness(hair_look* look)
{
    float wet = look->wetness;
    if (!(wet > 0)) return;
    darken(look->color.root, WET_POWER(wet));
    darken(look->color.tip, WET_POWER(wet));
    darken(look->color.streak_color, WET_POWER(wet));
    look->shading.roughness[0] = fmaxf(look->shading.roughness[0] * (1 - 0.55f * wet), 0.05f);
    look->shading.roughness[1] = fmaxf(look->shading.roughness[1] * (1 - 0.4f * wet), 0.05f);
    look->shading.specular[0] = fminf(look->shading.specular[0] * (1 + 3 * wet), 4);
    look->shading.gloss[0] = fminf(look->shading.gloss[0] * (1 + 2 * wet), 1000);
    look->shading.gloss[1] = fminf(look->shading.gloss[1] * (1 + 2 * wet), 1000);
    draw_together(look, wet);
}
