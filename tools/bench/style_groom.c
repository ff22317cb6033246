// style_groom.c - Grooms of built-in haircuts, whose strands are the guides.
#include "tools/bench/style_groom.h"

hair_result bench_style_groom(struct bench* bench, hair_style_desc* style, uint32_t guide_vertices,
                              uint32_t followers, hair_groom** out)
{
    hair_groom_desc desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    style->host = desc.host = &bench->host;
    hair_result result = hair_asset_generate(style, &asset);
    if (!result) result = hair_asset_to_groom_desc(asset, &desc);
    if (guide_vertices) desc.guide_vertices = guide_vertices;
    desc.follower_count = followers;
    if (!result) result = hair_groom_create(&desc, out);
    hair_asset_destroy(asset);
    return result;
}
