// haircut.c - built-in haircuts, for tests of how hair looks.
#include "tests/support/haircut.h"

hair_groom* hair_test_haircut(struct hair_test* test, const hair_style_desc* style, uint32_t followers)
{
    hair_style_desc of = *style;
    hair_groom_desc desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    of.host = desc.host = &test->host.host;
    hair_test_ok(test, hair_asset_generate(&of, &asset));
    hair_test_ok(test, hair_asset_to_groom_desc(asset, &desc));
    desc.follower_count = followers;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    hair_asset_destroy(asset);
    return groom;
}

hair_instance* hair_test_wear(struct hair_test* test, hair_style style, uint32_t followers, float radius,
                              hair_groom** groom)
{
    hair_style_desc of = hair_style_desc_default();
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    hair_instance* hair = NULL;
    of.style = style;
    look.strand.radius = radius;
    look.strand.segments = 24;
    desc.look = &look;
    *groom = hair_test_haircut(test, &of, followers);
    hair_test_ok(test, hair_create(test->context, *groom, &desc, &hair));
    return hair;
}
