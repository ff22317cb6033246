// cache.c - compiled programs in a cache that the application provides.
//
//   byte  0  "hairprog"
//         8  u64 the second hash of the sources. The first is the key of the cache entry.
//        16  u32 the driver's format
//        20  the driver's bytes
//   the end  u64 FNV-1a hash of all bytes before
//
// An entry of another form, or one that the driver rejects, counts as missing. The program is then
// compiled and stored again.
#include "lib/base/bytes.h"
#include "lib/gl/gl.h"

#define MAGIC "hairprog"
#define HEADER 20
#define TRAILER 8
#define MAX_BYTES (64u << 20) // Maximum bytes of one program.
#define MAX_FORMATS 64
#define OTHER_HASH 0x9e3779b97f4a7c15u // Initial value of the second hash.

void hair_gl_key_add(struct hair_gl_key* key, const char* text)
{
    size_t size = text ? strlen(text) + 1 : 0;
    key->hash = hair_hash_bytes(key->hash, text, size);
    key->check = hair_hash_bytes(key->check, text, size);
}

struct hair_gl_key hair_gl_key_begin(struct hair_gl* gl)
{
    static const GLenum driver[] = {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION};
    struct hair_gl_key key = {HAIR_HASH_BEGIN, OTHER_HASH};
    for (int i = 0; i < 4; ++i) hair_gl_key_add(&key, (const char*)gl->GetString(driver[i]));
    return key;
}

// Return whether the driver knows the format. An unknown format would raise the application's
// error flag.
static bool is_known(struct hair_gl* gl, GLenum format)
{
    GLint formats[MAX_FORMATS], count = 0;
    gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    if (count <= 0 || count > MAX_FORMATS) return false;
    gl->GetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats);
    for (GLint i = 0; i < count; ++i)
        if ((GLenum)formats[i] == format) return true;
    return false;
}

static bool is_whole(const unsigned char* bytes, size_t size, struct hair_gl_key key)
{
    HAIR_ASSERT(size > HEADER + TRAILER);
    return memcmp(bytes, MAGIC, 8) == 0 && hair_read_u64(bytes + 8) == key.check &&
           hair_read_u64(bytes + size - TRAILER) == hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size - TRAILER);
}

static bool load_program(struct hair_gl* gl, const unsigned char* bytes, size_t size, GLuint program)
{
    GLint done = 0;
    GLenum format = hair_read_u32(bytes + 16);
    if (!is_known(gl, format)) return false;
    gl->ProgramBinary(program, format, bytes + HEADER, (GLsizei)(size - HEADER - TRAILER));
    gl->GetProgramiv(program, GL_LINK_STATUS, &done);
    return done != 0;
}

bool hair_gl_cache_load(struct hair_gl* gl, struct hair_gl_key key, GLuint program)
{
    const hair_cache* cache = &gl->cache;
    size_t size = cache->get ? cache->get(key.hash, NULL, 0, cache->user) : 0;
    if (size <= HEADER + TRAILER || size > MAX_BYTES) return false;
    unsigned char* bytes = hair_alloc(&gl->host, size, 1);
    if (!bytes) return false; // The program can be compiled without the cache.
    int there = cache->get(key.hash, bytes, size, cache->user) == size && is_whole(bytes, size, key) &&
                load_program(gl, bytes, size, program);
    hair_free(&gl->host, bytes);
    return there;
}

void hair_gl_cache_store(struct hair_gl* gl, struct hair_gl_key key, GLuint program)
{
    const hair_cache* cache = &gl->cache;
    GLint length = 0;
    GLsizei got = 0;
    GLenum format = 0;
    if (!cache->put) return;
    gl->GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0 || length > (GLint)(MAX_BYTES - HEADER - TRAILER)) return;
    unsigned char* bytes = hair_alloc(&gl->host, (size_t)length + HEADER + TRAILER, 1);
    if (!bytes) return;
    gl->GetProgramBinary(program, length, &got, &format, bytes + HEADER);
    size_t size = (size_t)got + HEADER;
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the bytes are no string.
    memcpy(bytes, MAGIC, 8);
    hair_write_u64(bytes + 8, key.check);
    hair_write_u32(bytes + 16, format);
    hair_write_u64(bytes + size, hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size));
    if (got > 0) cache->put(key.hash, bytes, size + TRAILER, cache->user);
    hair_free(&gl->host, bytes);
}
