// crowd.c - the hair-hair grid. The groom at rest determines its size and limits. The grid is
// filled and read at the start of every block.
#include "lib/sim/crowd.h"

#include "lib/sim/sim.h"

#define BLOCK (1.0 / 120) // Length of a block, s. A block is at least a substep long.
// Minimum distance between nodes, m. Cells smaller than the spacing of guides would hold no
// neighbours.
#define LEAST_CELL 0.01f
#define MOST_IN_BIN 32 // Maximum number of vertices sampled in a cell.
// Maximum length of a strand at a node, in cells, that the grid's units can hold. More counts as
// this.
#define MOST_OF_STRAND 16

// Place the grid around all that hair of its rest length can reach.
static void place_grid(struct hair_sim* sim, const struct hair_guide* guides, const struct hair_rest* rest)
{
    struct hair_crowd* crowd = &sim->crowd;
    float lower[3] = {INFINITY, INFINITY, INFINITY};
    float upper[3] = {-INFINITY, -INFINITY, -INFINITY}, widest = 0;
    for (uint32_t i = 0; i < sim->guides; ++i) {
        const float* root = &rest[guides[i].first].position.x;
        for (int k = 0; k < 3; ++k) {
            lower[k] = fminf(lower[k], root[k] - guides[i].arc_length);
            upper[k] = fmaxf(upper[k], root[k] + guides[i].arc_length);
            widest = fmaxf(widest, upper[k] - lower[k]);
        }
    }
    crowd->lower = hair_load3(lower);
    crowd->cell = fmaxf(LEAST_CELL, widest / (HAIR_CROWD_NODES - 1));
    HAIR_ASSERT(crowd->cell >= LEAST_CELL);
    for (int k = 0; k < 3; ++k) {
        uint32_t nodes = (uint32_t)ceilf((upper[k] - lower[k]) / crowd->cell) + 1;
        crowd->nodes[k] = nodes < 2 ? 2 : nodes < HAIR_CROWD_NODES ? nodes : HAIR_CROWD_NODES;
    }
}

static uint32_t node_count(const struct hair_crowd* crowd)
{
    return crowd->nodes[0] * crowd->nodes[1] * crowd->nodes[2];
}

// Return the number of vectors of four numbers, the unit in which the grid is cleared.
static uint32_t grid_fours(const struct hair_crowd* crowd)
{
    return (HAIR_CROWD_NODE_NUMBERS * node_count(crowd) + 3) / 4;
}

struct spot {
    uint32_t node[3]; // The lowest of the eight nodes around.
    float part[3]; // Fraction of the way to the next node, per axis.
};

static struct spot spot_of(const struct hair_crowd* crowd, const hair_vec4* position)
{
    const float at[3] = {position->x - crowd->lower.x, position->y - crowd->lower.y,
                         position->z - crowd->lower.z};
    struct spot spot;
    for (int k = 0; k < 3; ++k) {
        float g = fminf(fmaxf(at[k] / crowd->cell, 0), (float)(crowd->nodes[k] - 1));
        uint32_t n = (uint32_t)g;
        spot.node[k] = n < crowd->nodes[k] - 2 ? n : crowd->nodes[k] - 2;
        spot.part[k] = g - (float)spot.node[k];
        HAIR_ASSERT(0 <= spot.part[k] && spot.part[k] <= 1);
    }
    return spot;
}

static uint32_t node_at(const struct hair_crowd* crowd, uint32_t x, uint32_t y, uint32_t z)
{
    HAIR_ASSERT(x < crowd->nodes[0] && y < crowd->nodes[1] && z < crowd->nodes[2]);
    return x + crowd->nodes[0] * (y + crowd->nodes[1] * z);
}

// Arrays for the computation of the grid at rest.
struct draft {
    double* mass; // Mass of every vertex, half the length of its adjacent segments, m.
    double* volume; // Volume of every vertex, in cells.
    double* filled; // Volume at every node, in cells.
    uint32_t* bin; // Start of every cell in `vertex`.
    uint32_t* vertex; // Vertices sorted by cell.
};

static void weigh(const struct hair_sim* sim, const struct hair_guide* guides, const struct hair_rest* rest,
                  double* mass)
{
    for (uint32_t g = 0; g < sim->guides; ++g)
        for (uint32_t i = 0; i < guides[g].count; ++i) {
            uint32_t at = guides[g].first + i;
            double before = i > 0 ? (double)rest[at - 1].position.w : 0;
            mass[at] = (before + (double)rest[at].position.w) / 2;
        }
}

