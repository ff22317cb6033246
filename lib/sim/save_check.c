// save_check.c - the header of a saved state, and the reading of its bytes without OpenGL. save.c
// describes the header.
#include "lib/sim/save_fields.h"

#include <string.h>

#include "lib/base/bytes.h"

#define HEADER HAIR_SAVE_HEADER
#define TRAILER HAIR_SAVE_TRAILER
#define MAGIC "hairsave"

void hair_save_seal(unsigned char* bytes, size_t end)
{
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(bytes, MAGIC, 8);
    hair_write_u32(bytes + 8, HAIR_SAVE_VERSION);
    hair_write_u64(bytes + 12, end + TRAILER);
    hair_write_u64(bytes + end, hair_hash_bytes(HAIR_HASH_BEGIN, bytes, end));
}

hair_result hair_save_check(const hair_host* host, const unsigned char* bytes, size_t size)
{
    if (size < HEADER + TRAILER || memcmp(bytes, MAGIC, 8) != 0)
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the %zu bytes are no saved state: it is longer, with \"" MAGIC "\" at byte 0",
                         size);
    uint32_t version = hair_read_u32(bytes + 8);
    uint64_t whole = hair_read_u64(bytes + 12);
    if (version != HAIR_SAVE_VERSION)
        return hair_fail(host, HAIR_ERROR_FILE, "the version at byte 8 of the saved state is %u, not %d",
                         version, HAIR_SAVE_VERSION);
    if (whole != size)
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the saved state ends at byte %zu, not at byte %llu as byte 12 says", size,
                         (unsigned long long)whole);
    if (hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size - TRAILER) != hair_read_u64(bytes + size - TRAILER))
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the saved state is damaged: the hash at byte %zu is not that of the bytes before",
                         size - TRAILER);
    return HAIR_OK;
}

hair_result hair_save_read(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded,
                           struct hair_colliders* colliders)
{
    hair_sim_serialize(s, sim, loaded);
    if (!s->result && s->at != s->end)
        s->result =
            hair_fail(s->host, HAIR_ERROR_FILE,
                      "the fields of the saved state end at byte %zu, not at byte %zu", s->at, s->end);
    if (!s->result) s->result = hair_pins_check(sim, loaded->resolved_pin, loaded->pins);
    if (s->result) return s->result;
    return hair_colliders_restore(s->host, colliders, loaded->now.collider, loaded->now.count,
                                  loaded->before.collider, loaded->before.count);
}
