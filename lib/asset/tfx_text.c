// tfx_text.c - the text .tfx format of AMD's TressFX, versions 1 and 2, which contains guides.
//
//   version 2.0                       then for every strand
//   scale 1.0                           strand 0 numVerts 3 texcoord 0.25 0.5
//   rotation 0 0 0                      0.0 1.0 0.0
//   translation 0 0 0                   0.0 0.9 0.1
//   numStrands 1                        0.0 0.8 0.3
//   is sorted 1
//
// A strand needs its numVerts. Every other line may be missing. Version 1 lacks all lines before
// numStrands. Positions are scaled, then rotated, then translated, as TressFX does. The rotation is
// in radians: about z by the third number, about x by the first, about y by the second. Lines about
// followers and texture coordinates are not used. The text is read twice: first to count, then to
// fill memory of the right size.
#include "lib/asset/formats.h"
#include "lib/asset/text.h"

#include <math.h>

struct text_reader {
    const struct hair_source* source;
    struct hair_text text;
    struct hair_strands* fill; // NULL only counts.
    uint32_t strands, vertices;
    bool has_count, warned;
    uint32_t count; // numStrands
    float scale, rotation[3], translation[3];
};

static hair_result complain(const struct text_reader* reader, size_t at, const char* sentence)
{
    return hair_fail(reader->source->host, HAIR_ERROR_FILE, "at byte %zu %s", at, sentence);
}

static hair_result read_numbers(const struct text_reader* reader, struct hair_line* line, float* out,
                                uint32_t count)
{
    struct hair_token token;
    for (uint32_t i = 0; i < count; ++i) {
        double value;
        if (!hair_line_next(line, &token))
            return complain(reader, line->end, "the line ends before its last number");
        if (!hair_token_number(&token, &value)) return complain(reader, token.at, "stands no number");
        out[i] = (float)value;
    }
    if (hair_line_next(line, &token))
        return complain(reader, token.at, "stands more than the numbers of the line");
    return HAIR_OK;
}

// Read numbers that must be finite, because they transform the whole haircut.
static hair_result read_finite(const struct text_reader* reader, struct hair_line* line, float* out,
                               uint32_t count)
{
    HAIR_TRY(read_numbers(reader, line, out, count));
    for (uint32_t i = 0; i < count; ++i)
        if (!isfinite(out[i])) return complain(reader, line->start, "a number of the line is not finite");
    return HAIR_OK;
}

static hair_result read_count(const struct text_reader* reader, struct hair_line* line, uint32_t* out)
{
    struct hair_token token;
    double value;
    if (!hair_line_next(line, &token)) return complain(reader, line->end, "the line ends before its count");
    if (!hair_token_number(&token, &value) || !(value >= 0 && value <= UINT32_MAX) || value != floor(value))
        return complain(reader, token.at, "stands no count");
    *out = (uint32_t)value;
    return HAIR_OK;
}