static void sort(const struct hair_sim* sim, const struct hair_rest* rest, struct draft* draft)
{
    const struct hair_crowd* crowd = &sim->crowd;
    for (int place = 0; place < 2; ++place) {
        for (uint32_t i = 0; i < sim->guide_vertices; ++i) {
            struct spot s = spot_of(crowd, &rest[i].position);
            uint32_t bin = node_at(crowd, s.node[0], s.node[1], s.node[2]);
            if (place)
                draft->vertex[draft->bin[bin + 1]++] = i;
            else
                ++draft->bin[bin + 2];
        }
        for (uint32_t n = 2; !place && n < node_count(crowd) + 2; ++n) draft->bin[n] += draft->bin[n - 1];
    }
}

// Return the mass around a vertex, with the weights that a node at the vertex would have. The
// minimum is the mass of a straight strand along an axis, the direction that puts the most mass
// into a node. A strand by itself thus fills no node, whatever its position and direction.
static double mass_around(const struct hair_sim* sim, const struct hair_rest* rest, const struct draft* draft,
                          uint32_t i)
{
    const struct hair_crowd* crowd = &sim->crowd;
    struct spot s = spot_of(crowd, &rest[i].position);
    double sum = 0, cell = (double)crowd->cell;
    for (uint32_t n = 0; n < 27; ++n) {
        uint32_t x = s.node[0] + n % 3 - 1, y = s.node[1] + n / 3 % 3 - 1, z = s.node[2] + n / 9 - 1;
        // A coordinate of -1 wraps to UINT32_MAX.
        if (x >= crowd->nodes[0] || y >= crowd->nodes[1] || z >= crowd->nodes[2]) continue;
        uint32_t bin = node_at(crowd, x, y, z), end = draft->bin[bin + 1];
        uint32_t stride = (end - draft->bin[bin] + MOST_IN_BIN - 1) / MOST_IN_BIN;
        for (uint32_t k = draft->bin[bin]; k < end; k += stride) {
            const hair_vec4 *a = &rest[i].position, *b = &rest[draft->vertex[k]].position;
            double wx = 1 - fabs((double)(a->x - b->x)) / cell, wy = 1 - fabs((double)(a->y - b->y)) / cell;
            double wz = 1 - fabs((double)(a->z - b->z)) / cell;
            if (wx > 0 && wy > 0 && wz > 0) sum += stride * draft->mass[draft->vertex[k]] * wx * wy * wz;
        }
    }
    HAIR_ASSERT(sum >= 0);
    return fmax(sum, fmax(cell, draft->mass[i]));
}

static void fill(const struct hair_sim* sim, const struct hair_rest* rest, struct draft* draft)
{
    const struct hair_crowd* crowd = &sim->crowd;
    for (uint32_t i = 0; i < sim->guide_vertices; ++i) {
        struct spot s = spot_of(crowd, &rest[i].position);
        draft->volume[i] = draft->mass[i] / mass_around(sim, rest, draft, i);
        for (uint32_t c = 0; c < 8; ++c) {
            double weight = draft->volume[i];
            for (int k = 0; k < 3; ++k) weight *= (c >> k & 1) ? (double)s.part[k] : 1 - (double)s.part[k];
            draft->filled[node_at(crowd, s.node[0] + (c & 1), s.node[1] + (c >> 1 & 1),
                                  s.node[2] + (c >> 2))] += weight;
        }
    }
}

// Upload the contributions of vertices in the grid's units. NULL for `volume` means 0.
static hair_result upload_shares(struct hair_sim* sim, const struct hair_guide* guides, const double* mass,
                                 const double* volume, GLuint* out)
{
    const hair_host* host = &sim->gl->host;
    uint32_t vertices = sim->guide_vertices;
    struct hair_share* share = hair_alloc(host, vertices, sizeof *share);
    double masses = 0, volumes = 0;
    if (!share) return hair_fail_memory(host, "the crowd's grid");
    for (uint32_t i = 0; i < vertices; ++i) masses += mass[i], volumes += volume ? volume[i] : 0;
    HAIR_ASSERT(masses > 0);
    for (uint32_t i = 0; i < vertices; ++i) {
        share[i].mass = (uint32_t)(mass[i] * (HAIR_CROWD_UNITS / masses) + 0.5);
        share[i].volume = volume ? (uint32_t)(volume[i] * (HAIR_CROWD_UNITS / volumes) + 0.5) : 0;
    }
    for (uint32_t g = 0; g < sim->guides; ++g)
        for (uint32_t i = 0, first = guides[g].first; i < guides[g].count; ++i)
            share[first + i].first = first, share[first + i].end = first + guides[g].count;
    hair_result result = hair_gl_storage(sim->gl, "hair share", vertices * sizeof *share, share, out);
    hair_free(host, share);
    return result;
}

