// groom_source.c - The haircut of a scene, from a file, in a built-in style, or as fur on a ball.
#include "tools/common/groom_source.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>

#define MAX_BYTES ((size_t)4 << 30)
#define FUR_VERTICES 8

// Create a groom with the maps and the attributes of a scene. A groom with images keeps its texture
// coordinates, and has the maps of the scene at the vertices of the scalp.
static int build_mapped(const struct hair_scene* scene, hair_groom_desc* desc, hair_groom** out)
{
    hair_map_set sets[HAIR_SCENE_SETS];
    hair_strand_attribute all[HAIR_SCENE_ALL_ATTRIBUTES];
    const float* own_uvs = hair_scene_has_images(desc) ? desc->scalp_uvs : NULL;
    uint32_t own_count = desc->strand_attribute_count;
    size_t uv_count = 2 * (size_t)desc->scalp_vertex_count,
           value_count = (size_t)scene->attributes.count * HAIR_SCENE_MAP * HAIR_SCENE_MAP,
           baked_count = own_uvs ? hair_scene_count_baked(&scene->maps, &scene->attributes, desc) : 0;
    float* uvs = malloc((uv_count + value_count + baked_count) * sizeof *uvs);
    if (!uvs) return HAIR_EXIT_RUNTIME;
    hair_scene_put_maps(&scene->maps, sets, uvs, desc);
    hair_scene_put_attributes(&scene->attributes, all, uvs + uv_count, desc);
    if (own_uvs) {
        hair_scene_bake_images(sets, scene->maps.count, all + own_count, scene->attributes.count, uvs,
                               uvs + uv_count + value_count, desc);
        desc->scalp_uvs = own_uvs;
    }
    hair_result result = hair_groom_create(desc, out);
    free(uvs);
    return hair_exit_for(result);
}

static void report_unused(const char* tool, const struct hair_scene* scene, const hair_groom_desc* desc)
{
    if (scene->attributes.count && !desc->scalp_positions)
        hair_complain(tool, "attributes of the scene are left out, because the groom has no scalp");
}

static int build(const char* tool, const hair_host* host, const struct hair_scene* scene,
                 struct hair_character* character, hair_asset* asset, hair_groom** out)
{
    hair_groom_desc desc = scene->settings.groom;
    desc.host = host;
    int code = hair_exit_for(hair_asset_to_groom_desc(asset, &desc));
    bool is_mapped = scene->maps.count || scene->attributes.count;
    float* changed = NULL;
    if (!code && character) code = hair_character_fit(character, scene, &desc, &changed);
    if (!code) report_unused(tool, scene, &desc);
    if (!code)
        code = is_mapped && desc.scalp_positions ? build_mapped(scene, &desc, out)
                                                 : hair_exit_for(hair_groom_create(&desc, out));
    free(changed);
    hair_asset_destroy(asset);
    return code;
}

#define LONGEST_STRAND 3.0f // m, a file with longer strands is in smaller units

// Guess the unit of a file, because files do not state it. The unit is metres unless strands would
// be longer than LONGEST_STRAND. Then centimetres or millimetres are used.
static float guess_scale(const char* tool, const char* path, const hair_asset* asset)
{
    hair_asset_info info = hair_asset_info_default();
    hair_asset_describe(asset, &info);
    float longest = info.length[2];
    if (longest <= LONGEST_STRAND) return 1;
    float scale = longest * 0.01f <= LONGEST_STRAND ? 0.01f : 0.001f;
    hair_complain(tool, "%s: the longest strand has %g units, taken to be %g m each; --scale says otherwise",
                  path, (double)longest, (double)scale);
    return scale;
}

static hair_result read_asset(const hair_host* host, hair_import import, const struct hair_bytes* bytes,
                              hair_asset** out)
{
    hair_asset_desc desc = hair_asset_desc_default();
    desc.host = host;
    desc.import = &import;
    return hair_asset_read(&desc, bytes->data, bytes->size, out);
}

