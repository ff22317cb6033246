// save_fuzz.c - fuzz target of saved states, from the header to the last field.
//
// The simulation is a stub that has every buffer a field can be for. Uploads need OpenGL and are
// not part of the target. tests/gpu/save_hostile_test.c has them.
#include "tests/fuzz/fuzz.h"
#include "lib/base/bytes.h"
#include "lib/sim/save_fields.h"

#include <math.h>
#include <string.h>

#define GUIDES 2
#define VERTICES 7

// Bits of the byte that selects the simulation.
enum { WITHOUT_BEND = 1, WITHOUT_GRID = 2, WITHOUT_FLUID = 4, WITHOUT_SCALP = 8, WITHOUT_RODS = 16 };

// Names of the buffers of the stub. Those of HAIR_SERIALIZER_NEW get the last.
enum {
    STATE = 1,
    MATERIAL,
    HISTORY,
    BEND,
    ACCELERATION,
    ROOTS,
    SCALP,
    SCALP_TO_COME,
    TARGETS,
    TARGET_POSITIONS,
    TARGET_POSITIONS_TO_COME,
    AIR,
    ANCHORS,
    BUFFERS
};

static const unsigned char* contents[BUFFERS]; // in native byte order

// Copy a buffer of the stub, as OpenGL does.
static void APIENTRY get_buffer(GLuint buffer, GLintptr offset, GLsizeiptr size, void* out)
{
    HAIR_FUZZ_CHECK(buffer && buffer < BUFFERS && contents[buffer] && offset == 0);
    memcpy(out, contents[buffer], (size_t)size);
}

struct stub {
    struct hair_gl gl;
    struct hair_sim sim;
    struct hair_guide guides[GUIDES];
    struct hair_groom groom;
    struct hair_rods rods;
    struct hair_root_bindings bindings;
    hair_collision_mesh mesh;
    hair_collider collider;
};

static void make_stub(struct stub* stub, const struct hair_fuzz_host* host, unsigned kind)
{
    memset(stub, 0, sizeof *stub);
    struct hair_sim* sim = &stub->sim;
    stub->gl.host = host->host;
    stub->gl.GetNamedBufferSubData = get_buffer;
    stub->gl.memory.limit = stub->gl.memory.bytes = 1; // Buffers are read without a copy.
    stub->guides[0].count = 4, stub->guides[1].count = VERTICES - 4;
    stub->groom.guides = stub->guides;
    stub->groom.info.follower_count = 3;
    stub->rods.groom = &stub->groom;
    stub->bindings.vertex_count = 3;
    stub->mesh.content_hash = 0x0123456789abcdef;
    stub->mesh.holders = 1000000;
    stub->collider = hair_collider_default();
    stub->collider.shape = HAIR_SHAPE_MESH;
    stub->collider.mesh = &stub->mesh;
    *sim = (struct hair_sim){.gl = &stub->gl,
                             .asked_substep = 0.01,
                             .guides = GUIDES,
                             .guide_vertices = VERTICES,
                             .layout = 5,
                             .rods = kind & WITHOUT_RODS ? NULL : &stub->rods,
                             .state = STATE,
                             .material = MATERIAL,
                             .history = HISTORY,
                             .bend = kind & WITHOUT_BEND ? 0 : BEND};
    sim->colliders.current = (struct hair_collider_list){.collider = &stub->collider, .count = 1};
    sim->hair_grid.acceleration = kind & WITHOUT_GRID ? 0 : ACCELERATION;
    if (!(kind & WITHOUT_SCALP)) {
        sim->scalp_motion.root_bindings = &stub->bindings;
        sim->scalp_motion.root_transform = ROOTS;
        sim->scalp_motion.scalp[0] = SCALP;
        sim->scalp_motion.scalp[1] = SCALP_TO_COME;
    }
    sim->lengths.groom = &stub->groom;
    sim->targets.target = TARGETS;
    sim->targets.position[0] = TARGET_POSITIONS;
    sim->targets.position[1] = TARGET_POSITIONS_TO_COME;
    sim->wind_coupling.fluid.desc.cells = 2;
    sim->wind_coupling.fluid.desc.side = 1;
    if (!(kind & WITHOUT_FLUID)) sim->wind_coupling.fluid.gl = &stub->gl;
    sim->wind_coupling.fluid.velocity[0].buffer = AIR;
}

static bool has_meshes(const struct hair_collider_list* list)
{
    bool has = true;
    for (uint32_t i = 0; i < list->count; ++i)
        has &= list->collider[i].shape != HAIR_SHAPE_MESH || list->collider[i].mesh;
    return has;
}

// Return whether the simulation that was read keeps everything that was in the bytes. A collision
// mesh that it does not know is dropped, as the air of another fluid is.
static bool has_all(const struct hair_sim* sim, const struct hair_colliders* colliders, unsigned kind)
{
    return kind == 0 && !sim->wind_coupling.fluid.is_reset && has_meshes(&colliders->current) &&
           has_meshes(&colliders->previous);
}

