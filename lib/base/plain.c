// plain.c - the default functions of structs without a header, and of curves.
#include <hair/hair.h>

#include <string.h>

// Copy the defaults to a struct of the caller, which may be of another version and size.
static void copy(const void* usual, size_t size, void* desc, size_t caller_size)
{
    if (!desc) return;
    memset(desc, 0, caller_size);
    memcpy(desc, usual, caller_size < size ? caller_size : size);
}

void hair_collider_init(hair_collider* collider, size_t size)
{
    static const hair_collider usual = {
        .shape = HAIR_SHAPE_SPHERE, .rotation = {0, 0, 0, 1}, .scale = 1, .friction = 1};
    copy(&usual, sizeof usual, collider, size);
}

void hair_pin_init(hair_pin* pin, size_t size)
{
    static const hair_pin usual = {.vertex = UINT32_MAX, .to = HAIR_PIN_HEAD};
    copy(&usual, sizeof usual, pin, size);
}

void hair_wind_source_init(hair_wind_source* source, size_t size)
{
    static const hair_wind_source usual = {.speed = 5, .radius = 0.05f};
    copy(&usual, sizeof usual, source, size);
}

hair_curve hair_curve_line(float root, float tip)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = root + (tip - root) * (float)i / 7;
    return curve;
}
