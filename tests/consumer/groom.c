// groom.c - a program that makes a haircut, without OpenGL.
#include <hair/hair.h>
#include <hair/hair_asset.h>
#include <stdio.h>

int main(void)
{
    hair_asset* asset;
    hair_groom* groom;
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    hair_groom_info info = hair_groom_info_default();
    if (hair_asset_generate(&style, &asset) || hair_asset_to_groom_desc(asset, &desc)) return 1;
    if (hair_groom_create(&desc, &groom) || hair_groom_describe(groom, &info)) return 1;
    printf("%u guides, %u followers\n", info.guide_count, info.follower_count);
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
    return hair_version() != HAIR_VERSION;
}
