// memory.c - the record of every buffer and texture: its size, the instance that owns it and its
// category in reports.
#include "lib/gl/buffers.h"

// Slots are a hash table with linear probing, never more than half full. A name of 0 marks a free
// slot.
struct hair_gl_allocation {
    GLuint name;
    bool is_texture; // Buffers and textures have names of their own.
    hair_gl_category category;
    uint64_t bytes;
    struct hair_gl_owner* owner; // NULL if no report counts the object.
    const void* data; // Data of a shared buffer. NULL if the object has one user.
    uint32_t users; // Number of users of a shared buffer.
};

static uint32_t find_home(const struct hair_gl_memory* memory, GLuint name, bool is_texture)
{
    return (2 * name + is_texture) & (memory->room - 1);
}

// Return the slot of an object, or the free slot where it belongs.
static uint32_t find_slot(const struct hair_gl_memory* memory, GLuint name, bool is_texture)
{
    const struct hair_gl_allocation* slots = memory->allocations;
    HAIR_ASSERT(name && memory->room > memory->count);
    uint32_t slot = find_home(memory, name, is_texture);
    while (slots[slot].name && (slots[slot].name != name || slots[slot].is_texture != is_texture))
        slot = (slot + 1) & (memory->room - 1);
    return slot;
}

bool hair_gl_memory_grow(struct hair_gl* gl)
{
    struct hair_gl_memory* memory = &gl->memory;
    if (2 * (memory->count + 1) <= memory->room) return true;
    struct hair_gl_memory grown = *memory;
    grown.room = memory->room ? 2 * memory->room : 64;
    grown.allocations = hair_alloc(&gl->host, grown.room, sizeof *grown.allocations);
    if (!grown.allocations) return false;
    for (uint32_t i = 0; i < memory->room; ++i) {
        const struct hair_gl_allocation* old = &memory->allocations[i];
        if (old->name) grown.allocations[find_slot(&grown, old->name, old->is_texture)] = *old;
    }
    hair_free(&gl->host, memory->allocations);
    *memory = grown;
    return true;
}

// Change the size of an object.
static void set_bytes(struct hair_gl_memory* memory, struct hair_gl_allocation* of, uint64_t bytes)
{
    HAIR_ASSERT(memory->bytes >= of->bytes);
    memory->bytes += bytes - of->bytes;
    if (memory->bytes > memory->peak) memory->peak = memory->bytes;
    if (of->owner) of->owner->bytes[of->category] += bytes - of->bytes;
    of->bytes = bytes;
}

void hair_gl_memory_set_limit(struct hair_gl* gl, uint64_t bytes)
{
    gl->memory.limit = bytes;
}

bool hair_gl_memory_allows(const struct hair_gl_memory* memory, uint64_t size)
{
    return !memory->limit || (memory->bytes <= memory->limit && size <= memory->limit - memory->bytes);
}

hair_result hair_gl_memory_ask(struct hair_gl* gl, const char* label, uint64_t size)
{
    const struct hair_gl_memory* memory = &gl->memory;
    if (hair_gl_memory_allows(memory, size))
        return hair_gl_memory_grow(gl) ? HAIR_OK : hair_fail_memory(&gl->host, label);
    return hair_fail(&gl->host, HAIR_ERROR_MEMORY,
                     "%s: %llu more bytes than the %llu in use would be beyond the limit of %llu", label,
                     (unsigned long long)size, (unsigned long long)memory->bytes,
                     (unsigned long long)memory->limit);
}

void hair_gl_memory_add(struct hair_gl* gl, hair_gl_category category, bool is_texture, GLuint name,
                        uint64_t size)
{
    struct hair_gl_memory* memory = &gl->memory;
    HAIR_ASSERT(2 * (memory->count + 1) <= memory->room && (unsigned)category <= HAIR_GL_NO_CATEGORY);
    struct hair_gl_allocation* to = &memory->allocations[find_slot(memory, name, is_texture)];
    HAIR_ASSERT(!to->name);
    *to = (struct hair_gl_allocation){.name = name, .is_texture = is_texture, .category = category};
    if (category != HAIR_GL_NO_CATEGORY) to->owner = gl->owner;
    ++memory->count;
    set_bytes(memory, to, size);
}

void hair_gl_memory_resize(struct hair_gl* gl, GLuint buffer, uint64_t size)
{
    struct hair_gl_allocation* of = &gl->memory.allocations[find_slot(&gl->memory, buffer, false)];
    HAIR_ASSERT(of->name);
    set_bytes(&gl->memory, of, size);
}

void hair_gl_memory_remove(struct hair_gl* gl, bool is_texture, GLuint name)
{
    struct hair_gl_memory* memory = &gl->memory;
    struct hair_gl_allocation* slots = memory->allocations;
    uint32_t hole = find_slot(memory, name, is_texture), mask = memory->room - 1;
    HAIR_ASSERT(slots[hole].name);
    set_bytes(memory, &slots[hole], 0);
    // Objects behind the hole move up to it, unless it lies before their home.
    for (uint32_t i = (hole + 1) & mask; slots[i].name; i = (i + 1) & mask) {
        uint32_t home = find_home(memory, slots[i].name, slots[i].is_texture);
        if (((i - home) & mask) < ((i - hole) & mask)) continue;
        slots[hole] = slots[i];
        hole = i;
    }
    slots[hole].name = 0;
    --memory->count;
}

GLuint hair_gl_memory_join(struct hair_gl* gl, const void* data)
{
    struct hair_gl_memory* memory = &gl->memory;
    for (uint32_t i = 0; i < memory->room; ++i) {
        struct hair_gl_allocation* of = &memory->allocations[i];
        if (!of->name || of->data != data) continue;
        ++of->users;
        return of->name;
    }
    return 0;
}

void hair_gl_memory_open(struct hair_gl* gl, GLuint buffer, const void* data)
{
    struct hair_gl_allocation* of = &gl->memory.allocations[find_slot(&gl->memory, buffer, false)];
    HAIR_ASSERT(of->name && !of->data && !of->owner && data);
    of->data = data;
    of->users = 1;
}

bool hair_gl_memory_leave(struct hair_gl* gl, GLuint buffer)
{
    struct hair_gl_allocation* of = &gl->memory.allocations[find_slot(&gl->memory, buffer, false)];
    HAIR_ASSERT(of->name && (!of->data || of->users > 0));
    return of->data && --of->users > 0;
}
