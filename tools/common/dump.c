// dump.c - A file of the positions of all strands in every frame, for hair-convert.
#include "tools/common/dump.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "a dump is written as it lies in memory");

struct header {
    char name[8];
    uint32_t version, strands, vertices, frames, first, followers;
    double fps;
};
_Static_assert(sizeof(struct header) == 40, "the header has no gaps");

// Find the numbers of strands and vertices, and make room for the positions of a frame.
static int measure(struct hair_dump* dump, hair_instance* hair)
{
    hair_buffers buffers = hair_buffers_default();
    buffers.attributes = HAIR_ATTRIBUTE_POSITION;
    hair_result result = hair_get_buffers(hair, dump->source, &buffers);
    if (result) return hair_exit_for(result);
    dump->strands = buffers.strand_count;
    dump->vertices = buffers.strand_vertices;
    dump->positions = calloc((size_t)dump->strands * dump->vertices + 1, 3 * sizeof *dump->positions);
    if (dump->positions) return HAIR_EXIT_OK;
    hair_complain(dump->tool, "out of memory for the positions of %u strands", dump->strands);
    return HAIR_EXIT_RUNTIME;
}

static int write_bytes(struct hair_dump* dump, const void* bytes, size_t size)
{
    if (fwrite(bytes, 1, size, dump->output.file) == size) return HAIR_EXIT_OK;
    hair_complain(dump->tool, "cannot write %s", dump->path);
    return HAIR_EXIT_RUNTIME;
}

int hair_dump_open(const char* tool, const char* path, hair_read_source source, hair_instance* hair,
                   const struct hair_dump_frames* frames, struct hair_dump* dump)
{
    *dump = (struct hair_dump){.tool = tool, .path = path, .source = source};
    if (!path) return HAIR_EXIT_OK;
    if (!hair_output_open(tool, path, &dump->output)) {
        dump->path = NULL;
        return HAIR_EXIT_RUNTIME;
    }
    int code = measure(dump, hair);
    struct header header = {.version = 1,
                            .strands = dump->strands,
                            .vertices = dump->vertices,
                            .frames = frames->count,
                            .first = frames->first,
                            .followers = source == HAIR_READ_FOLLOWERS,
                            .fps = frames->fps};
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(header.name, "HAIRDUMP", sizeof header.name);
    if (!code) code = write_bytes(dump, &header, sizeof header);
    if (code) hair_dump_discard(dump);
    return code;
}

int hair_dump_put(struct hair_dump* dump, hair_instance* hair)
{
    uint32_t count, room = dump->strands * dump->vertices;
    if (!dump->path) return HAIR_EXIT_OK;
    hair_result result = hair_read_positions(hair, dump->source, dump->positions, room, &count);
    if (result) return hair_exit_for(result);
    if (count != room) {
        hair_complain(dump->tool, "%s: the frame has %u vertices, but the first has %u", dump->path, count,
                      room);
        return HAIR_EXIT_RUNTIME;
    }
    return write_bytes(dump, dump->positions, (size_t)room * 3 * sizeof *dump->positions);
}

static void forget(struct hair_dump* dump)
{
    free(dump->positions);
    *dump = (struct hair_dump){0};
}

int hair_dump_commit(struct hair_dump* dump)
{
    bool ok = !dump->path || hair_output_commit(&dump->output);
    forget(dump);
    return ok ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

void hair_dump_discard(struct hair_dump* dump)
{
    if (dump->path) hair_output_discard(&dump->output);
    forget(dump);
}