static bool is_unused(const struct hair_token* name)
{
    static const char* const names[] = {"version",
                                        "bothEndsImmovable",
                                        "maxNumVerticesInStrand",
                                        "numFollowHairsPerGuideHair",
                                        "maxRadiusAroundGuideHair",
                                        "is",
                                        "isSorted"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (hair_token_is(name, names[i])) return true;
    return false;
}

static hair_result read_setting(struct text_reader* reader, const struct hair_token* name,
                                struct hair_line* line)
{
    if (hair_token_is(name, "scale")) return read_finite(reader, line, &reader->scale, 1);
    if (hair_token_is(name, "rotation")) return read_finite(reader, line, reader->rotation, 3);
    if (hair_token_is(name, "translation")) return read_finite(reader, line, reader->translation, 3);
    if (hair_token_is(name, "numStrands")) {
        reader->has_count = true;
        return read_count(reader, line, &reader->count);
    }
    double number;
    if (hair_token_number(name, &number))
        return complain(reader, name->at, "stands a number outside of any strand");
    if (!is_unused(name) && !reader->warned) {
        hair_log(reader->source->host, HAIR_LOG_WARNING, "the line at byte %zu is not known and not read",
                 name->at);
        reader->warned = true;
    }
    return HAIR_OK;
}

static hair_result find_vertex_count(const struct text_reader* reader, struct hair_line* line, uint32_t* out)
{
    struct hair_token token;
    while (hair_line_next(line, &token))
        if (hair_token_is(&token, "numVerts")) return read_count(reader, line, out);
    return complain(reader, line->start, "the strand does not say its numVerts");
}

// Rotate p as a row vector by the matrices Rz Rx Ry.
static void turn(const float rotation[3], double p[3])
{
    static const int order[3] = {2, 0, 1};
    for (int i = 0; i < 3; ++i) {
        int axis = order[i], u = (axis + 1) % 3, v = (axis + 2) % 3;
        double c = cos(rotation[axis]), s = sin(rotation[axis]);
        double x = c * p[u] - s * p[v], y = s * p[u] + c * p[v];
        p[u] = x;
        p[v] = y;
    }
}

static void place_vertex(const struct text_reader* reader, float* position)
{
    const float *r = reader->rotation, *t = reader->translation;
    double p[3] = {position[0], position[1], position[2]};
    for (int i = 0; i < 3; ++i) p[i] *= reader->scale;
    if (r[0] != 0 || r[1] != 0 || r[2] != 0) turn(r, p);
    for (int i = 0; i < 3; ++i) position[i] = (float)(p[i] + t[i]);
}

static hair_result read_vertex(struct text_reader* reader, size_t strand_at)
{
    struct hair_line line;
    float position[3] = {0};
    if (!hair_text_next(&reader->text, &line))
        return hair_fail(reader->source->host, HAIR_ERROR_FILE,
                         "the file ends at byte %zu, within the strand at byte %zu", reader->source->size,
                         strand_at);
    HAIR_TRY(read_numbers(reader, &line, position, 3));
    if (reader->fill) {
        HAIR_ASSERT(reader->vertices < reader->fill->vertex_count);
        place_vertex(reader, position);
        memcpy(reader->fill->positions + 3 * (size_t)reader->vertices, position, sizeof position);
    }
    ++reader->vertices;
    return HAIR_OK;
}

static hair_result read_strand(struct text_reader* reader, struct hair_line* line)
{
    uint32_t count = 0;
    HAIR_TRY(find_vertex_count(reader, line, &count));
    if (count > UINT32_MAX - reader->vertices)
        return complain(reader, line->start, "the strand makes too many vertices");
    for (uint32_t i = 0; i < count; ++i) HAIR_TRY(read_vertex(reader, line->start));
    HAIR_ASSERT(!reader->fill || reader->strands < reader->fill->strand_count);
    if (reader->fill) reader->fill->vertices[reader->strands] = count;
    ++reader->strands;
    return HAIR_OK;
}

static void rewind_to_start(struct text_reader* reader, struct hair_strands* fill)
{
    bool bom = reader->source->size >= 3 && memcmp(reader->source->bytes, "\xef\xbb\xbf", 3) == 0;
    reader->text = (struct hair_text){reader->source->bytes, reader->source->size, bom ? 3 : 0};
    reader->fill = fill;
    reader->strands = 0;
    reader->vertices = 0;
}

static hair_result read_all(struct text_reader* reader)
{
    struct hair_line line;
    while (hair_text_next(&reader->text, &line)) {
        struct hair_token name;
        if (!hair_line_next(&line, &name)) continue;
        HAIR_TRY(hair_token_is(&name, "strand") ? read_strand(reader, &line)
                                                : read_setting(reader, &name, &line));
    }
    return HAIR_OK;
}

static hair_result check_text_counts(const struct text_reader* reader)
{
    size_t end = reader->source->size;
    if (reader->has_count && reader->count != reader->strands)
        return hair_fail(reader->source->host, HAIR_ERROR_FILE,
                         "the file ends at byte %zu after %u strands, but numStrands is %u", end,
                         reader->strands, reader->count);
    if (reader->vertices == 0)
        return hair_fail(reader->source->host, HAIR_ERROR_FILE, "the file ends at byte %zu without a strand",
                         end);
    return HAIR_OK;
}

bool hair_is_tfx_text(const unsigned char* bytes, size_t size)
{
    bool bom = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0;
    struct hair_text text = {bytes, size, bom ? 3 : 0};
    struct hair_line line;
    struct hair_token name;
    return hair_text_next(&text, &line) && hair_line_next(&line, &name) &&
           (hair_token_is(&name, "version") || hair_token_is(&name, "numStrands"));
}

uint64_t hair_max_size_of_tfx_text(const unsigned char* bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return HAIR_TEXT_MAX_BYTES;
}

hair_result hair_decode_tfx_text(const struct hair_source* source, hair_asset* asset)
{
    struct text_reader reader = {.source = source, .scale = 1};
    if (source->size > HAIR_TEXT_MAX_BYTES)
        return hair_fail(source->host, HAIR_ERROR_FILE,
                         "the text goes on after byte %zu, which is the maximum of a text",
                         HAIR_TEXT_MAX_BYTES);
    rewind_to_start(&reader, NULL);
    HAIR_TRY(read_all(&reader));
    HAIR_TRY(check_text_counts(&reader));
    HAIR_TRY(hair_strands_allocate(source->host, &asset->strands, reader.strands, reader.vertices));

    asset->strand_set = HAIR_STRAND_SET_GUIDES;
    reader.warned = true;
    rewind_to_start(&reader, &asset->strands);
    return read_all(&reader);
}