// Upload the contributions of vertices and the volume limit of each node. A node exerts pressure
// above the volume of a full cell, or above its volume at rest if that is greater.
static hair_result upload(struct hair_sim* sim, const struct hair_guide* guides, const struct draft* draft)
{
    const hair_host* host = &sim->gl->host;
    struct hair_crowd* crowd = &sim->crowd;
    uint32_t nodes = node_count(crowd);
    float* limit = hair_alloc(host, nodes, sizeof *limit);
    double volume = 0;
    hair_result result = limit ? HAIR_OK : hair_fail_memory(host, "the crowd's grid");
    for (uint32_t i = 0; i < sim->guide_vertices; ++i) volume += draft->volume[i];
    HAIR_ASSERT(volume > 0);
    for (uint32_t n = 0; n < nodes && !result; ++n)
        limit[n] = (float)(fmax(draft->filled[n], 1) * (HAIR_CROWD_UNITS / volume));
    if (!result) result = upload_shares(sim, guides, draft->mass, draft->volume, &crowd->share);
    if (!result) result = hair_gl_storage(sim->gl, "hair limit", nodes * sizeof *limit, limit, &crowd->limit);
    hair_free(host, limit);
    return result;
}

static hair_result make_rest(struct hair_sim* sim, const struct hair_guide* guides,
                             const struct hair_rest* rest)
{
    const hair_host* host = &sim->gl->host;
    uint32_t vertices = sim->guide_vertices, nodes;
    place_grid(sim, guides, rest);
    nodes = node_count(&sim->crowd);
    struct draft draft = {0};
    draft.mass = hair_alloc(host, vertices, sizeof *draft.mass);
    draft.volume = hair_alloc(host, vertices, sizeof *draft.volume);
    draft.filled = hair_alloc(host, nodes, sizeof *draft.filled);
    draft.bin = hair_alloc(host, nodes + 2, sizeof *draft.bin);
    draft.vertex = hair_alloc(host, vertices, sizeof *draft.vertex);
    int whole = draft.mass && draft.volume && draft.filled && draft.bin && draft.vertex;
    hair_result result = whole ? HAIR_OK : hair_fail_memory(host, "the crowd's grid");
    if (!result) {
        weigh(sim, guides, rest, draft.mass);
        sim->crowd.metres = 0;
        for (uint32_t i = 0; i < vertices; ++i) sim->crowd.metres += draft.mass[i];
        sort(sim, rest, &draft);
        HAIR_ASSERT(draft.bin[nodes] == vertices);
        fill(sim, rest, &draft);
        result = upload(sim, guides, &draft);
    }
    hair_free(host, draft.mass);
    hair_free(host, draft.volume);
    hair_free(host, draft.filled);
    hair_free(host, draft.bin);
    hair_free(host, draft.vertex);
    return result;
}

hair_result hair_crowd_weigh(struct hair_sim* sim, GLuint* share, double* metres)
{
    const hair_host* host = &sim->gl->host;
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    double* mass = hair_alloc(host, sim->guide_vertices, sizeof *mass);
    if (!mass) return hair_fail_memory(host, "the lengths of guides");
    weigh(sim, guides, rest, mass);
    *metres = 0;
    for (uint32_t i = 0; i < sim->guide_vertices; ++i) *metres += mass[i] / HAIR_CROWD_UNITS;
    hair_result result = upload_shares(sim, guides, mass, NULL, share);
    hair_free(host, mass);
    return result;
}

hair_result hair_crowd_make(struct hair_sim* sim, const struct hair_guide* guides,
                            const struct hair_rest* rest)
{
    struct hair_gl* gl = sim->gl;
    struct hair_crowd* crowd = &sim->crowd;
    if (!hair_crowd_is_on(sim) || crowd->texture) return HAIR_OK;
    hair_result result = make_rest(sim, guides, rest);
    if (!result) result = hair_gl_need_rows(gl, HAIR_GL_CROWD_CLEAR, HAIR_GL_CROWD_GATHER, 0);
    size_t grid = (size_t)grid_fours(crowd) * 4 * sizeof(int32_t);
    if (!result) result = hair_gl_uniform(gl, "hair crowd", sizeof(struct hair_crowd_params), &crowd->params);
    if (!result) result = hair_gl_storage(gl, "hair crowd", grid, NULL, &crowd->grid);
    if (!result)
        result =
            hair_gl_storage(gl, "hair push", sim->guide_vertices * sizeof(hair_vec4), NULL, &crowd->push);
    if (!result) result = hair_gl_buffer_texture(gl, "hair push", GL_RGBA32F, crowd->push, &crowd->texture);
    if (result) hair_crowd_free(sim);
    return result;
}

