// playback.c - Playback of a dump of guides as target poses of an instance.
#include "tools/common/playback.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_CACHE ((size_t)4 << 30) // bytes
#define HEADER 40 // bytes
#define CLOSE 1e-3 // distance from a frame that counts as the frame, in frames

static uint32_t whole_at(const struct hair_playback* cache, size_t offset)
{
    uint32_t value;
    memcpy(&value, cache->bytes.data + offset, sizeof value);
    return value;
}

static int refuse(const struct hair_playback* cache, const char* sentence)
{
    hair_complain(cache->tool, "%s: %s", cache->path, sentence);
    return HAIR_EXIT_INPUT;
}

// Check the header and the size of the file.
static int read_header(struct hair_playback* cache)
{
    if (cache->bytes.size < HEADER || memcmp(cache->bytes.data, "HAIRDUMP", 8) != 0)
        return refuse(cache, "the file does not begin with \"HAIRDUMP\" and a header of 40 bytes");
    if (whole_at(cache, 8) != 1) return refuse(cache, "the version at byte 8 is not 1");
    uint32_t guides = whole_at(cache, 12);
    cache->samples = whole_at(cache, 16);
    cache->frames = whole_at(cache, 20);
    cache->first = whole_at(cache, 24);
    memcpy(&cache->fps, cache->bytes.data + 32, sizeof cache->fps);
    if (whole_at(cache, 28) != 0) return refuse(cache, "byte 28 is not 0: these are followers, not guides");
    if (guides != cache->guides) {
        hair_complain(cache->tool, "%s: the number of guides at byte 12 is %u, not the %u of the haircut",
                      cache->path, guides, cache->guides);
        return HAIR_EXIT_INPUT;
    }
    if (cache->samples < 2 || cache->samples > 65536)
        return refuse(cache, "the number of vertices at byte 16 is not in [2, 65536]");
    if (cache->frames < 1) return refuse(cache, "the number of frames at byte 20 is 0");
    if (!(cache->fps >= 1e-3 && cache->fps <= 1e6))
        return refuse(cache, "the frames a second at byte 32 are not in [1e-3, 1e6]");
    uint64_t frame = 12ull * cache->guides * cache->samples, rest = cache->bytes.size - HEADER;
    if (rest % frame != 0 || rest / frame != cache->frames) {
        hair_complain(cache->tool, "%s: the file has %zu bytes, not the %llu of a header and %u frames",
                      cache->path, cache->bytes.size,
                      (unsigned long long)(HEADER + (frame * (uint64_t)cache->frames)), cache->frames);
        return HAIR_EXIT_INPUT;
    }
    return HAIR_EXIT_OK;
}

// Find the fraction of the length at each vertex of a guide at rest.
static void find_places(uint32_t count, const float* rest, float* place)
{
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        double square = 0;
        for (int k = 0; k < 3 && i > 0; ++k)
            square += pow((double)rest[3 * i + (uint32_t)k] - (double)rest[3 * i - 3 + (uint32_t)k], 2);
        sum += sqrt(square);
        place[i] = (float)sum;
    }
    for (uint32_t i = 0; i < count; ++i) place[i] = sum > 0 ? (float)((double)place[i] / sum) : 0;
}

static int measure_guides(struct hair_playback* cache, const hair_groom* groom)
{
    hair_groom_info info = hair_groom_info_default();
    hair_result result = hair_groom_describe(groom, &info);
    if (result) return hair_exit_for(result);
    cache->guides = info.guide_count;
    cache->vertices = info.guide_vertex_count;
    cache->guide_vertices = calloc(cache->guides, sizeof *cache->guide_vertices);
    cache->place = calloc(cache->vertices, sizeof *cache->place);
    cache->positions = calloc(cache->vertices, 3 * sizeof *cache->positions);
    if (!cache->guide_vertices || !cache->place || !cache->positions) {
        hair_complain(cache->tool, "out of memory for the cache of %u guides", cache->guides);
        return HAIR_EXIT_RUNTIME;
    }
    result =
        hair_groom_get_guides(groom, cache->guide_vertices, cache->guides, cache->positions, cache->vertices);
    for (uint32_t g = 0, at = 0; !result && g < cache->guides; at += cache->guide_vertices[g++])
        find_places(cache->guide_vertices[g], cache->positions + 3 * (size_t)at, cache->place + at);
    return hair_exit_for(result);
}

