// every_strand.c - A haircut all of whose strands are simulated. The strands are read back from an
// instance at rest, so that they are those of the haircut with followers.
#include "tools/common/every_strand.h"
#include "tools/common/file.h"
#include "tools/common/groups.h"

#include <stdlib.h>
#include <string.h>

// Read the vertices of all strands at rest, to be freed.
static hair_result read_strands(hair_context* context, const struct hair_scene* scene, hair_groom* groom,
                                float** positions, uint32_t* count)
{
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    desc.physics = &scene->settings.physics;
    desc.look = &scene->settings.look;
    hair_result result = hair_create(context, groom, &desc, &hair);
    if (!result) result = hair_groups_apply(hair, &scene->settings, NULL);
    if (!result) result = hair_read_positions(hair, HAIR_READ_FOLLOWERS, NULL, 0, count);
    if (!result) *positions = malloc(3 * ((size_t)*count + 1) * sizeof **positions);
    if (!result && !*positions) result = HAIR_ERROR_MEMORY;
    if (!result) result = hair_read_positions(hair, HAIR_READ_FOLLOWERS, *positions, *count, count);
    hair_destroy(hair);
    return result;
}

static hair_result make_groom(const hair_host* host, const struct hair_scene* scene, const float* positions,
                              uint32_t count, hair_groom** out)
{
    uint32_t each = scene->settings.look.strand.segments + 1;
    hair_groom_desc desc = hair_groom_desc_default();
    uint32_t* vertices = malloc((size_t)(count / each + 1) * sizeof *vertices);
    if (!vertices) return HAIR_ERROR_MEMORY;
    for (uint32_t i = 0; i < count / each; ++i) vertices[i] = each;
    desc.host = host;
    desc.positions = positions;
    desc.strand_vertices = vertices;
    desc.strand_count = desc.guide_count = count / each;
    desc.guide_vertices = scene->settings.groom.guide_vertices;
    desc.seed = scene->settings.groom.seed;
    hair_result result = hair_groom_create(&desc, out);
    free(vertices);
    return result;
}

int hair_every_strand_make(const char* tool, const hair_host* host, hair_context* context,
                           const struct hair_scene* scene, hair_groom** groom)
{
    if (!scene->settings.simulates_all) return HAIR_EXIT_OK;
    hair_groom_info info = hair_groom_info_default();
    hair_groom_describe(*groom, &info);
    if (info.group_count > 1) {
        hair_complain(tool, "every_strand is for haircuts of 1 group, and this one has %u", info.group_count);
        return HAIR_EXIT_INPUT;
    }
    if (*scene->character.file) {
        hair_complain(tool, "every_strand is for haircuts without a character");
        return HAIR_EXIT_USAGE;
    }
    float* positions = NULL;
    uint32_t count = 0;
    hair_groom* all = NULL;
    hair_result result = read_strands(context, scene, *groom, &positions, &count);
    if (!result) result = make_groom(host, scene, positions, count, &all);
    free(positions);
    if (result == HAIR_ERROR_MEMORY) hair_complain(tool, "out of memory for every strand");
    if (result) return hair_exit_for(result);
    hair_groom_destroy(*groom);
    *groom = all;
    return HAIR_EXIT_OK;
}

// Copy what the strands of a groom have as their shape, if every strand is simulated.
static void copy_shape(const hair_look* from, hair_look* to)
{
    to->strand.length = from->strand.length;
    to->strand.length_variation = from->strand.length_variation;
    to->clump = from->clump;
    to->curl = from->curl;
    to->strays = from->strays;
}

hair_look hair_every_strand_look(const struct hair_settings* settings)
{
    hair_look look = settings->look, plain = hair_look_default();
    if (!settings->simulates_all) return look;
    plain.clump.interpolation = HAIR_INTERPOLATION_MULTI;
    plain.strays.fraction = plain.strays.tip_fraction = 0;
    copy_shape(&plain, &look);
    return look;
}

bool hair_every_strand_differs(const struct hair_settings* a, const struct hair_settings* b)
{
    hair_look same = a->look;
    if (a->simulates_all != b->simulates_all) return true;
    copy_shape(&b->look, &same);
    return a->simulates_all &&
           (a->look.strand.segments != b->look.strand.segments || memcmp(&same, &a->look, sizeof same));
}