hair_result hair_sim_need_crowd(struct hair_sim* sim)
{
    return sim->rods ? hair_crowd_make(sim, sim->rods->guides, sim->rods->rest) : HAIR_OK;
}

void hair_crowd_free(struct hair_sim* sim)
{
    struct hair_crowd* crowd = &sim->crowd;
    hair_gl_free_buffer_texture(sim->gl, &crowd->texture);
    hair_gl_free_buffer(sim->gl, &crowd->params);
    hair_gl_free_buffer(sim->gl, &crowd->grid);
    hair_gl_free_buffer(sim->gl, &crowd->share);
    hair_gl_free_buffer(sim->gl, &crowd->limit);
    hair_gl_free_buffer(sim->gl, &crowd->push);
}

static uint32_t block_length(const struct hair_sim* sim)
{
    HAIR_ASSERT(sim->substep > 0);
    uint32_t substeps = (uint32_t)(BLOCK / sim->substep + 0.5);
    return substeps < 1 ? 1 : substeps;
}

static void write_params(const struct hair_sim* sim, struct hair_crowd_params* params)
{
    const struct hair_crowd* crowd = &sim->crowd;
    double time = block_length(sim) * sim->substep, rate = (double)sim->physics.cohesion;
    float sound = 0.5f * crowd->cell / (float)time; // Half a cell per block is stable.
    hair_quat q = sim->last_after.rotation;
    hair_vec3 moved = hair_pose_offset(&sim->last_after, &sim->last_before);
    // The fraction of a relative velocity after a block is exp(-rate time), for any length of the
    // block.
    *params = (struct hair_crowd_params){
        .rotation = {q.x, q.y, q.z, q.w},
        .moved = {moved.x, moved.y, moved.z, (float)(1 / sim->last_substep)},
        .lower = {crowd->lower.x, crowd->lower.y, crowd->lower.z, crowd->cell},
        .nodes_x = crowd->nodes[0],
        .nodes_y = crowd->nodes[1],
        .nodes_z = crowd->nodes[2],
        .vertices = sim->guide_vertices,
        .cohesion = (float)(-expm1(-rate * time) / time),
        .pressure_stiffness = fminf(sim->physics.pressure_stiffness, sound * sound),
        .per_strand = (float)(crowd->metres / HAIR_CROWD_UNITS) / (MOST_OF_STRAND * crowd->cell),
        .ahead = HAIR_CROWD_SPEED * 0.5f * (float)time / crowd->cell,
    };
}

static void find_push(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_crowd* crowd = &sim->crowd;
    struct hair_crowd_params params;
    GLuint storage[] = {sim->state, crowd->grid, sim->history, crowd->share, crowd->limit, crowd->push};
    uint32_t groups = (sim->guide_vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE;
    HAIR_ASSERT(crowd->texture && sim->last_substep > 0);
    write_params(sim, &params);
    hair_gl_write_uniform(gl, crowd->params, sizeof params, &params);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_CROWD_PARAMS, 1, &crowd->params);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_STATE, 6, storage);
    hair_gl_run(gl, HAIR_GL_CROWD_CLEAR, (grid_fours(crowd) + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_run(gl, HAIR_GL_CROWD_SPLAT, groups);
    hair_gl_run(gl, HAIR_GL_CROWD_GATHER, groups);
}

uint32_t hair_crowd_left(struct hair_sim* sim)
{
    uint32_t length = block_length(sim);
    if (sim->crowd.beat >= length) sim->crowd.beat = 0; // Substeps have become longer.
    if (sim->crowd.beat == 0) {
        find_push(sim);
        hair_sim_bind(sim);
        hair_sim_bind_rods(sim);
    }
    return length - sim->crowd.beat;
}

void hair_crowd_bind(struct hair_sim* sim)
{
    sim->gl->BindTextureUnit(HAIR_UNIT_PUSH, sim->crowd.texture);
}

void hair_crowd_count(struct hair_sim* sim, uint32_t substeps)
{
    sim->crowd.beat = (sim->crowd.beat + substeps) % block_length(sim);
}