int hair_playback_open(const char* tool, const char* path, const hair_groom* groom,
                       struct hair_playback* cache)
{
    *cache = (struct hair_playback){.tool = tool, .path = path};
    if (!path) return HAIR_EXIT_OK;
    if (!hair_file_read(tool, path, MAX_CACHE, &cache->bytes)) return HAIR_EXIT_INPUT;
    int code = measure_guides(cache, groom);
    return code ? code : read_header(cache);
}

// Return one coordinate of a guide at a fraction of its length, by the cubic through the samples
// around (Catmull and Rom 1974).
static double sample(const float* strand, uint32_t samples, float place, int k)
{
    double at = (double)place * (samples - 1), p[4];
    uint32_t i = at < samples - 2 ? (uint32_t)at : samples - 2;
    double t = at - i;
    for (int n = 0; n < 4; ++n) {
        uint32_t j = i + (uint32_t)n < 1 ? 0 : i + (uint32_t)n - 1;
        p[n] = (double)strand[3 * (size_t)(j < samples ? j : samples - 1) + (size_t)k];
    }
    if (i == 0) p[0] = 2 * p[1] - p[2];
    if (i + 2 == samples) p[3] = 2 * p[2] - p[1];
    double a = p[2] - p[0], b = 2 * p[0] - 5 * p[1] + 4 * p[2] - p[3], c = 3 * (p[1] - p[2]) + p[3] - p[0];
    return p[1] + 0.5 * t * (a + t * (b + t * c));
}

// Write the targets between two frames.
static void interpolate(struct hair_playback* cache, uint32_t frame, double part)
{
    size_t stride = 3 * (size_t)cache->samples, size = stride * cache->guides;
    const float* a = (const float*)(const void*)(cache->bytes.data + HEADER) + frame * size;
    const float* b = part > 0 ? a + size : a;
    for (uint32_t g = 0, at = 0; g < cache->guides; ++g)
        for (uint32_t i = 0; i < cache->guide_vertices[g]; ++i, ++at)
            for (int k = 0; k < 3; ++k) {
                double x = sample(a + g * stride, cache->samples, cache->place[at], k);
                double y = sample(b + g * stride, cache->samples, cache->place[at], k);
                cache->positions[3 * (size_t)at + (size_t)k] = (float)(x + part * (y - x));
            }
}

hair_result hair_playback_play(struct hair_playback* cache, hair_instance* hair, double time)
{
    if (!cache->path) return HAIR_OK;
    double at = time * cache->fps - cache->first, nearest = floor(at + 0.5), last = cache->frames - 1.0;
    if (fabs(at - nearest) < CLOSE) at = nearest;
    if (at > last && cache->plays) {
        cache->plays = false;
        return hair_set_targets(hair, NULL, 0, 0, NULL);
    }
    if (at < 0 || at > last) return HAIR_OK;
    bool begins = !cache->plays && time <= 0;
    interpolate(cache, (uint32_t)at, at - floor(at));
    hair_result result = hair_set_targets(hair, cache->positions, cache->vertices, 12, NULL);
    cache->plays = !result;
    // A cache that begins with the scene needs no way to its first pose.
    return !result && begins ? hair_reset(hair) : result;
}

void hair_playback_free(struct hair_playback* cache)
{
    free(cache->bytes.data);
    free(cache->guide_vertices);
    free(cache->place);
    free(cache->positions);
    *cache = (struct hair_playback){0};
}