static int load_file(const char* tool, const hair_host* host, const struct hair_scene* scene,
                     struct hair_character* character, hair_groom** out)
{
    struct hair_bytes bytes;
    if (!hair_file_read_haircut(tool, scene->groom, MAX_BYTES, &bytes)) return HAIR_EXIT_INPUT;
    hair_host named = *host;
    named.user = (void*)hair_log_name(tool, scene->groom);
    hair_import import = scene->settings.import;
    bool guesses = import.scale == HAIR_SCALE_GUESSED;
    if (guesses) import.scale = 1;
    hair_asset* asset = NULL;
    hair_result result = read_asset(&named, import, &bytes, &asset);
    if (!result && guesses) {
        import.scale = guess_scale(tool, scene->groom, asset);
        // Read the file again, because the minimum strand length depends on the scale.
        if (import.scale != 1) {
            hair_asset_destroy(asset);
            result = read_asset(&named, import, &bytes, &asset);
        }
    }
    free(bytes.data);
    return result ? hair_exit_for(result) : build(tool, host, scene, character, asset, out);
}

static int make_style(const char* tool, const hair_host* host, const struct hair_scene* scene,
                      struct hair_character* character, hair_groom** out)
{
    hair_style_desc desc = scene->settings.style;
    desc.host = host;
    hair_asset* asset;
    hair_result result = hair_asset_generate(&desc, &asset);
    return result ? hair_exit_for(result) : build(tool, host, scene, character, asset, out);
}

// Fur ---------------------------------------------------------------------------------------------

// Return evenly distributed noise in [-1, 1) from an integer. This is the finalizer of MurmurHash3
// (Appleby 2011).
static float noise(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    x ^= x >> 16;
    return (float)(x >> 8) * (2.0f / 16777216.0f) - 1;
}

// Make strand i of the fur. Roots lie on Fibonacci's lattice, which distributes any number of
// points evenly over a sphere. Each strand leans over the ball as it is combed, and randomly. The
// lean increases towards the tip.
static void grow(const struct hair_scene* scene, uint32_t i, float* out)
{
    uint32_t seed = scene->settings.groom.seed * 2654435761u + 8 * i;
    float y = 1 - (2 * (float)i + 1) / (float)scene->fur_strands;
    float ring = sqrtf(1 - y * y), angle = (float)fmod(2.39996322972865332 * (double)i, 6.28318530717958648);
    float at[3] = {ring * cosf(angle), y, ring * sinf(angle)};
    float length = scene->fur_length * (1 + 0.25f * noise(seed));
    const float* comb = scene->fur_comb;
    float lean[3], outwards = at[0] * comb[0] + at[1] * comb[1] + at[2] * comb[2];
    for (uint32_t k = 0; k < 3; ++k) lean[k] = 0.35f * noise(seed + 1 + k) + comb[k] - outwards * at[k];
    for (int v = 0; v < FUR_VERTICES; ++v) {
        float t = (float)v / (FUR_VERTICES - 1);
        for (int k = 0; k < 3; ++k)
            out[3 * v + k] = scene->ball_radius * at[k] + length * t * (at[k] + 0.5f * t * lean[k]);
    }
}

static int make_fur(const char* tool, const hair_host* host, const struct hair_scene* scene, hair_groom** out)
{
    size_t count = scene->fur_strands;
    float* positions = malloc(count * FUR_VERTICES * 3 * sizeof *positions);
    uint32_t* vertices = malloc(count * sizeof *vertices);
    int code = HAIR_EXIT_RUNTIME;
    if (positions && vertices) {
        for (uint32_t i = 0; i < scene->fur_strands; ++i) {
            grow(scene, i, positions + (size_t)3 * FUR_VERTICES * i);
            vertices[i] = FUR_VERTICES;
        }
        hair_groom_desc desc = scene->settings.groom;
        desc.host = host;
        desc.positions = positions;
        desc.strand_vertices = vertices;
        desc.strand_count = scene->fur_strands;
        report_unused(tool, scene, &desc);
        code = hair_exit_for(hair_groom_create(&desc, out));
    } else
        hair_complain(tool, "out of memory for %u strands of fur", scene->fur_strands);
    free(positions);
    free(vertices);
    return code;
}

int hair_groom_source_load(const char* tool, const hair_host* host, const struct hair_scene* scene,
                           struct hair_character* character, hair_groom** out)
{
    switch (scene->subject) {
    case HAIR_SUBJECT_FILE: return load_file(tool, host, scene, character, out);
    case HAIR_SUBJECT_FUR: return make_fur(tool, host, scene, out);
    case HAIR_SUBJECT_STYLE: break;
    }
    return make_style(tool, host, scene, character, out);
}