// Write the fields of the simulation, and check that they are the bytes that were read.
static void check_round_trip(struct hair_sim* sim, const struct hair_serializer* read,
                             const struct hair_loaded* loaded, const struct hair_colliders* colliders)
{
    struct hair_loaded none = {0};
    for (uint32_t i = 0; i < read->buffers; ++i) {
        GLuint name = read->buffer[i].buffer == HAIR_SERIALIZER_NEW ? ANCHORS : read->buffer[i].buffer;
        contents[name] = read->native + read->buffer[i].at;
    }
    sim->colliders = *colliders;
    sim->pins.resolved_pin = loaded->resolved_pin;
    sim->pins.count = loaded->pins;
    sim->sleep.anchor = ANCHORS;
    uint32_t marks = hair_read_u32(read->read + HAIR_SAVE_HEADER);
    if (!(marks & HAIR_SAVE_SKINNED)) sim->scalp_motion.root_transform = 0;
    if (!(marks & HAIR_SAVE_TARGETS)) sim->targets.target = 0;
    if (marks & HAIR_SAVE_LENGTHS) {
        sim->lengths.guides = sim->lengths.groom->guides;
        sim->lengths.guide_fraction = loaded->guide_fraction;
        sim->lengths.follower_fraction = loaded->follower_fraction;
    }
    struct hair_serializer s = {.host = read->host, .gl = sim->gl, .at = HAIR_SAVE_HEADER};
    if (read->lacks_bend) sim->bend = 0;
    s.write = malloc(read->end);
    HAIR_FUZZ_CHECK(s.write);
    hair_sim_serialize(&s, sim, &none);
    HAIR_FUZZ_CHECK(!s.result && s.at == read->end);
    HAIR_FUZZ_CHECK(
        !memcmp(s.write + HAIR_SAVE_HEADER, read->read + HAIR_SAVE_HEADER, read->end - HAIR_SAVE_HEADER));
    free(s.write);
}

static void check(const struct hair_sim* sim, const struct hair_serializer* s,
                  const struct hair_loaded* loaded)
{
    HAIR_FUZZ_CHECK(isfinite(sim->accumulator) && sim->last_substep > 0 && isfinite(sim->last_substep));
    for (int k = 0; k < 3; ++k) HAIR_FUZZ_CHECK(fabs(sim->head.position[k]) <= 1e9);
    for (uint32_t i = 0; i < s->buffers; ++i)
        for (size_t k = 0; k < s->buffer[i].size; k += 4) {
            float number;
            memcpy(&number, s->native + s->buffer[i].at + k, sizeof number);
            HAIR_FUZZ_CHECK(fabs((double)number) <= HAIR_MAX_STATE);
        }
    HAIR_FUZZ_CHECK(loaded->now.count <= HAIR_MAX_COLLIDERS && loaded->before.count <= HAIR_MAX_COLLIDERS);
    for (uint32_t i = 0; i < loaded->pins; ++i)
        HAIR_FUZZ_CHECK(loaded->resolved_pin[i].guide < GUIDES && loaded->resolved_pin[i].vertex > 0);
}

static void free_loaded(const struct hair_host* host, struct hair_loaded* loaded,
                        struct hair_colliders* colliders, unsigned char* native)
{
    hair_free(host, loaded->now.collider);
    hair_free(host, loaded->before.collider);
    hair_free(host, loaded->resolved_pin);
    hair_free(host, loaded->guide_fraction);
    hair_free(host, loaded->follower_fraction);
    hair_colliders_free(host, colliders);
    hair_free(host, native);
}

// Read sealed bytes. The parts that hair_sim_load() does without OpenGL are those of save_check.c.
static bool read_sealed(const struct hair_fuzz_host* host, const unsigned char* bytes, size_t size,
                        unsigned kind, uint64_t* hash)
{
    static struct stub stub;
    struct hair_loaded loaded = {0};
    struct hair_colliders colliders = {0};
    make_stub(&stub, host, kind);
    if (hair_save_check(&host->host, bytes, size)) return false;
    if ((kind & WITHOUT_SCALP) && (hair_read_u32(bytes + HAIR_SAVE_HEADER) & HAIR_SAVE_SKINNED)) return false;
    struct hair_serializer s = {.host = &host->host,
                                .gl = &stub.gl,
                                .read = bytes,
                                .at = HAIR_SAVE_HEADER,
                                .end = size - HAIR_SAVE_TRAILER,
                                .native = hair_alloc(&host->host, 1, size)};
    bool ok = s.native && !hair_save_read(&s, &stub.sim, &loaded, &colliders);
    HAIR_FUZZ_CHECK(ok || !s.native || host->errors);
    if (ok) {
        hair_fuzz_end_refusals();
        check(&stub.sim, &s, &loaded);
        if (has_all(&stub.sim, &colliders, kind)) check_round_trip(&stub.sim, &s, &loaded, &colliders);
        *hash = hair_hash_bytes(*hash ? *hash : HAIR_HASH_BEGIN, bytes, size);
        for (uint32_t i = 0; i < loaded.pins; ++i) hair_fuzz_add(hash, loaded.resolved_pin[i].vertex);
        for (uint32_t i = 0; i < loaded.now.count; ++i) hair_fuzz_add(hash, loaded.now.collider[i].shape);
    }
    free_loaded(&host->host, &loaded, &colliders, s.native);
    return ok;
}

// The lowest byte of the size in the header selects the simulation. It is 0, the one that has
// everything, in a state with the right size.
HAIR_FUZZ(save)
{
    struct hair_fuzz_host host;
    hair_fuzz_host_init(&host);
    hair_save_check(&host.host, bytes, size);
    if (size < HAIR_SAVE_HEADER + 4 + HAIR_SAVE_TRAILER) return false;
    unsigned char* sealed = malloc(size);
    if (!sealed) return false;
    memcpy(sealed, bytes, size);
    hair_save_seal(sealed, size - HAIR_SAVE_TRAILER);
    bool accepted = read_sealed(&host, sealed, size, (bytes[12] ^ (unsigned)size) & 31, hash);
    free(sealed);
    HAIR_FUZZ_CHECK(host.blocks == 0);
    return accepted;
}
