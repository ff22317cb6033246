// strand_color.c - colours of strands for shaders, and the effect of water on a look.
#include "lib/light/lighting.h"

#define WET_POWER(wet) (1 + 0.7f * (wet)) // Exponent that darkens colours.

void hair_look_write_tint(const hair_look* look, struct hair_tint* out)
{
    for (int i = 0; i <= HAIR_CURVE_INTERVALS; ++i) {
        float t = (float)i / HAIR_CURVE_INTERVALS, c[3];
        float by[3] = {look->tint_red.at[i], look->tint_green.at[i], look->tint_blue.at[i]};
        for (int k = 0; k < 3; ++k)
            c[k] = fminf(by[k] * (look->root_color[k] + t * (look->tip_color[k] - look->root_color[k])), 1);
        out->ramp[i] = (hair_vec4){c[0], c[1], c[2], 0};
    }
    out->streak =
        (hair_vec4){look->streak_color[0], look->streak_color[1], look->streak_color[2], look->streaks};
    out->brightness = look->color_spread;
    out->hue = look->hue_spread;
    out->roughness = look->roughness_spread;
    out->tilt = look->cuticle_tilt_spread;
    out->root_darkening = look->root_darkening;
    HAIR_ASSERT(look->root_darkening_length > 0);
    out->root_recovery = 1 / look->root_darkening_length;
    out->streak_clumping = look->streak_clumping;
    out->sparkle = look->sparkle;
    out->groom_color = look->groom_colors;
    out->groom_color_power = WET_POWER(look->wetness);
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
        look->clump.at[i] += wet * fmaxf(clumped[i] - look->clump.at[i], 0);
        look->clump_width.at[i] *= 1 + wet * (width - 1);
        look->frizz.at[i] *= 1 - 0.8f * wet;
    }
    look->tip_stray_fraction *= 1 - 0.8f * wet;
    look->stray_fraction *= 1 - 0.8f * wet;
}

void hair_look_apply_wetness(hair_look* look)
{
    float wet = look->wetness;
    if (!(wet > 0)) return;
    darken(look->root_color, WET_POWER(wet));
    darken(look->tip_color, WET_POWER(wet));
    darken(look->streak_color, WET_POWER(wet));
    look->roughness[0] = fmaxf(look->roughness[0] * (1 - 0.55f * wet), 0.05f);
    look->roughness[1] = fmaxf(look->roughness[1] * (1 - 0.4f * wet), 0.05f);
    look->specular[0] = fminf(look->specular[0] * (1 + 3 * wet), 4);
    look->gloss[0] = fminf(look->gloss[0] * (1 + 2 * wet), 1000);
    look->gloss[1] = fminf(look->gloss[1] * (1 + 2 * wet), 1000);
    draw_together(look, wet);
}
